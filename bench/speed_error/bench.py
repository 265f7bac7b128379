#!/usr/bin/env python3
"""Speed against error: renders scenes with many configurations for the same time, measures the error on the way, and writes
results.json, report.html, plots and tables. ./run bench calls it. Whatever was measured before by the same program on the same
machine is not measured again: an interrupted run goes on where it was."""

import argparse
import dataclasses
import json
import sys
from pathlib import Path

import measure
import plan
from regression import compare_with_baseline
from report import write_report
from runs import LEMMA, PROJECT, Jobs, Progress, commit, machine, program_digest, run
from summary import summarize


def parse_arguments():
    parser = argparse.ArgumentParser(prog="./run bench", description=__doc__, allow_abbrev=False)
    parser.add_argument("scenes", nargs="*", default=list(plan.SCENES), metavar="SCENE",
                        help="scenes of our own by name, others by path (default: all of our own)")
    parser.add_argument("--quick", action="store_true", help="small images, half a second each, five seeds, no hard cases: under 5 minutes")
    parser.add_argument("--cross", action="store_true", help="all combinations, not only one difference from the default")
    parser.add_argument("--seconds", type=float, help="of each rendering")
    parser.add_argument("--seeds", type=int, help="independent runs of each configuration")
    parser.add_argument("--size", help="of the images, WIDTHxHEIGHT")
    parser.add_argument("--reference-spp", type=int, help="samples a pixel of the references")
    parser.add_argument("--out", type=Path, default=Path("bench-results"), help="folder for all files")
    parser.add_argument("--baseline", type=Path, help="results.json to compare with, by ratio; exit code 3 if worse")
    return parser.parse_args()


def effort_of(arguments):
    effort = plan.QUICK if arguments.quick else plan.FULL
    told = {name: getattr(arguments, name) for name in ("seconds", "seeds", "size", "reference_spp")}
    return dataclasses.replace(effort, **{name: value for name, value in told.items() if value is not None})


def run_all(arguments, effort, configurations, jobs):
    """All renderings, in turns over the configurations, so that a slow hour of the machine slows all of them."""
    references, renderings = {}, []
    for scene in arguments.scenes:
        print(f"reference of {scene}", file=sys.stderr, flush=True)
        references[scene] = measure.reference(jobs, scene, effort)
    progress = Progress(len(arguments.scenes) * len(configurations) * effort.seeds * effort.seconds)
    for seed in range(1, effort.seeds + 1):
        for scene in arguments.scenes:
            for configuration in configurations:
                figures = measure.rendering(jobs, scene, configuration, seed, effort, references[scene]["image"])
                renderings.append({"scene": scene, "configuration": configuration.name, "seed": seed,
                                   "options": dict(configuration.options), "figures": figures})
                progress.done(f"{scene}: {configuration.name}, seed {seed}", effort.seconds)
    return references, renderings


def main():
    arguments = parse_arguments()
    effort = effort_of(arguments)
    configurations = plan.configurations(arguments.cross)
    environment = {"machine": machine(), "version": run([LEMMA, "--version"]).strip(), "commit": commit(),
                   "program": program_digest()}
    jobs = Jobs(arguments.out / "jobs", [environment["machine"], environment["program"]])
    references, renderings = run_all(arguments, effort, configurations, jobs)
    results = {
        **environment,
        "effort": dataclasses.asdict(effort),
        "references": references,
        "renderings": renderings,
        "parity": [measure.parity(jobs, scene, effort) for scene in arguments.scenes],
        "traversal": measure.traversal(jobs, effort, PROJECT / "build/release/bench/traversal"),
        "hard_cases": effort.hard_cases and measure.hard_cases(jobs, PROJECT / "build/release/tests/hard_tests"),
    }
    results["summary"] = summarize(renderings, effort)
    (arguments.out / "results.json").write_text(json.dumps(results))
    report = write_report(results, arguments.out)
    print(f"report: {report}")
    if arguments.baseline:
        baseline = json.loads(arguments.baseline.read_text())
        sys.exit(compare_with_baseline(results["summary"], baseline.get("summary", baseline)))


if __name__ == "__main__":
    main()
