"""Arguments of the benchmark, checked before anything is measured."""

import json
import os
import re

from plan import REFERENCE_REPLICATES
from regression import EFFORT, LEAST_SEEDS
from runs import refuse

MOST_PIXELS = 65536  # in a row or column, as lemma allows


def check_effort(effort):
    """Ranges of what is told on the command line."""
    size = re.fullmatch(r"(\d+)x(\d+)", effort.size)
    if not size or not all(1 <= int(n) <= MOST_PIXELS for n in size.groups()):
        refuse(f"--size {effort.size}", f"expected WIDTHxHEIGHT, each from 1 to {MOST_PIXELS}, e.g. 320x180")
    if not 0 < effort.seconds < float("inf"):
        refuse(f"--seconds {effort.seconds:g}", "expected a number above 0, e.g. 0.5")
    if effort.seeds < 1:
        refuse(f"--seeds {effort.seeds}", "expected at least 1; intervals need 2")
    if effort.reference_spp < REFERENCE_REPLICATES:
        refuse(f"--reference-spp {effort.reference_spp}",
               f"expected at least {REFERENCE_REPLICATES}, one of each independent scrambling, whose spread tells the reference's own error")


def check_seeds(effort):
    if effort.seeds < LEAST_SEEDS:
        refuse(f"--seeds {effort.seeds}", f"a baseline needs at least {LEAST_SEEDS}, whose spread tells what is chance")


def read_baseline(path, effort):
    """A file of --save-baseline, of a run of the same effort."""
    hint = "name a file that --save-baseline wrote, such as bench/baseline.json"
    try:
        baseline = json.loads(path.read_text())
    except OSError as error:
        refuse(f"--baseline {path}: {error.strerror}", hint)
    except ValueError:
        refuse(f"--baseline {path}: this is no JSON", hint)
    if not isinstance(baseline, dict) or not {"effort", "figures"} <= set(baseline):
        refuse(f"--baseline {path}: this is no baseline", hint)
    told = {key: getattr(effort, key) for key in EFFORT}
    if baseline["effort"] != told:
        refuse(f"--baseline {path}: it is of another effort, {baseline['effort']}",
               f"this run has {told}; take the options of the baseline's run")
    return baseline


def check_target(file, option):
    """That a file can be written when all is measured."""
    check_writable(file.parent, option)
    if file.is_dir():
        refuse(f"{option} {file}: this is a folder", "name a file")


def check_writable(folder, option):
    if not folder.is_dir() or not os.access(folder, os.W_OK):
        refuse(f"{option}: {folder} is no folder that can be written to", "make it, or name another one")


def make_folder(folder, option):
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        refuse(f"{option} {folder}: {error.strerror}", "name a folder that can be written to")
    check_writable(folder, option)
