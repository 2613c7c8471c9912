#!/usr/bin/env python3
"""Writes sun.hdr, the environment map of sun.xml: a sky in 256 x 128 pixels, one of which is a sun.

Usage: make_sun.py [OUTPUT] [SUN]
The sun has SUN times the radiance of the sky around it (1e5). Colours are in RGBE (Ward 1991), rows run-length encoded.
"""
import math
import pathlib
import sys

WIDTH, HEIGHT = 256, 128
SUN_COLUMN, SUN_ROW = 90, 38


def rgbe(color):
    mantissa, exponent = math.frexp(max(color))
    scale = mantissa * 256 / max(color)
    return bytes([*(int(c * scale) for c in color), exponent + 128])


def sky(row):
    above = max(0.0, math.cos((row + 0.5) * math.pi / HEIGHT))  # the horizon is white, the zenith blue, the ground dark
    return (1 - 0.7 * above, 1 - 0.5 * above, 1.0) if row < HEIGHT // 2 else (0.1, 0.1, 0.1)


def encoded(values):
    """Runs and literals of at most 127 bytes."""
    code, start = bytearray(), 0
    while start < len(values):
        end = start
        while end < len(values) and values[end] == values[start] and end - start < 127:
            end += 1
        code += bytes([128 + end - start, values[start]])
        start = end
    return bytes(code)


def write(path, sun):
    with path.open("wb") as file:
        file.write(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {HEIGHT} +X {WIDTH}\n".encode())
        for row in range(HEIGHT):
            pixels = [rgbe(sky(row))] * WIDTH
            if row == SUN_ROW:
                pixels[SUN_COLUMN] = rgbe([sun * c for c in sky(row)])
            file.write(bytes([2, 2, WIDTH >> 8, WIDTH & 255]))
            for channel in range(4):
                file.write(encoded([pixel[channel] for pixel in pixels]))


if __name__ == "__main__":
    here = pathlib.Path(__file__).parent
    write(
        pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else here / "sun.hdr",
        float(sys.argv[2]) if len(sys.argv) > 2 else 1e5,
    )
