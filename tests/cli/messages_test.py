"""What `lemma render` prints: warnings, progress and the summary, and where."""

import concurrent.futures
import contextlib
import os
import pty
import re
import unittest

from lemma import LemmaTest

SCENE_LINE = r"cornell-box\.xml \+ cornell-box\.obj \+ cornell-box\.mtl: 32 triangles .*, camera \d+x\d+\n"
PROGRESS_LINE = r" *(\d+) %  .*\n"
SLOW = {"size": "160x120", "spp": 64}  # long enough for progress to be shown on the way


def read_to_end(terminal):
    """What is written to a terminal until it is closed, which reading meets as an error."""
    text = b""
    with contextlib.suppress(OSError):
        while part := os.read(terminal, 4096):
            text += part
    return text.decode()


def text_on_terminal(write):
    """What `write`, called with the descriptor of a terminal, puts there."""
    screen, terminal = pty.openpty()
    with concurrent.futures.ThreadPoolExecutor() as readers:
        text = readers.submit(read_to_end, screen)
        try:
            write(terminal)
        finally:
            os.close(terminal)
    os.close(screen)
    return text.result()


class VarianceTest(LemmaTest):
    """Fixed roulette in a scene that reflects too much for it."""

    def render_with_albedo(self, albedo, *arguments):
        scene = self.copy_scene()
        mtl = scene / "cornell-box.mtl"
        mtl.write_text(mtl.read_text().replace("Kd 0.725 0.71 0.68", f"Kd {albedo} 0.1 0.1"))
        return self.render("--progress", "off", *arguments, scene="scene").stderr

    def test_infinite_variance_is_warned_of(self):
        text = self.render_with_albedo(0.9, "--rr", "fixed")
        self.assertIn("scene/cornell-box.xml: warning: --rr fixed: surfaces reflect up to 0.9 of the light, whose square "
                      "is not below 0.6: the variance is infinite where paths cannot leave; --rr throughput has no "
                      "such limit\n", text)

    def test_there_is_no_warning_without_cause(self):
        self.assertNotIn("warning", self.render_with_albedo(0.77, "--rr", "fixed"))

    def test_throughput_has_no_such_limit(self):
        self.assertNotIn("warning", self.render_with_albedo(0.9))

    def test_two_samples_a_vertex_vary_more(self):
        self.assertIn("warning: --rr fixed: surfaces reflect up to 0.725 of the light, whose square times the 1.5 of "
                      "mis-report's two samples is not below 0.6: the variance can be infinite",
                      self.render_with_albedo(0.725, "--rr", "fixed", "--integrator", "mis-report"))


class UnusedOptionsTest(LemmaTest):
    """Options that change nothing beside others."""

    def test_are_warned_of(self):
        for unused, beside in (("--lights power", "--integrator brdf"), ("--mis balance", "--integrator brdf"),
                               ("--mis balance", "--integrator direct"), ("--mis balance", "--technique light"),
                               ("--lights power", "--technique brdf"), ("--technique light", "--integrator brdf"),
                               ("--technique brdf", "--integrator mis-report"), ("--phong-norm n+2", "--brdf blinn-phong"),
                               ("--brdf-sampling p6", "--brdf blinn-phong"),
                               ("--replicates 4", "--sampler independent")):
            with self.subTest(unused=unused, beside=beside):
                warning = f"lemma: warning: {unused} changes nothing with {beside}\n"
                self.assertIn(warning, self.render(*unused.split(), *beside.split()).stderr)

    def test_change_no_pixel(self):
        for unused, beside in (("--lights power", "--integrator brdf"), ("--mis balance", "--integrator direct")):
            self.assert_same_pixels(self.render_to("with.exr", *unused.split(), *beside.split()),
                                    self.render_to("without.exr", *beside.split()))

    def test_there_is_no_warning_of_used_ones(self):
        for options in ("--lights power --mis balance", "--integrator mis-report --mis balance",
                        "--technique light --lights power", "--brdf-sampling p6 --phong-norm n+2", "--replicates 4"):
            with self.subTest(options):
                self.assertNotIn("warning", self.render(*options.split()).stderr)


