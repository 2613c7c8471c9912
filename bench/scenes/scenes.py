"""Draws the charts of `phlux bench scenes` from scenes.csv and scenes-convergence.csv; writes its section of the report.

    python3 scenes.py FOLDER
"""
import sys

import chart_style as style
import matplotlib.pyplot as plt
from image_sheets import sheets
from scene_charts import (Method, chart, draw_convergence, draw_efficiency, draw_times, legend_beside, plain_log)


def draw_overview(scenes, theme):
    figure, axes = chart(1 + 0.42 * len(scenes), left=0.17)
    axes.set_title("Time to equal error")
    labelled, ratios = {}, [1]
    for i, methods in enumerate(scenes.values()):
        shown = [method for method in methods if not method.refused and method.row.variance_measured > 0]
        best = best_of(methods)
        if best is None:
            axes.text(1, i, "no method is sound", va="center", ha="center", fontsize=8, color=theme.muted)
            continue
        axes.axhline(i, color=theme.grid, linewidth=0.8, zorder=0)
        for method in shown:
            if method.verdict == "biased":
                continue
            apart = 0.09 * (method.variant_number - 3) + 0.05 * method.strategy_number
            axes.plot(method.cost / best.cost, i + apart, linestyle="", markersize=6, **method.marker(theme))
            labelled.setdefault(method.name, method)
            ratios.append(method.cost / best.cost)
    axes.set_yticks(range(len(scenes)), list(scenes))
    axes.set_ylim(len(scenes) - 0.4, -0.6)
    axes.set_xscale("log")
    plain_log(axes.xaxis, ratios)
    axes.tick_params(axis="y", length=0)
    axes.grid(True, axis="x")
    axes.set_xlabel("time relative to the best method of the scene")
    entries = sorted(labelled.values(), key=lambda method: (method.strategy_number, method.variant_number))
    handles = [plt.Line2D([], [], linestyle="", markersize=6,
                          **{**method.marker(theme), "markerfacecolor": method.color(theme)}) for method in entries]
    handles.append(plt.Line2D([], [], linestyle="", markersize=6, marker="o", markerfacecolor=theme.paper,
                              markeredgecolor=theme.muted, markeredgewidth=1.3))
    legend_beside(axes, handles, [method.name for method in entries] + ["hollow: suspect,\na lower bound"])
    return figure


def best_of(methods):
    """The sound method with the least time to unit variance; None if no method is sound."""
    return min((method for method in methods if method.sound), key=lambda method: method.cost, default=None)


def names_of(methods, verdict):
    return ", ".join(method.name for method in methods if method.verdict == verdict)


def summary(scenes):
    rows = []
    for scene, methods in scenes.items():
        best = best_of(methods)
        if best is None:
            rows.append([scene, "none is sound", None, "", None, None, names_of(methods, "suspect"),
                         names_of(methods, "biased"), names_of(methods, "refused")])
            continue
        second = best_of([method for method in methods if method is not best])
        default = next((method for method in methods if method.variant == "path mis" and method.sound), None)
        rows.append([scene, best.name, round(best.cost, 6), second.name if second else "",
                     second.cost / best.cost if second else None, default.cost / best.cost if default else None,
                     names_of(methods, "suspect"), names_of(methods, "biased"), names_of(methods, "refused")])
    return {"columns": ["scene", "best", "µs to unit variance", "second best", "its time / best", "time of path mis / best",
                        "suspect variance", "biased", "refused"],
            "rows": rows,
            "note": "Best: the sound method with the least time to unit variance (variance per sample times seconds per sample). "
                    "An image of N pixels reaches relative MSE e after N / e times that time."}


