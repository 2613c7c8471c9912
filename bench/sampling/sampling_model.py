"""Draws the charts of `phlux bench sampling --lobe` from the tables sampling-MODEL.csv; writes a section for each model.

    python3 sampling_model.py FOLDER
"""
import pathlib
import re
import sys

import chart_style as style
import matplotlib.pyplot as plt

PANELS = (("variance", "variance of one sample"), ("ns_per_sample", "nanoseconds per sample"),
          ("variance_times_cost", "variance × time"))


def models_of(folder):
    names = (re.fullmatch(r"sampling-(\w+)\.csv", path.name) for path in sorted(pathlib.Path(folder).glob("*.csv")))
    return [name[1] for name in names if name]


def draw(rows, theme):
    figure, panels = plt.subplots(1, len(PANELS), figsize=(9, 3), layout="constrained")
    for axes, (column, title) in zip(panels, PANELS):
        for i, strategy in enumerate(dict.fromkeys(row.strategy for row in rows)):
            points = [(row.theta_deg, getattr(row, column)) for row in rows if row.strategy == strategy]
            axes.plot(*zip(*points), label=strategy, **theme.series(i))
        axes.set(title=title, xlabel="angle of incidence, degrees", yscale="log")
        axes.grid(True)
    panels[0].legend()
    return figure


def write_section(folder, model, rows):
    table = f"sampling-{model}.csv"
    columns = ["strategy", "theta_deg", "samples", "mean", "exact", "bias_sigma", "variance", "variance_standard_error",
               "rays_per_sample", "ns_per_sample", "variance_times_cost", "marks"]
    text = [f"The model {model} sampled by itself, with Russian roulette, and the same function sampled by the cosine and "
            "uniformly. exact is the reflectivity by quadrature of the function; bias_sigma is the difference of the mean from "
            "it in standard errors."]
    chart = {"svg": f"sampling-{model}.svg", "title": "Variance and time of a sample",
             "caption": "Roulette that absorbs adds variance, and saves the rays that are not traced."}
    style.section(folder, f"sampling-{model}", title=f"Sampling {model}", order=21, text=text, charts=[chart],
                  tables=[{"csv": table, "title": "All results", "columns": columns}])


def main():
    folder = sys.argv[1]
    for model in models_of(folder):
        rows = style.read(folder, f"sampling-{model}.csv")
        style.save(folder, f"sampling-{model}", lambda theme, rows=rows: draw(rows, theme))
        write_section(folder, model, rows)


if __name__ == "__main__":
    main()
