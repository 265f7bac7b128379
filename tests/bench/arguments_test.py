"""Scenes and arguments of the benchmark: what identifies them, and one message for what is wrong before anything is measured."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import numpy  # noqa: F401  (as the benchmark does)
    import matplotlib  # noqa: F401
except ImportError as missing:
    raise unittest.SkipTest(f"{missing}: apt install python3-numpy python3-matplotlib") from None

import report
import runs
import scenes

BENCH = runs.PROJECT / "bench/speed_error/bench.py"
QUICK = ["--quick", "--size", "16x9", "--seconds", "0.2", "--seeds", "2", "--reference-spp", "64"]


class WithFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="lemma-arguments-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def copy_of_the_box(self, where):
        return Path(shutil.copytree(runs.PROJECT / "scenes/cornell-box", self.folder / where))


class SceneTest(WithFolder):
    def setUp(self):
        super().setUp()
        if not runs.LEMMA.exists():
            self.skipTest(f"no {runs.LEMMA}")

    def test_every_file_of_a_scene_counts(self):
        scene = self.copy_of_the_box("room")
        digests = {scenes.read_scenes([scene])[0].digest}
        for ending in ("xml", "obj", "mtl"):
            file = scene / f"cornell-box.{ending}"
            file.write_text(file.read_text()[:-1] + " ")  # as long as before
            digests.add(scenes.read_scenes([scene])[0].digest)
        self.assertEqual(len(digests), 4)
        (scene / "report.html").write_text("no part of it")
        self.assertIn(scenes.read_scenes([scene])[0].digest, digests)

    def test_textures_count(self):
        (self.folder / "pictures").mkdir()
        for name, text in (("a.xml", "x"), ("a.obj", "o"), ("a.mtl", "newmtl m\nmap_Kd pictures/wood.png\n"),
                           ("pictures/wood.png", "w"), ("pictures/other.png", "not named")):
            (self.folder / name).write_text(text)
        checked = {"xml": self.folder / "a.xml", "obj": self.folder / "a.obj", "mtl": [self.folder / "a.mtl"]}
        self.assertEqual({file.name for file in scenes.scene_files(checked)}, {"a.xml", "a.obj", "a.mtl", "wood.png"})

    def test_scenes_of_one_name(self):
        found = scenes.read_scenes([self.copy_of_the_box("one/room"), self.copy_of_the_box("two/room"), "veach-mis"])
        self.assertEqual([scene.name for scene in found], ["one/room", "two/room", "veach-mis"])

    def test_a_scene_is_given_once(self):
        scene = self.copy_of_the_box("room")
        with self.assertRaisesRegex(SystemExit, "given twice"):
            scenes.read_scenes([scene, scene / "cornell-box.obj"])

    def test_names_of_files(self):
        names = report.file_names(["one/room", "one-room", "two/room"])
        self.assertEqual(list(names.values()), ["one-room", "one-room-2", "two-room"])


class ArgumentsTest(WithFolder):
    def bench(self, *arguments):
        return subprocess.run([sys.executable, "-B", BENCH, *QUICK, *map(str, arguments)], capture_output=True, text=True, timeout=60,
                              cwd=self.folder)

    def test_what_is_wrong_is_told_before_anything_is_measured(self):
        (self.folder / "text").write_text("no JSON")
        (self.folder / "else.json").write_text("{}")
        other = {"effort": {"size": "9x9", "seconds": 1, "reference_spp": 64}, "figures": {}}
        (self.folder / "other.json").write_text(json.dumps(other))
        cases = [("--baseline nosuch.json", "No such file"), ("--baseline text", "no JSON"), ("--baseline else.json", "no baseline"),
                 ("--baseline other.json", "another effort"), ("--reference-spp 1", "--reference-spp 1"),
                 ("--out text", "File exists"), ("--out /proc/x", "/proc/x"), ("--save-baseline no/such.json", "no folder"),
                 ("--save-baseline .", "a folder"), ("--size 10", "--size 10"), ("--size 0x4", "--size 0x4"),
                 ("--seconds 0", "--seconds 0"), ("--seconds nan", "--seconds nan"), ("--seeds 0", "--seeds 0"),
                 ("--seconds x", "--seconds: invalid float value"), ("--nosuch", "--nosuch"), ("--relative-to x", "no such configuration"),
                 ("--seeds 2 --save-baseline new.json", "--seeds 2")]
        if runs.LEMMA.exists():
            cases += [("nosuch", "no such file or folder"), ("cornell-box cornell-box", "given twice")]
        for arguments, message in cases:
            with self.subTest(arguments):
                done = self.bench(*arguments.split())
                self.assertEqual((done.returncode, done.stdout), (1, ""))
                self.assertRegex(done.stderr, rf"\Abench: error: .*{re.escape(message)}.*\n  hint: .*\n\Z")
                self.assertFalse((self.folder / "bench-results/jobs").exists())

    def test_an_interrupted_run_says_how_to_go_on(self):
        if not runs.LEMMA.exists():
            self.skipTest(f"no {runs.LEMMA}")
        process = subprocess.Popen([sys.executable, "-B", BENCH, *QUICK, "cornell-box"], cwd=self.folder, stderr=subprocess.PIPE,
                                   text=True, start_new_session=True)
        first = process.stderr.readline()
        self.assertIn("reference", first)
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does: to all of the group
        rest = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 130, rest)
        self.assertTrue(rest.endswith("bench: interrupted; the same command goes on where it was\n"), rest)
        self.assertNotIn("Traceback", rest)


if __name__ == "__main__":
    unittest.main()
