#!/usr/bin/env python3
"""Renders the references of this folder with Mitsuba 3 (pip install mitsuba numpy; its LLVM variant): README.md.

usage: render.py [--passes 64] [--spp 4096] [NAME...]"""
import argparse
import struct
import tempfile
import xml.etree.ElementTree as ElementTree
import zlib
from pathlib import Path

import mitsuba as mi
import numpy as np

mi.set_variant("llvm_ad_rgb")
import drjit as dr  # noqa: E402

here = Path(__file__).parent
scenes = {
    name: (name, {})
    for name in ("phong", "metals", "rough-glass", "plastics", "textures", "sky", "smooth", "caustic")
} | {"smooth-strict": ("smooth", {"strict": "true"})}


class Phong(mi.BSDF):
    """kd / pi + ks (n + 2) / (2 pi) cos^n, of the front alone, as in Mitsuba 0.6; sampled by the cosine."""

    def __init__(self, properties):
        mi.BSDF.__init__(self, properties)
        self.kd = mi.Color3f(properties["diffuse_reflectance"])
        self.ks = mi.Color3f(properties["specular_reflectance"])
        self.n = properties["exponent"]
        self.m_components = [mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide]
        self.m_flags = self.m_components[0]

    def eval(self, context, si, wo, active):
        active &= (si.wi.z > 0) & (wo.z > 0)
        cosine = dr.maximum(dr.dot(mi.reflect(si.wi), wo), 0)
        lobe = (self.n + 2) / (2 * dr.pi) * cosine**self.n
        return dr.select(active, (self.kd / dr.pi + self.ks * lobe) * wo.z, 0)

    def pdf(self, context, si, wo, active):
        return dr.select(active & (si.wi.z > 0) & (wo.z > 0), wo.z / dr.pi, 0)

    def eval_pdf(self, context, si, wo, active):
        return self.eval(context, si, wo, active), self.pdf(context, si, wo, active)

    def sample(self, context, si, sample1, sample2, active):
        result = mi.BSDFSample3f()
        result.wo = mi.warp.square_to_cosine_hemisphere(sample2)
        result.pdf = self.pdf(context, si, result.wo, active)
        result.eta = 1
        result.sampled_type = mi.UInt32(int(self.m_flags))
        result.sampled_component = mi.UInt32(0)
        active &= result.pdf > 0
        return result, dr.select(active, self.eval(context, si, result.wo, active) / result.pdf, 0)


class Strict(mi.BSDF):
    """strictNormals of Mitsuba 0.6: nothing passes between directions that the two normals place differently."""

    def __init__(self, properties):
        mi.BSDF.__init__(self, properties)
        self.inside = next(properties[name] for name in properties if isinstance(properties[name], mi.BSDF))
        self.m_components = [self.inside.flags(i) for i in range(self.inside.component_count())]
        self.m_flags = self.inside.flags()

    @staticmethod
    def agrees(si, wo):
        return (dr.dot(si.n, si.to_world(si.wi)) * si.wi.z > 0) & (dr.dot(si.n, si.to_world(wo)) * wo.z > 0)

    def eval(self, context, si, wo, active):
        return dr.select(self.agrees(si, wo), self.inside.eval(context, si, wo, active), 0)

    def pdf(self, context, si, wo, active):
        return self.inside.pdf(context, si, wo, active)

    def eval_pdf(self, context, si, wo, active):
        return self.eval(context, si, wo, active), self.pdf(context, si, wo, active)

    def sample(self, context, si, sample1, sample2, active):
        result, weight = self.inside.sample(context, si, sample1, sample2, active)
        return result, dr.select(self.agrees(si, result.wo), weight, 0)


mi.register_bsdf("phong", lambda properties: Phong(properties))
mi.register_bsdf("strict", lambda properties: Strict(properties))


