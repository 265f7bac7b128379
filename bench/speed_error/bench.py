#!/usr/bin/env python3
"""Speed against error: renders scenes with many configurations for the same time, measures the error on the way, and writes
results.json, report.html, plots and tables. ./run bench calls it. Whatever was measured before by the same program on the same
machine is not measured again: an interrupted run goes on where it was."""

import argparse
import dataclasses
import datetime
import json
import signal
import sys
from pathlib import Path

import checks
import measure
import peers
import plan
from regression import baseline_of, compare_with_baseline
from report import verdict_lines, write_report
from runs import LEMMA, PROJECT, Jobs, Progress, commit, libraries, machine, program_digest, refuse, run
from scenes import read_scenes
from summary import summarize

TRAVERSAL = PROJECT / "build/release/bench/traversal"


class Parser(argparse.ArgumentParser):
    """Refuses what it cannot take as all else is refused: with exit code 1."""

    def error(self, message):
        refuse(message, "./run bench --help lists the options")


def parse_arguments():
    parser = Parser(prog="./run bench", description=__doc__, allow_abbrev=False)
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


def total_seconds(arguments, effort, runs):
    """What all jobs take, roughly."""
    each = effort.reference_seconds() + effort.parity_seconds() + runs * effort.seeds * effort.seconds
    if arguments.peers:
        each += effort.reference_seconds() * effort.peer_spp / effort.reference_spp
    each += effort.seeds * runs / plan.RENDERINGS_A_RATE * plan.RATE_SECONDS
    return len(arguments.scenes) * each + effort.traversal_seconds(len(arguments.scenes)) + plan.HARD_SECONDS


def run_all(arguments, effort, scenes, jobs, threads):
    """References, then all renderings, in turns over the configurations, so that a slow hour of the machine slows all of them,
    then the tables."""
    configurations = plan.configurations(arguments.cross)
    others = [peers.NAME] if arguments.peers else []
    progress = Progress(total_seconds(arguments, effort, len(configurations) + len(others)), jobs)
    references = {scene.name: measure.reference(jobs, scene, effort, progress) for scene in scenes}
    renderings, scales = [], {}
    for seed in range(1, effort.seeds + 1):
        for scene in scenes:
            image = references[scene.name]["image"]
            for turn, configuration in enumerate(configurations):
                if turn % plan.RENDERINGS_A_RATE == 0:
                    rate = measure.embree_rate(jobs, scene, seed, turn, effort, TRAVERSAL)
                figures = measure.rendering(jobs, scene, configuration, seed, effort, image, scales.get(scene.name))
                scales.setdefault(scene.name, measure.color_scale(figures))  # that of the first, for all
                renderings.append({"scene": scene.name, "configuration": configuration.name, "seed": seed,
                                   "options": dict(configuration.options), "embree_rate": rate, "figures": figures})
                progress.done(f"{scene.name}: {configuration.name}, seed {seed}", effort.seconds)
            for name in others:
                figures = peers.rendering(jobs, scene, seed, effort, threads, image, scales[scene.name])
                renderings.append({"scene": scene.name, "configuration": name, "seed": seed, "peer": True, "figures": figures})
                progress.done(f"{scene.name}: {name}, seed {seed}", effort.seconds)

    def told(what, seconds, value):
        progress.done(what, seconds)
        return value

    parity = [told(f"{s.name}: parity", effort.parity_seconds(), measure.parity(jobs, s, effort)) for s in scenes]
    agreement = [told(f"{s.name}: agreement of {peers.NAME}", effort.reference_seconds() * effort.peer_spp / effort.reference_spp,
                      peers.agreement(jobs, s, effort, threads, references[s.name])) for s in scenes] if arguments.peers else []
    traversal = told("traversal", effort.traversal_seconds(len(scenes)),
                     measure.traversal(jobs, effort, scenes, TRAVERSAL))
    hard_cases = told("hard cases", plan.HARD_SECONDS, measure.hard_cases(jobs, PROJECT / "build/release/tests/hard_tests"))
    return {"references": references, "renderings": renderings, "parity": parity, "peers": agreement, "traversal": traversal,
            "hard_cases": hard_cases}


def bench():
    arguments = parse_arguments()
    effort = effort_of(arguments)
    # All that can be wrong is found before hours of measuring.
    checks.check_effort(effort)
    baseline = checks.read_baseline(arguments.baseline, effort) if arguments.baseline else None
    if arguments.save_baseline:
        checks.check_target(arguments.save_baseline, "--save-baseline")
    if arguments.baseline or arguments.save_baseline:
        checks.check_seeds(effort)
    scenes = read_scenes(arguments.scenes)
    out = arguments.out.resolve()
    checks.make_folder(out, "--out")
    environment = {"machine": machine(), "version": run([LEMMA, "--version"]).strip(), "libraries": libraries(),
                   "commit": commit(), "program": program_digest(), "date": datetime.date.today().isoformat()}
    jobs = Jobs(out / "jobs", [environment["machine"], environment["program"]])
    results = {**environment, "effort": dataclasses.asdict(effort), "relative_to": arguments.relative_to,
               **run_all(arguments, effort, scenes, jobs, environment["machine"]["threads"])}
    results["summary"] = summarize(results["renderings"], results["references"], effort, arguments.relative_to)
    (out / "results.json").write_text(json.dumps(results))
    print(f"report: {write_report(results, out)}")
    for line in verdict_lines(results["summary"]):
        print(line)
    try:
        if arguments.save_baseline:
            arguments.save_baseline.write_text(json.dumps(baseline_of(results), indent=1) + "\n")
        if baseline:
            sys.exit(compare_with_baseline(baseline_of(results), baseline))
    except ValueError as error:
        sys.exit(f"bench: error: {error}")


def main():
    try:
        bench()
    except KeyboardInterrupt:
        sys.exit(interrupted())
    except OSError as error:
        refuse(f"{error.filename}: {error.strerror}", "is the disk full, or was a file taken away?")


def interrupted():
    print("bench: interrupted; the same command goes on where it was", file=sys.stderr)
    return 128 + signal.SIGINT


if __name__ == "__main__":
    main()
