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
            axes.text(0.02, i, "too little time to tell", transform=axes.get_yaxis_transform(), va="center", fontsize=8,
                      color=theme.muted)
            continue
        axes.axhline(i, color=theme.grid, linewidth=0.8, zorder=0)
        for method in shown:
            if method.verdict == "biased":
                continue
            apart = 0.09 * (method.variant_number - 3) + 0.05 * method.strategy_number
            value, low, high = method.ratio
            axes.plot([low, high], [i + apart] * 2, color=method.color(theme), linewidth=1)
            axes.plot(value, i + apart, linestyle="", markersize=6, **method.marker(theme))
            labelled.setdefault(method.name, method)
            ratios += [low, high]
    axes.set_yticks(range(len(scenes)), list(scenes))
    axes.set_ylim(len(scenes) - 0.4, -0.6)
    axes.set_xscale("log")
    plain_log(axes.xaxis, ratios)
    axes.tick_params(axis="y", length=0)
    axes.grid(True, axis="x")
    axes.set_xlabel("time relative to the best sound method of the scene")
    entries = sorted(labelled.values(), key=lambda method: (method.strategy_number, method.variant_number))
    handles = [plt.Line2D([], [], linestyle="", markersize=6,
                          **{**method.marker(theme), "markerfacecolor": method.color(theme)}) for method in entries]
    handles.append(plt.Line2D([], [], linestyle="", markersize=6, marker="o", markerfacecolor=theme.paper,
                              markeredgecolor=theme.muted, markeredgewidth=1.3))
    legend_beside(axes, handles, [method.name for method in entries] + ["hollow: suspect\nor undecided"])
    return figure


def ranked(methods, rank):
    """The methods of this rank, the least cost first."""
    return sorted((method for method in methods if method.row.rank == rank), key=lambda method: method.cost)


def best_of(methods):
    """The sound method with the least cost; None if no method is sound."""
    return next(iter(ranked(methods, "best")), None)


def names_of(methods):
    return ", ".join(method.name for method in methods)


def ratio_text(method):
    value, low, high = method.ratio
    return "1" if method.row.rank == "best" else f"{value:.3g} ({low:.3g} to {high:.3g})"


def summary(folder, scenes):
    rows = []
    for scene, methods in scenes.items():
        first = ranked(methods, "best") + ranked(methods, "tied")
        following = next(iter(ranked(methods, "slower")), None)
        default = next((method for method in methods if method.variant == "path mis" and method.sound), None)
        open_ones = ranked(methods, "open")
        rows.append([scene, names_of(first) or "none is sound", round(first[0].cost, 6) if first else None,
                     following.name if following else "", ratio_text(following) if following else "",
                     ratio_text(default) if default and first else "", names_of(open_ones),
                     names_of(method for method in methods if method.verdict == "biased"),
                     names_of(method for method in methods if method.refused)])
    return {"text": style.read_verdict(folder, "scenes"),
            "columns": ["scene", "least time of the sound (several: tied)", "µs to unit variance", "the next", "its time / least",
                        "time of path mis / least", "too little time to tell", "biased", "refused"],
            "rows": rows,
            "note": "Time: variance per sample times seconds per sample. An image of N pixels reaches the relative MSE e after N / e "
                    "times this time. In brackets: confidence interval; with probability 95% all intervals of a scene are right. "
                    "Methods are tied if their interval contains 1."}


TEXT = [
    "Every method renders each scene for the same total time. The methods alternate, and each round has a new seed. The "
    "variance is the expected relative MSE with one sample per pixel, as in phlux compare: squared error / (reference² + "
    "0.0001), averaged over pixels and channels. A sample is one path; for light, one light path per pixel of the image. "
    "Variance per sample times seconds per sample is the time to unit variance; it is least for the most efficient method. On "
    "CPUs it is processor time, which excludes other programs. The intervals of ratios are bootstrapped over the rounds.",
    "A variance is suspect, that is possibly infinite, if its standard error is above a tenth of it and the largest 0.1% of "
    "the errors of single samples cause more than 30% of the squared error; or if the variance from renders with many samples is "
    "at least twice that from renders with one sample. Its measured value is then a lower bound. A method is biased if it is known "
    "to be, or if its mean or its pixels differ from the reference by 4.5 standard errors, those of the reference included. It is "
    "undecided if the standard error of its variance is above 25%, or if a bias of 10% would not be found.",
    "The reference is rendered by the method with the least time to unit variance in a trial. The dashed line in the "
    "convergence charts is the error of the reference: errors near it or below it are not meaningful.",
]


def scene_charts(folder, scene, methods, points):
    """The (name, draw) pairs of one scene, and their entries in the report section."""
    row = methods[0].row
    drawings = [(f"scenes-{scene}-efficiency", lambda theme: draw_efficiency(scene, methods, theme)),
                (f"scenes-{scene}-convergence", lambda theme: draw_convergence(scene, methods, points, theme)),
                (f"scenes-{scene}-times", lambda theme: draw_times(scene, methods, theme))]
    charts = [
        {"heading": scene, "svg": f"scenes-{scene}-efficiency.svg", "title": f"{scene}: speed and accuracy",
         "caption": "Lower points have less variance per sample; points to the right have more samples per second. On each grey "
                    "line the time to unit variance is constant, so that the method furthest to the lower right is the most "
                    "efficient. Error bars: standard error of the variance, range of the speed over the rounds."},
        {"svg": f"scenes-{scene}-convergence.svg", "title": f"{scene}: error against time",
         "caption": f"Mean and range over {row.rounds:.0f} seeds, {row.image} pixels. Reference: {row.reference_by}, "
                    f"{row.reference_seconds:.3g} s."},
        {"svg": f"scenes-{scene}-times.svg", "title": f"{scene}: time to unit variance",
         "caption": "Variance per sample times seconds per sample; less is better. Black lines: confidence interval of the ratio to "
                    "the best method."},
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
        for method in methods:
            method.any_open = any(other.row.rank == "open" for other in methods)
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
                       "caption": "Time to equal error, relative to the best sound method of each scene; left is better."})
    for scene, methods in scenes.items():
        if not all(method.refused for method in methods):
            of_scene = scene_charts(folder, scene, methods, points.get(scene, {}))
            drawings += of_scene[0]
            charts += of_scene[1]
    style.save_all(folder, drawings)
    style.section(
        folder, "scenes", title="Rendering methods by scene", order=10, text=TEXT, summary=summary(folder, scenes), charts=charts,
        tables=[{"csv": "scenes.csv", "title": "Every method on every scene",
                 "columns": ["scene", "integrator", "strategy", "connect_or_weights", "verdict", "variance_per_sample",
                             "variance_standard_error", "top_share", "seconds_per_sample", "clock", "cost", "cost_ratio_low",
                             "cost_ratio_high", "rank", "relmse", "seconds", "samples_per_pixel", "mean_bias_sigma", "reason"]},
                {"csv": "scenes-convergence.csv", "title": "Error against render time"}])


if __name__ == "__main__":
    main()
