"""Draws what `phlux bench stability` measured: each method's time to unit variance over a lobe's exponent and a light's size,
and which method is the best; writes the section of the report.

    python3 stability.py FOLDER
"""
import math
import os
import sys
from functools import partial

import chart_style as style
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.patches import Patch, PathPatch, Rectangle
from matplotlib.path import Path

CLEAR_MARGIN = 1.05  # two times that are nearer are a tie, whatever the variances' errors


class Entry:
    """A row of stability.csv with what charts need."""

    def __init__(self, row, strategies):
        self.row = row
        self.variant = style.variant_of(row)
        self.method = self.variant if len(strategies) == 1 else f"{self.variant}, {row.strategy}"
        self.place = (row.exponent, row.light_radius)
        self.sound = row.verdict == "sound"
        self.suspect = row.verdict == "suspect"
        self.refused = row.verdict == "refused"
        self.number = style.VARIANTS.index(self.variant) + len(style.VARIANTS) * strategies.index(row.strategy)

    @property
    def cost(self):
        """Microseconds to unit variance; where the variance is suspect, what was met of it, and 0 where nothing was."""
        seconds = self.row.processor_seconds_per_sample if self.row.clock == "processor" else self.row.seconds_per_sample
        return 1e6 * self.row.variance_measured * seconds

    @property
    def relative_error(self):
        return self.row.variance_measured_standard_error / self.row.variance_measured


class Atlas:
    def __init__(self, rows):
        strategies = list(dict.fromkeys(row.strategy for row in rows))
        self.entries = sorted((Entry(row, strategies) for row in rows), key=lambda entry: entry.number)
        self.methods = list(dict.fromkeys(entry.method for entry in self.entries))
        self.exponents = sorted({row.exponent for row in rows})
        self.radii = sorted({row.light_radius for row in rows})
        self.places = [(n, radius) for n in self.exponents for radius in self.radii]

    def of(self, method):
        return [entry for entry in self.entries if entry.method == method]

    def ranked(self, place):
        """The methods that may win there, the best first."""
        return sorted((entry for entry in self.entries if entry.place == place and entry.sound), key=lambda entry: entry.cost)

    def suspects(self, place):
        """Those of which something was met, by that."""
        return sorted((entry for entry in self.entries if entry.place == place and entry.suspect and entry.cost > 0),
                      key=lambda entry: entry.cost)

    def color(self, method, theme):
        return theme.color(self.of(method)[0].number)


def margin_of(ranked, suspects):
    """How many times as long the runner-up takes, and whether that is more than the errors explain, and no method that is
    suspect may be faster."""
    undecided = any(entry.cost < ranked[0].cost for entry in suspects)
    if len(ranked) < 2:
        return math.inf, not undecided
    margin = ranked[1].cost / ranked[0].cost
    error = math.hypot(ranked[0].relative_error, ranked[1].relative_error)
    return margin, margin > CLEAR_MARGIN and math.log(margin) > 2 * error and not undecided


def of_another(ranked, suspects):
    """The best of the other integrators over the best of all; where none of them is sound, what is known of it."""
    for entries, sign in ((ranked, ""), (suspects, "≥")):
        others = [entry for entry in entries if entry.row.integrator != ranked[0].row.integrator]
        if others:
            return f"{others[0].row.integrator} {sign}{ratio(others[0].cost / ranked[0].cost)}"
    return ""


def short(value):
    if value >= 1000:
        power = math.floor(math.log10(value))
        return f"{value / 10**power:.0f}e{power}" if round(value / 10**power) < 10 else f"1e{power + 1}"
    return f"{value:.0f}" if value >= 9.95 else f"{value:.1f}" if value >= 0.995 else f"{value:.2f}"


def ratio(value):
    return f"{value:.1g}" if value < 0.095 else f"{value:.2f}" if value < 1.995 else short(value)


def exponent_text(n):
    return f"{n:g}" if n < 1000 else f"{n:.0e}".replace("e+0", "e")


# ---- Maps


def maps(lines, columns, size, *, left=0.75, right=0.15, top=0.62, bottom=0.55, gap=(0.14, 0.34)):
    """Panels of a size and margins, in inches: matplotlib's own layout takes a second a chart."""
    width, height = left + columns * (size[0] + gap[0]) + right, top + lines * (size[1] + gap[1]) - gap[1] + bottom
    figure = plt.figure(figsize=(width, height))
    panels = [figure.add_axes(((left + column * (size[0] + gap[0])) / width,
                               1 - (top + (line + 1) * size[1] + line * gap[1]) / height, size[0] / width, size[1] / height))
              for line in range(lines) for column in range(columns)]
    return figure, panels


