#!/usr/bin/env python3
"""Renders a scene in Mitsuba 3 under Lemma's conventions: the same camera and triangles, box filter, one-sided lights that do not
reflect, the report's Phong reflection, paths of the same greatest length, roulette from the third scattering on. Writes the
image at each doubling of the samples and after the last pass, with the time each took; compiling is not timed, as it is done
once for a scene of any number of samples. Runs in the environment that has Mitsuba; bench/speed_error/peers.py calls it."""

import argparse
import ctypes.util
import json
import os
import sys
import tempfile
import time
from pathlib import Path

import numpy

from course_scene import UnsupportedScene, read_scene

VARIANT = "llvm_ad_rgb"  # compiled for the machine, all threads
LLVM = "LLVM-19"  # that ./run installs; of others that may be found, 14 to 16 abort on processors with AVX-512
MAX_DEPTH = 1000  # scatterings, as `lemma render`
FIRST_ROULETTE = 3  # scattering at which roulette begins, as `lemma render`
LARGEST_PASS = 64  # samples a pixel: what one launch of the compiled kernel does


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, allow_abbrev=False)
    parser.add_argument("scene", type=Path)
    parser.add_argument("--size", required=True, help="WIDTHxHEIGHT")
    parser.add_argument("--seconds", type=float, help="stop after the pass that ends so late")
    parser.add_argument("--spp", type=int, help="stop at so many samples a pixel")
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--threads", type=int, required=True)
    parser.add_argument("--out", type=Path, required=True, help="begin of the names of all files written")
    return parser.parse_args()


def write_ply(mesh, path):
    """ASCII, every digit a float needs."""
    lines = ["ply", "format ascii 1.0", f"element vertex {len(mesh.vertices)}"]
    lines += [f"property float {axis}" for axis in "xyz"]
    lines += [f"element face {len(mesh.triangles)}", "property list uchar int vertex_index", "end_header"]
    lines += [" ".join(f"{x:.9g}" for x in vertex) for vertex in mesh.vertices]
    lines += ["3 " + " ".join(map(str, triangle)) for triangle in mesh.triangles]
    path.write_text("\n".join(lines) + "\n")


def bsdf(material):
    """Mitsuba's own Lambert where that is all; plates whose lobe matters have the plug-in."""
    if any(material.ks):
        return {"type": "phong", "kd": list(material.kd), "ks": list(material.ks), "exponent": float(material.ns)}
    diffuse = {"type": "diffuse", "reflectance": {"type": "rgb", "value": list(material.kd)}}
    return {"type": "twosided", "nested": diffuse}


def shape(mesh, material, path):
    write_ply(mesh, path)
    found = {"type": "ply", "filename": str(path), "face_normals": True, "bsdf": bsdf(material)}
    if material.radiance:
        found["emitter"] = {"type": "area", "radiance": {"type": "rgb", "value": list(material.radiance)}}
    return found


def description(scene, size, mi):
    """The scene as Mitsuba's dictionary. Writes a mesh file for each material into the folder, which must stay until it is loaded."""
    camera, (width, height) = scene.camera, size
    look = mi.ScalarTransform4f().look_at(origin=camera.eye, target=camera.look_at, up=camera.up)
    return {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": MAX_DEPTH + 1, "rr_depth": FIRST_ROULETTE},
        "sensor": {
            "type": "perspective", "fov": camera.fovy, "fov_axis": "y", "to_world": look, "near_clip": 1e-4, "far_clip": 1e8,
            "film": {"type": "hdrfilm", "width": width, "height": height, "pixel_format": "rgb", "component_format": "float32",
                     "rfilter": {"type": "box"}},
            "sampler": {"type": "independent"},
        },
    }


def load(scene, size, mi):
    with tempfile.TemporaryDirectory(prefix="lemma-peer-") as folder:
        everything = description(scene, size, mi)
        for i, mesh in enumerate(scene.meshes):
            everything[f"mesh{i}"] = shape(mesh, scene.materials[mesh.material], Path(folder) / f"{i}.ply")
        return mi.load_dict(everything)


class Accumulation:
    """Weighted sums over passes: the mean image, and the variance of that mean from the spread of the passes."""

    def __init__(self):
        self.spp = self.passes = 0
        self.mean = self.squares = 0.0  # squares: sum of n (x - mean)^2 (West 1979)

    def add(self, image, spp):
        self.spp += spp
        self.passes += 1
        delta = image - self.mean
        self.mean = self.mean + delta * (spp / self.spp)
        self.squares = self.squares + spp * delta * (image - self.mean)

    def variance(self):
        return self.squares / ((self.passes - 1) * self.spp)


