"""The commands of README.md do what they promise: they run."""

import re
import shlex
import shutil
import unittest

from lemma import DONE, PROJECT, SCENES, LemmaTest

QUICK = {"--size": "16x9", "--spp": "2"}  # in place of what the README says, for commands that render


def commands_of(text):
    """The lines of the ```sh blocks that run Lemma, each as a list of its words."""
    blocks = re.findall(r"^ *```sh\n(.*?)^ *```", text, re.MULTILINE | re.DOTALL)
    lines = "".join(blocks).replace("\\\n", " ").splitlines()
    words = [shlex.split(line, comments=True) for line in lines]
    return [command for command in words if command and command[0] in ("./run", "lemma")]


def commands_of_run():
    """The commands that the script ./run carries out itself; it hands all others to the program."""
    script = (PROJECT / "run").read_text(encoding="utf-8")
    return re.findall(r"^([\w-]+)\)$", script, re.MULTILINE)


def without(arguments, option):
    """The arguments but for an option and its value."""
    text = "\0".join(arguments)
    return re.sub(rf"\0{option}(=|\0)[^\0]*", "", text).split("\0")


def made_quick(arguments):
    """A rendering with few pixels and samples; what is no rendering, or one of one pixel, as it is."""
    if arguments[0] != "render" or "--pixel" in arguments:
        return arguments
    for option, value in QUICK.items():
        arguments = [*without(arguments, option), option, value]
    return arguments


class ReadmeTest(LemmaTest):
    def setUp(self):
        super().setUp()
        shutil.copytree(SCENES, self.folder / "scenes")

    def failure(self, command):
        """What goes wrong when a command of a README is run; None if nothing does."""
        program, *arguments = command
        if not arguments:
            return f"{shlex.join(command)}: no command"
        if program == "./run" and arguments[0] in commands_of_run():
            return None  # these build and test: more than a test should do
        run = self.lemma(*made_quick(arguments))
        return None if run.returncode == DONE else f"{shlex.join(command)}: exit code {run.returncode}\n{run.stderr}"

    def test_commands_run(self):
        readme = PROJECT / "README.md"
        self.assertTrue(readme.exists(), "there is no README.md")
        commands = commands_of(readme.read_text(encoding="utf-8"))
        self.assertTrue(commands, "README.md has no ```sh block with a line that starts with ./run or lemma")
        for command in commands:  # in order: one may read what another has written
            with self.subTest(shlex.join(command)):
                self.assertIsNone(failure := self.failure(command), failure)

    def test_commands_are_found(self):
        text = ("```sh\n./run render a \\\n  -o 'b c.png'   # a picture\n\ncd build\n```\n"
                "`lemma no`\n```\nlemma neither\n```\n```sh\nlemma --help\n```\n")
        self.assertEqual(commands_of(text), [["./run", "render", "a", "-o", "b c.png"], ["lemma", "--help"]])

    def test_renderings_are_made_quick(self):
        self.assertEqual(made_quick("render a --spp 4096 -o b.exr --size=800x600 --seed 1".split()),
                         "render a -o b.exr --seed 1 --size 16x9 --spp 2".split())
        one_pixel = "render a --pixel 640,400 --explain".split()
        self.assertEqual(made_quick(one_pixel), one_pixel)

    def test_wrong_commands_are_found(self):
        self.assertIsNone(self.failure(["./run", "render", "scenes/cornell-box", "--spp", "64"]))
        self.assertIsNone(self.failure(["./run", "test"]))
        self.assertIn('unknown option "--acel"', self.failure(["lemma", "render", "scenes/veach-mis", "--acel=grid"]))
        self.assertIn("no such file", self.failure(["./run", "render", "scenes/nowhere"]))
        self.assertIn("unknown command", self.failure(["lemma", "test"]))


if __name__ == "__main__":
    unittest.main()
