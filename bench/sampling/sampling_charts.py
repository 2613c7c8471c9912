"""Maps over exponent and angle of `phlux bench sampling`: the cost of each strategy, and the best strategy."""
import math

import chart_style as style
import matplotlib.pyplot as plt
from matplotlib.colors import LogNorm
from matplotlib.patches import Patch, Rectangle
from sampling_ranking import CONDITIONS, CONSTANT, LIGHTS, STRATEGIES, WINNERS, factor_text, groups_of



def exponent_text(n):
    if n < 1000:
        return f"{n:g}"
    power = round(math.log10(n))
    return f"$10^{power}$" if n == 10**power else f"{n:g}"


def name_of(material):
    return f"$k_d$ = {material[0]:g}, $k_s$ = {material[1]:g}"


def set_grid(axes, exponents, angles, labelled=True):
    style.set_grid(axes, [exponent_text(n) for n in exponents], [f"{angle:g}" if labelled else "" for angle in angles])


def draw_cell(axes, x, y, color, **more):
    axes.add_patch(Rectangle((x - 0.5, y - 0.5), 1, 1, facecolor=color, edgecolor="none", **more))


def panels_of(lines, columns, panel, *, gap=(0.25, 0.4), left=0.65, right=0.15, top=0.65, bottom=0.55, **more):
    """lines x columns panels of fixed size, gaps and margins in inches: automatic layout would take a second per chart."""
    width = left + columns * panel[0] + (columns - 1) * gap[0] + right
    height = top + lines * panel[1] + (lines - 1) * gap[1] + bottom
    figure, panels = plt.subplots(lines, columns, figsize=(width, height), squeeze=False, **more)
    figure.subplots_adjust(left / width, bottom / height, 1 - right / width, 1 - top / height, gap[0] / panel[0],
                           gap[1] / panel[1])
    return figure, panels


def title_of(figure, text):
    size = min(11, 130 * figure.get_figwidth() / len(text))  # points; smaller where the figure is narrow
    figure.text(0.5, 1 - 0.12 / figure.get_figheight(), text, ha="center", va="top", fontsize=size)


def legend_below(figure, handles):
    figure.legend(handles.values(), handles.keys(), loc="lower center", ncol=max(3, int(figure.get_figwidth() / 1.6)))


def draw_heat(rows, material, exponents, angles, light, theme):
    """Of the rows without roulette."""
    chosen = {(row.strategy, *row.cell): row for row in rows
              if row.material == material and row.integrand == light and not row.roulette}
    costs = [row.relative_variance * row.cost_ns for row in chosen.values()
             if row.compared and row.relative_variance > CONSTANT and row.n in exponents and row.theta_deg in angles]
    least, most = min(costs, default=1), max(costs, default=10)
    norm = LogNorm(least, most, clip=True)
    colors = plt.get_cmap(style.SEQUENTIAL + "_r")
    figure, panels = panels_of(-(-len(STRATEGIES) // 4), 4, (2.3, 2.2), gap=(0.15, 0.32), right=1.0, sharex=True, sharey=True)
    for axes, strategy in zip(panels.flat, STRATEGIES):
        for x, n in enumerate(exponents):
            for y, angle in enumerate(angles):
                row = chosen.get((strategy, n, angle))
                if row is None or "infinite-variance-suspected" in row.verdict:
                    draw_cell(axes, x, y, theme.wash)
                    axes.text(x, y, "–" if row is None else "∞", ha="center", va="center", fontsize=7, color=theme.muted)
                    continue
                color = colors(norm(max(row.relative_variance * row.cost_ns, least)))
                draw_cell(axes, x, y, color)
                if not row.compared:
                    sign = "b" if "biased" in row.verdict else "?"
                    axes.text(x, y, sign, ha="center", va="center", fontsize=7, color=theme.on(color))
        set_grid(axes, exponents, angles)
        axes.set_title(strategy, fontsize=9)
    for axes in panels.flat[len(STRATEGIES):]:
        axes.set_axis_off()
    for axes in panels[-1]:
        axes.set_xlabel("$n$")
    for axes in panels[:, 0]:
        axes.set_ylabel("θ, degrees")
    place = figure.add_axes((1 - 0.85 / figure.get_figwidth(), 0.3, 0.016, 0.4))
    bar = figure.colorbar(plt.cm.ScalarMappable(norm, colors), cax=place)
    bar.set_label("relative variance × nanoseconds per sample")
    bar.outline.set_visible(False)
    title_of(figure, f"Time of each strategy without roulette in {LIGHTS[light]}, {name_of(material)}")
    return figure


def draw_winners_panel(axes, rows, exponents, angles, theme):
    """Colours each cell by its best strategy; returns these strategies."""
    cells, shown = groups_of(rows, lambda row: row.cell), set()
    for x, n in enumerate(exponents):
        for y, angle in enumerate(angles):
            compared = [row for row in cells[n, angle] if row.compared]
            if not compared:
                continue
            tie = sum(row.verdict in WINNERS for row in compared) > 1
            strategy = compared[0].strategy
            shown.add(strategy)
            draw_cell(axes, x, y, theme.color(STRATEGIES.index(strategy)), alpha=0.45 if tie else 1)
            if not tie and len(compared) > 1:
                axes.text(x, y, factor_text(compared[1].factor), ha="center", va="center", fontsize=6, color=theme.paper)
    return shown


def draw_winners(rows, grids, light, theme):
    figure, panels = panels_of(len(CONDITIONS), len(grids), (2.8 if len(grids) > 1 else 5.5, 2.6), left=1.0, bottom=1.0,
                               sharex="col")
    shown = set()
    for line, (condition, text) in zip(panels, CONDITIONS.items()):
        for axes, (material, (exponents, angles)) in zip(line, grids.items()):
            labelled = axes is line[0] or angles != next(iter(grids.values()))[1]
            some = [row for row in rows
                    if row.material == material and row.integrand == light and row.roulette == condition]
            shown |= draw_winners_panel(axes, some, exponents, angles, theme)
            set_grid(axes, exponents, angles, labelled)
            if condition == 0:
                axes.set_title(name_of(material), fontsize=9)
            else:
                axes.set_xlabel("$n$")
        line[0].set_ylabel(text.replace(", ", "\n").replace(" at ", "\nat ") + "\nθ, degrees")
    patches = {strategy: Patch(facecolor=theme.color(i)) for i, strategy in enumerate(STRATEGIES) if strategy in shown}
    legend_below(figure, patches)
    title_of(figure, f"The strategy with the least variance × cost in {LIGHTS[light]}")
    return figure
