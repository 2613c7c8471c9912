"""Draws the charts of `phlux bench sampling --lobe` from the tables sampling-MODEL.csv; writes a section for each model.

    python3 sampling_model.py FOLDER
"""
import pathlib
import re
import sys

import chart_style as style
import matplotlib.pyplot as plt
from sampling_ranking import read

COST = "nanoseconds per sample, ray included"
PANELS = (("relative variance of one sample", lambda row: row.relative_variance),
          (COST, lambda row: row.cost_ns),
          ("variance × cost, ns", lambda row: row.relative_variance * row.cost_ns))


def models_of(folder):
    names = (re.fullmatch(r"sampling-(\w+)\.csv", path.name) for path in sorted(pathlib.Path(folder).glob("*.csv")))
    return [name[1] for name in names if name]


def draw(ranking, theme):
    figure, panels = plt.subplots(1, len(PANELS), figsize=(9, 3), layout="constrained")
    rows = [row for row in ranking if not row.roulette]
    for axes, (title, value) in zip(panels, PANELS):
        for i, strategy in enumerate(sorted({row.strategy for row in rows})):
            points = sorted((row.theta_deg, value(row)) for row in rows if row.strategy == strategy)
            axes.plot(*zip(*points), label=strategy, **theme.series(i))
        axes.set(title=title, xlabel="angle of incidence, degrees")
        if title != COST:
            axes.set_yscale("log")
        else:
            axes.set_ylim(0, 1.1 * axes.get_ylim()[1])
        axes.grid(True)
    panels[0].legend()
    return figure


def write_section(folder, model, ranking):
    table = f"sampling-{model}.csv"
    columns = ["strategy", "theta_deg", "samples", "mean", "exact", "bias_sigma", "variance", "variance_standard_error",
               "rays_per_sample", "ns_per_sample", "variance_times_cost", "marks"]
    text = [f"The strategy {model} is the sampling of the model itself; cosine and uniform sample the same function. In the table, "
            "exact is the reflectivity by quadrature of the function, and bias_sigma is (mean - exact) in standard errors."]
    if any(row.strategy == "exact-split" for row in ranking):
        text.append("exact-split is the sampling of the model, but with the exact reflectivities of its diffuse and its specular "
                    "part instead of estimates, in the choice between the parts and in roulette.")
    chart = {"svg": f"sampling-{model}.svg", "title": "Variance and cost of a sample without roulette",
             "caption": f"The cost is the time of the sampler plus {ranking[0].ray_ns:.3g} ns for each reflected ray."}
    style.section(folder, f"sampling-{model}", title=f"Sampling {model}", order=21, charts=[chart],
                  text=style.read_verdict(folder, f"sampling-{model}") + text,
                  tables=[{"csv": table, "title": "All results", "columns": columns}])


def main():
    folder = sys.argv[1]
    for model in models_of(folder):
        ranking = read(folder, f"sampling-{model}")
        style.save(folder, f"sampling-{model}", lambda theme, ranking=ranking: draw(ranking, theme))
        write_section(folder, model, ranking)


if __name__ == "__main__":
    main()
