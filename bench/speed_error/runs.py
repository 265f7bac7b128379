"""Runs the programs and keeps what they say: a job that has a result is not done again."""

import hashlib
import json
import os
import platform
import re
import subprocess
import sys
import time
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
LEMMA = Path(os.environ.get("LEMMA", PROJECT / "build/release/lemma"))


def run(command, accepted=(0,)):
    """What a command prints. Stops with its own words if it fails."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode not in accepted:
        sys.exit(f"bench: error: {' '.join(map(str, command))}: exit code {done.returncode}\n{done.stderr or done.stdout}")
    return done.stdout


class Jobs:
    """Results in a folder, one file each, named after all that they depend on."""

    def __init__(self, folder, identity):
        self.folder = folder
        self.identity = identity  # of program and machine: other ones have other results
        folder.mkdir(parents=True, exist_ok=True)

    def path(self, key, ending):
        digest = hashlib.sha256(json.dumps([self.identity, key], sort_keys=True).encode()).hexdigest()[:16]
        return self.folder / f"{digest}{ending}"

    def is_done(self, key):
        return self.path(key, ".json").exists()

    def result(self, key, work):
        """The result of a job; `work` is called with the path its files begin with if there is none yet."""
        path = self.path(key, ".json")
        if not path.exists():
            value = work(path.with_suffix(""))
            partial = path.with_suffix(".partial")
            partial.write_text(json.dumps(value))
            partial.rename(path)
        return json.loads(path.read_text())


class Progress:
    """A line on stderr for each job, with the time that the rest will take."""

    def __init__(self, total_seconds):
        self.total = total_seconds
        self.expected = 0.0  # of the jobs done
        self.start = time.monotonic()

    def done(self, what, expected_seconds):
        self.expected += expected_seconds
        spent = time.monotonic() - self.start
        part = self.expected / self.total if self.total else 1
        print(f"{100 * part:3.0f} %  {spent:.0f} s, {spent * max(0, 1 / part - 1):.0f} s to go  {what}", file=sys.stderr, flush=True)


def _first_match(pattern, text):
    found = re.search(pattern, text, re.MULTILINE)
    return found.group(1).strip() if found else "unknown"


def machine():
    """What the times depend on."""
    memory = int(_first_match(r"^MemTotal: *(\d+) kB", Path("/proc/meminfo").read_text()))
    return {
        "processor": _first_match(r"^model name\s*: (.*)$", Path("/proc/cpuinfo").read_text()),
        "threads": len(os.sched_getaffinity(0)),
        "memory_gb": round(memory / 1e6, 1),
        "system": _first_match(r'^PRETTY_NAME="(.*)"', Path("/etc/os-release").read_text()),
        "kernel": platform.release(),
    }


def commit():
    """Of the project, with a mark if files differ from it."""
    git = ["git", "-C", str(PROJECT)]
    described = subprocess.run([*git, "describe", "--always", "--dirty", "--abbrev=12"], capture_output=True, text=True)
    return described.stdout.strip() or "unknown"


def libraries():
    """Files of the libraries that the speed depends on, whose names end with their versions."""
    loaded = re.findall(r"=> (/\S*lib(?:embree|tbb)\S*)", run(["ldd", LEMMA]))
    return sorted(Path(file).resolve().name for file in loaded)


def program_digest():
    return hashlib.sha256(LEMMA.read_bytes()).hexdigest()[:16]
