"""Draws the charts of `phlux bench sampling` from its rankings; writes its section of the report.

    python3 sampling.py FOLDER
"""
import sys
from functools import partial

import chart_style as style
import numpy as np
from sampling_charts import draw_heat, draw_winners
from sampling_ranking import CONDITIONS, LARGEST_FACTOR, LIGHTS, STRATEGIES, factor_text, groups_of, materials_of, read
from sampling_tradeoff import draw_tradeoff

MOST_RANKINGS = 6  # of which the summary shows every factor


def factor_cell(row):
    if row is None or not row.compared:
        return row.verdict.split()[0] if row else ""
    if row.factor == 1:
        return row.verdict
    if row.factor > LARGEST_FACTOR:
        return f"over {LARGEST_FACTOR}"
    interval = f"{factor_text(row.factor)} ({factor_text(row.factor_least)} to {factor_text(row.factor_most)})"
    return f"tied, {interval}" if row.verdict == "tied" else interval


def factors_summary(rankings):
    """A row per strategy: variance x cost over that of the best in each ranking."""
    columns = ["strategy"] + [f"{light}, {'roulette' if roulette else 'no roulette'}" for light, roulette, *_ in rankings]
    of_strategies = [{row.strategy: row for row in rows} for rows in rankings.values()]
    lines = [[strategy] + [factor_cell(rows.get(strategy)) for rows in of_strategies] for strategy in STRATEGIES]
    note = ("Variance × cost, divided by that of the best strategy: the ratio of the times to the same error. In brackets: its 95% "
            "confidence interval, corrected for the number of strategies. Strategies are tied if it contains 1.")
    return columns, [line for line in lines if any(line[1:])], note


def counts_summary(rankings):
    """A row per strategy: how often it is the best or tied, and how far it is from the best."""
    columns, lines = ["strategy"], {strategy: [strategy] for strategy in STRATEGIES}
    for condition in CONDITIONS:
        name = "roulette" if condition else "no roulette"
        columns += [f"best, {name}", f"tied, {name}", f"factor, {name}"]
        for strategy, line in lines.items():
            rows = [row for (_, roulette, *_), some in rankings.items() if roulette == condition
                    for row in some if row.strategy == strategy and row.compared]
            line += [sum(row.verdict == "best" for row in rows), sum(row.verdict == "tied" for row in rows),
                     float(np.quantile([min(row.factor, LARGEST_FACTOR) for row in rows], 0.9)) if rows else ""]
    note = ("Best, tied: number of cases (material, angle and light). Factor: variance × cost, divided by that of the best strategy "
            f"of the case; the 90th percentile over all cases, at most {LARGEST_FACTOR}.")
    return columns, [line for line in lines.values() if any(line[1:])], note


def summary_of(folder, rows):
    rankings = groups_of(rows, lambda row: (row.integrand, row.roulette, row.material, row.cell))
    few = len(rankings) <= MOST_RANKINGS
    columns, lines, note = factors_summary(rankings) if few else counts_summary(rankings)
    note += f" Cost: time of the sampler plus {rows[0].ray_ns:.3g} ns for each reflected ray."
    return {"text": style.read_verdict(folder, "sampling"), "columns": columns, "rows": lines, "note": note}


def write_section(folder, rows, charts):
    text = [
        "Each strategy samples a direction and estimates the reflected radiance of one material for one direction. The best "
        "strategy has the least variance × cost, which is proportional to the time to a given error. The cost of a sample is the "
        f"time of the sampler, plus {rows[0].ray_ns:.3g} ns for a ray if the sample is reflected. By default this is about the time "
        "of a ray through half a million triangles; --ray-cost sets it.",
        "By default a render samples without roulette before edge 5 (--rr-depth), and with it from there on. The variances with "
        "and without roulette differ by orders of magnitude, and the best strategies differ too.",
        "lobe-estimate-printed is the estimate as CW 197 prints it. It is biased: its estimate of the reflectivity of the lobe is 0 "
        "if the sample for that estimate is below the surface, and the lobe is then never chosen. Its variance is infinite too: "
        "a sample that is drawn with probability e has weight 1/e, and e can be arbitrarily small. The variance of N samples grows "
        "only with the logarithm of N; it is left empty, and the strategy is not compared. A row is unresolved if the standard "
        "error of its variance is above a third of it, or if too few samples are in the lobe.",
    ]
    columns = ["strategy", "kd", "ks", "n", "theta_deg", "integrand", "bias_sigma", "variance", "variance_standard_error",
               "rays_per_sample", "ns_per_sample", "marks"]
    tables = {"sampling.csv": "With roulette in the strategies that sample the lobe",
              "sampling-no-roulette.csv": "These strategies without roulette",
              "sampling-plain-roulette.csv": "The other strategies with roulette"}
    style.section(folder, "sampling", title="Sampling strategies", order=20, text=text, summary=summary_of(folder, rows),
                  charts=charts, tables=[{"csv": name, "title": title, "columns": columns} for name, title in tables.items()])


def main():
    folder = sys.argv[1]
    rows = read(folder, "sampling")
    grids = materials_of(rows)
    lights = [light for light in LIGHTS if any(row.integrand == light for row in rows)]
    cases = list(dict.fromkeys((row.material, row.cell) for row in rows))[:4]
    charts, drawings = [], []

    def chart(name, draw, title, caption):
        drawings.append((name, draw))
        charts.append({"svg": name + ".svg", "title": title, "caption": caption})

    if grids:
        for light in lights:
            chart(f"sampling-winners-{light}", partial(draw_winners, rows, grids, light),
                  f"Best strategy in {LIGHTS[light]}",
                  "The number is variance × cost of the second best strategy, divided by that of the best (≫: more than 1000). "
                  "In faint cells without a number the best is tied with others.")
    for light in lights:
        chart(f"sampling-tradeoff-{light}", partial(draw_tradeoff, rows, cases, light),
              f"Variance against cost in {LIGHTS[light]}",
              "Bars: 95% confidence intervals. On each grey line the time to a given error is constant; its label is this time "
              "divided by that of the best strategy with any variance. Strategies outside the frame are drawn at its edge, with "
              "their value after an arrow. Bold: the best strategy, and those tied with it.")
    if grids:
        material = (0.4, 0.4) if (0.4, 0.4) in grids else next(iter(grids))
        for light in lights:
            chart(f"sampling-cost-{light}", partial(draw_heat, rows, material, *grids[material], light),
                  f"Time of each strategy without roulette in {LIGHTS[light]}",
                  "Nanoseconds until the variance of the mean equals the square of the mean. ∞: the variance is suspected to "
                  "be infinite; b: biased; ?: too few samples; –: not measured, because it needs too many proposals.")
    style.save_all(folder, drawings)
    write_section(folder, rows, charts)


if __name__ == "__main__":
    main()
