"""The jobs of the benchmark: references, renderings, accelerators."""

import base64
import hashlib
import json
import re
from pathlib import Path

from plan import REFERENCE, REFERENCE_REPLICATES, REFERENCE_SEED
from runs import LEMMA, PROJECT, run

COMPARISON_FAILED = 3  # exit code of lemma
EMBREE_CASE = "veach-mis"  # of the rays that are the unit of time
PART_SPP = 4096  # samples a pixel of a reference that are rendered at once


def reference(jobs, scene, effort, progress):
    """Renders the reference once, in parts of their own seeds, so that little is lost when it is interrupted: its image and its
    own error."""
    sizes = part_sizes(effort.reference_spp)
    parts = []
    for index, spp in enumerate(sizes):
        parts.append(_reference_part(jobs, scene, effort, index, spp))
        progress.done(f"{scene.name}: reference, part {index + 1} of {len(sizes)}", effort.reference_seconds() / len(sizes))

    def work(stem):
        image = Path(parts[0]["image"])
        if len(parts) > 1:
            image = stem.with_suffix(".exr")
            run(mean_command([part["image"] for part in parts], image))
        return {"image": str(image), "picture": parts[0]["picture"], "stats": mean_stats([part["stats"] for part in parts])}

    made = jobs.result(["reference", scene.digest, effort.size, sizes, REFERENCE], work)
    return {"scene": scene.name, **made}


def part_sizes(spp):
    """Samples a pixel of each part: equal ones, so that the mean of the parts is that of all samples."""
    return [spp // -(-spp // PART_SPP)] * -(-spp // PART_SPP)


def _reference_part(jobs, scene, effort, index, spp):
    seed = REFERENCE_SEED + index

    def work(stem):
        image, png, stats = (stem.with_suffix(ending) for ending in (".exr", ".png", ".stats"))
        run([LEMMA, "render", scene.path, "-q", "--size", effort.size, "--spp", spp, *REFERENCE, "--seed", seed,
             "-o", image, "-o", png, "--stats", stats])
        return {"image": str(image), "picture": data_url(png), "stats": json.loads(stats.read_text())}

    return jobs.result(["part", scene.digest, effort.size, spp, seed, REFERENCE], work)


def mean_command(images, out):
    """The command that averages images of equal numbers of samples: variances of the mean fall as one over their number, and
    their degrees of freedom add up."""
    count = len(images)
    sums = [word for image in images[1:] for word in (image, "--add")]
    factors = ",".join(map(str, [1 / count] * 3 + [1 / count**2] * 3))
    freedom = count * (REFERENCE_REPLICATES - 1)
    return ["oiiotool", images[0], *sums, "--mulc", factors, "--attrib:type=int", "lemma:variance-parts", freedom + 1,
            "-o", out]


def mean_stats(parts):
    """The first part's, with the samples of all and the error of their mean."""
    count, first = len(parts), parts[0]
    errors = {key: sum(part["estimated_error"]["relmse"][key] for part in parts) / count**2 for key in ("value", "low", "high")}
    return {**first, "spp": sum(part["spp"] for part in parts), "estimated_error": {"relmse": errors}}


def data_url(png):
    return "data:image/png;base64," + base64.b64encode(png.read_bytes()).decode()


def rendering_key(scene, configuration, seed, effort):
    return ["render", scene.digest, configuration.options, seed, effort.size, effort.seconds,
            effort.reference_spp, REFERENCE]


def rendering(jobs, scene, configuration, seed, effort, image, scale):
    """Renders for the time of the effort, with the error at every doubling of samples. Pictures are kept of the first seed, with
    the colours of `views`."""

    def work(stem):
        exr, png, stats = (stem.with_suffix(ending) for ending in (".exr", ".png", ".stats"))
        run([LEMMA, "render", scene.path, "-q", "--size", effort.size, "--time", effort.seconds, "--seed", seed,
             "--reference", image, *configuration.arguments(), "-o", exr, "-o", png, "--stats", stats])
        figures = json.loads(stats.read_text())
        if seed == 1:
            figures["views"] = views(exr, png, image, stem, scale)
        exr.unlink()
        return figures

    return jobs.result(rendering_key(scene, configuration, seed, effort), work)


def views(exr, png, reference_image, stem, scale):
    """Picture, signed difference, FLIP and the statistical test of a rendering against its reference. Colours of the difference are
    full at `scale`; None: at what 99 % of the pixels stay below."""
    difference, report = stem.with_suffix(".difference.png"), stem.with_suffix(".compare")
    run([LEMMA, "compare", exr, reference_image, "-q", "-o", difference, "--json", report, "--statistical",
         *(["--scale", repr(scale)] if scale else [])],
        accepted=(0, COMPARISON_FAILED))
    compared = json.loads(report.read_text())
    return {"picture": data_url(png), "difference": data_url(difference), "flip": compared["flip"],
            "statistical": compared["statistical"], "colors": compared["difference_image"]["colors"]}


def color_scale(figures):
    """The difference at which the colours of a rendering's views are full; None without views."""
    return figures["views"]["colors"][-1]["difference"] if "views" in figures else None


def embree_rate(jobs, scene, seed, turn, effort, program):
    """Rays a second of processor time that Embree alone traces now, as a unit of the time of renderings made beside; None without
    the program."""
    if not program.exists():
        return None
    return jobs.result(["embree rate", scene.digest, seed, turn, effort.seconds],
                       lambda _: float(run([program, "--embree-rate", EMBREE_CASE])))


def parity(jobs, scene, effort):
    """The accelerators against the exact oracle on a scene."""

    def work(stem):
        report = stem.with_suffix(".parity")
        run([LEMMA, "parity", scene.path, "-q", "--rays", effort.parity_rays, "--json", report],
            accepted=(0, COMPARISON_FAILED))
        return json.loads(report.read_text())

    report = jobs.result(["parity", scene.digest, effort.parity_rays], work)
    return {**report, "scene": scene.name}


def traversal_names(effort, scenes):
    """Cases of the program by the names of the report: the scenes of the run, by their paths, and its own."""
    return {**{str(scene.path): scene.name for scene in scenes},
            **{case: case for case in effort.traversal_cases if PROJECT / "scenes" / case not in [scene.path for scene in scenes]}}


def traversal(jobs, effort, scenes, program):
    """Rays a second of grid against Embree, in turns; None without the program."""
    if not program.exists():
        return None
    names = traversal_names(effort, scenes)

    def work(stem):
        out = stem.with_suffix(".traversal")
        run([program, "--ratios", *names, f"--rounds={effort.traversal_rounds}", f"--ratios-out={out}"])
        return json.loads(out.read_text())

    table = jobs.result(["traversal", *([scene.digest, str(scene.path)] for scene in scenes), effort.traversal_cases,
                         effort.traversal_rounds], work)
    return {**table, "cases": [{**case, "case": names[case["case"]]} for case in table["cases"]]}


def hard_rows(table):
    """What the program of the hard cases prints at its end, a row a case and accelerator."""
    row = re.compile(r"^(.{40})(\S+) +(.*?) +(\d+) +(\d+) +(0|shown)$", re.MULTILINE)
    return [{"case": m[1].strip(), "backend": m[2], "expected": m[3], "tried": int(m[4]), "faults": int(m[5]),
             "allowed": m[6]} for m in row.finditer(table)]


def hard_cases(jobs, program):
    """The table of named hard cases; None without the program of the tests."""
    if not program.exists():
        return None

    def work(_):
        return hard_rows(run([program], accepted=(0, 1)))

    return jobs.result(["hard", hashlib.sha256(program.read_bytes()).hexdigest()], work)
