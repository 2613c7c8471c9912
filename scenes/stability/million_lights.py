#!/usr/bin/env python3
"""Writes million-lights.ply, the mesh of million-lights.xml: triangles that face down, one in each square metre.

Usage: million_lights.py [OUTPUT] [SIDE]
The mesh has SIDE * SIDE triangles (1000 * 1000) at y = 1.
"""
import array
import pathlib
import random
import struct
import sys

EDGE = 0.15


def write(path, side):
    chance = random.Random(1)
    positions, faces = array.array("f"), bytearray()
    for row in range(side):
        for column in range(side):
            x = column - side / 2 + chance.random() * (1 - EDGE)
            z = row - side / 2 + chance.random() * (1 - EDGE)
            positions.extend((x, 1, z, x + EDGE, 1, z, x, 1, z + EDGE))
            faces += struct.pack("<B3i", 3, *range(len(positions) // 3 - 3, len(positions) // 3))
    with path.open("wb") as file:
        file.write(
            f"ply\nformat binary_little_endian 1.0\nelement vertex {3 * side * side}\n"
            "property float x\nproperty float y\nproperty float z\n"
            f"element face {side * side}\nproperty list uchar int vertex_indices\nend_header\n".encode()
        )
        if sys.byteorder != "little":
            positions.byteswap()
        positions.tofile(file)
        file.write(faces)


if __name__ == "__main__":
    here = pathlib.Path(__file__).parent
    write(
        pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else here / "million-lights.ply",
        int(sys.argv[2]) if len(sys.argv) > 2 else 1000,
    )
