"""From renderings to the figures of the report: for each scene and configuration its curve, slope, efficiency and times."""

import math

import estimates

TARGET = 0.01  # relMSE
TIMES = (1.0, 10.0, 60.0)  # seconds
FIRST_FITTED = 4  # samples a pixel: with fewer, the error is that of images full of holes
AS_GOOD = 1.1  # the default may be less efficient than the best configuration by this factor
NOISE_SHARE = 0.5  # of the reference's own squared error: what is left of an error below this is no measurement
BUSY = 1.5  # samples of one configuration that differ by more than this between seeds tell of other work on the machine
NEARLY = 1.25  # passes are whole: a run that ends this much before a time counts there with its last, larger error


def own_relmse(reference):
    """A reference's own estimated error."""
    return reference["stats"]["estimated_error"]["relmse"]["value"]


def measured(point, reference_relmse):
    """Whether a point's error, the reference's subtracted, is clearly more than what is uncertain of the subtraction."""
    return point["relmse"] > NOISE_SHARE * reference_relmse


def with_measured_points(figures, reference_relmse):
    """A run without the points that are no measurements: every figure below is made of what is left."""
    return {**figures, "error_curve": [p for p in figures["error_curve"] if measured(p, reference_relmse)]}


def points(figures, key):
    """(key, relMSE) of a run's points."""
    return [p[key] for p in figures["error_curve"]], [p["relmse"] for p in figures["error_curve"]]


def curve(runs):
    """Errors at the numbers of samples that all runs reached."""
    by_spp = {}
    for figures in runs:
        for p in figures["error_curve"]:
            by_spp.setdefault(p["spp"], []).append(p)
    complete = sorted(spp for spp, found in by_spp.items() if len(found) == len(runs))
    return [{"spp": spp,
             "seconds": estimates.geometric_mean([p["seconds"] for p in by_spp[spp]]).value,
             "relmse": estimates.geometric_mean([p["relmse"] for p in by_spp[spp]]).as_json()} for spp in complete]


def end(runs, complete):
    """Where the runs end, each with a number of samples of its own: the means of their last points. None if the curve's last point
    is that of all runs already, or a run has no measured point."""
    if not all(figures["error_curve"] for figures in runs):
        return None
    last = [figures["error_curve"][-1] for figures in runs]
    if complete and {p["spp"] for p in last} == {complete[-1]["spp"]}:
        return None
    means = {key: estimates.geometric_mean([p[key] for p in last]) for key in ("spp", "seconds", "relmse")}
    return {"spp": means["spp"].value, "seconds": means["seconds"].value, "relmse": means["relmse"].as_json()}


def unmeasured_ends(runs, reference_relmse):
    """How many runs have a last point that is no measurement, so that an earlier one stands for it."""
    return sum(not measured(figures["error_curve"][-1], reference_relmse) for figures in runs)


def error_at_time(runs, seconds):
    """Geometric mean over the runs; None if one did not last as long."""
    errors = []
    for figures in runs:
        work, error = points(figures, "seconds")
        if not work:
            return None
        at = min(seconds, work[-1]) if work[-1] * NEARLY >= seconds else seconds
        errors.append(estimates.error_at(work, error, at))
    return None if None in errors else estimates.geometric_mean(errors).as_json()


def time_to_target(runs):
    """None if a run has no measured point."""
    if not all(figures["error_curve"] for figures in runs):
        return None
    found = [estimates.work_to_reach(*points(figures, "seconds"), TARGET) for figures in runs]
    return {**estimates.geometric_mean([seconds for seconds, _ in found]).as_json(),
            "reached": all(reached for _, reached in found)}


def efficiencies(runs, time="seconds"):
    """1 / (relMSE x seconds) at the last measured point of each run, None without one; with `time` "cpu_seconds", of all threads'
    processor time."""
    last = [figures["error_curve"][-1] if figures["error_curve"] else None for figures in runs]
    return [p and 1 / (p["relmse"] * p[time]) for p in last]


def efficiency(runs, time="seconds"):
    """Geometric mean over the runs that have one; None without."""
    found = [e for e in efficiencies(runs, time) if e]
    return estimates.geometric_mean(found).as_json() if found else None


def sample_rates(runs):
    """Samples a pixel in a second of processor time: less noisy than efficiencies, and blind to what a sample is worth."""
    return [figures["error_curve"][-1]["spp"] / figures["error_curve"][-1]["cpu_seconds"] for figures in runs]


