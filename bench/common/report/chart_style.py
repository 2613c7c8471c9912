"""Shared by the chart scripts of `phlux bench`: light and dark colours, fonts, output files, and sections of the report.
See bench/README.md.
"""
import csv
import json
import multiprocessing
import os
import platform
import re
from types import SimpleNamespace

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

# Each role has a light and a dark colour. No two share a light colour: dark_rules() finds a role in an SVG by it.
ROLES = {
    #          light      dark
    "paper": ("#ffffff", "#14181d"),
    "ink": ("#22272e", "#e3e7eb"),
    "muted": ("#5d6670", "#a2acb6"),  # notes, ticks
    "axis": ("#9aa3ad", "#626c77"),
    "grid": ("#e6e9ec", "#2a3138"),
    "wash": ("#f1f4f7", "#1c2229"),  # background of marked areas
}
# Colours of data series, in order; neighbours differ in hue and in lightness.
SERIES = (
    ("#1f66a8", "#62aaf0"),  # blue
    ("#cf5f12", "#f79a4f"),  # orange
    ("#2a8453", "#5cc792"),  # green
    ("#8a3f9e", "#cf95e0"),  # purple
    ("#b3243c", "#f0788a"),  # red
    ("#12899c", "#4dcfe2"),  # teal
    ("#94790b", "#d9c04a"),  # olive
    ("#c9559f", "#f5a0d2"),  # pink
    ("#73533a", "#c6a384"),  # brown
    ("#4a5a78", "#9db0d2"),  # slate
    ("#5f9e1b", "#a6dd60"),  # lime
    ("#6c5fd0", "#aaa2ff"),  # violet
)
MARKERS = "osD^vP*Xph<>"
DASHES = ("-", (0, (5, 1.6)), (0, (1.4, 1.2)))

# Integrators with their variants, in the order of tables, charts and colours.
VARIANTS = ["path none", "path light", "path mis", "light", "bidir balance", "bidir power", "bidir uniform"]

SEQUENTIAL = "viridis"  # colour maps are the same in both themes
DIVERGING = "RdBu_r"
DPI = 130


