"""The charts of one scene of `phlux bench scenes`: error against time, variance against speed, time to unit variance."""
import chart_style as style
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

# Line styles tell directional strategies apart; colours tell integrators and their variants apart.
MARKERS = "osD^vPX*<>ph"
DASHES = ["-", (0, (5, 1.6)), (0, (1.4, 1.2)), (0, (6, 1.4, 1.4, 1.4))]


class Method:
    """A row of scenes.csv, with its name, colour and marker in the charts."""

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
        self.any_open = False  # whether a method of the scene may be better than its best sound one

    @property
    def rank_note(self):
        if self.row.rank == "best" and self.any_open:
            return "best of the sound"
        return self.row.rank if self.row.rank in ("best", "tied") else ""

    @property
    def label(self):
        note = self.verdict if not self.sound else self.rank_note
        return f"{self.name} ({note})" if note else self.name

    @property
    def cost(self):
        """Microseconds to unit variance, by the clock of the row; a lower bound if the variance is suspect."""
        return 1e6 * self.row.cost

    @property
    def ratio(self):
        """The cost relative to the best sound method: value, low and high end of its interval; NaN for biased methods."""
        return self.row.cost_ratio, self.row.cost_ratio_low, self.row.cost_ratio_high

    @property
    def seconds(self):
        """Seconds per sample by the clock of the row: median, least and most over the rounds."""
        row = self.row
        if row.clock == "processor":
            return (row.processor_seconds_per_sample, row.processor_seconds_per_sample_least,
                    row.processor_seconds_per_sample_most)
        return row.seconds_per_sample, row.seconds_per_sample_least, row.seconds_per_sample_most

    def color(self, theme):
        return theme.color(self.variant_number)

    def marker(self, theme):
        """Filled if the verdict is sound, else hollow."""
        return {"marker": MARKERS[(self.variant_number + 3 * self.strategy_number) % len(MARKERS)],
                "markerfacecolor": self.color(theme) if self.sound else theme.paper,
                "markeredgecolor": self.color(theme), "markeredgewidth": 1.3}

    def line(self, theme):
        return {"color": self.color(theme), "linestyle": DASHES[self.strategy_number % len(DASHES)],
                **self.marker(theme)}


def plain_log(axis, values):
    """Labels a logarithmic axis 0.1, 1, 10, 1000, 1e+05; below two decades also at 2 and 5, and at more below one."""
    if max(values) < 100 * min(values):
        axis.set_major_locator(LogLocator(subs=(1, 2, 3, 4, 5, 7) if max(values) < 10 * min(values) else (1, 2, 5)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def short(value):
    return f"{value:.3g}" if value < 1000 else f"{value:,.0f}" if value < 1e6 else f"{value:.2g}"


def chart(height=4.4, left=0.09):
    """A figure and axes of fixed size with room for a legend on the right: automatic layout would take half of the time."""
    figure = plt.figure(figsize=(8.6, height))
    below, above = 0.52 / height, 0.34 / height
    return figure, figure.add_axes((left, below, 0.75 - left, 1 - below - above))


def legend_beside(axes, *entries):
    axes.legend(*entries, loc="upper left", bbox_to_anchor=(1.01, 1.01), borderaxespad=0)


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
        axes.axhline(own_error, color=theme.muted, linestyle=(0, (4, 3)), linewidth=1, label="error of the reference")
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


def draw_efficiency(scene, methods, theme):
    figure, axes = chart()
    axes.set_title(f"{scene}: speed and accuracy")
    shown = [method for method in methods if not method.refused and method.row.variance_measured > 0]
    for method in shown:
        row, (seconds, least, most) = method.row, method.seconds
        rate, variance = 1e-6 / seconds, row.variance_measured
        error = min(row.variance_measured_standard_error, 0.9 * variance)
        axes.errorbar(rate, variance, yerr=[[error], [row.variance_measured_standard_error]],
                      xerr=[[rate - 1e-6 / most], [1e-6 / least - rate]],
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
    if right / left < 4:  # widens a narrow range to a factor of 4
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
    axes.set_xlabel(f"million samples per second of {methods[0].row.clock} time")
    axes.set_ylabel("relative variance per sample")
    legend_beside(axes)
    return figure


def draw_times(scene, methods, theme):
    figure, axes = chart(0.95 + 0.32 * len(methods), left=0.15)
    axes.set_title(f"{scene}: time to unit variance")
    costs = [method.cost for method in methods if not method.refused]
    best = next((method.cost for method in methods if method.row.rank == "best"), None)
    left = min(costs) / 3
    for i, method in enumerate(methods):
        if method.refused:
            axes.text(left * 1.1, i, "refused", va="center", fontsize=8, color=theme.muted)
            continue
        style_of = {"color": method.color(theme)} if method.sound else {
            "facecolor": theme.paper, "edgecolor": method.color(theme), "hatch": "////", "linewidth": 1}
        axes.barh(i, method.cost - left, left=left, height=0.62, **style_of)
        end = method.cost
        if best and method.row.rank != "best" and np.isfinite(method.ratio).all():
            low, high = (best * ratio for ratio in method.ratio[1:])
            axes.plot([max(low, left), high], [i, i], color=theme.ink, linewidth=1.1, marker="|", markersize=6)
            end = max(end, high)
        note = f" ({method.rank_note})" if method.rank_note else ""
        note = note if method.sound else f" ({method.verdict})"
        at_least = "at least " if method.verdict == "suspect" else ""
        axes.text(end * 1.06, i, f"{at_least}{short(method.cost)} µs{note}", va="center", fontsize=8)
    axes.set_yticks(range(len(methods)), [method.name for method in methods])
    axes.set_ylim(len(methods) - 0.4, -0.6)
    axes.set_xscale("log")
    axes.set_xlim(left, 1.2 * max(costs))
    plain_log(axes.xaxis, axes.get_xlim())
    axes.tick_params(axis="y", length=0)
    axes.grid(True, axis="x")
    axes.set_xlabel(f"microseconds of {methods[0].row.clock} time to unit variance of a pixel")
    return figure
