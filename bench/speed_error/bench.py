#!/usr/bin/env python3
"""Speed against error: renders scenes with many configurations for the same time, measures the error on the way, and writes
results.json, report.html, plots and tables. ./run bench calls it. Whatever was measured before by the same program on the same
machine is not measured again: an interrupted run goes on where it was."""

import argparse
import dataclasses
import datetime
import json
import sys
from pathlib import Path

import measure
import peers
import plan
from regression import baseline_of, compare_with_baseline
from report import verdict_lines, write_report
from runs import LEMMA, PROJECT, Jobs, Progress, commit, libraries, machine, program_digest, run
from summary import summarize


def parse_arguments():
    parser = argparse.ArgumentParser(prog="./run bench", description=__doc__, allow_abbrev=False)
    parser.add_argument("scenes", nargs="*", default=list(plan.SCENES), metavar="SCENE",
                        help="scenes of our own by name, others by path (default: all of our own)")
    parser.add_argument("--quick", action="store_true", help="small images, half a second each, five seeds: under 5 minutes")
    parser.add_argument("--cross", action="store_true", help="all combinations, not only one difference from the default")
    parser.add_argument("--seconds", type=float, help="of each rendering")
    parser.add_argument("--seeds", type=int, help="independent runs of each configuration")
    parser.add_argument("--size", help="of the images, WIDTHxHEIGHT")
    parser.add_argument("--reference-spp", type=int, help="samples a pixel of the references")
    parser.add_argument("--peers", action="store_true", help="Mitsuba 3 on the same scenes, with as many threads (./run installs it)")
    parser.add_argument("--relative-to", default=plan.DEFAULT, metavar="CONFIGURATION",
                        help="what efficiencies are ratios to, by its name in the report, for example \"lights power\"")
    parser.add_argument("--out", type=Path, default=Path("bench-results"), help="folder for all files")
    parser.add_argument("--baseline", type=Path, help="baseline to compare with, by ratio; exit code 3 if worse")
    parser.add_argument("--save-baseline", type=Path, help="file to keep this run in as a baseline")
    arguments = parser.parse_args()
    names = [c.name for c in plan.configurations(arguments.cross)] + ([peers.NAME] if arguments.peers else [])
    if arguments.relative_to not in names:
        parser.error(f"--relative-to {arguments.relative_to}: no such configuration; there are: {'; '.join(names)}")
    return arguments


def effort_of(arguments):
    effort = plan.QUICK if arguments.quick else plan.FULL
    told = {name: getattr(arguments, name) for name in ("seconds", "seeds", "size", "reference_spp")}
    return dataclasses.replace(effort, **{name: value for name, value in told.items() if value is not None})


def run_all(arguments, effort, configurations, jobs, threads):
    """All renderings, in turns over the configurations, so that a slow hour of the machine slows all of them."""
    references, renderings = {}, []
    others = [peers.NAME] if arguments.peers else []
    for scene in arguments.scenes:
        references[scene] = measure.reference(jobs, scene, effort)
    count = len(configurations) + len(others)
    progress = Progress(len(arguments.scenes) * count * effort.seeds * effort.seconds, jobs)
    for seed in range(1, effort.seeds + 1):
        for scene in arguments.scenes:
            for configuration in configurations:
                figures = measure.rendering(jobs, scene, configuration, seed, effort, references[scene]["image"])
                renderings.append({"scene": scene, "configuration": configuration.name, "seed": seed,
                                   "options": dict(configuration.options), "figures": figures})
                progress.done(f"{scene}: {configuration.name}, seed {seed}", effort.seconds)
            for name in others:
                figures = peers.rendering(jobs, scene, seed, effort, threads, references[scene]["image"])
                renderings.append({"scene": scene, "configuration": name, "seed": seed, "peer": True, "figures": figures})
                progress.done(f"{scene}: {name}, seed {seed}", effort.seconds)
    return references, renderings


def main():
    arguments = parse_arguments()
    effort = effort_of(arguments)
    # Read before hours of measuring: a wrong name is told at once.
    baseline = json.loads(arguments.baseline.read_text()) if arguments.baseline else None
    configurations = plan.configurations(arguments.cross)
    environment = {"machine": machine(), "version": run([LEMMA, "--version"]).strip(), "libraries": libraries(),
                   "commit": commit(), "program": program_digest(), "date": datetime.date.today().isoformat()}
    threads = environment["machine"]["threads"]
    jobs = Jobs(arguments.out / "jobs", [environment["machine"], environment["program"]])
    references, renderings = run_all(arguments, effort, configurations, jobs, threads)
    results = {
        **environment,
        "effort": dataclasses.asdict(effort),
        "relative_to": arguments.relative_to,
        "references": references,
        "renderings": renderings,
        "parity": [measure.parity(jobs, scene, effort) for scene in arguments.scenes],
        "traversal": measure.traversal(jobs, effort, PROJECT / "build/release/bench/traversal"),
        "hard_cases": measure.hard_cases(jobs, PROJECT / "build/release/tests/hard_tests"),
        "peers": [peers.agreement(jobs, scene, effort, threads, references[scene]) for scene in arguments.scenes]
        if arguments.peers else [],
    }
    results["summary"] = summarize(renderings, effort, arguments.relative_to)
    (arguments.out / "results.json").write_text(json.dumps(results))
    report = write_report(results, arguments.out)
    print(f"report: {report}")
    for line in verdict_lines(results["summary"]):
        print(line)
    try:
        if arguments.save_baseline:
            arguments.save_baseline.write_text(json.dumps(baseline_of(results), indent=1) + "\n")
        if baseline:
            sys.exit(compare_with_baseline(baseline_of(results), baseline))
    except ValueError as error:
        sys.exit(f"bench: error: {error}")


if __name__ == "__main__":
    main()
