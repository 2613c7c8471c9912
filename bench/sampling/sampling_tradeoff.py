"""The chart of variance against cost: a panel for each case and condition, with lines of equal time to a given error."""
import math
import textwrap

import chart_style as style
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FixedLocator, MaxNLocator, NullLocator
from sampling_ranking import CONDITIONS, CONSTANT, LIGHTS, STRATEGIES, WINNERS, number_text, result_text

PANEL, LABELS = (2.5, 2.7), 1.7  # inches: a panel, and the column of labels at its right
MARGINS = {"left": 0.8, "right": 0.05, "top": 0.9, "bottom": 0.5}
GAP = (0.45, 1.05)
INTERVAL = 1.96  # standard errors of a 95% interval
# A strategy is in the frame if its variance x cost and its cost are at most these multiples of those of the best that has
# variance.
FRAMED, FRAMED_COST = 8, 2.5
LEAST_SPAN = 1.3  # of an axis: largest over smallest value
LABEL_HEIGHT = 0.135  # inches
MULTIPLES = (1, 1.02, 1.05, 1.1, 1.2, 1.5, 2, 3, 5, 10, 20, 50, 100)


def name_of(material, cell):
    return f"$k_d$ = {material[0]:g}, $k_s$ = {material[1]:g}, $n$ = {cell[0]:g}, θ = {cell[1]:g}°"


def product(row):
    return row.relative_variance * row.cost_ns


def frame_of(rows):
    """Limits of the two axes that contain the error bars of the strategies that are not outliers."""
    best = min(rows, key=product)
    inside = [row for row in rows
              if product(row) <= FRAMED * product(best) and row.cost_ns <= FRAMED_COST * best.cost_ns]
    limits = []
    for value, error in (("cost_ns", "cost_standard_error"), ("relative_variance", "relative_variance_standard_error")):
        lows = [getattr(row, value) - INTERVAL * getattr(row, error) for row in inside]
        highs = [getattr(row, value) + INTERVAL * getattr(row, error) for row in inside]
        middles = [getattr(row, value) for row in inside]
        low, high = np.log(max(min(lows), min(middles) / 2)), np.log(min(max(highs), max(middles) * 2))
        middle, half = (low + high) / 2, max(high - low, math.log(LEAST_SPAN)) / 2
        limits.append(np.exp((middle - 1.15 * half, middle + 1.15 * half)))
    return limits


def ticks_of(low, high):
    """Three to seven round values."""
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    for mantissas in ((1,), (1, 3), (1, 2, 5), (1, 1.5, 2, 3, 5, 7)):
        values = [mantissa * 10.0**power for power in powers for mantissa in mantissas]
        values = [value for value in values if low <= value <= high]
        if 3 <= len(values) <= 7:
            return values
    return [value for value in MaxNLocator(5).tick_values(low, high) if low <= value <= high]


def set_scales(axes, frame):
    axes.spines[:].set_visible(True)
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis, limits, set_limits in ((axes.xaxis, frame[0], axes.set_xlim), (axes.yaxis, frame[1], axes.set_ylim)):
        values = ticks_of(*limits)
        axis.set_major_locator(FixedLocator(values))
        axis.set_minor_locator(NullLocator())
        axis.set_major_formatter(lambda value, _: f"{value:.6g}")
        set_limits(limits)


def draw_equal_times(axes, frame, best, theme):
    """Lines of equal variance x cost, labelled by the multiple of the best."""
    corners = frame[0] * frame[1] / best
    step = math.log(corners[1] / corners[0]) / 6
    drawn = []
    for multiple in MULTIPLES:
        if corners[0] < multiple < corners[1] and (not drawn or math.log(multiple / drawn[-1]) > step):
            drawn.append(multiple)
    for multiple in drawn:
        axes.plot(frame[0], multiple * best / frame[0], color=theme.grid, lw=0.9, zorder=0)
        at_right = multiple * best / frame[0][1]
        x, y = (frame[0][1], at_right) if at_right > frame[1][0] else (multiple * best / frame[1][0], frame[1][0])
        axes.annotate(f"×{multiple:g}", (x, y), (-2, 1), textcoords="offset points", ha="right", va="bottom", fontsize=6.5,
                      color=theme.muted, zorder=0)


