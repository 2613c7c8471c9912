"""Draws what `phlux bench sampling` measured: heat maps of each strategy's cost, maps of which strategy wins where, and
speed against accuracy; writes the section of the report.

    python3 sampling.py FOLDER
"""
import math
import sys
from collections import Counter, defaultdict
from functools import partial

import chart_style as style
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.patches import Patch, Rectangle

STRATEGIES = ("uniform", "theta-phi", "cosine", "disk", "rejection", "lobe-ks", "lobe-estimate-printed", "lobe-estimate",
              "lobe-rho", "mixture", "fold", "exact")
LIGHTS = {
    "constant": "constant light",
    "mirror-disk": "a bright disk about the mirror direction",
    "horizon-sky": "a sky that is bright at the horizon",
}
MOST_MARGIN = 1000
ROUNDING = 1e-6


class View:
    """What is compared: with strategies absorbing by roulette as they are made to or not, and what a ray costs, in
    samples of lobe-ks."""

    def __init__(self, title, roulette, ray_cost):
        self.title, self.roulette, self.ray_cost = title, roulette, ray_cost

    def cost(self, row):
        return row.ns_per_sample + self.ray_cost * row.unit_time * row.rays_per_sample

    def relative_error(self, row):
        """Of variance x cost; of a median over rounds, a quarter of their range over the root of their number."""
        of_variance = row.variance_standard_error / row.variance if row.variance > 0 else 0
        of_time = (row.ns_most - row.ns_least) / 4 / math.sqrt(row.rounds) / self.cost(row)
        return math.hypot(of_variance, of_time)


# A ray costs about as much where it is traced through half a million triangles (bench/PERFORMANCE.md).
RAY_COST = 20
VIEWS = (View("roulette, rays are free", True, 0), View(f"roulette, a ray costs {RAY_COST} samples", True, RAY_COST),
         View(f"no roulette, a ray costs {RAY_COST} samples", False, RAY_COST))


def read_rows(folder):
    """Rows with strategies absorbing as they are made to, and rows without absorption."""
    rows, without = style.read(folder, "sampling.csv"), style.read(folder, "sampling-no-roulette.csv")
    bare = [row for row in rows if row.roulette == 0] + without
    for row in rows + without:
        row.marks = row.marks.split() if isinstance(row.marks, str) else []
        row.material = (row.kd, row.ks)
        row.place = (row.n, row.theta_deg)
    times = defaultdict(list)
    measured = {row.strategy for row in rows}
    for row in rows:
        if row.strategy == "lobe-ks" or "lobe-ks" not in measured:
            times[row.material, row.place, row.integrand].append(row.ns_per_sample)
    for row in rows + without:
        row.unit_time = float(np.median(times[row.material, row.place, row.integrand]))
    return rows, bare


def grid_of(rows):
    """The exponents and angles of which every combination was measured."""
    angles = defaultdict(set)
    for row in rows:
        angles[row.n].add(row.theta_deg)
    most = max(map(len, angles.values()))
    exponents = sorted(n for n in angles if len(angles[n]) == most)
    return exponents, sorted(set.intersection(*(angles[n] for n in exponents)))


def materials_of(rows):
    """Materials that were measured over a grid, with their exponents and angles."""
    grids = {}
    for material in dict.fromkeys(row.material for row in rows):
        exponents, angles = grid_of([row for row in rows if row.material == material])
        if len(exponents) > 1 and len(angles) > 1:
            grids[material] = exponents, angles
    return grids


def exponent_text(n):
    if n < 1000:
        return f"{n:g}"
    power = round(math.log10(n))
    return f"$10^{power}$" if n == 10**power else f"{n:g}"


def name_of(material):
    return f"$k_d$ = {material[0]:g}, $k_s$ = {material[1]:g}"


def set_grid(axes, exponents, angles, labelled=True):
    axes.set_xlim(-0.5, len(exponents) - 0.5)
    axes.set_ylim(-0.5, len(angles) - 0.5)
    axes.set_xticks(range(len(exponents)), [exponent_text(n) for n in exponents])
    axes.set_yticks(range(len(angles)), [f"{angle:g}" if labelled else "" for angle in angles])
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)


def cell(axes, x, y, color, **more):
    axes.add_patch(Rectangle((x - 0.5, y - 0.5), 1, 1, facecolor=color, edgecolor="none", **more))


def panels_of(lines, columns, panel, *, gap=(0.25, 0.4), left=0.65, right=0.15, top=0.65, bottom=0.55, **more):
    """Panels of a size, and gaps and margins around them, in inches: matplotlib's own layout takes a second a chart."""
    width = left + columns * panel[0] + (columns - 1) * gap[0] + right
    height = top + lines * panel[1] + (lines - 1) * gap[1] + bottom
    figure, panels = plt.subplots(lines, columns, figsize=(width, height), squeeze=False, **more)
    figure.subplots_adjust(left / width, bottom / height, 1 - right / width, 1 - top / height, gap[0] / panel[0],
                           gap[1] / panel[1])
    return figure, panels


