"""The maps of `phlux bench stability` over lobe exponent and light radius: time of each method, and the best method."""
import math

import chart_style as style
import matplotlib.pyplot as plt
from matplotlib.colors import LogNorm
from matplotlib.patches import Patch, PathPatch, Rectangle
from matplotlib.path import Path
from stability_results import best_of_another_integrator, exponent_text, margin_of, ratio_text, short_text


def panels_of(lines, columns, size, *, left=0.75, right=0.15, top=0.62, bottom=0.55, gap=(0.14, 0.34)):
    """lines x columns panels of fixed size, gaps and margins in inches: automatic layout would take a second per chart."""
    width, height = left + columns * (size[0] + gap[0]) + right, top + lines * (size[1] + gap[1]) - gap[1] + bottom
    figure = plt.figure(figsize=(width, height))
    panels = [figure.add_axes(((left + column * (size[0] + gap[0])) / width,
                               1 - (top + (line + 1) * size[1] + line * gap[1]) / height, size[0] / width, size[1] / height))
              for line in range(lines) for column in range(columns)]
    return figure, panels


def set_grid(axes, grid, title="", labels=(True, True)):
    """labels: whether the columns and the rows are labelled."""
    style.set_grid(axes, [exponent_text(n) if labels[0] else "" for n in grid.exponents],
                   [f"{radius:g}" if labels[1] else "" for radius in grid.radii])
    axes.set_title(title, fontsize=9, pad=3)


def draw_cell(axes, cell, grid, **look):
    x, y = grid.position(cell)
    axes.add_patch(Rectangle((x - 0.5, y - 0.5), 1, 1, linewidth=0, clip_on=False, **look))
    return x, y


def draw_hatched(axes, cells, grid, hatch, theme):
    """Hatches the cells by one compound patch: one patch per cell would make the file much larger."""
    corners = ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5), (-0.5, -0.5))
    squares = [Path([(x + dx, y + dy) for dx, dy in corners], closed=True) for x, y in map(grid.position, cells)]
    if squares:
        axes.add_patch(PathPatch(Path.make_compound_path(*squares), facecolor=theme.wash, edgecolor=theme.axis, linewidth=0,
                                 hatch=hatch, clip_on=False))


def name_axes(figure):
    width, height = figure.get_size_inches()
    figure.text(0.5, 0.1 / height, "exponent of the lobe", ha="center", va="bottom")
    figure.text(0.12 / width, 0.5, "radius of the light", ha="left", va="center", rotation=90)


def title_of(figure, text):
    width, height = figure.get_size_inches()
    figure.text(0.5, 1 - 0.12 / height, text, ha="center", va="top", fontsize=11)


def draw_map(axes, grid, method, norm, colors, theme):
    """Sound cells are coloured by their time to unit variance; suspect ones are hatched, biased ones crossed."""
    results = [result for result in grid.of(method) if not result.refused]
    draw_hatched(axes, [result.cell for result in results if result.suspect], grid, "////", theme)
    draw_hatched(axes, [result.cell for result in results if not result.suspect and not result.sound], grid, "xxxx", theme)
    for result in results:
        if result.sound:
            color = colors(norm(result.cost))
            x, y = draw_cell(axes, result.cell, grid, facecolor=color)
            axes.text(x, y, short_text(result.cost), ha="center", va="center", fontsize=6.5, color=theme.on(color))
        else:
            x, y = grid.position(result.cell)
            axes.text(x, y, short_text(result.cost) if result.cost > 0 else "?", ha="center", va="center", fontsize=6,
                      color=theme.ink)


def draw_costs(grid, theme):
    costs = [result.cost for result in grid.results if result.sound]
    norm = LogNorm(min(costs), max(max(costs), 1.1 * min(costs)))
    colors = plt.get_cmap(style.SEQUENTIAL + "_r")
    columns = min(4, len(grid.methods))
    lines = -(-len(grid.methods) // columns)
    size = max(1.2, 0.36 * len(grid.exponents) + 0.1), max(0.9, 0.31 * len(grid.radii) + 0.1)
    figure, panels = panels_of(lines, columns, size, right=1.0)
    plt.rcParams["hatch.linewidth"] = 0.5
    for i, axes in enumerate(panels):
        if i >= len(grid.methods):
            axes.axis("off")
            continue
        draw_map(axes, grid, grid.methods[i], norm, colors, theme)
        set_grid(axes, grid, grid.methods[i], (i + columns >= len(grid.methods), i % columns == 0))
    width, height = figure.get_size_inches()
    bar = figure.colorbar(plt.cm.ScalarMappable(norm, colors), cax=figure.add_axes((1 - 0.85 / width, 0.25, 0.13 / width, 0.5)))
    bar.set_label("µs to unit variance")
    bar.outline.set_visible(False)
    name_axes(figure)
    title_of(figure, "Variance × seconds per sample; hatched: suspect variance")
    return figure


def draw_best_cell(axes, grid, cell, theme):
    """Draws one cell of the map of best methods; returns the best result, None if no method is sound."""
    ranked = grid.ranked(cell)
    if not ranked:
        if any(result.cell == cell for result in grid.results):
            x, y = draw_cell(axes, cell, grid, facecolor=theme.wash)
            axes.text(x, y, "none\nsound", ha="center", va="center", fontsize=7, color=theme.muted)
        return None
    suspects = grid.suspects(cell)
    margin, significant = margin_of(ranked, suspects)
    color = grid.color(ranked[0].method, theme)
    x, y = draw_cell(axes, cell, grid, facecolor=color, alpha=1 if significant else 0.45)
    ink = theme.paper if significant else theme.ink
    axes.text(x, y + 0.16, "alone" if math.isinf(margin) else ratio_text(margin), ha="center", va="center", fontsize=8,
              color=ink)
    axes.text(x, y - 0.22, best_of_another_integrator(ranked, suspects), ha="center", va="center", fontsize=6.5, color=ink)
    return ranked[0]


def draw_best(grid, theme):
    size = max(3.2, 0.62 * len(grid.exponents) + 0.4), max(1.5, 0.5 * len(grid.radii))
    figure, (axes,) = panels_of(1, 1, size, right=1.75)
    drawn = [draw_best_cell(axes, grid, cell, theme) for cell in grid.cells]
    winners = {best.number: best.method for best in drawn if best}
    set_grid(axes, grid)
    handles = [Patch(facecolor=grid.color(method, theme), label=method) for _, method in sorted(winners.items())]
    if handles:
        axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.02, 1.01), borderaxespad=0)
    name_axes(figure)
    title_of(figure, "The best method, and the time of others relative to it")
    return figure
