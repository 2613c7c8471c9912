"""Draws the charts of `phlux bench stability` from stability.csv; writes its section of the report.

    python3 stability.py FOLDER
"""
import os
import sys
from functools import partial

import chart_style as style
import numpy as np
from stability_maps import draw_best, draw_costs, panels_of
from stability_results import Grid, exponent_text


def image_file(folder, cell):
    return os.path.join(folder, "stability-images", f"n{cell[0]:g}-r{cell[1]:g}.npy")


def tone(image):
    return style.srgb(np.clip(1.4 * image, 0, 1))


def draw_scene(folder, cells, theme):
    figure, panels = panels_of(1, len(cells), (1.9, 1.9), left=0.1, top=0.35, bottom=0.1)
    for axes, cell in zip(panels, cells):
        axes.imshow(tone(np.load(image_file(folder, cell)).astype(float)), interpolation="none")
        axes.axis("off")
        axes.set_title(f"n {exponent_text(cell[0])}, radius {cell[1]:g}", fontsize=9, pad=3)
    return figure


def diagonal(grid):
    """Up to four cells, from the widest lobe and the largest light to the narrowest and the smallest."""
    chosen = []
    for share in (0, 1 / 3, 2 / 3, 1):
        n = grid.exponents[round(share * (len(grid.exponents) - 1))]
        radius = grid.radii[round((1 - share) * (len(grid.radii) - 1))]
        if (n, radius) not in chosen:
            chosen.append((n, radius))
    return chosen


TEXT = [
    "One room with a disk light of constant power beside the camera, and two panels with a Phong lobe: one casts a caustic on the "
    "walls, the other shows a reflection of the light. The exponent of the lobe and the radius of the light vary. In every cell "
    "bidirectional path tracing has an efficient technique for each path; path tracing and light tracing each lack some of them.",
    "Numbers are microseconds to unit variance: variance per sample (relative, as in the section on scenes) times seconds per "
    "sample, in processor time if the device is a CPU. A variance is suspect, that is possibly infinite, if the renders disagree "
    "about it, if it grows with the number of samples, or if no sample has found the light. The number is then a lower bound.",
    "The reference of each cell is rendered by bidir balance with other seeds. All methods are unbiased. If an image still "
    "differs from the reference, its method has rare large samples that no round has drawn; it is marked as biased.",
]


def summary(grid):
    rows = []
    for method in grid.methods:
        results = [result for result in grid.of(method) if not result.refused]
        ratios = [result.cost / grid.ranked(result.cell)[0].cost for result in results if result.sound]
        wins = sum(grid.ranked(result.cell)[0] is result for result in results if result.sound)
        rows.append([method, len(ratios), len(results) - len(ratios), wins, sum(ratio < 1.5 for ratio in ratios),
                     float(np.median(ratios)) if ratios else "", max(ratios, default="")])
    return {"columns": ["method", "sound in cells", "suspect or biased", "best in", "within 1.5 times the best",
                        "median time / best, where sound", "largest"],
            "rows": rows, "note": f"Of {len(grid.cells)} cells: exponents {', '.join(map(exponent_text, grid.exponents))}; "
                                  f"radii {', '.join(f'{radius:g}' for radius in grid.radii)}."}


def map_charts(grid):
    """The (name, draw) pairs of the maps, and their entries in the report section."""
    drawings = [("stability-best", partial(draw_best, grid)), ("stability-cost", partial(draw_costs, grid))]
    charts = [
        {"svg": "stability-best.svg", "title": "The best method",
         "caption": "The colour of a cell is that of its best method. Upper number: time of the second best method, divided by that of "
                    "the best. The cell is faint if they are tied, or if a suspect or undecided method may need less time. Lower "
                    "number: the same for the best method of another integrator; ≥: its variance is suspect, and this is a lower "
                    "bound."},
        {"svg": "stability-cost.svg", "title": "Each method",
         "caption": "Microseconds to unit variance. Hatched: the variance is suspect and the number is a lower bound; ?: no "
                    "sample found light. Crossed: biased, the image differs from the reference by more than its variance "
                    "explains."}]
    return drawings, charts


def main():
    folder = sys.argv[1]
    grid = Grid(style.read(folder, "stability.csv"))
    drawings, charts = map_charts(grid) if any(result.sound for result in grid.results) else ([], [])
    cells = [cell for cell in diagonal(grid) if os.path.exists(image_file(folder, cell))]
    if cells:
        drawings.append(("stability-scene", partial(draw_scene, folder, cells)))
        charts.append({"svg": "stability-scene.svg", "title": "The scene", "caption": "The references of some cells."})
    style.save_all(folder, drawings)
    style.section(
        folder, "stability", title="Where methods fail", order=50, text=TEXT, summary=summary(grid), charts=charts,
        tables=[{"csv": "stability.csv", "title": "Every method in every cell",
                 "columns": ["exponent", "light_radius", "integrator", "strategy", "connect_or_weights", "verdict",
                             "variance_per_sample", "variance_standard_error", "top_share", "cost", "cost_ratio_low",
                             "cost_ratio_high", "rank", "variance_measured", "mean_bias_sigma", "reference_relmse", "reason"]}])


if __name__ == "__main__":
    main()
