"""Draws what `phlux bench scenes` measured, and writes its section of the report.

    python3 scenes.py FOLDER
"""
import os
import sys

import chart_style as style
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

MARKERS = "osD^vPX*<>ph"
DASHES = ["-", (0, (5, 1.6)), (0, (1.4, 1.2)), (0, (6, 1.4, 1.4, 1.4))]


class Method:
    """A row of scenes.csv with what charts need."""

    def __init__(self, row, strategies):
        self.row = row
        self.variant = style.variant_of(row)
        self.strategy = row.strategy
        self.key = (row.integrator, row.strategy, row.connect_or_weights)
        self.name = self.variant if len(strategies) == 1 else f"{self.variant}, {row.strategy}"
        self.sound = row.verdict == "sound"
        self.refused = row.verdict == "refused"
        self.verdict = row.verdict
        self.variant_number = style.VARIANTS.index(self.variant)
        self.strategy_number = strategies.index(row.strategy)

    @property
    def label(self):
        return self.name if self.sound else f"{self.name} ({self.verdict})"

    @property
    def cost(self):
        """Microseconds to unit variance; where the variance is suspect, at least so many."""
        return 1e6 * self.row.variance_measured * self.row.seconds_per_sample

    def color(self, theme):
        return theme.color(self.variant_number)

    def marker(self, theme):
        """A hollow one is a figure that the method has not earned."""
        return {"marker": MARKERS[(self.variant_number + 3 * self.strategy_number) % len(MARKERS)],
                "markerfacecolor": self.color(theme) if self.sound else theme.paper,
                "markeredgecolor": self.color(theme), "markeredgewidth": 1.3}

    def line(self, theme):
        return {"color": self.color(theme), "linestyle": DASHES[self.strategy_number % len(DASHES)],
                **self.marker(theme)}


def plain_log(axis, values):
    """Ticks as people write them, 0.1, 1, 10, 1000, 1e+05, and finer ones over less than two decades."""
    if max(values) < 100 * min(values):
        axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def short(value):
    return f"{value:.3g}" if value < 1000 else f"{value:,.0f}" if value < 1e6 else f"{value:.2g}"


def chart(height=4.4, left=0.09):
    """Axes with room for a legend to their right. Fixed, where matplotlib's own layout takes half of the time."""
    figure = plt.figure(figsize=(8.6, height))
    below, above = 0.52 / height, 0.34 / height
    return figure, figure.add_axes((left, below, 0.75 - left, 1 - below - above))


def legend_beside(axes, *entries):
    axes.legend(*entries, loc="upper left", bbox_to_anchor=(1.01, 1.01), borderaxespad=0)


# ---- (a) Convergence


def draw_convergence(scene, methods, points, theme):
    figure, axes = chart()
    axes.set_title(f"{scene}: error against time")
    lows, highs, ends = [], [], []
    for method in methods:
        rows = points.get(method.key, [])
        if method.refused or not rows:
            continue
        seconds = [row.seconds for row in rows]
        axes.fill_between(seconds, [row.relmse_least for row in rows], [row.relmse_most for row in rows],
                          color=method.color(theme), alpha=0.13, linewidth=0)
        axes.plot(seconds, [row.relmse for row in rows], label=method.label, **method.line(theme))
        lows += [row.relmse for row in rows]
        highs += [row.relmse for row in rows]
        ends += seconds
    own_error = methods[0].row.reference_relmse
    if own_error > 0:
        axes.axhline(own_error, color=theme.muted, linestyle=(0, (4, 3)), linewidth=1, label="the reference's own error")
    guide = np.array([min(ends), max(ends)])
    middle = np.sqrt(min(lows) * max(highs)) * np.sqrt(guide[1] / guide[0])
    axes.plot(guide, middle * guide[0] / guide, color=theme.axis, linewidth=1.1, linestyle=":", marker="",
              label="error ~ 1 / time")
    axes.set_xscale("log")
    axes.set_yscale("log")
    plain_log(axes.xaxis, ends)
    axes.set_xlabel("seconds of rendering")
    axes.set_ylabel("relative MSE")
    axes.grid(True)
    legend_beside(axes)
    return figure


# ---- (b) Variance against speed