def title_of(figure, text):
    size = min(11, 130 * figure.get_figwidth() / len(text))  # a narrow figure has less room for it
    figure.text(0.5, 1 - 0.12 / figure.get_figheight(), text, ha="center", va="top", fontsize=size)


def legend_below(figure, handles):
    figure.legend(handles.values(), handles.keys(), loc="lower center", ncol=max(3, int(figure.get_figwidth() / 1.6)))


# ---- Heat maps


def relative_cost(row):
    """Nanoseconds of sampling until the variance of the mean is the mean's square."""
    return row.variance / row.exact**2 * row.ns_per_sample


def draw_heat(rows, material, exponents, angles, light, theme):
    chosen = {(row.strategy, *row.place): row for row in rows if row.material == material and row.integrand == light}
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
                    cell(axes, x, y, theme.wash)
                    axes.text(x, y, "–" if row is None else "∞", ha="center", va="center", fontsize=7, color=theme.muted)
                    continue
                color = colors(norm(max(relative_cost(row), min(costs))))
                cell(axes, x, y, color)
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


# ---- Who wins


def contest(rows, view):
    """The rows that may win, by variance times cost, the best first. What varies by float32's rounding alone counts as
    that."""
    entries = [(max(row.variance, (ROUNDING * row.exact) ** 2) * view.cost(row), row) for row in rows if not row.marks]
    return sorted(entries, key=lambda entry: entry[0])


def margin_of(entries, view):
    """By how much the best wins, and whether that is more than the errors of both explain."""
    if len(entries) < 2:
        return MOST_MARGIN, True
    (best, first), (second, other) = entries[:2]
    margin = min(MOST_MARGIN, second / best)
    error = math.hypot(view.relative_error(first), view.relative_error(other))
    return margin, margin > 1.02 and math.log(margin) > 2 * error


def margin_text(margin):
    if margin >= MOST_MARGIN:
        return "≫"
    return f"{margin:.{2 if margin < 1.095 else 1 if margin < 9.95 else 0}f}"


def draw_winners(tables, grids, light, theme):
    figure, panels = panels_of(len(VIEWS), len(grids), (2.8 if len(grids) > 1 else 5.5, 2.6), left=1.0, bottom=1.0,
                               sharex="col")
    seen = set()
    for number, (line, view) in enumerate(zip(panels, VIEWS)):
        for axes, (material, (exponents, angles)) in zip(line, grids.items()):
            labelled = axes is line[0] or angles != next(iter(grids.values()))[1]
            cells = defaultdict(list)
            for row in tables[not view.roulette]:
                if row.material == material and row.integrand == light:
                    cells[row.place].append(row)
            for x, n in enumerate(exponents):
                for y, angle in enumerate(angles):
                    entries = contest(cells[n, angle], view)
                    if not entries:
                        continue
                    margin, clear = margin_of(entries, view)
                    strategy = entries[0][1].strategy
                    seen.add(strategy)
                    cell(axes, x, y, theme.color(STRATEGIES.index(strategy)), alpha=1 if clear else 0.45)
                    if clear:
                        axes.text(x, y, margin_text(margin), ha="center", va="center", fontsize=6, color=theme.paper)
            set_grid(axes, exponents, angles, labelled)
            if number == 0:
                axes.set_title(name_of(material), fontsize=9)
            if number == len(VIEWS) - 1:
                axes.set_xlabel("$n$")
        line[0].set_ylabel(f"{view.title}\nθ, degrees")
    patches = {strategy: Patch(facecolor=theme.color(i)) for i, strategy in enumerate(STRATEGIES) if strategy in seen}
    legend_below(figure, patches)
    title_of(figure, f"The strategy with the least variance × cost under {LIGHTS[light]}")
    return figure


# ---- Speed against accuracy


def widen(axes):
    """Makes the axes span a decade and a half at least, so that each has labels."""
    for limits, set_limits in ((axes.get_xlim(), axes.set_xlim), (axes.get_ylim(), axes.set_ylim)):
        middle, half = np.mean(np.log10(limits)), max(0.75, np.ptp(np.log10(limits)) / 2)
        set_limits(10 ** (middle - half), 10 ** (middle + half))


