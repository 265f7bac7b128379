"""The jobs of the benchmark: references, renderings, accelerators."""

import base64
import hashlib
import json
import re
import sys

from plan import REFERENCE, SCENES
from runs import LEMMA, PROJECT, run

COMPARISON_FAILED = 3  # exit code of lemma


def scene_path(name):
    """One of our own scenes by its name, or any other by its path."""
    return PROJECT / "scenes" / name if name in SCENES else name


def reference(jobs, scene, effort):
    """Renders the reference once: its image and its own error."""
    key = ["reference", str(scene), effort.size, effort.reference_spp, REFERENCE]

    def work(stem):
        image = stem.with_suffix(".exr")
        run([LEMMA, "render", scene_path(scene), "-q", "--size", effort.size, "--spp", effort.reference_spp, *REFERENCE,
             "-o", image, "-o", stem.with_suffix(".png"), "--stats", stem.with_suffix(".stats")])
        stats = json.loads(stem.with_suffix(".stats").read_text())
        return {"scene": str(scene), "image": str(image), "picture": data_url(stem.with_suffix(".png")), "stats": stats}

    return jobs.result(key, work)


def data_url(png):
    return "data:image/png;base64," + base64.b64encode(png.read_bytes()).decode()


def rendering_key(scene, configuration, seed, effort):
    return ["render", str(scene), configuration.options, seed, effort.size, effort.seconds,
            effort.reference_spp, REFERENCE]


def rendering(jobs, scene, configuration, seed, effort, image):
    """Renders for the time of the effort, with the error at every doubling of samples. Pictures are kept of the first seed."""

    def work(stem):
        exr, png, stats = (stem.with_suffix(ending) for ending in (".exr", ".png", ".stats"))
        run([LEMMA, "render", scene_path(scene), "-q", "--size", effort.size, "--time", effort.seconds, "--seed", seed,
             "--reference", image, *configuration.arguments(), "-o", exr, "-o", png, "--stats", stats])
        figures = json.loads(stats.read_text())
        if seed == 1:
            figures["views"] = views(exr, png, image, stem)
        exr.unlink()
        return figures

    return jobs.result(rendering_key(scene, configuration, seed, effort), work)


def views(exr, png, reference_image, stem):
    """Picture, signed difference, FLIP and the statistical test of a rendering against its reference."""
    difference, report = stem.with_suffix(".difference.png"), stem.with_suffix(".compare")
    run([LEMMA, "compare", exr, reference_image, "-q", "-o", difference, "--json", report, "--statistical"],
        accepted=(0, COMPARISON_FAILED))
    compared = json.loads(report.read_text())
    return {"picture": data_url(png), "difference": data_url(difference), "flip": compared["flip"],
            "statistical": compared["statistical"]}


def parity(jobs, scene, effort):
    """The accelerators against the exact oracle on a scene."""

    def work(stem):
        report = stem.with_suffix(".parity")
        run([LEMMA, "parity", scene_path(scene), "-q", "--rays", effort.parity_rays, "--json", report],
            accepted=(0, COMPARISON_FAILED))
        return json.loads(report.read_text())

    return jobs.result(["parity", str(scene), effort.parity_rays], work)


def traversal(jobs, effort, program):
    """Rays a second of grid against Embree, in turns; None without the program."""
    if not program.exists():
        return None

    def work(stem):
        out = stem.with_suffix(".traversal")
        run([program, "--ratios", *effort.traversal_cases, f"--rounds={effort.traversal_rounds}", f"--ratios-out={out}"])
        return json.loads(out.read_text())

    return jobs.result(["traversal", effort.traversal_cases, effort.traversal_rounds], work)


def hard_rows(table):
    """What the program of the hard cases prints at its end, a row a case and accelerator."""
    row = re.compile(r"^(.{40})(\S+) +(.*?) +(\d+) +(\d+) +(0|shown)$", re.MULTILINE)
    return [{"case": m[1].strip(), "backend": m[2], "expected": m[3], "tried": int(m[4]), "faults": int(m[5]),
             "allowed": m[6]} for m in row.finditer(table)]


def hard_cases(jobs, program, left_out):
    """The table of named hard cases, but for those left out; None without the program of the tests."""
    if not program.exists():
        return None

    def work(_):
        patterns = [f"*/{re.sub(r'[^A-Za-z0-9]', '_', name)}_*" for name in left_out]
        for name, pattern in zip(left_out, patterns):
            if "NoFaults" not in run([program, "--gtest_list_tests", f"--gtest_filter={pattern}"]):
                sys.exit(f"bench: error: no hard case {name!r} to leave out")
        rows = hard_rows(run([program, f"--gtest_filter=-{':'.join(patterns)}"], accepted=(0, 1)))
        return {"rows": rows, "left_out": list(left_out)}

    return jobs.result(["hard", hashlib.sha256(program.read_bytes()).hexdigest(), left_out], work)
