"""Draws the charts of `phlux bench arithmetic` (error against time of formulas); writes its section of the report.

    python3 arithmetic.py FOLDER
"""
import math
import sys
from functools import partial

import chart_style as style
import matplotlib.pyplot as plt
from matplotlib.ticker import NullFormatter

LEAST_ERROR = 1e-9  # smaller errors are drawn as this
LEAST_TIME = 0.02  # nanoseconds; smaller times are not distinguishable from the timing loop
WHAT = {
    "lobe": "cos$^n$ of the angle between two directions",
    "sine": "sin(α) of a lobe sample",
    "frame": "a frame about a direction: deviation from orthonormal",
    "turns": "cosine and sine of 2πu: absolute error",
    "offset": "offset of a position from its surface: distance",
}
PLAIN = ("frame", "turns", "offset")
FUNCTIONS = ("exp", "log", "log1p", "expm1", "sqrt", "rsqrt", "divide")


def time_of(row):
    return max(row.ns_per_value, LEAST_TIME)


def draw_points(axes, rows, names, theme):
    """A point for each formula at its root mean square error, and a line up to its largest error."""
    for row in rows:
        i = names.index(row.formula)
        look = {**theme.series(i), "linestyle": "none"}
        typical, largest = max(row.rms_relative, LEAST_ERROR), max(row.largest_relative, LEAST_ERROR)
        axes.plot([time_of(row)] * 2, [typical, largest], color=theme.color(i), lw=1)
        axes.plot(time_of(row), typical, label=row.formula, ms=6, **look)
        if row.used:
            axes.plot(time_of(row), typical, marker="o", ms=12, mfc="none", mec=theme.ink, mew=1, ls="none")
        if row.failed:
            axes.annotate(f"{row.failed / row.values:.2g} fail", (time_of(row), largest), xytext=(0, 4),
                          textcoords="offset points", ha="center", fontsize=7, color=theme.muted)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.grid(True)
    axes.margins(0.2, 0.15)
    low, high = (math.log10(limit) for limit in axes.get_xlim())
    if high - low < 1.5:  # decades: fewer would not leave room for the labels
        middle = (low + high) / 2
        axes.set_xlim(10 ** (middle - 0.75), 10 ** (middle + 0.75))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.yaxis.set_minor_formatter(NullFormatter())


def draw_powers(rows, group, theme):
    exponents = sorted({row.n for row in rows if row.group == group})
    names = list(dict.fromkeys(row.formula for row in rows if row.group == group))
    figure, panels = plt.subplots(1, len(exponents), figsize=(11, 4.3), sharex=True, sharey=True)
    for axes, n in zip(panels, exponents):
        draw_points(axes, [row for row in rows if row.group == group and row.n == n], names, theme)
        axes.set_title(f"$n$ = {n:,.0f}", fontsize=9)
        axes.set_xlabel("ns per value")
    panels[0].set_ylabel("relative error, rms to largest")
    figure.subplots_adjust(0.07, 0.33, 0.99, 0.86, 0.08)
    figure.legend(*panels[0].get_legend_handles_labels(), loc="lower center", ncol=3)
    figure.text(0.53, 0.97, WHAT[group], ha="center", va="top", fontsize=11)
    return figure


def draw_plain(rows, theme):
    figure, panels = plt.subplots(1, len(PLAIN), figsize=(11, 4.5))
    for axes, group in zip(panels, PLAIN):
        of_group = [row for row in rows if row.group == group]
        draw_points(axes, of_group, [row.formula for row in of_group], theme)
        axes.set_title(WHAT[group], fontsize=8.5)
        axes.set_xlabel("ns per value")
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncol=1)
    panels[0].set_ylabel("error, rms to largest")
    figure.subplots_adjust(0.07, 0.38, 0.99, 0.93, 0.22)
    return figure


def draw_functions(rows, theme):
    chosen = [row for group in FUNCTIONS for row in rows if row.group == group]
    figure, axes = plt.subplots(figsize=(8, 0.8 + 0.26 * len(chosen)))
    places, place, last = [], 0, None
    for row in chosen:
        place += 1.4 if last not in (None, row.group) else 1
        last = row.group
        places.append(place)
    for row, y in zip(chosen, places):
        axes.barh(y, time_of(row), 0.75, color=theme.color(0 if row.used else 1))
        axes.text(time_of(row), y, f"  {row.largest_ulp:.2g} ulp", va="center", fontsize=8)
    axes.set_yticks(places, [row.formula for row in chosen])
    axes.set_ylim(max(places) + 0.7, min(places) - 0.7)
    axes.set_xlabel("ns per value; the numbers are largest errors")
    axes.margins(x=0.15)
    axes.grid(True, axis="x")
    axes.tick_params(axis="y", length=0)
    figure.subplots_adjust(0.2, 0.6 / figure.get_figheight(), 0.98, 0.98)
    return figure


def comparison(rows):
    """For each group and exponent: the formula in the kernels, and the fastest one with at most twice its error."""
    lines = []
    for group, n in dict.fromkeys((row.group, row.n) for row in rows):
        here = [row for row in rows if (row.group, row.n) == (group, n)]
        used = next(row for row in here if row.used)
        rivals = [row for row in here if row.rms_relative <= 2 * used.rms_relative and row.failed <= used.failed]
        best = min(rivals, key=lambda row: row.ns_per_value)
        if time_of(best) > 0.95 * time_of(used):
            best = used
        lines.append([group, n if group in ("lobe", "sine") else "", used.formula, used.ns_per_value, used.rms_relative,
                      used.largest_ulp, "the same" if best is used else best.formula,
                      1.0 if best is used else time_of(used) / time_of(best)])
    return lines


def main():
    folder = sys.argv[1]
    rows = style.read(folder, "arithmetic.csv")
    style.save_all(folder, [("arithmetic-lobe", partial(draw_powers, rows, "lobe")),
                            ("arithmetic-sine", partial(draw_powers, rows, "sine")),
                            ("arithmetic-geometry", partial(draw_plain, rows)),
                            ("arithmetic-functions", partial(draw_functions, rows))])
    how = ("Points are root mean square errors; lines end at the largest errors. Points to the left and below are better. A ring "
           "marks the formula that the kernels use.")
    style.section(
        folder, "arithmetic", title="Arithmetic", order=40,
        text=["Several formulas compute the same value in float32; they are compared with float64 from the same float32 inputs. Times "
              "are per value on the whole device, by its clock, in a loop on registers, minus the time of the empty loop. They are "
              "medians over rounds in which the formulas alternate, accurate to about a tenth of a nanosecond."],
        summary={"columns": ["value", "n", "formula in the kernels", "ns", "rms relative error", "largest error, ulp",
                             "fastest with at most twice the error", "speedup"],
                 "rows": comparison(rows), "note": "ulp: units in the last place of the value by which the error is divided"},
        charts=[{"svg": "arithmetic-lobe.svg", "title": "Power of the lobe", "caption": how},
                {"svg": "arithmetic-sine.svg", "title": "The sine of a lobe sample", "caption": how},
                {"svg": "arithmetic-geometry.svg", "title": "Frames, cosine and sine, offsets",
                 "caption": how + " An offset fails if the position is still on the wrong side of its surface. The larger an "
                 "offset, the more light leaks through edges."},
                {"svg": "arithmetic-functions.svg", "title": "Functions", "caption": "Blue: the function that the kernels use."}],
        tables=[{"csv": "arithmetic.csv", "title": "All results"}])


if __name__ == "__main__":
    main()
