"""Draws the figures of CW 197 from the tables of `phlux bench figures`; writes their section of the report.

    python3 figures.py FOLDER

FOLDER/figure-N.csv becomes figure-N.svg and figure-N.png, N = 1 to 7.
"""
import csv
import math
import os
import sys

import chart_style as style
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LightSource

# None of these is a colour of chart_style.py: in the report its colours change with the theme.
INK = "#23272e"
GRAY = "#9ba3ad"
WHITE = "#fffffe"
BLUE = "#2f6ea5"
PALE = "#dce9f4"
FACE = "#f3f8fc"
ORANGE = "#c8641c"
CAPTION = "$k_d$ = 0.4, $k_s$ = 0.05, $n$ = 50"

plt.rcParams.update({
    "font.size": 9,
    "font.family": "DejaVu Sans",
    "axes.edgecolor": GRAY,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.8,
    "axes.titlesize": 9,
    "axes.titlecolor": INK,
    "text.color": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    "svg.hashsalt": "phlux",
    "svg.fonttype": "path",
    "figure.facecolor": WHITE,
    "axes.facecolor": WHITE,
})


def read(folder, number):
    """The columns of figure NUMBER's table, by name."""
    with open(os.path.join(folder, f"figure-{number}.csv"), newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def save(figure, folder, number):
    for extension in ("svg", "png"):
        metadata = {"Date": None} if extension == "svg" else {"Software": None}
        figure.savefig(os.path.join(folder, f"figure-{number}.{extension}"), dpi=130, metadata=metadata)
    plt.close(figure)


# ---- The section

TEXT = [
    "The figures of CW 197 (Lafortune and Willems 1994), computed by the kernels. They have a white background in both themes, as "
    "in print. Figures 6 and 7 must agree up to noise.",
]
CAPTIONS = {
    1: "f_r in the plane of incidence, for six directions of incidence.",
    2: "Integrand of the reflectivity over the angles θ and φ: f_r cos θ sin θ.",
    3: "Integrand over c = 1 - cos θ and φ, which is uniform in solid angle: f_r (1 - c).",
    4: "Integrand over the unit square with the mapping in proportion to the cosine: π f_r.",
    5: "Integrand over the unit disk, the projected hemisphere: f_r.",
    6: "Partial reflectivity of each square, from sampled directions.",
    7: "Partial reflectivity of each square, from evaluating f_r at random points in it.",
}


def write_section(folder):
    style.section(folder, "figures", title="The figures of CW 197", order=60, text=TEXT, charts=[
        {"svg": f"figure-{number}.svg", "title": f"Figure {number}", "caption": caption} for number, caption in CAPTIONS.items()])


# ---- Figure 1


def polar_panel(axes, incoming, outgoing, value, reach):
    """Polar diagram of f_r in the plane of incidence; light comes from the left."""
    half = np.radians(np.linspace(-90, 90, 181))
    for radius in np.arange(0.1, reach, 0.1):
        axes.plot(radius * np.sin(half), radius * np.cos(half), color=GRAY, lw=0.4)
        if round(radius * 10) % 2 == 0:
            axes.text(radius, -0.02, f"{radius:.1f}", ha="center", va="top", fontsize=7)
    for degrees in range(-90, 91, 30):
        angle = math.radians(degrees)
        axes.plot([0, reach * math.sin(angle)], [0, reach * math.cos(angle)], color=GRAY, lw=0.4)
    angle = np.radians(outgoing)
    x, y = value * np.sin(angle), value * np.cos(angle)
    axes.fill(np.append(x, 0), np.append(y, 0), color=PALE, lw=0)
    axes.plot(np.concatenate(([0], x, [0])), np.concatenate(([0], y, [0])), color=BLUE, lw=1.4)
    tilt = math.radians(incoming)
    tail = (-reach * math.sin(tilt), reach * math.cos(tilt))
    axes.annotate("", xy=(0, 0), xytext=tail,
                  arrowprops={"arrowstyle": "-|>", "color": ORANGE, "lw": 1.3, "shrinkA": 0, "shrinkB": 0})
    axes.axhline(0, color=INK, lw=0.9)
    axes.set_title(rf"$\theta_i$ = {incoming:g}°", pad=3)
    axes.set_xlim(-reach * 1.03, reach * 1.03)
    axes.set_ylim(-0.07, reach * 1.05)
    axes.set_aspect("equal")
    axes.axis("off")


def figure_1(folder):
    data = read(folder, 1)
    angles = sorted(set(data["incoming_degrees"]))
    reach = 0.1 * math.ceil(data["f_r"].max() * 10)
    figure, panels = plt.subplots(2, 3, figsize=(9.6, 4.9))
    for axes, incoming in zip(panels.flat, angles):
        of_angle = data["incoming_degrees"] == incoming
        polar_panel(axes, incoming, data["outgoing_degrees"][of_angle], data["f_r"][of_angle], reach)
    figure.suptitle(f"Polar diagrams of the modified Phong $f_r$ (1/sr), {CAPTION}", fontsize=10)
    figure.text(0.5, 0.02, "arrow: incoming light; distance from the origin: $f_r$ towards that direction",
                ha="center", fontsize=8)
    figure.subplots_adjust(left=0.02, right=0.98, top=0.88, bottom=0.06, wspace=0.05, hspace=0.08)
    save(figure, folder, 1)


# ---- Figures 2 to 5

PI_TICKS = ([0, math.pi / 2, math.pi, 3 * math.pi / 2, 2 * math.pi], ["0", "π/2", "π", "3π/2", "2π"])
UNIT_TICKS = ([0, 0.5, 1], ["0", "0.5", "1"])
SPACES = {
    2: {"names": (r"$\theta$", r"$\phi$"), "ticks": (([0, math.pi / 4, math.pi / 2], ["0", "π/4", "π/2"]), PI_TICKS),
        "integrand": r"$f_r\,\cos\theta\,\sin\theta$", "lines": (4, 4), "mesh": (1, 2)},
    3: {"names": ("$c$", r"$\phi$"), "ticks": (UNIT_TICKS, PI_TICKS), "integrand": "$f_r\\,(1-c)$",
        "lines": (4, 4), "mesh": (1, 2)},
    4: {"names": (r"$\xi_1$", r"$\xi_2$"), "ticks": (UNIT_TICKS, UNIT_TICKS), "integrand": r"$\pi f_r$",
        "lines": (4, 4), "mesh": (1, 2)},
    5: {"names": ("$x$", "$y$"), "ticks": (([-1, 0, 1],) * 2, ([-1, 0, 1],) * 2), "integrand": "$f_r$",
        "lines": (6, 6), "mesh": (2, 2)},
}


def gridded(data):
    """The columns as arrays over (first, second); NaN where the table has no row."""
    firsts, seconds = np.unique(data["first"]), np.unique(data["second"])
    i, j = np.searchsorted(firsts, data["first"]), np.searchsorted(seconds, data["second"])
    grids = {}
    for name, values in data.items():
        grid = np.full((len(firsts), len(seconds)), np.nan)
        grid[i, j] = values
        grids[name] = grid
    return firsts, seconds, grids


def plain_3d(axes):
    for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
        axis.pane.set_facecolor(WHITE)
        axis.pane.set_edgecolor(GRAY)
        axis.set_rotate_label(False)
        axis._axinfo["grid"].update(color="#e3e6ea", linewidth=0.5)


def parameter_panel(axes, firsts, seconds, grids, space):
    step, other = space["lines"]
    inside = ~np.isnan(grids["f_r"])
    for i in range(0, len(firsts), step):
        line = inside[i]
        axes.plot(np.full(line.sum(), firsts[i]), seconds[line], color=BLUE, lw=0.6)
    for j in range(0, len(seconds), other):
        line = inside[:, j]
        axes.plot(firsts[line], np.full(line.sum(), seconds[j]), color=BLUE, lw=0.6)
    if not inside.all():
        angle = np.linspace(0, 2 * math.pi, 200)
        axes.plot(np.cos(angle), np.sin(angle), color=BLUE, lw=1.0)
    axes.set_xlabel(space["names"][0])
    axes.set_ylabel(space["names"][1], rotation=0, labelpad=8)
    axes.set_xticks(space["ticks"][0][0], space["ticks"][0][1])
    axes.set_yticks(space["ticks"][1][0], space["ticks"][1][1])
    axes.set_box_aspect(1)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


VIEW = {"elev": 32, "azim": -62}


def faces_viewer(x, y, z):
    """Whether points of the unit sphere are on the side towards the viewer."""
    elevation, azimuth = math.radians(VIEW["elev"]), math.radians(VIEW["azim"])
    viewer = (math.cos(elevation) * math.cos(azimuth), math.cos(elevation) * math.sin(azimuth), math.sin(elevation))
    return x * viewer[0] + y * viewer[1] + z * viewer[2] > 0


def hemisphere_line(axes, x, y, z, **style):
    """A line on the hemisphere, faint on the far side."""
    near = faces_viewer(x, y, z)
    for part, alpha in ((near, 1.0), (~near, 0.25)):
        axes.plot(np.where(part, x, np.nan), np.where(part, y, np.nan), np.where(part, z, np.nan), alpha=alpha, **style)


def to_the_rim(line, along):
    """Extends a line of the (x, y) grid along this coordinate to the horizon."""
    line = line[:, ~np.isnan(line[2])]
    if line.shape[1] < 2 or line[2].min() < 1e-3:
        return line
    ends = line[:, [0, -1]].copy()
    ends[along] = np.sign(ends[along]) * np.sqrt(1 - ends[1 - along] ** 2)
    ends[2] = 0
    return np.column_stack((ends[:, 0], line, ends[:, 1]))


def hemisphere_panel(axes, grids, space):
    step, other = space["lines"]
    directions = np.array([grids[f"direction_{name}"] for name in "xyz"])
    flat = space["names"] == ("$x$", "$y$")
    lines = [(directions[:, i, :], 1) for i in range(0, directions.shape[1], step)]
    lines += [(directions[:, :, j], 0) for j in range(0, directions.shape[2], other)]
    for line, along in lines:
        hemisphere_line(axes, *(to_the_rim(line, along) if flat else line), color=BLUE, lw=0.6)
    angle = np.linspace(0, 2 * math.pi, 200)
    axes.plot(np.cos(angle), np.sin(angle), 0 * angle, color=INK, lw=0.8)
    tilt, reach = math.pi / 6, 1.5
    tip = (reach * math.sin(tilt), 0, reach * math.cos(tilt))
    axes.plot([tip[0], 0], [0, 0], [tip[2], 0], color=ORANGE, lw=1.3)
    axes.text(tip[0], 0, tip[2] + 0.05, "light", color=ORANGE, fontsize=8, ha="center")
    axes.plot([-tip[0], 0], [0, 0], [tip[2], 0], color=ORANGE, lw=1.0, ls=(0, (3, 2)))
    axes.text(-tip[0], 0, tip[2] + 0.05, "mirrored", color=ORANGE, fontsize=8, ha="center")
    axes.view_init(**VIEW)
    axes.set_xlim(-1, 1), axes.set_ylim(-1, 1), axes.set_zlim(0, 1.2)
    axes.set_box_aspect((2, 2, 1.2), zoom=1.35)
    axes.set_axis_off()


def integrand_panel(axes, firsts, seconds, grids, space):
    first, second = np.meshgrid(firsts, seconds, indexing="ij")
    value = grids["integrand"]
    axes.plot_surface(first, second, value, rstride=space["mesh"][0], cstride=space["mesh"][1], color=FACE,
                      edgecolor=BLUE, linewidth=0.35, shade=False)
    axes.set_xlabel(space["names"][0], labelpad=2)
    axes.set_ylabel(space["names"][1], labelpad=2)
    axes.set_xticks(space["ticks"][0][0], space["ticks"][0][1])
    axes.set_yticks(space["ticks"][1][0], space["ticks"][1][1])
    axes.set_zlim(0, None)
    axes.tick_params(pad=0)
    axes.view_init(elev=30, azim=-55)
    axes.set_box_aspect((1, 1, 0.8), zoom=0.92)
    plain_3d(axes)


def figure_of_space(folder, number):
    space = SPACES[number]
    firsts, seconds, grids = gridded(read(folder, number))
    figure = plt.figure(figsize=(11, 3.9))
    parameter_panel(figure.add_axes((0.06, 0.14, 0.24, 0.66)), firsts, seconds, grids, space)
    hemisphere_panel(figure.add_axes((0.31, -0.02, 0.33, 0.88), projection="3d"), grids, space)
    integrand_panel(figure.add_axes((0.64, 0.02, 0.34, 0.84), projection="3d"), firsts, seconds, grids, space)
    for x, title in ((0.18, "parameter space"), (0.475, "mapped to the hemisphere"),
                     (0.81, f"integrand {space['integrand']}")):
        figure.text(x, 0.855, title, ha="center")
    names = ", ".join(name.strip("$") for name in space["names"])
    figure.suptitle(rf"The $({names})$ parametrisation, {CAPTION}, $\theta_i$ = π/6", fontsize=10)
    save(figure, folder, number)


# ---- Figures 6 and 7


def figure_of_squares(folder, number, how, top):
    data = read(folder, number)
    value = data["partial_reflectivity"]
    side = int(round(math.sqrt(len(value))))
    width = 2 / side
    figure = plt.figure(figsize=(7.2, 5.0))
    axes = figure.add_axes((0.02, 0.0, 0.92, 0.92), projection="3d")
    shown = value > 0
    axes.bar3d(data["x"][shown] - width / 2, data["y"][shown] - width / 2, 0, width, width, value[shown],
               color=PALE, edgecolor=BLUE, linewidth=0.3, shade=True, lightsource=LightSource(azdeg=200, altdeg=65))
    axes.set_xlabel("$x$")
    axes.set_ylabel("$y$")
    axes.set_zlabel(r"$\Delta\rho_k$", labelpad=12)
    axes.set_xticks([-1, -0.5, 0, 0.5, 1])
    axes.set_yticks([-1, -0.5, 0, 0.5, 1])
    axes.set_zlim(0, top)
    axes.view_init(elev=30, azim=-55)
    axes.set_box_aspect((1, 1, 0.7), zoom=0.98)
    plain_3d(axes)
    figure.suptitle(f"Partial reflectivities by {how}\n{CAPTION}, "
                    rf"$\theta_i$ = π/6, {side} × {side} squares, sum {value.sum():.4f}", fontsize=10)
    save(figure, folder, number)


def main():
    folder = sys.argv[1]
    figure_1(folder)
    for number in SPACES:
        figure_of_space(folder, number)
    top = 1.05 * max(read(folder, number)["partial_reflectivity"].max() for number in (6, 7))
    figure_of_squares(folder, 6, "sampling: 100,000 samples", top)
    figure_of_squares(folder, 7, "evaluating: 10 samples per square", top)
    write_section(folder)


if __name__ == "__main__":
    main()