class Theme:
    """The colours of one theme: theme.ink, theme.axis, ..., and theme.series(i)."""

    def __init__(self, name):
        self.name = name
        self.dark = name == "dark"
        for role, colors in ROLES.items():
            setattr(self, role, colors[self.dark])

    def color(self, i):
        return SERIES[i % len(SERIES)][self.dark]

    def series(self, i):
        """Colour, marker and dashes of series i, as keywords of plot()."""
        return {"color": self.color(i), "marker": MARKERS[i % len(MARKERS)],
                "linestyle": DASHES[i // len(SERIES) % len(DASHES)]}

    @staticmethod
    def on(rgba):
        """Black or white text for a background of this colour, by its luminance; the same in both themes."""
        red, green, blue = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in rgba[:3])
        return "#0a0a0a" if 0.2126 * red + 0.7152 * green + 0.0722 * blue > 0.18 else "#fafafa"

    def parameters(self):
        return {
            "font.size": 9, "font.family": "sans-serif", "font.sans-serif": ["DejaVu Sans"],
            "axes.titlesize": 10, "axes.labelsize": 9,
            "xtick.labelsize": 8, "ytick.labelsize": 8, "legend.fontsize": 8, "legend.frameon": False,
            "axes.edgecolor": self.axis, "axes.labelcolor": self.ink, "axes.titlecolor": self.ink,
            "axes.facecolor": self.paper, "axes.linewidth": 0.8, "axes.grid": False, "axes.axisbelow": True,
            "axes.spines.top": False, "axes.spines.right": False,
            "grid.color": self.grid, "grid.linewidth": 0.7, "text.color": self.ink,
            "xtick.color": self.axis, "ytick.color": self.axis,
            "xtick.labelcolor": self.ink, "ytick.labelcolor": self.ink,
            "figure.facecolor": self.paper, "savefig.facecolor": self.paper, "legend.labelcolor": self.ink,
            "lines.linewidth": 1.5, "lines.markersize": 4.5,
            "svg.hashsalt": "phlux", "svg.fonttype": "none", "pdf.fonttype": 42,  # text stays text
        }


LIGHT, DARK = Theme("light"), Theme("dark")


def dark_rules(svg):
    """A style sheet that replaces the light colours in this SVG by the dark ones where the viewer prefers dark."""
    rules = []
    for light, dark in (*ROLES.values(), *SERIES):
        for property in ("fill", "stroke"):
            if f"{property}: {light}" in svg:
                rules.append(f'[style*="{property}: {light}"]{{{property}:{dark}!important}}')
            if f'{property}="{light}"' in svg:  # background of a hatched area
                rules.append(f'[{property}="{light}"]{{{property}:{dark}}}')
    return "@media (prefers-color-scheme:dark){" + "".join(rules) + "}"


def write(folder, name, text):
    """Writes folder/name atomically."""
    path = os.path.join(folder, name)
    with open(path + ".tmp", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".tmp", path)


def save(folder, name, draw):
    """Writes NAME.svg, which follows the viewer's theme, NAME.pdf, NAME.png and NAME-dark.png. draw(theme) returns a figure that uses
    colours of the theme and of colour maps only."""
    for theme in (LIGHT, DARK):
        with plt.rc_context(theme.parameters()):
            figure = draw(theme)
            suffix = "-dark" if theme.dark else ""
            figure.savefig(os.path.join(folder, f"{name}{suffix}.png"), dpi=DPI, metadata={"Software": None})
            if not theme.dark:
                figure.savefig(os.path.join(folder, name + ".pdf"), metadata={"CreationDate": None})
                path = os.path.join(folder, name + ".svg")
                figure.savefig(path, dpi=DPI, metadata={"Date": None})
                with open(path, encoding="utf-8") as file:
                    svg = re.sub(r">\s+<", "><", file.read())  # saves a sixth of the size
                end = re.search(r"<svg\b[^>]*>", svg).end()
                write(folder, name + ".svg", f"{svg[:end]}\n <style>{dark_rules(svg)}</style>{svg[end:]}")
            plt.close(figure)


def save_all(folder, drawings):
    """save() for each (name, draw), with one process per processor."""
    context = multiprocessing.get_context("fork")

    def save_some(some):
        for name, draw in some:
            save(folder, name, draw)

    count = min(os.cpu_count() or 1, len(drawings))
    workers = [context.Process(target=save_some, args=(drawings[i::count],)) for i in range(count)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    if any(worker.exitcode != 0 for worker in workers):
        raise SystemExit("a chart could not be drawn")


def value_of(text):
    """The text as a number if it is one; NaN if it is empty; else the text."""
    if text == "":
        return float("nan")
    try:
        return float(text)
    except ValueError:
        return text


def read(folder, name):
    """The rows of a CSV file, as objects with an attribute per column."""
    with open(os.path.join(folder, name), newline="", encoding="utf-8") as file:
        return [SimpleNamespace(**{column: value_of(text) for column, text in row.items()})
                for row in csv.DictReader(file)]


def read_verdict(folder, name):
    """The lines of NAME.verdict.txt, the answers that the command prints; none without the file."""
    path = os.path.join(folder, name + ".verdict.txt")
    if not os.path.exists(path):
        return []
    with open(path, encoding="utf-8") as file:
        return [line for line in file.read().split("\n") if line]


def variant_of(row):
    """The entry of VARIANTS for a row."""
    return row.integrator if row.connect_or_weights == "-" else f"{row.integrator} {row.connect_or_weights}"


def set_grid(axes, columns, rows):
    """Prepares axes for a map with one unit square per cell, labelled by these texts."""
    axes.set_xlim(-0.5, len(columns) - 0.5)
    axes.set_ylim(-0.5, len(rows) - 0.5)
    axes.set_xticks(range(len(columns)), columns)
    axes.set_yticks(range(len(rows)), rows)
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)


def srgb(linear):
    """sRGB values for linear ones in [0, 1]."""
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def section(folder, name, *, title, order, text=(), summary=None, charts=(), tables=()):
    """Writes NAME.section.json, a section of the report (bench/README.md)."""
    provenance = {"drawn by": f"Python {platform.python_version()}, matplotlib {matplotlib.__version__}"}
    content = {"title": title, "order": order, "text": list(text), "summary": summary, "charts": list(charts),
               "tables": list(tables), "provenance": provenance}
    write(folder, name + ".section.json", json.dumps(content, indent=1, ensure_ascii=False) + "\n")
