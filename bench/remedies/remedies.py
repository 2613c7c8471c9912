"""Draws the chart of `phlux bench remedies` (efficiency with and without); writes its section of the report.

    python3 remedies.py FOLDER
"""
import sys
from functools import partial

import chart_style as style
import matplotlib.pyplot as plt

TITLES = {
    "light-selection": "Light selection by contribution (before: by power)",
    "connections": "Russian roulette on the connections of long paths (before: all connections)",
    "exact-lobe": "Sampling and MIS weights by the exact lobe (before: lobe-ks)",
}
NEAR_TICKS = (0.5, 0.6, 0.7, 0.8, 0.9, 1, 1.1, 1.2, 1.4)
TICKS = (0.5, 0.7, 1, 1.5, 2, 3, 5, 10, 20, 50, 100, 1000, 10000, 100000)


def method_of(row):
    return f"{row.integrator} {row.connect_or_weights}"


def draw(rows, theme):
    remedies = list(dict.fromkeys(row.remedy for row in rows))
    methods = list(dict.fromkeys(method_of(row) for row in rows))
    places = {remedy: list(dict.fromkeys(row.place for row in rows if row.remedy == remedy)) for remedy in remedies}
    heights = [len(places[remedy]) + 1.5 for remedy in remedies]
    figure, panels = plt.subplots(len(remedies), 1, figsize=(9, 0.9 + 0.36 * sum(heights)), squeeze=False,
                                  gridspec_kw={"height_ratios": heights})
    for remedy, axes in zip(remedies, panels[:, 0]):
        for row in (row for row in rows if row.remedy == remedy):
            i = methods.index(method_of(row))
            y = places[remedy].index(row.place) + 0.2 * (i - (len(methods) - 1) / 2)
            error = 2 * row.gain_standard_error
            axes.errorbar(row.gain, y, xerr=[[min(error, 0.9 * row.gain)], [error]], color=theme.color(i),
                          marker=style.MARKERS[i], ls="none", lw=0.8, label=method_of(row))
        axes.axvline(1, color=theme.ink, lw=0.8)
        axes.set_xscale("log")
        low, high = min(0.8, axes.get_xlim()[0]), max(1.25, axes.get_xlim()[1])
        axes.set_xlim(low, high)
        ticks = [tick for tick in (TICKS if high > 3 * low else NEAR_TICKS) if low <= tick <= high]
        axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
        axes.set_xticks([], minor=True)
        axes.set_yticks(range(len(places[remedy])), places[remedy])
        axes.set_ylim(len(places[remedy]) - 0.5, -0.5)
        axes.grid(True, axis="x")
        axes.set_title(TITLES[remedy], loc="left")
    panels[-1, 0].set_xlabel("efficiency gain: (variance x time) before / after")
    height = figure.get_figheight()
    figure.subplots_adjust(0.2, 0.75 / height, 0.98, 1 - 0.3 / height, hspace=0.45)
    known = {}
    for axes in panels[:, 0]:
        for handle, label in zip(*axes.get_legend_handles_labels()):
            known.setdefault(label, handle)
    figure.legend(known.values(), known.keys(), loc="lower center", ncol=len(known))
    return figure


def main():
    folder = sys.argv[1]
    rows = style.read(folder, "remedies.csv")
    style.save_all(folder, [("remedies", partial(draw, rows))])
    table = [[row.remedy, row.place, method_of(row), row.gain, row.gain_standard_error, row.variance_before,
              row.variance_after, row.rays_per_sample_before, row.rays_per_sample_after] for row in rows]
    style.section(
        folder, "remedies", title="Techniques that reduce variance", order=55,
        text=["Each technique lowers the variance and leaves the mean unchanged. Renders with and without it alternate, with the same "
              "seeds. The gain is (variance x time) without the technique, divided by that with it; its standard error comes from "
              "those of the two variances. If a few samples dominate the variance without it, the gain is a lower bound."],
        summary={"columns": ["remedy", "scene", "method", "gain", "standard error", "variance before", "after",
                             "rays per sample before", "after"], "rows": table,
                 "note": "Variances are relative variances of one sample per pixel."},
        charts=[{"svg": "remedies.svg", "title": "Gain of each technique",
                 "caption": "Error bars are two standard errors. With a gain below 1, a technique costs more time than it saves."}],
        tables=[{"csv": "remedies.csv", "title": "All results"}])


if __name__ == "__main__":
    main()