def draw_efficiency(scene, methods, theme):
    figure, axes = chart()
    axes.set_title(f"{scene}: speed and accuracy")
    shown = [method for method in methods if not method.refused and method.row.variance_measured > 0]
    for method in shown:
        row = method.row
        rate, variance = 1e-6 / row.seconds_per_sample, row.variance_measured
        error = min(row.variance_measured_standard_error, 0.9 * variance)
        axes.errorbar(rate, variance, yerr=[[error], [row.variance_measured_standard_error]],
                      xerr=[[rate - 1e-6 / row.seconds_per_sample_most], [1e-6 / row.seconds_per_sample_least - rate]],
                      color=method.color(theme), linestyle="", elinewidth=0.9, markersize=7, label=method.label,
                      **method.marker(theme))
        if method.verdict == "suspect":
            axes.annotate("", (rate, variance * 2.2), (rate, variance), zorder=1,
                          arrowprops={"arrowstyle": "->", "color": method.color(theme), "lw": 1.2})
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.margins(0.15)
    left, right = axes.get_xlim()
    bottom, top = axes.get_ylim()
    if right / left < 4:  # a decade at the least is easier to read than a fraction of one
        middle = np.sqrt(left * right)
        left, right = middle / 2, middle * 2
    for power in np.arange(np.floor(np.log10(bottom / right)), np.ceil(np.log10(top / left)) + 1):
        cost = 10.0 ** power  # microseconds to unit variance: variance / rate
        axes.plot([left, right], [cost * left, cost * right], color=theme.axis, linewidth=0.6, alpha=0.6, zorder=0)
        x = min(right, top / cost)
        if bottom * 1.3 < cost * x and x > left * 1.3:
            axes.annotate(f"{cost:g} µs", (x, cost * x), xytext=(-3, -3), textcoords="offset points", ha="right",
                          va="top", fontsize=7.5, color=theme.muted)
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)
    plain_log(axes.xaxis, (left, right))
    axes.set_xlabel("million samples per second")
    axes.set_ylabel("relative variance per sample")
    legend_beside(axes)
    return figure


# ---- (c) Time to unit variance


def draw_times(scene, methods, theme):
    figure, axes = chart(0.95 + 0.32 * len(methods), left=0.15)
    axes.set_title(f"{scene}: time to unit variance")
    costs = [method.cost for method in methods if not method.refused]
    left = min(costs) / 3
    for i, method in enumerate(methods):
        if method.refused:
            axes.text(left * 1.1, i, "refused", va="center", fontsize=8, color=theme.muted)
            continue
        style_of = {"color": method.color(theme)} if method.sound else {
            "facecolor": theme.paper, "edgecolor": method.color(theme), "hatch": "////", "linewidth": 1}
        axes.barh(i, method.cost - left, left=left, height=0.62, **style_of)
        note = "" if method.sound else ", if any: suspect" if method.verdict == "suspect" else ", but biased"
        at_least = "at least " if method.verdict == "suspect" else ""
        axes.text(method.cost * 1.06, i, f"{at_least}{short(method.cost)} µs{note}", va="center", fontsize=8)
    axes.set_yticks(range(len(methods)), [method.name for method in methods])
    axes.set_ylim(len(methods) - 0.4, -0.6)
    axes.set_xscale("log")
    axes.set_xlim(left, 1.2 * max(costs))
    plain_log(axes.xaxis, axes.get_xlim())
    axes.tick_params(axis="y", length=0)
    axes.grid(True, axis="x")
    axes.set_xlabel("microseconds to unit variance of a pixel")
    return figure


# ---- (d) Images at equal time


def tone(image, exposure):
    linear = np.clip(image * exposure, 0, None)
    bright = linear > 0.6  # a shoulder, as in the previews
    return style.srgb(np.where(bright, 0.6 + 0.4 * (1 - np.exp(-(linear - 0.6) / 0.4)), linear))


