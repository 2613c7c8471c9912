"""Sheets of images for `phlux bench scenes`: each method after equal time, and its error."""
import os

import chart_style as style
import matplotlib.pyplot as plt
import numpy as np


def tone(image, exposure):
    linear = np.clip(image * exposure, 0, None)
    bright = linear > 0.6  # compressed as in the PNG previews (host/files/tone_map.h)
    return style.srgb(np.where(bright, 0.6 + 0.4 * (1 - np.exp(-(linear - 0.6) / 0.4)), linear))


def sheet(images, draw, right=0.0):
    """A grid of images, four to a row, with `right` inches free on the right. Returns the figure and the last drawn image."""
    columns = min(len(images), 4)
    rows = -(-len(images) // columns)
    pixel_rows, pixel_columns = images[0][1].shape[:2]
    side, gap, title = 2.1, 0.06, 0.24
    high = side * pixel_rows / pixel_columns
    width, height = columns * (side + gap) + gap + right, rows * (high + title + gap)
    figure = plt.figure(figsize=(width, height))
    for i, (name, image) in enumerate(images):
        row, column = divmod(i, columns)
        axes = figure.add_axes(((gap + column * (side + gap)) / width, 1 - (row + 1) * (high + title + gap) / height + gap / height,
                                side / width, high / height))
        drawn = draw(axes, image)
        axes.axis("off")
        axes.set_title(name, fontsize=8, pad=3)
    return figure, drawn


def draw_images(images, reference):
    luminance = reference.mean(axis=2)
    lit = luminance[luminance > 0]
    exposure = min(0.18 / np.exp(np.log(lit).mean()), 1 / np.percentile(lit, 95)) if lit.size else 1
    all_images = [("reference", reference)] + images
    return sheet(all_images, lambda axes, image: axes.imshow(tone(image, exposure), interpolation="none"))[0]


def draw_errors(images, reference):
    floor = 0.01  # square root of the 1e-4 in the relative MSE

    def draw(axes, image):
        relative = ((image - reference) / np.sqrt(reference ** 2 + floor ** 2)).mean(axis=2)
        return axes.imshow(np.clip(relative, -1, 1), cmap=style.DIVERGING, vmin=-1, vmax=1, interpolation="none")

    room = 0.85  # inches, for the colour bar
    figure, drawn = sheet(images, draw, right=room)
    width, height = figure.get_size_inches()
    bar = figure.colorbar(drawn, cax=figure.add_axes((1 - (room - 0.12) / width, 0.3 / height, 0.13 / width,
                                                      min(2.0, height - 0.8) / height)))
    bar.set_ticks([-1, -0.5, 0, 0.5, 1], labels=["-100%", "-50%", "0", "+50%", "+100%"])
    bar.outline.set_visible(False)
    bar.ax.tick_params(labelsize=7)
    return figure


def file_of(folder, scene, method):
    variant = "all" if method.row.connect_or_weights == "-" else method.row.connect_or_weights
    return os.path.join(folder, "scenes-images", scene, f"{method.row.integrator}-{variant}-{method.strategy}.npy")


def sheets(folder, scene, methods):
    """The (name, draw) pairs and their entries in the report section; empty if the image files are missing."""
    path = os.path.join(folder, "scenes-images", scene, "reference.npy")
    if not os.path.exists(path):
        return [], []
    reference = np.load(path).astype(float)
    images = [(method.label, np.load(file_of(folder, scene, method)).astype(float)) for method in methods
              if not method.refused and os.path.exists(file_of(folder, scene, method))]
    drawings = [(f"scenes-{scene}-images", lambda theme: draw_images(images, reference)),
                (f"scenes-{scene}-errors", lambda theme: draw_errors(images, reference))]
    return drawings, [
            {"svg": f"scenes-{scene}-images.svg", "title": f"{scene}: images at equal time",
             "caption": f"Each after {methods_time(methods)} of rendering, at the same exposure."},
            {"svg": f"scenes-{scene}-errors.svg", "title": f"{scene}: errors at equal time",
             "caption": "(image - reference) / sqrt(reference² + 0.0001), averaged over the channels. Red: too bright; blue: "
                        "too dark. Noise mixes both colours, a bias is an even tint."}]


def methods_time(methods):
    """The median render time of the methods, as text."""
    seconds = [method.row.seconds for method in methods if not method.refused]
    return f"{np.median(seconds):.2g} seconds" if seconds else "0 seconds"
