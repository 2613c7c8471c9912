"""The charts of `phlux bench sampling`: maps of each strategy's cost, maps of the best strategy, variance against speed."""
import math
from collections import defaultdict

import chart_style as style
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.patches import Patch, Rectangle
from sampling_efficiency import COST_MODELS, LARGEST_MARGIN, LIGHTS, ROUNDING, STRATEGIES, margin_of, ranked, relative_cost


def exponent_text(n):
    if n < 1000:
        return f"{n:g}"
    power = round(math.log10(n))
    return f"$10^{power}$" if n == 10**power else f"{n:g}"


def name_of(material):
    return f"$k_d$ = {material[0]:g}, $k_s$ = {material[1]:g}"


def set_grid(axes, exponents, angles, labelled=True):
    style.set_grid(axes, [exponent_text(n) for n in exponents], [f"{angle:g}" if labelled else "" for angle in angles])


def draw_cell(axes, x, y, color, **more):
    axes.add_patch(Rectangle((x - 0.5, y - 0.5), 1, 1, facecolor=color, edgecolor="none", **more))


def panels_of(lines, columns, panel, *, gap=(0.25, 0.4), left=0.65, right=0.15, top=0.65, bottom=0.55, **more):
    """lines x columns panels of fixed size, gaps and margins in inches: automatic layout would take a second per chart."""
    width = left + columns * panel[0] + (columns - 1) * gap[0] + right
    height = top + lines * panel[1] + (lines - 1) * gap[1] + bottom
    figure, panels = plt.subplots(lines, columns, figsize=(width, height), squeeze=False, **more)
    figure.subplots_adjust(left / width, bottom / height, 1 - right / width, 1 - top / height, gap[0] / panel[0],
                           gap[1] / panel[1])
    return figure, panels


def title_of(figure, text):
    size = min(11, 130 * figure.get_figwidth() / len(text))  # points; smaller where the figure is narrow
    figure.text(0.5, 1 - 0.12 / figure.get_figheight(), text, ha="center", va="top", fontsize=size)


def legend_below(figure, handles):
    figure.legend(handles.values(), handles.keys(), loc="lower center", ncol=max(3, int(figure.get_figwidth() / 1.6)))


def draw_heat(rows, material, exponents, angles, light, theme):
    chosen = {(row.strategy, *row.cell): row for row in rows if row.material == material and row.integrand == light}
    costs = [relative_cost(row) for row in chosen.values() if not row.marks and row.n in exponents
             and row.theta_deg in angles and row.variance > (ROUNDING * row.exact) ** 2]
    norm = LogNorm(min(costs), max(costs), clip=True)
    colors = plt.get_cmap(style.SEQUENTIAL + "_r")
    figure, panels = panels_of(3, 4, (2.3, 2.2), gap=(0.15, 0.32), right=1.0, sharex=True, sharey=True)
    for axes, strategy in zip(panels.flat, STRATEGIES):
        for x, n in enumerate(exponents):
            for y, angle in enumerate(angles):
                row = chosen.get((strategy, n, angle))
                if row is None or "infinite-variance-suspected" in row.marks:
                    draw_cell(axes, x, y, theme.wash)
                    axes.text(x, y, "–" if row is None else "∞", ha="center", va="center", fontsize=7, color=theme.muted)
                    continue
                color = colors(norm(max(relative_cost(row), min(costs))))
                draw_cell(axes, x, y, color)
                if row.marks:
                    sign = "b" if "biased" in row.marks else "?"
                    axes.text(x, y, sign, ha="center", va="center", fontsize=7, color=theme.on(color))
        set_grid(axes, exponents, angles)
        axes.set_title(strategy, fontsize=9)
    for axes in panels[-1]:
        axes.set_xlabel("$n$")
    for axes in panels[:, 0]:
        axes.set_ylabel("θ, degrees")
    place = figure.add_axes((1 - 0.85 / figure.get_figwidth(), 0.3, 0.016, 0.4))
    bar = figure.colorbar(plt.cm.ScalarMappable(norm, colors), cax=place)
    bar.set_label("relative variance × nanoseconds per sample (log)")
    bar.outline.set_visible(False)
    title_of(figure, f"Cost of each strategy under {LIGHTS[light]}, {name_of(material)}")
    return figure


def margin_text(margin):
    if margin >= LARGEST_MARGIN:
        return "≫"
    return f"{margin:.{2 if margin < 1.095 else 1 if margin < 9.95 else 0}f}"


