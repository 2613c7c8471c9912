"""Draws the chart of `phlux bench roulette` (variance x rays of each roulette in whole renders); writes its section of the
report.

    python3 roulette.py FOLDER
"""
import math
import sys
from functools import partial

import chart_style as style
import matplotlib.pyplot as plt

TICKS = (0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1, 1.2, 1.5, 2, 3, 5, 10)
DEPTHS = {1: "from edge 1", 5: "from edge 5", -1: ""}  # filled from 5 on, open from 1 on


def series_of(row):
    return row.roulette if row.strategy == "exact" else f"{row.strategy}, {row.roulette}"


def variant_of(row):
    return f"{series_of(row)} {DEPTHS[int(row.rr_depth)]}".strip()


def draw(rows, theme):
    integrators = list(dict.fromkeys(row.integrator for row in rows))
    scenes = list(dict.fromkeys(row.scene for row in rows))
    series = list(dict.fromkeys(series_of(row) for row in rows))
    high = len(scenes) * (0.42 + 0.05 * max(0, len(series) - 5))
    figure, panels = plt.subplots(len(integrators), 1, figsize=(9, 1.2 + (high + 0.55) * len(integrators)), squeeze=False)
    for integrator, axes in zip(integrators, panels[:, 0]):
        for row in (row for row in rows if row.integrator == integrator):
            i = series.index(series_of(row))
            y = scenes.index(row.scene) + 0.7 * ((i + 0.5) / len(series) - 0.5)
            color = theme.color(i % len(style.SERIES))
            axes.errorbar(row.ratio, y, xerr=2 * row.ratio_standard_error, color=color, ls="none", lw=0.8, ms=5,
                          marker=style.MARKERS[i % len(style.MARKERS)], mfc="none" if row.rr_depth == 1 else color,
                          label=variant_of(row))
        axes.axvline(1, color=theme.ink, lw=0.8)
        axes.set_xscale("log")
        low, most = axes.get_xlim()
        axes.set_xlim(min(0.8, low), max(1.25, most))
        ticks = [tick for tick in TICKS if min(0.8, low) <= tick <= max(1.25, most)]
        axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
        axes.set_xticks([], minor=True)
        axes.set_yticks(range(len(scenes)), scenes)
        axes.set_ylim(len(scenes) - 0.5, -0.5)
        axes.grid(True, axis="x")
        axes.set_title(integrator, loc="left")
    panels[-1, 0].set_xlabel("variance x rays, relative to --roulette strategy --rr-depth 5")
    known = {}
    for axes in panels[:, 0]:
        for handle, label in zip(*axes.get_legend_handles_labels()):
            known.setdefault(label, handle)
    height, lines = figure.get_figheight(), -(-len(known) // 4)
    figure.subplots_adjust(0.2, (0.65 + 0.22 * lines) / height, 0.98, 1 - 0.3 / height, hspace=0.3)
    figure.legend(known.values(), known.keys(), loc="lower center", ncol=4)
    return figure


def summary(folder, rows):
    """The geometric mean over the scenes of each variant's ratio, by integrator."""
    integrators = list(dict.fromkeys(row.integrator for row in rows))
    variants = list(dict.fromkeys(variant_of(row) for row in rows))
    lines = []
    for variant in variants:
        line = [variant]
        for integrator in integrators:
            ratios = [row.ratio for row in rows if row.integrator == integrator
                      and variant_of(row) == variant]
            line.append(math.exp(sum(math.log(ratio) for ratio in ratios) / len(ratios)))
        lines.append(line)
    return {"text": style.read_verdict(folder, "roulette"), "columns": ["roulette", *integrators], "rows": lines,
            "note": "Variance x rays, relative to --roulette strategy --rr-depth 5: geometric mean over the scenes."}


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
                 "caption": "Left of 1, fewer rays are needed for the same error. Open marks: roulette from edge 1 on. "
                            "Error bars are two standard errors."}],
        tables=[{"csv": "roulette.csv", "title": "All results"}])


if __name__ == "__main__":
    main()