TEXT = [
    "Every method renders each scene for the same total time. The methods alternate, and each round has a new seed. The "
    "variance is that of one sample per pixel, relative to the reference as in phlux compare: squared error / (reference² + "
    "0.0001), averaged over pixels and channels. A sample is one path; for light, one light path per pixel of the image. The "
    "variance is estimated from whole renders with different seeds, and its standard error by a jackknife over them. Variance "
    "per sample times seconds per sample is the time to unit variance: the most efficient method has the least.",
    "A variance is suspect, that is possibly infinite, if its standard error is above a quarter of it; or above a tenth while "
    "the largest 0.1% of the errors of single samples hold more than 30% of the squared error; or if the variance from renders "
    "with many samples is at least twice that from renders with one sample. The table then leaves the variance empty, and the "
    "charts show the measured value as a hollow marker, which is a lower bound. A method is biased if it is known to be, or if "
    "its mean, or the part of its error that the variance does not explain, differs significantly from the reference "
    "(p < 0.0001).",
    "The reference is rendered by the method with the least time to unit variance in a trial. The dashed line in the "
    "convergence charts is the error of the reference: measured errors near it or below are not meaningful.",
]


def scene_charts(folder, scene, methods, points):
    """The (name, draw) pairs of one scene, and their entries in the report section."""
    row = methods[0].row
    drawings = [(f"scenes-{scene}-efficiency", lambda theme: draw_efficiency(scene, methods, theme)),
                (f"scenes-{scene}-convergence", lambda theme: draw_convergence(scene, methods, points, theme)),
                (f"scenes-{scene}-times", lambda theme: draw_times(scene, methods, theme))]
    charts = [
        {"heading": scene, "svg": f"scenes-{scene}-efficiency.svg", "title": f"{scene}: speed and accuracy",
         "caption": "Down: less variance per sample; right: more samples per second. Methods on one grey line have the same time "
                    "to unit variance, so the method furthest to the lower right is the most efficient. Error bars: standard "
                    "error of the variance, range of the speed over the rounds."},
        {"svg": f"scenes-{scene}-convergence.svg", "title": f"{scene}: error against time",
         "caption": f"Mean and range over {row.rounds:.0f} seeds, {row.image} pixels. Reference: {row.reference_by}, "
                    f"{row.reference_seconds:.3g} s."},
        {"svg": f"scenes-{scene}-times.svg", "title": f"{scene}: time to unit variance",
         "caption": "Variance per sample times seconds per sample; less is better."},
    ]
    more_drawings, more_charts = sheets(folder, scene, methods)
    return drawings + more_drawings, charts + more_charts


def read_scenes(folder):
    """The methods of each scene, and the convergence rows of each scene and method."""
    rows = style.read(folder, "scenes.csv")
    strategies = list(dict.fromkeys(row.strategy for row in rows))
    scenes, points = {}, {}
    for row in rows:
        scenes.setdefault(row.scene, []).append(Method(row, strategies))
    scenes = dict(sorted(scenes.items()))
    for methods in scenes.values():
        methods.sort(key=lambda method: (method.strategy_number, method.variant_number))
    for row in style.read(folder, "scenes-convergence.csv"):
        points.setdefault(row.scene, {}).setdefault((row.integrator, row.strategy, row.connect_or_weights), []).append(row)
    return scenes, points


def main():
    folder = sys.argv[1]
    scenes, points = read_scenes(folder)
    drawings, charts = [], []
    if any(best_of(methods) for methods in scenes.values()):
        drawings.append(("scenes-overview", lambda theme: draw_overview(scenes, theme)))
        charts.append({"svg": "scenes-overview.svg", "title": "All scenes",
                       "caption": "Time to equal error, relative to the best method of each scene; left is better."})
    for scene, methods in scenes.items():
        if not all(method.refused for method in methods):
            of_scene = scene_charts(folder, scene, methods, points.get(scene, {}))
            drawings += of_scene[0]
            charts += of_scene[1]
    style.save_all(folder, drawings)
    style.section(
        folder, "scenes", title="Rendering methods by scene", order=10, text=TEXT, summary=summary(scenes), charts=charts,
        tables=[{"csv": "scenes.csv", "title": "Every method on every scene",
                 "columns": ["scene", "integrator", "strategy", "connect_or_weights", "verdict", "variance_per_sample",
                             "variance_standard_error", "top_share", "seconds_per_sample", "variance_times_seconds",
                             "relmse", "seconds", "samples_per_pixel", "mean_bias_sigma", "reason"]},
                {"csv": "scenes-convergence.csv", "title": "Error against render time"}])


if __name__ == "__main__":
    main()
