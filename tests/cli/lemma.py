"""What the tests of the command line share: running the program and reading what it writes."""

import functools
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
BINARY = os.environ.get("LEMMA", PROJECT / "build/release/lemma")
SCENES = PROJECT / "scenes"
CORNELL_BOX = SCENES / "cornell-box"

DONE, BAD_INPUT, INVALID_SAMPLES = 0, 1, 2  # exit codes


def image_header(image):
    """The attributes of an image file that are texts, by name."""
    listing = _tool("oiiotool", "--info", "-v", image)
    return dict(re.findall(r'^ +([\w:]+): "(.*)"$', listing, re.MULTILINE))


def image_size(image):
    """Width and height."""
    first_line = _tool("oiiotool", "--info", image)
    width, height = re.search(r":\s+(\d+) x\s+(\d+),", first_line).groups()
    return int(width), int(height)


def image_format(image):
    """Type of the values and name of the format, for example "float openexr"."""
    return re.search(r"\d channel, (\w+ \w+)", _tool("oiiotool", "--info", image)).group(1)


def image_pixels(image):
    """Red, green and blue of every pixel, as the file stores them: whole numbers if it is an 8-bit picture."""
    listing = _tool("oiiotool", "--dumpdata", image)
    pixels = re.findall(r"^ *Pixel \(\d+, \d+\): (\S+) (\S+) (\S+)", listing, re.MULTILINE)
    return [tuple(map(float, pixel)) for pixel in pixels]


def same_pixels(image, other):
    """Whether no value of any pixel differs."""
    return subprocess.run(["idiff", "-q", "-fail", "0", image, other], capture_output=True).returncode == 0


def choices(option):
    """The names that help lists for an option of `lemma render`, in its order."""
    long_name = r"(?: {30}\S.*\n)?"  # what the option is for, where its name fills the line
    block = re.search(rf"^  {option} NAME.*\n{long_name}((?: {{32}}\S.*\n)+)", render_help(), re.MULTILINE).group(1)
    return re.findall(r"^ +([^ :]+):", block, re.MULTILINE)


def options_with_choices():
    """The options that take one of several names."""
    return re.findall(r"^  (--[\w-]+) NAME", render_help(), re.MULTILINE)


def render_options():
    """The options that help lists for `lemma render`, in its order."""
    return re.findall(r"^  (?:-\w,)?(--[\w-]+)", render_help(), re.MULTILINE)


@functools.cache
def render_help():
    return _tool(BINARY, "render", "--help")


def _tool(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


class LemmaTest(unittest.TestCase):
    """A test with a folder of its own, in which the program runs."""

    maxDiff = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="lemma-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def lemma(self, *arguments, **options):
        """Runs the program and returns what came of it, its output as text. Further options go to subprocess.run."""
        options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options}
        run = subprocess.run([BINARY, *map(str, arguments)], cwd=self.folder, **options)
        run.stdout = (run.stdout or b"").decode()  # here, because subprocess would turn carriage returns into newlines
        run.stderr = (run.stderr or b"").decode()
        return run

    def render(self, *arguments, scene=CORNELL_BOX, size="16x12", spp=1, expected=DONE, **options):
        """Runs `lemma render`, small unless told otherwise, and checks the exit code."""
        run = self.lemma("render", scene, "--size", size, "--spp", spp, *arguments, **options)
        self.assertEqual(run.returncode, expected, run.stderr)
        return run

    def render_to(self, name, *arguments, **options):
        """The file of that name, rendered quietly."""
        self.render("-q", "-o", name, *arguments, **options)
        return self.folder / name

    def files(self):
        """Names of all files and folders in the test's folder."""
        return {str(path.relative_to(self.folder)) for path in self.folder.rglob("*")}

    def write(self, name, text):
        """Writes a text file and returns its path."""
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def copy_scene(self, name="scene"):
        """A copy of the Cornell box that the test may change: its folder."""
        return Path(shutil.copytree(CORNELL_BOX, self.folder / name))

    def assert_same_pixels(self, image, other):
        self.assertTrue(same_pixels(image, other), f"{image} and {other} differ")

    def assert_different_pixels(self, image, other):
        self.assertFalse(same_pixels(image, other), f"{image} and {other} are equal")

    def assert_refused(self, arguments, message):
        """The program prints exactly the message, exits with 1, and writes nothing."""
        before = self.files()
        run = self.lemma(*arguments)
        self.assertEqual(run.stderr, message + "\n")
        self.assertEqual(run.stdout, "")
        self.assertEqual(run.returncode, BAD_INPUT)
        self.assertEqual(self.files(), before)
