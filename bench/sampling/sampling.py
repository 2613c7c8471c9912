"""Draws the charts of `phlux bench sampling` from its two tables; writes its section of the report.

    python3 sampling.py FOLDER
"""
import sys
from functools import partial

import chart_style as style
import numpy as np
from sampling_charts import draw_heat, draw_tradeoff, draw_winners
from sampling_efficiency import (COST_MODELS, LIGHTS, RAY_COST, STRATEGIES, materials_of, read_rows, relative_products,
                                 relative_times)


def summary_of(rows, lights):
    times = relative_times(rows)
    results = {light: relative_products([row for row in rows if row.integrand == light], COST_MODELS[1]) for light in lights}
    lines = []
    for strategy in STRATEGIES:
        of_strategy = [row for row in rows if row.strategy == strategy]
        if not of_strategy:
            continue
        line = [strategy, float(np.median(times[strategy])) if times[strategy] else ""]
        for light in lights:
            ratios, wins = results[light]
            if ratios[strategy]:
                line += [wins[strategy], *map(float, np.quantile(ratios[strategy], (0.5, 0.9)))]
            else:
                line += ["", "", ""]
        line += [sum(bool(row.marks) for row in of_strategy), len(of_strategy)]
        lines.append(line)
    columns = ["strategy", "time"]
    for light in lights:
        columns += [f"{light}: best in", "median ratio", "90th percentile"]
    note = ("time: median of the time per sample over that of lobe-ks. ratio: variance × cost over that of the best strategy in "
            "the same case, with roulette where the strategy has it, and with a ray that costs "
            f"{RAY_COST} samples of lobe-ks. Marked rows (biased, suspected of infinite variance, or too few samples) are left out.")
    return {"columns": columns + ["marked", "of"], "rows": lines, "note": note}


def write_section(folder, rows, lights, charts):
    text = [
        "Each strategy samples a direction and estimates the reflected radiance of one material for one direction. Strategies "
        "with Russian roulette trace fewer rays, so their variance must be compared at equal cost. The best strategy has the "
        "least variance × cost. The cost is the time of the sampler alone, as if rays were free, or that time plus the cost of "
        "the rays that are traced on.",
        "lobe-estimate-printed is the estimate as CW 197 prints it. It is biased: it loses the part of the lobe that its own "
        "sample finds below the surface. Its variance is infinite as well, but diverges only logarithmically (a sample that is "
        "drawn with probability e has weight 1/e, and e can be arbitrarily small), so its variance is left empty and it is not "
        "compared. A row is unresolved if the standard error of its variance is above a third of it, that is, if too few "
        "samples hit the lobe.",
    ]
    style.section(folder, "sampling", title="Sampling strategies", order=20, text=text,
                  summary=summary_of(rows, lights), charts=charts,
                  tables=[{"csv": "sampling.csv", "title": "All results",
                           "columns": ["strategy", "kd", "ks", "n", "theta_deg", "integrand", "samples", "mean", "exact",
                                       "bias_sigma", "variance", "variance_standard_error", "rays_per_sample",
                                       "ns_per_sample", "ns_least", "ns_most", "variance_times_cost", "marks"]}])


def main():
    folder = sys.argv[1]
    rows, no_roulette = read_rows(folder)
    grids = materials_of(rows)
    lights = [light for light in LIGHTS if any(row.integrand == light for row in rows)]
    cases = list(dict.fromkeys((row.material, row.cell) for row in rows))[:4]
    charts, drawings = [], []

    def chart(name, draw, title, caption):
        drawings.append((name, draw))
        charts.append({"svg": name + ".svg", "title": title, "caption": caption})

    if grids:
        for light in lights:
            chart(f"sampling-winners-{light}", partial(draw_winners, (rows, no_roulette), grids, light),
                  f"Best strategy under {LIGHTS[light]}",
                  "The number is variance × cost of the second best strategy over that of the best (≫: 1000 or more). "
                  "Pale cells without a number: the difference is not significant.")
    for light in lights:
        chart(f"sampling-tradeoff-{light}", partial(draw_tradeoff, rows, cases, light),
              f"Variance against speed under {LIGHTS[light]}",
              "Strategies on one grey line are equally efficient; right and down is better. Hollow: biased.")
    if grids:
        material = (0.4, 0.4) if (0.4, 0.4) in grids else next(iter(grids))
        for light in lights:
            chart(f"sampling-cost-{light}", partial(draw_heat, rows, material, *grids[material], light),
                  f"Cost of each strategy under {LIGHTS[light]}",
                  "Nanoseconds of sampling until the variance of the mean equals the square of the mean. ∞: the variance is "
                  "suspected to be infinite; b: biased; ?: too few samples; –: not measured, too many proposals.")
    style.save_all(folder, drawings)
    write_section(folder, rows, lights, charts)


if __name__ == "__main__":
    main()
