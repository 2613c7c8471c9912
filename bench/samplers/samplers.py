"""Draws the charts of `phlux bench samplers` (error against samples per pixel; time to equal error); writes its section of the
report.

    python3 samplers.py FOLDER
"""
import math
import sys
from functools import partial

import chart_style as style
import matplotlib.pyplot as plt

COLUMNS = 3


def values(rows, key):
    return list(dict.fromkeys(getattr(row, key) for row in rows))


def draw_errors(rows, theme):
    """A panel for each scene: root mean square error against samples per pixel."""
    scenes, samplers = values(rows, "scene"), values(rows, "sampler")
    lines = math.ceil(len(scenes) / COLUMNS)
    figure, panels = plt.subplots(lines, COLUMNS, figsize=(9, 0.9 + 2.4 * lines), squeeze=False)
    for scene, axes in zip(scenes, panels.flat):
        for i, sampler in enumerate(samplers):
            own = sorted((row for row in rows if (row.scene, row.sampler) == (scene, sampler)),
                         key=lambda row: row.samples_per_pixel)
            axes.plot([row.samples_per_pixel for row in own], [row.error for row in own], color=theme.color(i), lw=1.2, ms=4,
                      marker=style.MARKERS[i % len(style.MARKERS)], label=sampler)
            axes.text(0.97, 0.94 - 0.1 * i, f"{own[0].slope:.2f}", color=theme.color(i), transform=axes.transAxes, ha="right",
                      va="top", fontsize="small")
        axes.set_xscale("log", base=2)
        axes.set_yscale("log")
        counts = sorted(set(row.samples_per_pixel for row in rows))
        axes.set_xticks(counts, [f"{count:g}" for count in counts])
        axes.set_title(scene, loc="left", fontsize="medium")
        axes.grid(True)
    for axes in list(panels.flat)[len(scenes):]:
        axes.set_visible(False)
    height = figure.get_figheight()
    figure.supxlabel("samples per pixel", fontsize="medium", y=0.32 / height)
    figure.supylabel("relative error", fontsize="medium")
    figure.subplots_adjust(0.11, 0.85 / height, 0.98, 1 - 0.3 / height, hspace=0.45, wspace=0.32)
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="lower center", ncol=len(samplers))
    return figure


def draw_times(rows, theme):
    """At the largest number of samples: time to the error of independent samples."""
    integrators, scenes = values(rows, "integrator"), values(rows, "scene")
    samplers = [sampler for sampler in values(rows, "sampler") if sampler != "independent"]
    figure, panels = plt.subplots(len(integrators), 1, figsize=(9, 0.9 + (0.3 * len(scenes) + 0.6) * len(integrators)),
                                  squeeze=False)
    for integrator, axes in zip(integrators, panels[:, 0]):
        for i, sampler in enumerate(samplers):
            own = [row for row in rows if (row.integrator, row.sampler) == (integrator, sampler)]
            errors = [2 * row.relative_time * row.gain_standard_error / row.gain for row in own]
            axes.errorbar([row.relative_time for row in own],
                          [scenes.index(row.scene) + 0.3 * ((i + 0.5) / len(samplers) - 0.5) for row in own], xerr=errors,
                          color=theme.color(i + 1), ls="none", lw=0.8, ms=5, marker=style.MARKERS[i + 1], label=sampler)
        axes.axvline(1, color=theme.ink, lw=0.8)
        axes.set_xscale("log")
        ticks = (0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2)
        axes.set_xlim(min(0.45, axes.get_xlim()[0]), max(1.6, axes.get_xlim()[1]))
        shown = [tick for tick in ticks if axes.get_xlim()[0] <= tick <= axes.get_xlim()[1]]
        axes.set_xticks(shown, [f"{tick:g}" for tick in shown])
        axes.set_xticks([], minor=True)
        axes.set_yticks(range(len(scenes)), scenes)
        axes.set_ylim(len(scenes) - 0.5, -0.5)
        axes.grid(True, axis="x")
        axes.set_title(integrator, loc="left")
    panels[-1, 0].set_xlabel("time to the same error, relative to independent samples")
    height = figure.get_figheight()
    figure.subplots_adjust(0.2, 0.85 / height, 0.98, 1 - 0.3 / height, hspace=0.35)
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="lower center", ncol=len(samplers))
    return figure


def main():
    folder = sys.argv[1]
    rows = style.read(folder, "samplers.csv")
    integrators = values(rows, "integrator")
    most = max(row.samples_per_pixel for row in rows)
    largest = [row for row in rows if row.samples_per_pixel == most]
    drawings = [(f"samplers-error-{name}", partial(draw_errors, [row for row in rows if row.integrator == name]))
                for name in integrators]
    style.save_all(folder, [("samplers-time", partial(draw_times, largest)), *drawings])
    style.section(
        folder, "samplers", title="Low-discrepancy samplers", order=57,
        text=["Relative errors of whole images, from renders with different seeds. The standard errors come from the jackknife over "
              "the rounds. Error and samples per pixel are related by error = c samples^slope; the slope of independent samples is "
              "-0.5."],
        summary={"text": style.read_verdict(folder, "samplers"), "columns": ["scene", "integrator", "sampler", "gain", "time"],
                 "rows": [[row.scene, row.integrator, row.sampler, row.gain, row.relative_time] for row in largest
                          if row.sampler != "independent"],
                 "note": f"{most:g} samples per pixel. Gain: variance with independent samples / with this sampler. Time: to the "
                         "error of independent samples, relative to theirs."},
        charts=[{"svg": "samplers-time.svg", "title": "Time to equal error",
                 "caption": f"{most:g} samples per pixel; left of 1 the sampler is better. Error bars are two standard errors."},
                *({"svg": f"samplers-error-{name}.svg", "title": f"Error against samples, {name}",
                   "caption": "The numbers are the slopes."} for name in integrators)],
        tables=[{"csv": "samplers.csv", "title": "All results"}])


if __name__ == "__main__":
    main()