def draw_tradeoff(rows, cases, light, theme):
    figure, panels = panels_of(1, len(cases), (2.7 if len(cases) > 1 else 5.5, 2.7), gap=(0.45, 0), left=0.75, bottom=1.1)
    for axes, case in zip(panels[0], cases):
        points = [row for row in rows if (row.material, row.place) == case and row.integrand == light
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
    title_of(figure, f"Speed against accuracy under {LIGHTS[light]}")
    return figure


# ---- The section


def losses(rows, view):
    """For each strategy, how many times the best strategy's variance x cost it needs, over all cases that it is fit for;
    and how often it is the best."""
    cells, times, wins = defaultdict(list), defaultdict(list), Counter()
    for row in rows:
        cells[row.material, row.place, row.integrand].append(row)
    for of_cell in cells.values():
        entries = contest(of_cell, view)
        if entries:
            wins[entries[0][1].strategy] += 1
            for product, row in entries:
                times[row.strategy].append(product / entries[0][0])
    return times, wins


def relative_times(rows):
    """Time per sample over that of lobe-ks in the same case."""
    times = defaultdict(list)
    for row in rows:
        times[row.strategy].append(row.ns_per_sample / row.unit_time)
    return times


def summary_of(rows, lights):
    times = relative_times(rows)
    results = {light: losses([row for row in rows if row.integrand == light], VIEWS[1]) for light in lights}
    lines = []
    for strategy in STRATEGIES:
        of_strategy = [row for row in rows if row.strategy == strategy]
        if not of_strategy:
            continue
        line = [strategy, float(np.median(times[strategy])) if times[strategy] else ""]
        for light in lights:
            factors, wins = results[light]
            if factors[strategy]:
                line += [wins[strategy], *map(float, np.quantile(factors[strategy], (0.5, 0.9)))]
            else:
                line += ["", "", ""]
        line += [sum(bool(row.marks) for row in of_strategy), len(of_strategy)]
        lines.append(line)
    columns = ["strategy", "time"]
    for light in lights:
        columns += [f"{light}: best in", "median loss", "90% below"]
    note = ("time: over that of lobe-ks, median; loss, its median and what nine of ten cases are below: variance × cost over "
            "that of the best strategy in the same case, with roulette where the strategy has it and a ray that costs "
            f"{RAY_COST} samples of lobe-ks. Marked rows (biased, suspected of infinite variance, or with too few samples) "
            "neither win nor count.")
    return {"columns": columns + ["marked", "of"], "rows": lines, "note": note}


def write_section(folder, rows, lights, charts):
    text = [
        "One sample of the reflected radiance, for every way to sample a direction. The variance of a sample says little "
        "without what it costs: strategies that absorb by roulette trace fewer rays. The least variance × cost wins; the "
        "cost is the sampler's time alone, as if rays were free, or the rays that it sends on, as if all else were.",
        "lobe-estimate-printed, the estimate as CW 197 prints it, is biased: it loses the share of the lobe that its own "
        "sample finds below the surface. Its variance diverges logarithmically as well (a sample that is drawn with "
        "probability e weighs 1/e, and e may be as small as one likes), so it is given none and takes no part. A row is "
        "unresolved when the standard error of its variance is above a third of it: too few samples met what matters.",
    ]
    style.section(folder, "sampling", title="Sampling strategies", order=20, text=text,
                  summary=summary_of(rows, lights), charts=charts,
                  tables=[{"csv": "sampling.csv", "title": "All figures",
                           "columns": ["strategy", "kd", "ks", "n", "theta_deg", "integrand", "samples", "mean", "exact",
                                       "bias_sigma", "variance", "variance_standard_error", "rays_per_sample",
                                       "ns_per_sample", "ns_least", "ns_most", "variance_times_cost", "marks"]}])


def main():
    folder = sys.argv[1]
    rows, bare = read_rows(folder)
    grids = materials_of(rows)
    lights = [light for light in LIGHTS if any(row.integrand == light for row in rows)]
    cases = list(dict.fromkeys((row.material, row.place) for row in rows))[:4]
    charts, drawings = [], []

    def chart(name, draw, title, caption):
        drawings.append((name, draw))
        charts.append({"svg": name + ".svg", "title": title, "caption": caption})

    if grids:
        for light in lights:
            chart(f"sampling-winners-{light}", partial(draw_winners, (rows, bare), grids, light),
                  f"Who wins under {LIGHTS[light]}",
                  "The number is how many times the runner-up's variance × cost is that of the winner (≫: 1000 or more); "
                  "pale, without a number: the difference is within the errors of the variances and times.")
    for light in lights:
        chart(f"sampling-tradeoff-{light}", partial(draw_tradeoff, rows, cases, light),
              f"Speed against accuracy under {LIGHTS[light]}",
              "Strategies on one gray line are equally efficient; further right and down is better. Hollow: biased.")
    if grids:
        material = (0.4, 0.4) if (0.4, 0.4) in grids else next(iter(grids))
        for light in lights:
            chart(f"sampling-cost-{light}", partial(draw_heat, rows, material, *grids[material], light),
                  f"Cost of each strategy under {LIGHTS[light]}",
                  "Nanoseconds of sampling until the variance of the mean is the square of the mean. ∞: the variance is "
                  "suspected to be infinite; b: biased; ?: too few samples to tell; –: not measured, too many proposals.")
    style.save_all(folder, drawings)
    write_section(folder, rows, lights, charts)


if __name__ == "__main__":
    main()
