"""Draws what `phlux bench precision` measured, float32's error against its speed, and writes its section of the report.

    python3 precision.py FOLDER
"""
import math
import sys
from functools import partial

import chart_style as style
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D

UNIT = 4096  # samples whose noise is the unit of errors
LEAST = 1e-6  # what is drawn of an error of 0
DARK = 1e-8  # a variance below is of an image that phlux compare takes for black
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
        axes.annotate(row.scene, (row.times_as_fast, error_of(row)), xytext=(-6, 3), textcoords="offset points",
                      ha="right", fontsize=7.5, color=theme.muted)
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
    axes.set_xlabel("times as many samples a second as float64")
    axes.set_ylabel(f"error of float32, in noise of {UNIT:,} samples")
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
    """Error against time of one pixel, in either precision: noise falls, what is systematic stays."""
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
                  color=theme.color(0), lw=0.8, ls=(0, (2, 2)), label="float32, at most")
        axes.axvline(UNIT * single, color=theme.axis, lw=0.8)
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_ylim(1e-7, 10)
        axes.set_title(row.scene, fontsize=9)
        axes.grid(True)
    for axes in panels[:, 0]:
        axes.set_ylabel("relative error")
    for axes in panels[-1]:
        axes.set_xlabel("seconds for a pixel")
    figure.subplots_adjust(0.07, 0.75 / figure.get_figheight(), 0.99, 1 - 0.3 / figure.get_figheight(), 0.08, 0.45)
    figure.legend(*panels[0][0].get_legend_handles_labels(), loc="lower center", ncol=3)
    return figure


def main():
    folder = sys.argv[1]
    rows = [row for row in style.read(folder, "precision.csv") if row.times_as_fast > 0]
    drawings = [("precision-tradeoff", partial(draw_tradeoff, rows))]
    charts = [{"svg": "precision-tradeoff.svg", "title": "Error of float32 against its speed",
               "caption": "A point for each scene, integrator and WIDTH: what two images of the same samples differ by, in "
                          "noise of 4,096 samples; its line goes to two standard errors above the systematic part, where "
                          "that is more. Below the line at 1 and to the right is good."}]
    if any(row.integrator == "path" and row.variance_per_sample > DARK for row in rows):
        drawings.append(("precision-time", partial(draw_time, rows)))
        charts.append({"svg": "precision-time.svg", "title": "Accuracy bought per second, path tracing",
                       "caption": "Noise falls with the root of time; what is systematic in float32 stays, and above it "
                                  "float64 is the worse buy. Dotted: two standard errors more than was measured. The "
                                  "upright line is at 4,096 samples in float32. Times are processor seconds."})
    style.save_all(folder, drawings)
    best = [[row.scene, row.integrator, row.width, row.difference, row.systematic, row.systematic_most, row.mean_difference,
             row.times_as_fast, row.break_even_samples] for row in rows]
    style.section(
        folder, "precision", title="Float32 against float64", order=45,
        text=["The same seed gives the same samples in either precision, but for rounding: what two images differ by is the "
              "error of float32, mostly far below their common noise. Part of it is systematic; the rest are samples that "
              "rounding sent another way, which is no bias: reflections enlarge the rounding of those before them, and samples "
              "of very long paths may have nothing in common in the end. A difference near 1 then says no more than that, and "
              "the systematic part is known no better. Both are root mean squares over pixels and channels in the measure of "
              "phlux compare.",
              "Camera, materials and lights are the same rounded floats in both, and so are sums on their way to the host; "
              "shapes are doubles in float64."],
        summary={"columns": ["scene", "integrator", "WIDTH", "difference", "systematic", "at most", "of the image's mean",
                             "times as fast", "break even at"], "rows": best,
                 "note": "In noise of 4,096 samples. At most: two standard errors above. Break even: samples per pixel in "
                         "float64 beyond which it is the more accurate of the two for the same time; a dash where no "
                         "systematic error was found."},
        charts=charts, tables=[{"csv": "precision.csv", "title": "All figures"}])


if __name__ == "__main__":
    main()
