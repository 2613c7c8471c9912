"""Draws the chart of `phlux bench rays` from rays.csv; writes its section of the report.

    python3 rays.py FOLDER
"""
import sys

import chart_style as style
import matplotlib.pyplot as plt

KINDS = ("camera", "bounce", "shadow")


def count_text(triangles):
    for unit, name in ((1e6, " M"), (1e3, "k")):
        if triangles >= unit:
            return f"{triangles / unit:.3g}{name}"
    return f"{triangles:.0f}"


def draw_rates(rows, theme):
    figure, panels = plt.subplots(1, 3, figsize=(9.6, 3.4), sharey=True, constrained_layout=True)
    sizes = sorted({row.triangles for row in rows})
    for axes, kind in zip(panels, KINDS):
        of_kind = {row.triangles: row for row in rows if row.kind == kind}
        for i, size in enumerate(sizes):
            if size not in of_kind:
                continue
            row = of_kind[size]
            axes.bar(i - 0.2, row.mrays_per_s, 0.38, color=theme.color(0), label="Phlux" if i == 0 else None)
            axes.bar(i + 0.2, row.embree_mrays_per_s, 0.38, color=theme.color(1), label="Embree" if i == 0 else None)
            top = max(row.mrays_per_s, row.embree_mrays_per_s)
            axes.text(i, top, f"{row.ratio:.2f}", ha="center", va="bottom", fontsize=8)
        axes.set_xticks(range(len(sizes)), [count_text(size) for size in sizes])
        axes.set_title(f"{kind} rays")
        axes.set_xlabel("triangles")
        axes.grid(True, axis="y")
        axes.margins(y=0.12)
    panels[0].set_ylabel("million rays per second")
    panels[-1].legend(loc="upper right")
    return figure


def main():
    folder = sys.argv[1]
    rows = style.read(folder, "rays.csv")
    style.save(folder, "rays-rates", lambda theme: draw_rates(rows, theme))
    style.section(
        folder, "rays", title="Rays, compared with Embree", order=30,
        text=["Phlux and Embree trace the same rays in one process, alternating, with the same number of threads. Rates are medians of "
              "seven rounds. Camera rays are coherent, bounce rays are not. Shadow rays only test for any intersection."],
        summary={"columns": ["triangles", "kind", "million rays/s", "Embree", "ratio"],
                 "rows": [[row.triangles, row.kind, row.mrays_per_s, row.embree_mrays_per_s, row.ratio] for row in rows],
                 "note": "ratio: rate of Phlux divided by that of Embree"},
        charts=[{"svg": "rays-rates.svg", "title": "Rays per second",
                 "caption": "Numbers: rate of Phlux divided by that of Embree, median over the rounds."}],
        tables=[{"csv": "rays.csv", "title": "All results"}])


if __name__ == "__main__":
    main()
