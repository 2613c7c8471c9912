"""Draws the chart of `phlux bench roulette` (variance x rays of each roulette in whole renders); writes its section of the
report.

    python3 roulette.py FOLDER
"""
import math
import sys
from functools import partial

import chart_style as style
import matplotlib.pyplot as plt

TICKS = (0.1, 0.3, 1, 3, 10, 30, 100)
FINE_TICKS = (0.3, 0.4, 0.6, 0.8, 1, 1.2, 1.5, 2, 3, 4)
DEPTHS = {1: "from edge 1", 5: "from edge 5", -1: "no roulette"}


def series_of(row):
    return row.roulette if row.strategy == "exact" else f"{row.strategy}, {row.roulette}"


def name_of(row, one_roulette):
    """The label of a row in the chart: its strategy if the others have the same roulette."""
    return row.strategy if one_roulette else series_of(row)


def variant_of(row):
    return series_of(row) if row.rr_depth < 0 else f"{series_of(row)} {DEPTHS[int(row.rr_depth)]}"


def draw(rows, theme):
    """A line of panels for each integrator, a column for each edge at which roulette begins."""
    rows = [row for row in rows if row.roulette != "strategy" or row.strategy != "exact"]  # with which they are compared
    one_roulette = len({row.roulette for row in rows if row.rr_depth > 0}) == 1
    integrators = list(dict.fromkeys(row.integrator for row in rows))
    scenes = list(dict.fromkeys(row.scene for row in rows))
    depths = [depth for depth in DEPTHS if any(row.rr_depth == depth for row in rows)]
    series = list(dict.fromkeys(name_of(row, one_roulette) for row in rows if row.rr_depth > 0))
    high = len(scenes) * (0.3 + 0.05 * len(series))
    figure, panels = plt.subplots(len(integrators), len(depths), figsize=(9, 1.2 + (high + 0.6) * len(integrators)),
                                  sharex=True, sharey=True, squeeze=False)
    for integrator, line in zip(integrators, panels):
        for depth, axes in zip(depths, line):
            own = [row for row in rows if (row.integrator, row.rr_depth) == (integrator, depth)]
            for row in own:
                name = name_of(row, one_roulette)
                i = series.index(name) if name in series else 0
                color = theme.ink if name not in series else theme.color(i % len(style.SERIES))
                y = scenes.index(row.scene) + 0.8 * ((i + 0.5) / len(series) - 0.5) * (name in series)
                axes.errorbar(row.ratio, y, xerr=2 * row.ratio_standard_error, color=color, ls="none", lw=0.8, ms=4.5,
                              marker=style.MARKERS[i % len(style.MARKERS)], label=name,
                              mfc=color if i < len(style.SERIES) else "none")
            axes.axvline(1, color=theme.ink, lw=0.8)
            axes.grid(True, axis="x")
            axes.set_title(f"{integrator}, {DEPTHS[depth]}", loc="left", fontsize="medium")
    axes = panels[0, 0]
    least = min(row.ratio for row in rows)
    most = max(row.ratio for row in rows)
    axes.set_xscale("log")
    axes.set_xlim(min(0.8, least / 1.2), max(1.25, most * 1.2))
    ticks = [tick for tick in (TICKS if most > 8 * least else FINE_TICKS) if axes.get_xlim()[0] <= tick <= axes.get_xlim()[1]]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.set_xticks([], minor=True)
    axes.set_yticks(range(len(scenes)), scenes)
    axes.set_ylim(len(scenes) - 0.5, -0.5)
    known = {}
    for axes in panels.flat:
        for handle, label in zip(*axes.get_legend_handles_labels()):
            if label in series:
                known.setdefault(label, handle)
    height, lines = figure.get_figheight(), -(-len(known) // 5)
    figure.supxlabel("variance x rays, relative to --roulette strategy --rr-depth 5", fontsize="medium",
                     y=(0.2 + 0.22 * lines) / height)
    figure.subplots_adjust(0.17, (0.7 + 0.22 * lines) / height, 0.98, 1 - 0.3 / height, hspace=0.25, wspace=0.08)
    figure.legend(known.values(), known.keys(), loc="lower center", ncol=5)
    return figure


def summary(folder, rows):
    """The geometric mean over the scenes of each variant's ratio, by integrator."""
    integrators = list(dict.fromkeys(row.integrator for row in rows))
    variants = list(dict.fromkeys(variant_of(row) for row in rows))
    scenes = len({row.scene for row in rows})
    lines = []
    for variant in variants:
        line = [variant]
        for integrator in integrators:
            ratios = [row.ratio for row in rows if row.integrator == integrator
                      and variant_of(row) == variant]
            complete = len(ratios) == scenes
            line.append(math.exp(sum(math.log(ratio) for ratio in ratios) / len(ratios)) if complete else "-")
        lines.append(line)
    return {"text": style.read_verdict(folder, "roulette"), "columns": ["roulette", *integrators], "rows": lines,
            "note": "Variance x rays, relative to --roulette strategy --rr-depth 5: geometric mean over the scenes; - if the "
                    "renderer refuses the variant on one of them."}


def main():
    folder = sys.argv[1]
    rows = style.read(folder, "roulette.csv")
    style.save_all(folder, [("roulette", partial(draw, rows))])
    style.section(
        folder, "roulette", title="Russian roulette in whole renders", order=56,
        text=["Results are the variance of one sample times its number of rays, relative to --roulette strategy --rr-depth 5, from "
              "renders with the same seeds. Rays are counted, so that other programs on the machine do not matter. Standard errors "
              "come from the jackknife over the rounds."],
        summary=summary(folder, rows),
        charts=[{"svg": "roulette.svg", "title": "Variance x rays of each roulette",
                 "caption": "Left of 1, fewer rays are needed for the same error. Error bars are two standard errors."}],
        tables=[{"csv": "roulette.csv", "title": "All results"}])


if __name__ == "__main__":
    main()
