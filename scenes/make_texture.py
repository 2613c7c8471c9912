#!/usr/bin/env python3
"""Writes planet.png, the image of textures.xml: land, sea, ice and a grid, in longitude and latitude.

Usage: make_texture.py [OUTPUT] [WIDTH]      the height is half the width; the committed file is 256 pixels wide
"""
import math
import pathlib
import struct
import sys
import zlib

SEA, LAND, ICE, GRID = (38, 92, 160), (98, 142, 62), (215, 222, 228), (215, 180, 85)
WAVES = [(1, 2, 0.3, 1.0), (2, -1, 1.7, 0.9), (3, 2, 4.0, 0.7), (5, -3, 2.2, 0.5), (7, 4, 5.1, 0.35), (11, 9, 0.8, 0.25)]


def height(longitude, latitude):
    """Above the sea if positive."""
    return sum(weight * math.sin(around * longitude + along * latitude + phase) for around, along, phase, weight in WAVES)


def color(x, y, width):
    longitude, latitude = 2 * math.pi * (x + 0.5) / width, math.pi * (0.5 - (y + 0.5) / (width / 2))
    line = width // 24  # a line every 15 degrees
    if x % line == 0 or y % line == 0:
        return GRID
    if abs(latitude) + 0.08 * height(longitude, 3 * latitude) > 1.25:
        return ICE
    return LAND if height(longitude, latitude) > 0.35 else SEA


def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def main():
    here = pathlib.Path(__file__).resolve().parent
    output = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else here / "planet.png"
    width = int(sys.argv[2]) if len(sys.argv) > 2 else 256
    rows = b"".join(b"\0" + bytes(value for x in range(width) for value in color(x, y, width)) for y in range(width // 2))
    header = struct.pack(">IIBBBBB", width, width // 2, 8, 2, 0, 0, 0)
    output.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) +
                       chunk(b"IEND", b""))


if __name__ == "__main__":
    main()
