"""The scenes of a run: where they are, a name of its own for each, and what identifies their content."""

import hashlib
import json
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from plan import SCENES
from runs import LEMMA, PROJECT, refuse


@dataclass(frozen=True)
class Scene:
    name: str  # of files, anchors and tables; no two scenes of a run share it
    path: Path
    digest: str  # of all files that the rendering reads


def scene_path(given):
    """One of our own scenes by its name, or any other by its path."""
    return PROJECT / "scenes" / given if given in SCENES else Path(given).resolve()


def scene_files(checked):
    """All files that a scene is made of, from what `lemma check` says: textures are those that its materials name."""
    materials = [Path(file) for file in checked["mtl"]]
    files = [Path(checked["xml"]), Path(checked["obj"]), *materials]
    for material in materials:
        text = material.read_bytes()
        if b"map_" in text.lower():
            files += [f for f in material.parent.rglob("*") if f.is_file() and f.name.encode() in text]
    return sorted(set(files))


def content_digest(files):
    """Of names and bytes."""
    digest = hashlib.sha256()
    for file in files:
        content = file.read_bytes()
        digest.update(f"{file.name}\0{len(content)}\0".encode() + content)
    return digest.hexdigest()[:16]


def check(path):
    """What `lemma check` says of a scene; stops with its words if it cannot be rendered."""
    with tempfile.NamedTemporaryFile(prefix="lemma-check-", suffix=".json") as report:
        done = subprocess.run([LEMMA, "check", path, "-q", "--json", report.name], capture_output=True, text=True)
        if done.returncode == 1:
            message, _, hint = done.stderr.strip().partition("\n  hint: ")
            refuse(message.replace("error: ", "", 1), hint or "./run bench --help names our own scenes; others are given by their path")
        return json.loads(Path(report.name).read_text())


def unique_names(paths):
    """The last part of each path, with as many folders before it as tell it from all others."""
    def tail(path, count):
        return "/".join(path.parts[-count:])

    names = []
    for path in paths:
        count = 1
        while any(tail(other, count) == tail(path, count) for other in paths if other != path):
            count += 1
        names.append(tail(path, count).lstrip("/"))
    return names


def read_scenes(given):
    """The scenes of a run, checked; refuses one that is given twice, by whatever path."""
    paths = [scene_path(text) for text in given]
    found = {}
    for text, path in zip(given, paths):
        checked = check(path)
        files = scene_files(checked)
        first = found.setdefault((checked["xml"], checked["obj"]), (text, path, content_digest(files)))
        if first[1] is not path:
            refuse(f"scene {text} is given twice", f"it is the same as {first[0]}; name it once")
    names = unique_names([path for _, path, _ in found.values()])
    return [Scene(name, path, digest) for name, (_, path, digest) in zip(names, found.values())]
