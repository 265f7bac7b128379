"""Other renderers on the same scenes: Mitsuba 3, by bench/peers, in an environment of its own that `./run bench --peers` makes."""

import hashlib
import json

import measure
from runs import LEMMA, PROJECT, run

FOLDER = PROJECT / "bench/peers"
PYTHON = PROJECT / "build/peers/bin/python"
NAME = "Mitsuba 3"
AGREEMENT_SEED = 2000003  # of the converged image; no seed of a rendering


def _identity():
    """What the results depend on beside scene and effort."""
    files = sorted([*FOLDER.glob("*.py"), FOLDER / "requirements.txt"])
    return [hashlib.sha256(file.read_bytes()).hexdigest()[:16] for file in files]


def _render(scene, size, seed, threads, stem, *end):
    """Figures of a rendering, whose images lie where they say."""
    run([PYTHON, "-B", FOLDER / "mitsuba_render.py", scene.path, "--size", size, "--seed", seed,
         "--threads", threads, "--out", stem, *end])
    return json.loads(stem.with_suffix(".json").read_text())


def _compared(image, reference, stem, *options):
    report = stem.with_suffix(".compare")
    run([LEMMA, "compare", image, reference, "-q", "--json", report, *options], accepted=(0, measure.COMPARISON_FAILED))
    return json.loads(report.read_text())


def _error_point(point, reference, stem):
    """A point as `lemma render --reference` has it, by the same program's figures."""
    errors = _compared(point["image"], reference, stem)
    return {**{key: point[key] for key in ("spp", "seconds", "cpu_seconds")},
            "rmse": max(0.0, errors["mse_without_noise"]) ** 0.5, "relmse": errors["relmse_without_noise"]}


def rendering(jobs, scene, seed, effort, threads, image, scale):
    """As measure.rendering, by the peer."""

    def work(stem):
        stem = stem.with_name(stem.name + "-peer")  # its own JSON file is not that of the job
        figures = _render(scene, effort.size, seed, threads, stem, "--seconds", effort.seconds)
        points = figures.pop("points")
        figures["error_curve"] = [_error_point(point, image, stem) for point in points]
        if seed == 1:
            figures["views"] = measure.views(points[-1]["image"], stem.with_suffix(".png"), image, stem, scale)
        for file in stem.parent.glob(f"{stem.name}.*"):
            file.unlink()
        return figures

    return jobs.result(["peer", _identity(), scene.digest, seed, effort.size, effort.seconds, threads,
                        effort.reference_spp, measure.REFERENCE], work)


def agreement(jobs, scene, effort, threads, reference):
    """Whether the peer's converged image could have the mean of our reference: `lemma compare --statistical`."""

    def work(stem):
        stem = stem.with_name(stem.name + "-peer")
        figures = _render(scene, effort.size, AGREEMENT_SEED, threads, stem, "--spp", effort.peer_spp)
        compared = _compared(figures["points"][-1]["image"], reference["image"], stem, "--statistical")
        for file in stem.parent.glob(f"{stem.name}.*"):
            file.unlink()
        return {"peer": figures["peer"], "spp": effort.peer_spp, "statistical": compared["statistical"],
                "relmse": compared["relmse_without_noise"], "reference_relmse": compared["reference_noise"]["relmse"]}

    made = jobs.result(["agreement", _identity(), scene.digest, effort.size, effort.peer_spp, threads,
                        effort.reference_spp, measure.REFERENCE], work)
    return {"scene": scene.name, **made}
