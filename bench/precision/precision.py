"""Draws the charts of `phlux bench precision` (error of float32 against its speed); writes its section of the report.

    python3 precision.py FOLDER
"""
import math
import sys
from functools import partial

import chart_style as style
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D

UNIT = 4096  # samples per pixel whose standard error is the unit of errors
LEAST = 1e-6  # smaller errors are drawn as this
DARK = 1e-8  # images of a smaller variance are black in the measure of phlux compare
INTEGRATORS = ("path", "light", "bidir")


def error_of(row):
    return max(row.difference, LEAST)


def draw_tradeoff(rows, theme):
    figure, axes = plt.subplots(figsize=(8, 5))
    narrow = min(row.width for row in rows)
    for row in rows:
        look = theme.series(INTEGRATORS.index(row.integrator))
        if row.systematic_most > error_of(row):
            axes.plot([row.times_as_fast] * 2, [error_of(row), row.systematic_most], color=look["color"], lw=0.8)
        axes.plot(row.times_as_fast, error_of(row), ls="none", marker=look["marker"], color=look["color"], ms=6,
                  mfc=theme.paper if row.width == narrow else look["color"])
    widest = max(row.width for row in rows)
    for row in sorted((row for row in rows if row.width == widest), key=error_of)[-3:]:
        below = 0.3 < error_of(row) < 1  # the line at 1 would cross a label above the point
        axes.annotate(row.scene, (row.times_as_fast, error_of(row)), xytext=(-6, -3 if below else 3), ha="right",
                      va="top" if below else "baseline", textcoords="offset points", fontsize=7.5, color=theme.muted)
    axes.axhline(1, color=theme.ink, lw=1)
    axes.text(0.4, 1.08, f"noise of {UNIT:,} samples", transform=axes.get_yaxis_transform(), ha="center", va="bottom",
              fontsize=8)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(min(error_of(row) for row in rows) / 2, max(3, 2 * max(error_of(row) for row in rows)))
    ticks = [tick for tick in (0.5, 1, 2, 5, 10, 20, 50) if min(r.times_as_fast for r in rows) / 1.5 <= tick
             <= 1.5 * max(r.times_as_fast for r in rows)]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.set_xticks([], minor=True)
    axes.grid(True)
    axes.set_xlabel("speed relative to float64")
    axes.set_ylabel(f"error of float32 / noise of {UNIT:,} samples")
    present = [name for name in INTEGRATORS if any(row.integrator == name for row in rows)]
    handles = [Line2D([], [], ls="none", color=theme.color(INTEGRATORS.index(name)), label=name,
                      marker=style.MARKERS[INTEGRATORS.index(name)]) for name in present]
    for width in sorted({row.width for row in rows}):
        handles.append(Line2D([], [], ls="none", marker="o", color=theme.muted, label=f"WIDTH {width:.0f}",
                              mfc=theme.paper if width == narrow else theme.muted))
    figure.subplots_adjust(0.1, 0.2, 0.98, 0.97)
    figure.legend(handles=handles, loc="lower center", ncol=5)
    return figure