def draw_winners_panel(axes, rows, exponents, angles, model, theme):
    """Colours each cell by its best strategy; returns these strategies."""
    cells, winners = defaultdict(list), set()
    for row in rows:
        cells[row.cell].append(row)
    for x, n in enumerate(exponents):
        for y, angle in enumerate(angles):
            entries = ranked(cells[n, angle], model)
            if not entries:
                continue
            margin, significant = margin_of(entries, model)
            strategy = entries[0][1].strategy
            winners.add(strategy)
            draw_cell(axes, x, y, theme.color(STRATEGIES.index(strategy)), alpha=1 if significant else 0.45)
            if significant:
                axes.text(x, y, margin_text(margin), ha="center", va="center", fontsize=6, color=theme.paper)
    return winners


def draw_winners(tables, grids, light, theme):
    """tables: the rows with roulette, and those without."""
    figure, panels = panels_of(len(COST_MODELS), len(grids), (2.8 if len(grids) > 1 else 5.5, 2.6), left=1.0, bottom=1.0,
                               sharex="col")
    winners = set()
    for number, (line, model) in enumerate(zip(panels, COST_MODELS)):
        for axes, (material, (exponents, angles)) in zip(line, grids.items()):
            labelled = axes is line[0] or angles != next(iter(grids.values()))[1]
            rows = [row for row in tables[not model.roulette] if row.material == material and row.integrand == light]
            winners |= draw_winners_panel(axes, rows, exponents, angles, model, theme)
            set_grid(axes, exponents, angles, labelled)
            if number == 0:
                axes.set_title(name_of(material), fontsize=9)
            if number == len(COST_MODELS) - 1:
                axes.set_xlabel("$n$")
        line[0].set_ylabel(f"{model.title}\nθ, degrees")
    patches = {strategy: Patch(facecolor=theme.color(i)) for i, strategy in enumerate(STRATEGIES) if strategy in winners}
    legend_below(figure, patches)
    title_of(figure, f"The strategy with the least variance × cost under {LIGHTS[light]}")
    return figure


def widen(axes):
    """Extends each axis to a decade and a half at least, so that it has several labels."""
    for limits, set_limits in ((axes.get_xlim(), axes.set_xlim), (axes.get_ylim(), axes.set_ylim)):
        middle, half = np.mean(np.log10(limits)), max(0.75, np.ptp(np.log10(limits)) / 2)
        set_limits(10 ** (middle - half), 10 ** (middle + half))


def draw_tradeoff(rows, cases, light, theme):
    figure, panels = panels_of(1, len(cases), (2.7 if len(cases) > 1 else 5.5, 2.7), gap=(0.45, 0), left=0.75, bottom=1.1)
    for axes, case in zip(panels[0], cases):
        points = [row for row in rows if (row.material, row.cell) == case and row.integrand == light
                  and row.variance > 0 and not {"infinite-variance-suspected", "unresolved"} & set(row.marks)]
        speed = np.array([1e3 / row.ns_per_sample for row in points])
        variance = np.array([row.variance / row.exact**2 for row in points])
        for row, x, y in zip(points, speed, variance):
            i = STRATEGIES.index(row.strategy)
            axes.plot(x, y, color=theme.color(i), marker=style.MARKERS[i], ls="none", label=row.strategy,
                      markerfacecolor=theme.paper if row.marks else theme.color(i))
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.margins(0.12)
        widen(axes)
        limits = axes.get_xlim(), axes.get_ylim()
        x = np.array(limits[0])
        for efficiency in np.logspace(-9, 9, 37):  # variance / speed
            axes.plot(x, x * efficiency, color=theme.grid, lw=0.8, zorder=0)
        axes.set_xlim(limits[0])
        axes.set_ylim(limits[1])
        (kd, ks), (n, angle) = case
        axes.set_title(f"{name_of((kd, ks))}, $n$ = {n:g}, θ = {angle:g}°", fontsize=8)
        axes.set_xlabel("million samples per second")
    panels[0][0].set_ylabel("relative variance of a sample")
    handles = {}
    for axes in panels[0]:
        for handle, label in zip(*axes.get_legend_handles_labels()):
            handles.setdefault(label, handle)
    legend_below(figure, handles)
    title_of(figure, f"Variance against speed under {LIGHTS[light]}")
    return figure
