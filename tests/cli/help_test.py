"""`lemma --help`, `--version` and `render --help`."""

import re
import unittest

from lemma import DONE, PROJECT, LemmaTest, choices, render_options


def project_version():
    text = (PROJECT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(lemma VERSION ([\d.]+)", text).group(1)


class HelpTest(LemmaTest):
    def assert_prints(self, *arguments):
        """The program prints to stdout alone, and does nothing else; returns what it prints."""
        run = self.lemma(*arguments)
        self.assertEqual((run.returncode, run.stderr, self.files()), (DONE, "", set()))
        return run.stdout

    def test_help_names_the_commands_and_the_exit_codes(self):
        text = self.assert_prints("--help")
        self.assertRegex(text, r"\n  render  +Render a scene")
        self.assertRegex(text, r"\nExit codes: 0 done; 1 bad .*; 2 done, but invalid samples")

    def test_version_is_that_of_the_project(self):
        self.assertEqual(self.assert_prints("--version"), f"lemma {project_version()}\n")

    def test_help_of_render_names_its_argument_and_options(self):
        text = self.assert_prints("render", "--help")
        self.assertRegex(text, r"(?m)^Usage: lemma render \[OPTIONS\] SCENE$")
        wanted = ("output tonemap max-radiance gamma exposure stats progress quiet accel integrator lights mis "
                  "technique rr max-depth brdf phong-norm brdf-sampling sampler replicates spp time target-error "
                  "reference seed threads size pixel explain explain-json emission strict").split()
        self.assertLessEqual({"--" + name for name in wanted}, set(render_options()))

    def test_help_of_render_lists_and_explains_the_names_that_options_accept(self):
        self.assertEqual(choices("--accel")[0], "embree", "the default comes first")
        self.assertLessEqual({"embree", "grid", "brute"}, set(choices("--accel")))
        self.assertLessEqual({"mis", "direct", "brdf"}, set(choices("--integrator")))
        self.assertEqual(choices("--lights")[0], "tree")
        self.assertLessEqual({"tree", "power", "solid-angle", "projected", "radiance-area"}, set(choices("--lights")))
        self.assertLessEqual({"throughput", "fixed"}, set(choices("--rr")))

    def test_help_tells_the_defaults(self):
        text = self.assert_prints("render", "--help")
        self.assertRegex(text, r"\n  --spp N=16 ")
        self.assertRegex(text, r"\n  --accel NAME=embree ")
        self.assertRegex(text, r"Default: SCENE's name with \.exr")

    def test_help_of_all_holds_the_help_of_render(self):
        self.assertIn("--integrator", self.assert_prints("--help-all"))


if __name__ == "__main__":
    unittest.main()