def draw_time(rows, theme):
    """Relative error against render time of one pixel, in both precisions."""
    chosen = [row for row in rows if row.integrator == "path" and row.width == max(r.width for r in rows)
              and row.variance_per_sample > DARK]
    columns = min(4, len(chosen))
    lines = math.ceil(len(chosen) / columns)
    figure, panels = plt.subplots(lines, columns, figsize=(11, 0.7 + 2.1 * lines), squeeze=False, sharey=True)
    for axes in panels.flat[len(chosen):]:
        axes.set_axis_off()
    for row, axes in zip(chosen, panels.flat):
        noise = math.sqrt(row.variance_per_sample)
        floor, most = (error * noise / math.sqrt(UNIT) for error in (row.systematic, row.systematic_most))
        samples = [10 ** (k / 4) for k in range(4, 57)]
        single, double = row.ns_per_sample * 1e-9, row.ns_per_sample_double * 1e-9
        axes.plot([n * double for n in samples], [noise / math.sqrt(n) for n in samples], color=theme.color(1),
                  label="float64")
        axes.plot([n * single for n in samples], [math.hypot(noise / math.sqrt(n), floor) for n in samples],
                  color=theme.color(0), label="float32")
        axes.plot([n * single for n in samples], [math.hypot(noise / math.sqrt(n), most) for n in samples],
                  color=theme.color(0), lw=0.8, ls=(0, (2, 2)), label="float32, upper bound")
        axes.axvline(UNIT * single, color=theme.axis, lw=0.8)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_ylim(1e-7, 10)
        axes.set_title(row.scene, fontsize=9)
        axes.grid(True)
    for axes in panels[:, 0]:
        axes.set_ylabel("relative error")
    for axes in panels[-1]:
        axes.set_xlabel("seconds per pixel")
    figure.subplots_adjust(0.07, 0.75 / figure.get_figheight(), 0.99, 1 - 0.3 / figure.get_figheight(), 0.08, 0.45)
    figure.legend(*panels[0][0].get_legend_handles_labels(), loc="lower center", ncol=3)
    return figure


def main():
    folder = sys.argv[1]
    rows = [row for row in style.read(folder, "precision.csv") if row.times_as_fast > 0]
    drawings = [("precision-tradeoff", partial(draw_tradeoff, rows))]
    charts = [{"svg": "precision-tradeoff.svg", "title": "Error of float32 against its speed",
               "caption": "Each point is a scene, an integrator and a WIDTH: the difference of two images with the same samples in "
                          "float32 and float64, divided by the noise of 4,096 samples. A line ends at the upper bound of the "
                          "systematic part (two standard errors), if that is larger. Points to the right and below 1 are better."}]
    if any(row.integrator == "path" and row.variance_per_sample > DARK for row in rows):
        drawings.append(("precision-time", partial(draw_time, rows)))
        charts.append({"svg": "precision-time.svg", "title": "Error against render time, path tracing",
                       "caption": "Noise decreases with the square root of the time; the systematic error of float32 does not. Where "
                                  "this error dominates, float64 is more accurate in the same time. Dotted: upper bound of the "
                                  "systematic error (two standard errors). Vertical line: 4,096 samples in float32. Times are "
                                  "processor seconds."})
    style.save_all(folder, drawings)
    table = [[row.scene, row.integrator, row.width, row.difference, row.systematic, row.systematic_most, row.mean_difference,
             row.times_as_fast, row.break_even_samples] for row in rows]
    style.section(
        folder, "precision", title="Float32 compared with float64", order=45,
        text=["The same seed gives the same samples in both precisions, except for rounding. The difference of two such images is "
              "the error of float32, which is mostly far below the noise of the images. A part of the difference is systematic. "
              "The rest comes from samples whose paths differ because of rounding, which is not a bias. Each reflection amplifies "
              "the rounding error, so that very long paths may end at quite different places. If the difference is near 1, most "
              "paths do, and the systematic part cannot be estimated. Both values are square roots of relative MSEs, as in phlux "
              "compare.",
              "Camera, materials and lights are rounded to float32 in both precisions, and so are the sums that are sent to the "
              "host. Shapes are in float64 if the kernels are."],
        summary={"columns": ["scene", "integrator", "WIDTH", "difference", "systematic", "upper bound", "difference of the means",
                             "speedup", "break even at"], "rows": table,
                 "note": "Difference and systematic part are divided by the noise of 4,096 samples; the upper bound is the "
                         "systematic part plus two standard errors. Break even: number of samples per pixel in float64 above which "
                         "float64 is more accurate in the same time; a dash if no systematic error was found."},
        charts=charts, tables=[{"csv": "precision.csv", "title": "All results"}])


if __name__ == "__main__":
    main()
