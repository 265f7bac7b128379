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


def refuse(message, hint):
    """Ends the benchmark with one message."""
    sys.exit(f"bench: error: {message}\n  hint: {hint}")


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
        self.made = 0  # results that were not there before this run
        folder.mkdir(parents=True, exist_ok=True)

    def path(self, key, ending):
        digest = hashlib.sha256(json.dumps([self.identity, key], sort_keys=True).encode()).hexdigest()[:16]
        return self.folder / f"{digest}{ending}"

    def result(self, key, work):
        """The result of a job; `work` is called with the path its files begin with if there is none yet."""
        path = self.path(key, ".json")
        if not path.exists():
            value = work(path.with_suffix(""))
            partial = path.with_suffix(".partial")
            partial.write_text(json.dumps(value))
            partial.rename(path)
            self.made += 1
        return json.loads(path.read_text())


class Progress:
    """A line on stderr for each job, with the time that the rest will take at the pace of the jobs that this run made: what an
    interrupted run had left took no time."""

    def __init__(self, total_seconds, jobs, clock=time.monotonic):
        self.total = total_seconds
        self.expected = self.expected_of_made = 0.0  # of the jobs done; of those that this run made
        self.spent = 0.0  # on the latter
        self.jobs, self.made_before = jobs, jobs.made
        self.clock, self.last = clock, clock()

    def done(self, what, expected_seconds):
        now, made = self.clock(), self.jobs.made
        self.expected += expected_seconds
        if made > self.made_before:
            self.expected_of_made += expected_seconds
            self.spent += now - self.last
        self.last, self.made_before = now, made
        print(self._line(what), file=sys.stderr, flush=True)

    def _line(self, what):
        left = max(0, self.total - self.expected)
        pace = self.spent / self.expected_of_made if self.expected_of_made else 1
        part = min(1, self.expected / self.total)
        return f"{100 * part:3.0f} %  {self.spent:.0f} s, {left * pace:.0f} s to go  {what}"


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