def set_grid(axes, atlas, title="", labels=(True, True)):
    axes.set_xlim(-0.5, len(atlas.exponents) - 0.5)
    axes.set_ylim(-0.5, len(atlas.radii) - 0.5)
    axes.set_xticks(range(len(atlas.exponents)), [exponent_text(n) if labels[0] else "" for n in atlas.exponents])
    axes.set_yticks(range(len(atlas.radii)), [f"{radius:g}" if labels[1] else "" for radius in atlas.radii])
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)
    axes.set_title(title, fontsize=9, pad=3)


def square(axes, place, atlas, **look):
    x, y = atlas.exponents.index(place[0]), atlas.radii.index(place[1])
    axes.add_patch(Rectangle((x - 0.5, y - 0.5), 1, 1, linewidth=0, clip_on=False, **look))
    return x, y


def hatched(axes, places, atlas, hatch, theme):
    """One patch for all of them, or the file grows."""
    corners = ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5), (-0.5, -0.5))
    squares = [Path([(atlas.exponents.index(n) + dx, atlas.radii.index(radius) + dy) for dx, dy in corners], closed=True)
               for n, radius in places]
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


def draw_map(axes, atlas, method, norm, colors, theme):
    """A colour is for a number that a method has earned."""
    entries = [entry for entry in atlas.of(method) if not entry.refused]
    hatched(axes, [entry.place for entry in entries if entry.suspect], atlas, "////", theme)
    hatched(axes, [entry.place for entry in entries if not entry.suspect and not entry.sound], atlas, "xxxx", theme)
    for entry in entries:
        if entry.sound:
            color = colors(norm(entry.cost))
            x, y = square(axes, entry.place, atlas, facecolor=color)
            axes.text(x, y, short(entry.cost), ha="center", va="center", fontsize=6.5, color=theme.on(color))
        else:
            x, y = atlas.exponents.index(entry.place[0]), atlas.radii.index(entry.place[1])
            axes.text(x, y, short(entry.cost) if entry.cost > 0 else "?", ha="center", va="center", fontsize=6,
                      color=theme.ink)


def draw_costs(atlas, theme):
    costs = [entry.cost for entry in atlas.entries if entry.sound]
    norm = LogNorm(min(costs), max(max(costs), 1.1 * min(costs)))
    colors = plt.get_cmap(style.SEQUENTIAL + "_r")
    columns = min(4, len(atlas.methods))
    lines = -(-len(atlas.methods) // columns)
    size = max(1.2, 0.36 * len(atlas.exponents) + 0.1), max(0.9, 0.31 * len(atlas.radii) + 0.1)
    figure, panels = maps(lines, columns, size, right=1.0)
    plt.rcParams["hatch.linewidth"] = 0.5
    for i, axes in enumerate(panels):
        if i >= len(atlas.methods):
            axes.axis("off")
            continue
        draw_map(axes, atlas, atlas.methods[i], norm, colors, theme)
        set_grid(axes, atlas, atlas.methods[i], (i + columns >= len(atlas.methods), i % columns == 0))
    width, height = figure.get_size_inches()
    bar = figure.colorbar(plt.cm.ScalarMappable(norm, colors), cax=figure.add_axes((1 - 0.85 / width, 0.25, 0.13 / width, 0.5)))
    bar.set_label("µs to unit variance")
    bar.outline.set_visible(False)
    name_axes(figure)
    title_of(figure, "Variance × seconds; hatched: suspect")
    return figure


def draw_best(atlas, theme):
    size = max(3.2, 0.62 * len(atlas.exponents) + 0.4), max(1.5, 0.5 * len(atlas.radii))
    figure, (axes,) = maps(1, 1, size, right=1.75)
    seen = {}
    for place in atlas.places:
        ranked = atlas.ranked(place)
        if not ranked:
            if any(entry.place == place for entry in atlas.entries):
                x, y = square(axes, place, atlas, facecolor=theme.wash)
                axes.text(x, y, "none\nsound", ha="center", va="center", fontsize=7, color=theme.muted)
            continue
        suspects = atlas.suspects(place)
        margin, clear = margin_of(ranked, suspects)
        color = atlas.color(ranked[0].method, theme)
        x, y = square(axes, place, atlas, facecolor=color, alpha=1 if clear else 0.45)
        ink = theme.paper if clear else theme.ink
        axes.text(x, y + 0.16, "alone" if math.isinf(margin) else ratio(margin), ha="center", va="center", fontsize=8, color=ink)
        axes.text(x, y - 0.22, of_another(ranked, suspects), ha="center", va="center", fontsize=6.5, color=ink)
        seen[ranked[0].number] = ranked[0].method
    set_grid(axes, atlas)
    handles = [Patch(facecolor=atlas.color(method, theme), label=method) for _, method in sorted(seen.items())]
    if handles:
        axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.02, 1.01), borderaxespad=0)
    name_axes(figure)
    title_of(figure, "The best method, and how much slower the others are")
    return figure