def spread(heights, distance):
    """Descending heights in [0, 1], moved so that neighbours are this far apart."""
    moved = []
    for height in heights:
        moved.append(min(height, moved[-1] - distance) if moved else min(height, 1))
    for i in reversed(range(len(moved))):
        moved[i] = max(moved[i], moved[i + 1] + distance if i + 1 < len(moved) else 0)
    return moved


def label_of(row, x, y):
    """The strategy; of an outlier with the number that the frame does not reach."""
    outside = ""
    if y != row.relative_variance:
        outside += (" ↑ " if row.relative_variance > y else " ↓ ") + number_text(row.relative_variance)
    if x != row.cost_ns:
        outside += (" → " if row.cost_ns > x else " ← ") + number_text(row.cost_ns) + " ns"
    return row.strategy + outside


def draw_panel(axes, entries, theme):
    compared = [row for row in entries if row.compared]
    varying = [row for row in compared if row.relative_variance > CONSTANT]
    if not varying:
        axes.set_axis_off()
        return
    frame = frame_of(varying)
    set_scales(axes, frame)
    draw_equal_times(axes, frame, min(map(product, varying)), theme)
    labels = []
    for row in compared:
        i = STRATEGIES.index(row.strategy)
        x, y = np.clip(row.cost_ns, *frame[0]), np.clip(row.relative_variance, *frame[1])
        if (x, y) == (row.cost_ns, row.relative_variance):
            axes.errorbar(x, y, INTERVAL * row.relative_variance_standard_error, INTERVAL * row.cost_standard_error,
                          color=theme.color(i), lw=1, capsize=1.5, capthick=0.8)
        axes.plot(x, y, color=theme.color(i), marker=style.MARKERS[i % len(style.MARKERS)], ls="none", clip_on=False, zorder=3)
        place = axes.transAxes.inverted().transform(axes.transData.transform((x, y)))
        labels.append((place[1], label_of(row, x, y), place, theme.color(i), row.verdict in WINNERS))
    labels += [(-0.1, f"{row.strategy}: {row.verdict.split()[0]}", None, theme.muted, False)
               for row in entries if not row.compared]
    labels.sort(key=lambda label: -label[0])
    heights = spread([label[0] for label in labels], LABEL_HEIGHT / PANEL[1])
    for (_, text, place, color, wins), height in zip(labels, heights):
        if place is not None:
            axes.plot((place[0], 1.05), (place[1], height), color=color, lw=0.5, alpha=0.55, transform=axes.transAxes,
                      clip_on=False, zorder=1)
        axes.text(1.06, height, text, transform=axes.transAxes, va="center", fontsize=7, color=color,
                  fontweight="bold" if wins else "normal")


def draw_tradeoff(rows, cases, light, theme):
    """rows: of the ranking. cases: (material, cell) of each line of panels."""
    conditions = [condition for condition in CONDITIONS if any(row.roulette == condition for row in rows)]
    width = MARGINS["left"] + MARGINS["right"] + len(conditions) * (PANEL[0] + LABELS) + (len(conditions) - 1) * GAP[0]
    height = MARGINS["top"] + MARGINS["bottom"] + len(cases) * PANEL[1] + (len(cases) - 1) * GAP[1]
    figure = plt.figure(figsize=(width, height))
    for line, case in enumerate(cases):
        for column, condition in enumerate(conditions):
            left = MARGINS["left"] + column * (PANEL[0] + LABELS + GAP[0])
            bottom = height - MARGINS["top"] - PANEL[1] - line * (PANEL[1] + GAP[1])
            axes = figure.add_axes((left / width, bottom / height, PANEL[0] / width, PANEL[1] / height))
            entries = [row for row in rows if (row.material, row.cell) == case and row.integrand == light
                       and row.roulette == condition]
            draw_panel(axes, entries, theme)
            title = "\n".join(textwrap.wrap(result_text(entries), 70, break_on_hyphens=False))
            axes.set_title(f"{name_of(*case)}, {CONDITIONS[condition]}\n{title}", loc="left", fontsize=7.5, pad=8)
            axes.set_xlabel(f"nanoseconds per sample: sampler and {rows[0].ray_ns:.3g} per ray")
            if column == 0:
                axes.set_ylabel("relative variance of one sample")
    figure.text(0.5, 1 - 0.12 / height, f"Variance against cost of one sample in {LIGHTS[light]}", ha="center", va="top",
                fontsize=10)
    return figure
