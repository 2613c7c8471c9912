"""Draws the charts of `phlux bench techniques` (share of each technique (s, t) in light, variance and rays); writes its section of the report.

    python3 techniques.py FOLDER
"""
import math
import sys
from functools import partial
from types import SimpleNamespace

import chart_style as style
import matplotlib.pyplot as plt

QUANTITIES = (("variance_share", "of the variance"), ("light_share", "of the light"), ("ray_share", "of the rays"))
LEAST_SHARE = 0.01  # of the variance or the light, to have bars of its own
T_95 = 2.26  # Student's t, 10 rounds


def name_of(row):
    return "longer paths" if math.isnan(row.edges) else f"({row.light_vertices:g}, {row.eye_vertices:g})"


def with_others(rows):
    """(label, row) of the techniques that are shown, and the sum of the others."""
    shown = [row for row in rows if max(row.variance_share, row.light_share) >= LEAST_SHARE]
    others = [row for row in rows if row not in shown]
    sums = SimpleNamespace(**{quantity: sum(getattr(row, quantity) for row in others) for quantity, _ in QUANTITIES})
    return [(name_of(row), row) for row in shown] + ([(f"{len(others)} others", sums)] if others else [])


def draw(rows, theme):
    labelled = with_others(rows)
    shown = [row for _, row in labelled]
    figure, axes = plt.subplots(figsize=(9, 1.15 + 0.5 * len(shown)))
    for k, (quantity, label) in enumerate(QUANTITIES):
        ys = [i + 0.26 * (k - 1) for i in range(len(shown))]
        shares = [100 * getattr(row, quantity) for row in shown]
        errors = [100 * T_95 * getattr(row, quantity + "_standard_error", 0.0) for row in shown]
        axes.barh(ys, shares, height=0.24, color=theme.color(k), label=label)
        if quantity != "ray_share":
            axes.errorbar(shares, ys, xerr=errors, ls="none", lw=0.9, color=theme.ink)
    axes.axvline(0, color=theme.axis, lw=0.8)
    axes.set_yticks(range(len(shown)), [label for label, _ in labelled])
    axes.set_ylim(len(shown) - 0.45, -0.55)
    axes.set_xlabel("share in percent")
    axes.set_ylabel("technique (light, eye vertices)")
    axes.grid(True, axis="x")
    height = figure.get_figheight()
    figure.subplots_adjust(0.16, 0.8 / height, 0.98, 1 - 0.12 / height)
    figure.legend(loc="lower right", ncol=3)
    return figure


def main():
    folder = sys.argv[1]
    rows = style.read(folder, "techniques.csv")
    scenes = list(dict.fromkeys(row.scene for row in rows))
    of_scene = {scene: [row for row in rows if row.scene == scene] for scene in scenes}
    style.save_all(folder, [(f"techniques-{scene}", partial(draw, of_scene[scene])) for scene in scenes])
    method = style.variant_of(rows[0])
    summary = []
    for scene in scenes:
        first = of_scene[scene][0]
        summary.append([scene, name_of(first), 100 * first.variance_share, 100 * T_95 * first.variance_share_standard_error,
                        100 * first.light_share, 100 * first.ray_share])
    style.section(
        folder, "techniques", title=f"Techniques of {method}", order=12,
        text=["A technique (s, t) makes paths from s vertices of a light subpath and t of an eye subpath. Its share of the variance "
              "is the covariance of its weighted contributions with the image, divided by the variance of the image, so that all "
              "shares add up to 100%; the share of a technique that compensates for others is negative. The rays of a technique are "
              "its shadow rays; the other rays are those of the subpaths, which all techniques use."],
        summary={"text": style.read_verdict(folder, "techniques"), "columns": ["scene", "technique", "% of the variance", "+-", "% of the light", "% of the rays"], "rows": summary,
                 "note": f"The technique of {method} that causes the largest part of the variance; +- is a 95% interval."},
        charts=[{"svg": f"techniques-{scene}.svg", "title": f"{scene}: share of each technique",
                 "caption": "Techniques with at least 1% of the variance or of the light. Error bars are 95% intervals."} for scene in scenes],
        tables=[{"csv": "techniques.csv", "title": "All techniques"}])


if __name__ == "__main__":
    main()