def sheet(images, draw, right=0.0):
    """Images side by side, four to a row, with `right` inches left free."""
    columns = min(len(images), 4)
    rows = -(-len(images) // columns)
    pixel_rows, pixel_columns = images[0][1].shape[:2]
    side, gap, title = 2.1, 0.06, 0.24
    high = side * pixel_rows / pixel_columns
    width, height = columns * (side + gap) + gap + right, rows * (high + title + gap)
    figure = plt.figure(figsize=(width, height))
    for i, (name, image) in enumerate(images):
        row, column = divmod(i, columns)
        axes = figure.add_axes(((gap + column * (side + gap)) / width, 1 - (row + 1) * (high + title + gap) / height + gap / height,
                                side / width, high / height))
        drawn = draw(axes, image)
        axes.axis("off")
        axes.set_title(name, fontsize=8, pad=3)
    return figure, drawn


def draw_images(images, reference):
    luminance = reference.mean(axis=2)
    lit = luminance[luminance > 0]
    exposure = min(0.18 / np.exp(np.log(lit).mean()), 1 / np.percentile(lit, 95)) if lit.size else 1
    all_images = [("reference", reference)] + images
    return sheet(all_images, lambda axes, image: axes.imshow(tone(image, exposure), interpolation="none"))[0]


def draw_errors(images, reference):
    floor = 0.01  # as in relative MSE: sqrt(1e-4)

    def draw(axes, image):
        relative = ((image - reference) / np.sqrt(reference ** 2 + floor ** 2)).mean(axis=2)
        return axes.imshow(np.clip(relative, -1, 1), cmap=style.DIVERGING, vmin=-1, vmax=1, interpolation="none")

    room = 0.85
    figure, drawn = sheet(images, draw, right=room)
    width, height = figure.get_size_inches()
    bar = figure.colorbar(drawn, cax=figure.add_axes((1 - (room - 0.12) / width, 0.3 / height, 0.13 / width,
                                                      min(2.0, height - 0.8) / height)))
    bar.set_ticks([-1, -0.5, 0, 0.5, 1], labels=["-100%", "-50%", "0", "+50%", "+100%"])
    bar.outline.set_visible(False)
    bar.ax.tick_params(labelsize=7)
    return figure


def file_of(folder, scene, method):
    variant = "all" if method.row.connect_or_weights == "-" else method.row.connect_or_weights
    return os.path.join(folder, "scenes-images", scene, f"{method.row.integrator}-{variant}-{method.strategy}.npy")


def sheets(folder, scene, methods):
    """The drawings and the charts' entries in the section; none where the images are gone."""
    path = os.path.join(folder, "scenes-images", scene, "reference.npy")
    if not os.path.exists(path):
        return [], []
    reference = np.load(path).astype(float)
    images = [(method.label, np.load(file_of(folder, scene, method)).astype(float)) for method in methods
              if not method.refused and os.path.exists(file_of(folder, scene, method))]
    drawings = [(f"scenes-{scene}-images", lambda theme: draw_images(images, reference)),
                (f"scenes-{scene}-errors", lambda theme: draw_errors(images, reference))]
    return drawings, [
            {"svg": f"scenes-{scene}-images.svg", "title": f"{scene}: images at equal time",
             "caption": f"Each after {methods_time(methods)} of rendering, exposed alike."},
            {"svg": f"scenes-{scene}-errors.svg", "title": f"{scene}: errors at equal time",
             "caption": "(image - reference) / sqrt(reference² + 0.0001), the mean of the channels. Red is too bright, blue "
                        "too dark; noise is both, a bias is an even tint."}]


def methods_time(methods):
    seconds = [method.row.seconds for method in methods if not method.refused]
    return f"{np.median(seconds):.2g} seconds" if seconds else "no time"


# ---- All scenes


def draw_overview(scenes, theme):
    figure, axes = chart(1 + 0.42 * len(scenes), left=0.17)
    axes.set_title("Time to the same error")
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
    axes.set_xlabel("relative to the best method of the scene")
    entries = sorted(labelled.values(), key=lambda method: (method.strategy_number, method.variant_number))
    handles = [plt.Line2D([], [], linestyle="", markersize=6,
                          **{**method.marker(theme), "markerfacecolor": method.color(theme)}) for method in entries]
    handles.append(plt.Line2D([], [], linestyle="", markersize=6, marker="o", markerfacecolor=theme.paper,
                              markeredgecolor=theme.muted, markeredgewidth=1.3))
    legend_beside(axes, handles, [method.name for method in entries] + ["hollow: suspect,\nat least so much"])
    return figure


def best_of(methods):
    """The sound method of the least time to unit variance."""
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
    return {"columns": ["scene", "best", "µs to unit variance", "second", "times slower", "path mis, times slower",
                        "suspect variance", "biased", "refused"],
            "rows": rows,
            "note": "Best: the least variance times seconds of a sample, of those that are sound. An image of N pixels has "
                    "relative MSE e after N / e of its times to unit variance."}


TEXT = [
    "Each method renders each scene for the same time, in turns, with seeds of its own. The variance is that of one sample "
    "per pixel (one path; for light, one light path per pixel of the image), zeros included, relative to the reference as in "
    "phlux compare: squared error / (reference² + 0.0001), the mean over pixels and channels. It is estimated from whole "
    "renders with different seeds, and its standard error by a jackknife over them. Variance times seconds of a sample is the "
    "time to unit variance: who has the least wins.",
    "A variance is called suspect (of being infinite) where repeats disagree on it by a quarter, or by a tenth while the "
    "largest 0.1% of the samples hold more than 30% of the squared error, or where it at least doubles between one sample and "
    "many. Then the table gives none, and charts show what was met, hollow, as a lower bound. A method is called biased where "
    "it is known to be, or where its mean, or what its variance does not explain of its error, differs from the reference "
    "(p < 0.0001).",
    "The reference is rendered by the method that converged best in a trial. Errors near the reference's own mean nothing: it "
    "is drawn as a line.",
]


def scene_charts(folder, scene, methods, points):
    """The drawings of a scene, and their entries in the section."""
    row = methods[0].row
    drawings = [(f"scenes-{scene}-efficiency", lambda theme: draw_efficiency(scene, methods, theme)),
                (f"scenes-{scene}-convergence", lambda theme: draw_convergence(scene, methods, points, theme)),
                (f"scenes-{scene}-times", lambda theme: draw_times(scene, methods, theme))]
    charts = [
        {"heading": scene, "svg": f"scenes-{scene}-efficiency.svg", "title": f"{scene}: speed and accuracy",
         "caption": "Lower is more accurate per sample, further right more samples per second; along a grey line the time to "
                    "unit variance is the same, and the method furthest to the lower right wins. Bars: standard error of the "
                    "variance, range of the speed over rounds."},
        {"svg": f"scenes-{scene}-convergence.svg", "title": f"{scene}: error against time",
         "caption": f"Mean and range over {row.rounds:.0f} seeds, {row.image} pixels. The reference is by {row.reference_by}, "
                    f"in {row.reference_seconds:.3g} s."},
        {"svg": f"scenes-{scene}-times.svg", "title": f"{scene}: time to unit variance",
         "caption": "Variance per sample times seconds per sample; shorter is better."},
    ]
    more_drawings, more_charts = sheets(folder, scene, methods)
    return drawings + more_drawings, charts + more_charts


def main():
    folder = sys.argv[1]
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

    drawings, charts = [], []
    if any(best_of(methods) for methods in scenes.values()):
        drawings.append(("scenes-overview", lambda theme: draw_overview(scenes, theme)))
        charts.append({"svg": "scenes-overview.svg", "title": "All scenes",
                       "caption": "1 is the best method of a scene; further right, slower to the same error."})
    for scene, methods in scenes.items():
        if not all(method.refused for method in methods):
            of_scene = scene_charts(folder, scene, methods, points.get(scene, {}))
            drawings += of_scene[0]
            charts += of_scene[1]
    style.save_all(folder, drawings)
    style.section(
        folder, "scenes", title="Methods on scenes", order=10, text=TEXT, summary=summary(scenes), charts=charts,
        tables=[{"csv": "scenes.csv", "title": "Every method on every scene",
                 "columns": ["scene", "integrator", "strategy", "connect_or_weights", "verdict", "variance_per_sample",
                             "variance_standard_error", "top_share", "seconds_per_sample", "variance_times_seconds",
                             "relmse", "seconds", "samples_per_pixel", "mean_bias_sigma", "reason"]},
                {"csv": "scenes-convergence.csv", "title": "Errors at doubling times"}])


if __name__ == "__main__":
    main()
