#!/usr/bin/env python3
"""Writes torus-knot.ply, the mesh of mesh.xml: a tube around a (2, 3) torus knot, with smooth normals.

Usage: make_mesh.py [OUTPUT] [TRIANGLES_ALONG] [TRIANGLES_AROUND]
The tube has 2 * ALONG * AROUND triangles; the committed file has 2 * 400 * 32 = 25,600.
"""
import math
import pathlib
import struct
import sys

P, Q = 2, 3  # turns around the torus's axis, and through its hole
TORUS_RADIUS, KNOT_RADIUS, TUBE_RADIUS = 0.8, 0.35, 0.18


def knot(t):
    """A point of the curve, t in [0, 2 pi]."""
    r = TORUS_RADIUS + KNOT_RADIUS * math.cos(Q * t)
    return (r * math.cos(P * t), r * math.sin(P * t), KNOT_RADIUS * math.sin(Q * t))


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(sum(x * x for x in a))
    return tuple(x / length for x in a)


def frame(t):
    """Two directions across the curve that close after one turn: away from the core circle of the torus, as far as that
    is across the tangent, and the third."""
    step = 1e-4
    tangent = unit(sub(knot(t + step), knot(t - step)))
    core = (TORUS_RADIUS * math.cos(P * t), TORUS_RADIUS * math.sin(P * t), 0.0)
    binormal = unit(cross(tangent, sub(knot(t), core)))
    return cross(binormal, tangent), binormal


def vertices(along, around):
    """Position and normal, one ring after the other."""
    for i in range(along):
        t = 2 * math.pi * i / along
        center = knot(t)
        across, binormal = frame(t)
        for j in range(around):
            angle = 2 * math.pi * j / around
            c, s = math.cos(angle), math.sin(angle)
            normal = tuple(c * a + s * b for a, b in zip(across, binormal))
            yield tuple(x + TUBE_RADIUS * n for x, n in zip(center, normal)), normal


def triangles(along, around):
    """Counter-clockwise seen from outside."""
    for i in range(along):
        for j in range(around):
            a, b = i * around + j, i * around + (j + 1) % around
            c, d = (a + around) % (along * around), (b + around) % (along * around)
            yield a, d, c
            yield a, b, d


def main():
    here = pathlib.Path(__file__).resolve().parent
    output = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else here / "torus-knot.ply"
    along = int(sys.argv[2]) if len(sys.argv) > 2 else 400
    around = int(sys.argv[3]) if len(sys.argv) > 3 else 32
    lines = ["ply", "format binary_little_endian 1.0", "comment scenes/make_mesh.py",
             f"element vertex {along * around}"]
    lines += [f"property float {name}" for name in ("x", "y", "z", "nx", "ny", "nz")]
    lines += [f"element face {2 * along * around}", "property list uchar int vertex_indices", "end_header", ""]
    with open(output, "wb") as file:
        file.write("\n".join(lines).encode("ascii"))
        for position, normal in vertices(along, around):
            file.write(struct.pack("<6f", *position, *normal))
        for triangle in triangles(along, around):
            file.write(struct.pack("<B3i", 3, *triangle))


if __name__ == "__main__":
    main()
