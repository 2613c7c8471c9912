#!/usr/bin/env python3
"""Writes planet.png, the image of textures.xml: land, sea, ice and a grid, in longitude and latitude; and leaf.png, the leaf
of leaves.xml, with its outline as alpha.

Usage: make_texture.py planet|leaf [OUTPUT] [WIDTH]
       the height is half the width of a planet and the width of a leaf; the committed files are 256 and 96 pixels wide
"""
import math
import pathlib
import struct
import sys
import zlib

SEA, LAND, ICE, GRID = (38, 92, 160), (98, 142, 62), (215, 222, 228), (215, 180, 85)
WAVES = [(1, 2, 0.3, 1.0), (2, -1, 1.7, 0.9), (3, 2, 4.0, 0.7), (5, -3, 2.2, 0.5), (7, 4, 5.1, 0.35), (11, 9, 0.8, 0.25)]
BLADE, EDGE, VEIN = (70, 120, 38), (46, 92, 30), (150, 176, 92)


def height(longitude, latitude):
    """Above the sea if positive."""
    return sum(weight * math.sin(around * longitude + along * latitude + phase) for around, along, phase, weight in WAVES)


def planet(x, y, width):
    longitude, latitude = 2 * math.pi * (x + 0.5) / width, math.pi * (0.5 - (y + 0.5) / (width / 2))
    line = width // 24  # a line every 15 degrees
    if x % line == 0 or y % line == 0:
        return GRID
    if abs(latitude) + 0.08 * height(longitude, 3 * latitude) > 1.25:
        return ICE
    return LAND if height(longitude, latitude) > 0.35 else SEA


def between(first, second, share):
    share = min(max(share, 0), 1)
    return tuple(round((1 - share) * a + share * b) for a, b in zip(first, second))


def leaf(x, y, width):
    """The midrib is the vertical line in the middle, the tip is at the top."""
    pixel = 1 / width
    aside, along = abs((x + 0.5) * pixel - 0.5), 1 - (y + 0.5) * pixel
    serration = 0.012 * abs(math.sin(14 * math.pi * along))
    half = 0.4 * math.sin(math.pi * along**0.8) ** 0.9 + serration - 0.012
    stalk = 0.015 if along < 0.12 else 0
    inside = max(half, stalk) - aside  # negative outside
    color = between(EDGE, BLADE, inside / 0.15)
    side_vein = abs((9 * (along - 0.6 * aside)) % 1 - 0.5) / 9
    color = between(VEIN, color, min((aside - 0.004) / 0.012, max((side_vein - 0.002) / 0.01, aside / 0.4)))
    return color + (round(255 * min(max(0.5 + inside / pixel, 0), 1)),)


def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def main():
    name = sys.argv[1]
    color, rows_per_width, kind, size = {"planet": (planet, 0.5, 2, 256), "leaf": (leaf, 1, 6, 96)}[name]  # PNG: RGB, RGBA
    output = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else pathlib.Path(__file__).resolve().parent / f"{name}.png"
    width = int(sys.argv[3]) if len(sys.argv) > 3 else size
    lines = int(rows_per_width * width)
    rows = b"".join(b"\0" + bytes(value for x in range(width) for value in color(x, y, width)) for y in range(lines))
    header = struct.pack(">IIBBBBB", width, lines, 8, kind, 0, 0, 0)
    output.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) +
                       chunk(b"IEND", b""))


if __name__ == "__main__":
    main()