def random_values(count, seed):
    """Numbers in [0, 1), by a congruential generator."""
    values = []
    for _ in range(count):
        seed = (seed * 1664525 + 1013904223) % 2**32
        values.append(seed / 2**32)
    return values


def write_png(file, width, height):
    """Random sRGB colours."""
    texels = bytes(int(256 * value) for value in random_values(3 * width * height, 1))
    rows = b"".join(b"\0" + texels[3 * width * y : 3 * width * (y + 1)] for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def write_sky(file, width, height):
    """Random radiances below 1, and one texel of 30."""
    mantissas = [int(255 * value**2) for value in random_values(3 * width * height, 2)]
    texels = [mantissas[3 * i : 3 * i + 3] + [128] for i in range(width * height)]
    texels[width + 2] = [240, 210, 180, 133]  # row 1
    header = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n"
    file.write_bytes(header.encode() + b"".join(map(bytes, texels)))


def mitsubas_map(sky, file):
    """The same radiance in each direction for Mitsuba 3, whose first row is at the zenith and whose last is at the nadir."""
    image = np.array(mi.Bitmap(str(sky)).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32))
    height = len(image)
    row = np.clip(np.arange(2 * height + 1) / 2 - 0.5, 0, height - 1)
    low = np.minimum(row.astype(int), height - 2)
    share = (row - low)[:, None, None]
    mi.Bitmap(((1 - share) * image[low] + share * image[low + 1]).astype(np.float32)).write(str(file))


def mitsubas_scene(name, definitions, folder):
    """The file without strict_normals, which Mitsuba 3 lacks: bsdfs are wrapped instead."""
    tree = ElementTree.parse(here / f"{name}.xml")
    root = tree.getroot()
    integrator = root.find("integrator")
    for property in integrator.findall("boolean"):
        integrator.remove(property)
    ElementTree.SubElement(integrator, "integer", name="rr_depth", value="1000")
    if definitions.get("strict") == "true":
        for shape in root.findall("shape"):
            for bsdf in shape.findall("bsdf"):
                shape.remove(bsdf)
                ElementTree.SubElement(shape, "bsdf", type="strict").append(bsdf)
    for element in list(root.findall("default")):
        if element.get("name") == "strict":
            root.remove(element)
    for element in root.iter("string"):
        if element.get("name") == "filename" and "." in element.get("value"):
            element.set("value", str(here / element.get("value")))
    sky = Path(folder) / "sky.exr"
    mitsubas_map(here / "sky.hdr", sky)
    for element in root.findall("default"):
        element.set("value", str(sky))
    file = Path(folder) / f"{name}.xml"
    tree.write(file)
    return mi.load_file(str(file))


def render(name, passes, spp):
    with tempfile.TemporaryDirectory() as folder:
        scene = mitsubas_scene(*scenes[name], folder)
        images = np.array([np.array(mi.render(scene, spp=spp, seed=seed)) for seed in range(passes)], dtype=np.float64)
    mean, variance = images.mean(0)[:, :, :3], images.var(0, ddof=1)[:, :, :3] / passes
    values = np.concatenate([mean, variance], 2).astype(np.float32)
    channels = ["R", "G", "B", "variance.R", "variance.G", "variance.B"]
    mi.Bitmap(values, mi.Bitmap.PixelFormat.MultiChannel, channels).write(str(here / f"{name}.exr"))
    noise = np.sqrt(variance.mean()) / mean.mean()
    print(f"{name}: mean {mean.mean((0, 1))}, standard error of a pixel {noise:.2g} of it")


parser = argparse.ArgumentParser()
parser.add_argument("--passes", type=int, default=64)
parser.add_argument("--spp", type=int, default=4096)
parser.add_argument("names", nargs="*", default=list(scenes))
arguments = parser.parse_args()
write_png(here / "image.png", 5, 3)
write_sky(here / "sky.hdr", 8, 4)
for reference in arguments.names:
    render(reference, arguments.passes, arguments.spp)
