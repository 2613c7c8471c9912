#!/usr/bin/env python3
"""Checks the chart of variance against cost of `phlux bench sampling`, drawn from a constructed ranking.

    sampling_charts.py BENCH

BENCH is the folder bench/ of the sources. The exit code is 77 (skipped) without matplotlib.
"""
import itertools
import os
import sys
import tempfile

SKIPPED = 77
HEADER = ("kd,ks,n,theta_deg,integrand,roulette,strategy,relative_variance,relative_variance_standard_error,ray_ns,cost_ns,"
          "cost_standard_error,factor,factor_least,factor_most,verdict")
# roulette, strategy, relative variance, cost, verdict; in the order of the ranking
ROWS = [
    (0, "exact", 0, 187, "best"), (0, "fold", 0.0141, 186, "slower"), (0, "mixture", 0.0142, 185, "slower"),
    (0, "lobe-rho", 0.0152, 184, "slower"), (0, "lobe-estimate", 0.09, 193, "slower"), (0, "lobe-ks", 0.31, 184, "slower"),
    (0, "rejection", 0.0141, 5672, "slower"), (0, "uniform", 17.5, 181, "slower"), (0, "cosine", 24.2, 181, "slower"),
    (0, "disk", 24.7, 182, "slower"), (0, "theta-phi", 25.2, 182, "slower"),
    (0, "lobe-estimate-printed", 1e-9, 100, "biased"),
    (1, "lobe-ks", 0.46, 164, "tied"), (1, "lobe-estimate", 0.48, 160, "tied"), (1, "exact", 0.98, 99, "slower"),
    (1, "rejection", 0.47, 570, "slower"), (1, "lobe-estimate-printed", 1e-9, 100, "biased"),
]


def write_ranking(folder):
    lines = [HEADER]
    for roulette, strategy, variance, cost, verdict in ROWS:
        best = next(row for row in ROWS if row[0] == roulette)
        factor = variance * cost / (best[2] * best[3]) if best[2] else 1 if strategy == "exact" else float("inf")
        lines.append(f"0.3,0.6,200,70,constant,{roulette},{strategy},{variance},{0.01 * variance},175,{cost},1,{factor},"
                     f"{0.95 * factor},{1.05 * factor},{verdict}")
    with open(os.path.join(folder, "sampling.ranking.csv"), "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


def check_axes(axes, renderer):
    for axis, limits in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        ticks = [value for value in axis.get_majorticklocs() if limits[0] <= value <= limits[1]]
        assert len(ticks) >= 3, f"an axis has the labels {ticks} only"
    boxes = [text.get_window_extent(renderer) for text in axes.texts if not text.get_text().startswith("×")]
    for one, other in itertools.combinations(boxes, 2):
        overlap = min(one.y1, other.y1) - max(one.y0, other.y0)
        assert overlap < 0.25 * one.height or one.x1 < other.x0 or other.x1 < one.x0, "labels overlap"
    for box in boxes + [axes.title.get_window_extent(renderer)]:
        assert box.x0 >= 0 and box.x1 <= axes.figure.bbox.x1 and box.y1 <= axes.figure.bbox.y1, "a text is cut"


def check_equal_times(axes, best, color):
    lines = [line for line in axes.lines if line.get_color() == color]
    multiples = [float(text.get_text()[1:]) for text in axes.texts if text.get_text().startswith("×")]
    assert len(lines) == len(multiples) >= 3 and multiples[0] == 1
    for line, multiple in zip(lines, multiples):
        for x, y in zip(line.get_xdata(), line.get_ydata()):
            assert abs(x * y / (multiple * best) - 1) < 1e-9, "a line is not of equal variance x cost"


def main():
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        print("SKIPPED: no matplotlib: install python3-matplotlib to have the charts checked")
        sys.exit(SKIPPED)
    sys.path[:0] = [os.path.join(sys.argv[1], "common", "report"), os.path.join(sys.argv[1], "sampling")]
    import chart_style as style
    import matplotlib.pyplot as plt
    from sampling_ranking import read
    from sampling_tradeoff import draw_tradeoff
    with tempfile.TemporaryDirectory() as folder:
        write_ranking(folder)
        rows = read(folder, "sampling")
        with plt.rc_context(style.LIGHT.parameters()):
            figure = draw_tradeoff(rows, [(rows[0].material, rows[0].cell)], "constant", style.LIGHT)
            figure.canvas.draw()
        left, right = figure.axes
        for axes in figure.axes:
            check_axes(axes, figure.canvas.get_renderer())
        check_equal_times(left, 0.0141 * 186, style.LIGHT.grid)
        check_equal_times(right, 0.46 * 164, style.LIGHT.grid)
        labels = {text.get_text() for text in left.texts}
        for label in ("exact ↓ 0", "fold", "rejection → 5,672 ns", "uniform ↑ 17.5", "lobe-estimate-printed: biased"):
            assert label in labels, f"{label} is not among {labels}"
        assert left.get_ylim()[1] < 0.2, "an outlier stretches the axis"
        assert "rejection → 570 ns" in {text.get_text() for text in right.texts}
        bold = {text.get_text() for text in right.texts if text.get_fontweight() == "bold"}
        assert bold == {"lobe-ks", "lobe-estimate"}, bold
        assert "best: exact, without variance" in left.get_title("left"), left.get_title("left")
        assert "tied: lobe-ks, lobe-estimate" in right.get_title("left"), right.get_title("left")

        style.save(folder, "chart", lambda theme: draw_tradeoff(rows, [(rows[0].material, rows[0].cell)], "constant", theme))
        with open(os.path.join(folder, "chart.svg"), encoding="utf-8") as file:
            assert ">lobe-estimate</text>" in file.read(), "text in the SVG is not text"
        with open(os.path.join(folder, "chart.pdf"), "rb") as file:
            assert b"/FontFile2" in file.read(), "fonts in the PDF are not TrueType"
    print("axes, labels, outliers, lines and verdicts are right; text is text")


if __name__ == "__main__":
    main()
