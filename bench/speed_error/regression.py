"""Comparison of two runs by ratio: is any configuration less efficient than it was?

What is compared does not depend on how fast the machine is: samples are worth what they do for the error, and their time is
counted in rays that Embree, which is not ours, traces in the same run in one thread (the traversal table). Processor time, since
other work on the machine does not count there. What is left are differences between processors: the tolerance is for them, too.
"""

import math

ALLOWED = 0.8  # ratio to the baseline that noise and another processor may explain
REGRESSED = 3  # exit code, as that of lemma when a comparison fails
FIGURES = {"efficiency": "cpu_efficiency", "samples": "cpu_sample_rate"}  # by their keys in the summary
EFFORT = ("size", "seconds")  # efficiencies of other ones are others: of sizes, and where the slope is not -1/2


def embree_rays_per_second(results):
    """Geometric mean over all cases and kinds of rays; None without the traversal table."""
    if not results["traversal"]:
        return None
    rates = [t["embree_rays_per_s"] for case in results["traversal"]["cases"] for t in case["trace"].values()]
    return math.exp(sum(map(math.log, rates)) / len(rates))


def baseline_of(results):
    """What is kept of a run: FIGURES, as intervals, by scene and configuration."""
    rate = embree_rays_per_second(results)
    if rate is None:
        raise ValueError("a baseline needs the traversal table: build the program traversal")
    figures = {
        kept: {scene: {name: {end: f[key][end] and f[key][end] / rate for end in ("value", "low", "high")}
                       for name, f in configurations.items() if not f["peer"] and f[key]}
               for scene, configurations in results["summary"].items()}
        for kept, key in FIGURES.items()}
    return {**{key: results[key] for key in ("machine", "version", "commit", "date")},
            "effort": {key: results["effort"][key] for key in EFFORT},
            "traversal_cases": [case["case"] for case in results["traversal"]["cases"]],
            "per_embree_ray": figures}


def worsened(now, before):
    """(figure, scene, configuration, ratio) of all that both have, and those whose ratio's interval ends below what is allowed."""
    for key in ("effort", "traversal_cases"):
        if now[key] != before[key]:
            raise ValueError(f"the baseline was measured with {key} {before[key]}, this run with {now[key]}")
    rows, bad = [], []
    for kind, scenes in now["per_embree_ray"].items():
        for scene, configurations in scenes.items():
            for name, figures in configurations.items():
                then = before["per_embree_ray"].get(kind, {}).get(scene, {}).get(name)
                if then is None:
                    continue
                row = (kind, scene, name, figures["value"] / then["value"])
                rows.append(row)
                if (figures["high"] or figures["value"]) / (then["low"] or then["value"]) < ALLOWED:
                    bad.append(row)
    return rows, bad


def compare_with_baseline(now, before):
    rows, bad = worsened(now, before)
    print(f"{'ratio to the baseline of':<28}{'scene':<20}{'configuration':<28}")
    for row in rows:
        kind, scene, name, ratio = row
        print(f"{kind:<28}{scene:<20}{name:<28}{ratio:>8.3f}{'  worse' if row in bad else ''}")
    return REGRESSED if bad else 0