# ---- The scene


def image_file(folder, place):
    return os.path.join(folder, "stability-images", f"n{place[0]:g}-r{place[1]:g}.npy")


def tone(image):
    return style.srgb(np.clip(1.4 * image, 0, 1))


def draw_scene(atlas, folder, places, theme):
    figure, panels = maps(1, len(places), (1.9, 1.9), left=0.1, top=0.35, bottom=0.1)
    for axes, place in zip(panels, places):
        axes.imshow(tone(np.load(image_file(folder, place)).astype(float)), interpolation="none")
        axes.axis("off")
        axes.set_title(f"n {exponent_text(place[0])}, radius {place[1]:g}", fontsize=9, pad=3)
    return figure


def corners(atlas):
    """Four cells from a dull lobe and a large light to a sharp one and a small one, as far as they were measured."""
    chosen = []
    for share in (0, 1 / 3, 2 / 3, 1):
        n = atlas.exponents[round(share * (len(atlas.exponents) - 1))]
        radius = atlas.radii[round((1 - share) * (len(atlas.radii) - 1))]
        if (n, radius) not in chosen:
            chosen.append((n, radius))
    return chosen


# ---- The section

TEXT = [
    "One room, with a lamp of constant power beside the camera and two panels that reflect by a Phong lobe: one throws a "
    "caustic on the walls, one shows the lamp's highlight. The lobe's exponent and the lamp's radius vary; every way of light "
    "has an efficient technique in all cells, and each method lacks some.",
    "Numbers are microseconds to unit variance: variance per sample (relative, as in the section on scenes) times seconds per "
    "sample, of the processor where the device is one. Where repeats do not agree on the variance, or it grows with the number of "
    "samples, or no sample has met the light, it is suspect: it may be infinite, and the number is what was met of it, a lower "
    "bound.",
    "The reference of each cell is by bidir balance, from other seeds. All methods are unbiased; one whose image differs from the "
    "reference all the same has rare large samples that no round met, and is marked as biased.",
]


def summary(atlas):
    rows = []
    for method in atlas.methods:
        entries = [entry for entry in atlas.of(method) if not entry.refused]
        losses = [entry.cost / atlas.ranked(entry.place)[0].cost for entry in entries if entry.sound]
        wins = sum(atlas.ranked(entry.place)[0] is entry for entry in entries if entry.sound)
        rows.append([method, len(losses), len(entries) - len(losses), wins, sum(loss < 1.5 for loss in losses),
                     float(np.median(losses)) if losses else "", max(losses, default="")])
    return {"columns": ["method", "sound in cells", "suspect or biased", "best in", "within 1.5 times the best",
                        "median time / best, where sound", "largest"],
            "rows": rows, "note": f"Of {len(atlas.places)} cells: exponents {', '.join(map(exponent_text, atlas.exponents))}; "
                                  f"radii {', '.join(f'{radius:g}' for radius in atlas.radii)}."}


def main():
    folder = sys.argv[1]
    atlas = Atlas(style.read(folder, "stability.csv"))
    drawings, charts = [], []
    if any(entry.sound for entry in atlas.entries):
        drawings += [("stability-best", partial(draw_best, atlas)), ("stability-cost", partial(draw_costs, atlas))]
        charts += [
            {"svg": "stability-best.svg", "title": "The best method",
             "caption": f"Above, how many times as long the runner-up takes; faint where that is below {CLEAR_MARGIN:g} or within "
                        "two standard errors, or where one that is suspect may be faster. Below, the best method of another "
                        "integrator; ≥: of what is known of it, its variance being suspect."},
            {"svg": "stability-cost.svg", "title": "Each method", "caption": "Microseconds to unit variance. Hatched: the variance is suspect, and what was met of it is a lower bound, if "
                        "anything was. Crossed: the image is off the reference, though its variance does not show why."}]
    places = [place for place in corners(atlas) if os.path.exists(image_file(folder, place))]
    if places:
        drawings.append(("stability-scene", partial(draw_scene, atlas, folder, places)))
        charts.append({"svg": "stability-scene.svg", "title": "The scene", "caption": "The references of some cells."})
    style.save_all(folder, drawings)
    style.section(
        folder, "stability", title="Where methods fail", order=50, text=TEXT, summary=summary(atlas), charts=charts,
        tables=[{"csv": "stability.csv", "title": "Every method in every cell",
                 "columns": ["exponent", "light_radius", "integrator", "strategy", "connect_or_weights", "verdict",
                             "variance_per_sample", "variance_standard_error", "top_share", "processor_seconds_per_sample",
                             "variance_times_seconds", "variance_measured", "mean_bias_sigma", "reference_relmse", "reason"]}])


if __name__ == "__main__":
    main()
