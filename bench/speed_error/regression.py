"""Comparison of two runs by ratio: is any configuration worse than it was, in what a sample is worth or in what it costs?

Errors are compared at equal samples, where time plays no part, seed by seed: unchanged code gives the same images, so that their
ratio is 1 whatever the machine does. Costs are processor time of a camera sample in units of the time of a ray that Embree, which
is not ours, traces with as many threads in the same minute: faster machines and other work on them change both. What is left of
their influence, and differences between processors, is what ALLOWED is for.
"""

import math
import statistics

import estimates
from summary import FIRST_FITTED, measured, own_relmse

ERROR, COST = "relMSE", "time of a sample"
ALLOWED = {ERROR: 1.02, COST: 1.15}  # ratios to the baseline that compilers, the machine and its other work may explain
JOINT_CHANCE = 0.05  # that one of all intervals of errors, taken together, lies beyond its ratio
ALL = "all configurations"
REGRESSED = 3  # exit code, as that of lemma when a comparison fails
LEAST_SEEDS = 3
EFFORT = ("size", "seconds", "reference_spp")  # a run of others has other references or other passes


def allowed(what):
    """The ratio up to which a row of scene_rows() may be worse."""
    return ALLOWED[COST if what == COST else ERROR]


def errors_at_samples(runs, reference_relmse):
    """Errors of all seeds by samples a pixel, where all were measured, from FIRST_FITTED samples on."""
    by_spp = {}
    for run in runs:
        for p in run["figures"]["error_curve"]:
            if p["spp"] >= FIRST_FITTED and measured(p, reference_relmse):
                by_spp.setdefault(p["spp"], []).append(p["relmse"])
    return {str(spp): found for spp, found in sorted(by_spp.items()) if len(found) == len(runs)}


def costs(runs, pixels):
    """Rays of Embree alone in the time of a camera sample, seed by seed."""
    last = [run["figures"]["error_curve"][-1] for run in runs]
    return [p["cpu_seconds"] / (p["spp"] * pixels) * run["embree_rate"] for p, run in zip(last, runs)]


def baseline_of(results):
    """What is kept of a run, by scene and configuration; other renderers are not."""
    if any(run["embree_rate"] is None for run in results["renderings"] if not run.get("peer")):
        raise ValueError("a baseline needs Embree's rate: build the program traversal")
    width, height = map(int, results["effort"]["size"].split("x"))
    runs = {}
    for run in sorted(results["renderings"], key=lambda run: run["seed"]):
        if not run.get("peer"):
            runs.setdefault(run["scene"], {}).setdefault(run["configuration"], []).append(run)
    noise = {scene: own_relmse(results["references"][scene]) for scene in runs}
    return {**{key: results[key] for key in ("machine", "version", "commit", "date")},
            "effort": {key: results["effort"][key] for key in EFFORT},
            "figures": {scene: {name: {ERROR: errors_at_samples(found, noise[scene]), COST: costs(found, width * height)}
                                for name, found in configurations.items()}
                        for scene, configurations in runs.items()}}


def pairs_of_errors(now, before):
    """(samples, errors now, errors before), of as many seeds, at the most samples that both reached; None without such a number."""
    common = set(map(int, now)) & set(map(int, before))
    if not common:
        return None
    spp = str(max(common))
    return spp, *zip(*zip(now[spp], before[spp]))


def median_ratio(now, before):
    """Ratio of the medians; its ends are those of all quotients, which k turns each exceed with a chance of 2 2^-k at most."""
    return estimates.Estimate(statistics.median(now) / statistics.median(before), min(now) / max(before), max(now) / min(before))


def geometric_means(rows):
    """Of each seed's values, over the configurations."""
    return [math.exp(statistics.fmean(map(math.log, values))) for values in zip(*rows)]


def scene_rows(now, before, chance):
    """(configuration, what, ratio) of all that both have, then of all of them as one: many small losses show there."""
    names = [name for name in now if name in before]
    errors = {name: pair for name in names if (pair := pairs_of_errors(now[name][ERROR], before[name][ERROR]))}
    for name in names:
        if name in errors:
            spp, *pair = errors[name]
            yield name, f"{ERROR} at {spp} spp", estimates.paired_ratio(*pair, chance)
        yield name, COST, median_ratio(now[name][COST], before[name][COST])
    if errors:
        yield ALL, ERROR, estimates.paired_ratio(*(geometric_means([pair[i] for pair in errors.values()]) for i in (1, 2)), chance)
    if names:
        yield ALL, COST, median_ratio(*(geometric_means([run[name][COST] for name in names]) for run in (now, before)))


def compared(now, before):
    """(scene, configuration, what, ratio, whether it is clearly worse: all of its interval beyond what is allowed)."""
    if now["effort"] != before["effort"]:
        raise ValueError(f"the baseline was measured with {before['effort']}, this run with {now['effort']}")
    scenes = [scene for scene in now["figures"] if scene in before["figures"]]
    tests = sum(len(now["figures"][scene]) + 1 for scene in scenes)
    rows = []
    for scene in scenes:
        for name, what, ratio in scene_rows(now["figures"][scene], before["figures"][scene], JOINT_CHANCE / tests):
            rows.append((scene, name, what, ratio, ratio.low > allowed(what)))
    return rows


def text_of(row):
    scene, name, what, ratio, _ = row
    return f"{scene}, {name}: {what} {ratio.value:.3f} ({ratio.low:.3f} to {ratio.high:.3f})"


def compare_with_baseline(now, before):
    rows = compared(now, before)
    print("ratios to the baseline, above 1: worse")
    for row in rows:
        print(f"  {text_of(row)}{'  worse' if row[-1] else ''}")
    bad = [row for row in rows if row[-1]]
    for row in bad:
        print(f"worse than the baseline: {text_of(row)} times; up to {allowed(row[2])} is allowed")
    return REGRESSED if bad else 0