def fitted_slope(runs):
    """Of the root of relMSE over samples: -0.5 for independent samples."""
    curves = []
    for figures in runs:
        work, error = points(figures, "spp")
        fitted = [(w, math.sqrt(e)) for w, e in zip(work, error) if w >= FIRST_FITTED]
        if len(fitted) < 2:
            return None
        curves.append(tuple(zip(*fitted)))
    return estimates.slope(curves).as_json()


def common_spp(curves):
    """The most samples a pixel that all configurations reached; None if there is no such number."""
    return max(set.intersection(*({p["spp"] for p in points} for points in curves)), default=None)


def verdict(configurations):
    """Whether the first configuration is the most efficient, or within 10 % of it, by processor time: "best", "within 10 %",
    "worse" if the interval of the best one's advantage lies above that, else "open"; and the best one with its advantage.
    Other renderers do not count. None if the default's error was not measured."""
    ours = {name: f["advantage"] for name, f in configurations.items() if not f["peer"] and f["advantage"]}
    if next(iter(configurations)) not in ours:
        return None
    best, advantage = max(ours.items(), key=lambda item: item[1]["value"])
    if best == next(iter(ours)):
        word = "best"
    elif advantage["value"] <= AS_GOOD:
        word = "within 10 %"
    else:
        word = "worse" if (advantage["low"] or 0) > AS_GOOD else "open"
    return {"verdict": word, "best": best, "advantage": advantage}


def ratios(runs, baseline, time):
    """Efficiency over that of a baseline, paired by seed, since the runs of a turn share their hour; 1 for the baseline itself,
    None if no seed has both."""
    pairs = [(e, b) for e, b in zip(efficiencies(runs, time), efficiencies(baseline, time)) if e and b]
    if not pairs:
        return None
    return (estimates.Estimate(1, 1, 1) if runs is baseline else estimates.paired_ratio(*zip(*pairs))).as_json()


def sample_spread(runs):
    """The most samples of a run over the fewest of another."""
    last = [figures["error_curve"][-1]["spp"] for figures in runs]
    return max(last) / min(last)


def summarize(renderings, references, effort, relative_to):
    """For each scene its configurations in the order they were run, the first being the default; efficiencies also as ratios to
    the configuration `relative_to`."""
    runs = {}
    for r in sorted(renderings, key=lambda r: r["seed"]):  # runs of all configurations in one order, to be paired
        runs.setdefault(r["scene"], {}).setdefault(r["configuration"], []).append(r["figures"])
    peers = {r["configuration"] for r in renderings if r.get("peer")}
    scenes = {}
    for scene, all_points in runs.items():
        noise = own_relmse(references[scene])
        by_configuration = {name: [with_measured_points(figures, noise) for figures in found] for name, found in all_points.items()}
        default, baseline = next(iter(by_configuration.values())), by_configuration[relative_to]
        curves = {name: curve(found) for name, found in by_configuration.items()}
        spp = common_spp(curves.values())
        scenes[scene] = {
            name: {
                "peer": name in peers,
                "curve": curves[name],
                "end": end(found, curves[name]),
                "unmeasured_ends": unmeasured_ends(all_points[name], noise),
                "unmeasured": sum(len(f["error_curve"]) for f in all_points[name]) - sum(len(f["error_curve"]) for f in found),
                "sample_spread": sample_spread(all_points[name]),
                "at_spp": next(({"spp": spp, **p["relmse"]} for p in curves[name] if p["spp"] == spp), None),
                "slope": fitted_slope(found),
                "efficiency": efficiency(found),
                "efficiency_ratio": ratios(found, baseline, "seconds"),
                "cpu_efficiency": efficiency(found, "cpu_seconds"),
                "cpu_efficiency_ratio": ratios(found, baseline, "cpu_seconds"),
                "cpu_sample_rate": estimates.geometric_mean(sample_rates(all_points[name])).as_json(),
                "advantage": ratios(found, default, "cpu_seconds"),
                "at": {f"{t:g}": error_at_time(found, t) for t in sorted({*TIMES, effort.seconds})},
                "to_target": time_to_target(found),
                "samples_per_second": estimates.geometric_mean(
                    [f["camera_samples_per_second"] for f in found]).value,
                "views": next((f["views"] for f in found if "views" in f), None),
                "viewed_spp": next((f["error_curve"][-1]["spp"] for f in all_points[name] if "views" in f), None),
            } for name, found in by_configuration.items()}
    return scenes