class SummaryTest(LemmaTest):
    def test_goes_to_stdout(self):
        text = self.render("--accel", "brute", "--threads", 1, size="20x10", spp=3).stdout
        self.assertRegex(text, r"\Amodel: Lambert, .*1 light \(2 triangles\)\n"
                               r"accelerator: brute force over 32 triangles, built in .* s, .* MB\n"
                               r"samples: 3 spp, 600 camera samples, .* million/s\n"
                               r"rays: \d+, .* million/s, \d+ % of the time in the accelerator\n"
                               r"time: [\d.]+ s on 1 threads\n"
                               r"estimated error: RMSE [\d.e-]+ \([\d.e-]+ to [\d.e-]+\), relMSE [\d.e-]+ \(.*\), 95 %; .*\n"
                               r"invalid samples: 0\n\Z")

    def test_tells_that_paths_were_cut(self):
        self.assertNotIn("paths cut", self.render().stdout)
        self.assertRegex(self.render("--max-depth", 2).stdout, r"\npaths cut at depth 2: [1-9]\d* \(the image lacks")


class QuietTest(LemmaTest):
    def scene_with_warning(self):
        scene = self.copy_scene()
        with open(scene / "cornell-box.xml", "a", encoding="utf-8") as xml:
            xml.write("<fog/>\n")
        return scene

    def test_prints_nothing_at_all(self):
        scene = self.scene_with_warning()
        for options in (["-q"], ["--quiet"], ["-q", "--progress", "bar"]):
            run = self.render(*options, scene=scene)
            self.assertEqual((run.stdout, run.stderr), ("", ""))

    def test_still_prints_errors(self):
        self.assert_refused(["render", "-q", "nowhere"],
                            "nowhere: error: no such file or folder\n"
                            "  hint: name the XML, the OBJ, or the folder that holds both")

    def test_warnings_are_printed_otherwise_whatever_the_progress(self):
        scene = self.scene_with_warning()
        for progress in ("plain", "bar", "off"):
            stderr = self.render("--progress", progress, scene=scene).stderr
            self.assertRegex(stderr, r"cornell-box\.xml:\d+:1: warning: <fog> is unknown and left out\n")


class ProgressTest(LemmaTest):
    def test_in_a_log_is_plain_lines(self):
        run = self.render("--accel", "brute", "--threads", 1, **SLOW)
        self.assertRegex(run.stderr, rf"\A{SCENE_LINE}(?:{PROGRESS_LINE})+\Z")
        self.assertNotRegex(run.stderr, r"[\r\x1b]")
        shown = [int(percent) for percent in re.findall(PROGRESS_LINE, run.stderr)]
        self.assertGreater(len(shown), 2)
        self.assertEqual(shown, sorted(set(shown)), "each once, in order")
        self.assertLessEqual(len(shown), 10)
        self.assertEqual(shown[-1], 100)
        to_go = [int(seconds) for seconds in re.findall(r"%  \d+ s, (\d+) s to go\n", run.stderr)]
        self.assertEqual(len(to_go), len(shown) - 1, "told until all is done")
        self.assertGreaterEqual(to_go[0], to_go[-1])

    def test_on_a_terminal_is_a_bar_with_the_time_to_go(self):
        text = text_on_terminal(lambda terminal: self.render(
            "--accel", "brute", "--threads", 1, stderr=terminal, **SLOW))
        bars = re.findall(r"\r\[(=*) *\] +(\d+) %  ([^\x1b]*)\x1b\[K", text)
        self.assertGreater(len(bars), 2)
        lengths = [len(filled) for filled, _, _ in bars]
        self.assertEqual(lengths, sorted(lengths))
        self.assertRegex(bars[0][2], r"^\d+ s, \d+ s to go$")
        self.assertEqual((lengths[-1], bars[-1][1]), (40, "100"))
        self.assertTrue(text.endswith("\n"))

    def test_can_be_told_wherever_it_goes(self):
        self.assertIn("\r[", self.render("--progress", "bar").stderr)
        plain = text_on_terminal(lambda terminal: self.render(
            "--progress", "plain", stderr=terminal))
        self.assertNotIn("\x1b", plain)
        self.assertIn("100 %", plain)

    def test_off_leaves_the_summary(self):
        run = self.render("--progress", "off")
        self.assertRegex(run.stderr, rf"\A{SCENE_LINE}\Z")
        self.assertIn("\nsamples: 1 spp", run.stdout)


if __name__ == "__main__":
    unittest.main()