def write_picture(image, path, mi):
    """By the sRGB curve, 1 being white, as `lemma render` writes pictures."""
    bitmap = mi.Bitmap(image.astype("float32"), mi.Bitmap.PixelFormat.RGB)
    bitmap.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.UInt8, srgb_gamma=True).write(str(path))


def write_exr(sums, path, mi):
    """R, G, B and, after two or more passes, Lemma's layer variance."""
    if sums.passes < 2:
        mi.Bitmap(sums.mean.astype("float32"), mi.Bitmap.PixelFormat.RGB).write(str(path))
        return
    layers = numpy.concatenate([sums.mean, sums.variance()], axis=2).astype("float32")
    names = ["R", "G", "B", "variance.R", "variance.G", "variance.B"]
    bitmap = mi.Bitmap(layers, mi.Bitmap.PixelFormat.MultiChannel, names)
    bitmap.metadata()["lemma:variance-parts"] = sums.passes
    bitmap.write(str(path))


class Renderer:
    """Passes of one loaded scene, each timed; a number of samples not met before is compiled first, on another seed."""

    def __init__(self, scene, mi):
        self.scene, self.mi = scene, mi
        self.compiled = set()

    def timed_pass(self, spp, seed):
        """Image, seconds, and seconds of all threads."""
        if spp not in self.compiled:
            self._render(spp, 0)
            self.compiled.add(spp)
        start, cpu = time.perf_counter(), time.process_time()
        image = self._render(spp, seed)
        return image, time.perf_counter() - start, time.process_time() - cpu

    def _render(self, spp, seed):
        # Mitsuba mixes seed and index of a sample; passes of one run and all runs must have seeds of their own.
        return numpy.array(self.mi.render(self.scene, spp=spp, seed=seed), dtype=float)


def next_pass(spp, limit):
    """Doubles the samples until a pass is as large as it gets."""
    pass_spp = min(max(spp, 1), LARGEST_PASS)
    return pass_spp if limit is None else min(pass_spp, limit - spp)


def render(scene, mi, arguments):
    renderer, sums = Renderer(scene, mi), Accumulation()
    points, seconds, cpu = [], 0.0, 0.0
    while True:
        spp = next_pass(sums.spp, arguments.spp)
        image, pass_seconds, pass_cpu = renderer.timed_pass(spp, 1000 * arguments.seed + sums.passes + 1)
        sums.add(image, spp)
        seconds, cpu = seconds + pass_seconds, cpu + pass_cpu
        last = (arguments.seconds and seconds >= arguments.seconds) or (arguments.spp and sums.spp >= arguments.spp)
        if last or sums.spp & (sums.spp - 1) == 0:
            file = arguments.out.with_suffix(f".{sums.spp}.exr")
            write_exr(sums, file, mi)
            points.append({"spp": sums.spp, "seconds": seconds, "cpu_seconds": cpu, "image": str(file)})
        if last:
            write_picture(sums.mean, arguments.out.with_suffix(".png"), mi)
            return points


def main():
    arguments = parse_arguments()
    if (arguments.seconds is None) == (arguments.spp is None):
        sys.exit("mitsuba_render: error: one of --seconds and --spp is needed")
    if library := ctypes.util.find_library(LLVM):
        os.environ.setdefault("DRJIT_LIBLLVM_PATH", library)  # read when Mitsuba is loaded
    import drjit
    import mitsuba as mi
    mi.set_variant(VARIANT)
    drjit.set_thread_count(arguments.threads)
    from phong import Phong
    mi.register_bsdf("phong", Phong)
    try:
        scene = read_scene(arguments.scene)
    except UnsupportedScene as error:
        sys.exit(f"mitsuba_render: error: {error}")
    size = tuple(map(int, arguments.size.split("x")))
    points = render(load(scene, size, mi), mi, arguments)
    figures = {"peer": f"mitsuba {mi.__version__}, {VARIANT}", "seed": arguments.seed, "threads": arguments.threads,
               "width": size[0], "height": size[1], "points": points,
               "camera_samples_per_second": size[0] * size[1] * points[-1]["spp"] / points[-1]["seconds"]}
    arguments.out.with_suffix(".json").write_text(json.dumps(figures))


if __name__ == "__main__":
    main()
