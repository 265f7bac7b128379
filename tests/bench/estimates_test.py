"""The benchmark's estimates, on synthetic runs whose truth is known."""

import contextlib
import io
import math
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

try:
    import numpy
except ImportError as missing:
    raise unittest.SkipTest(f"{missing}: apt install python3-numpy") from None

import estimates
import measure
import plan
import regression
import runs
import summary

TRIALS = 4000
REFERENCES = {"s": {"stats": {"estimated_error": {"relmse": {"value": 1e-4}}}}}


def coverage_bounds(rate):
    """Between these lies the part of TRIALS intervals that hold the truth, but for a chance of 1e-6 (binomial, 4.9 sigma)."""
    half = 4.9 * math.sqrt(rate * (1 - rate) / TRIALS)
    return rate - half, rate + half


class CoverageTest(unittest.TestCase):
    """Intervals hold the truth at their stated rate: 95 %."""

    def assert_covers(self, truth, estimate_of, low=None):
        random = numpy.random.default_rng(1)
        held = sum(e.low <= truth <= e.high for e in (estimate_of(random) for _ in range(TRIALS))) / TRIALS
        lowest, highest = coverage_bounds(0.95)
        self.assertGreater(held, lowest if low is None else low)
        self.assertLess(held, highest)

    def test_mean(self):
        for runs in (2, 3, 8, 30):
            self.assert_covers(7, lambda random, runs=runs: estimates.mean(random.normal(7, 2, runs)))

    def test_geometric_mean(self):
        self.assert_covers(0.01, lambda random: estimates.geometric_mean(0.01 * numpy.exp(random.normal(0, 0.3, 5))))

    def test_paired_ratio(self):
        """At its rate whatever the machine's load is, which both runs of a pair share and which would widen Welch's interval."""
        def estimate_of(random):
            load = random.normal(0, 1, 5)
            values, baseline = (numpy.exp(random.normal(0, 0.1, 5) + load) for _ in range(2))
            return estimates.paired_ratio(3 * values, baseline)

        self.assert_covers(3, estimate_of)
        e = estimate_of(numpy.random.default_rng(1))
        self.assertLess(e.high / e.low, 2)

    def test_slope(self):
        work = 2.0 ** numpy.arange(2, 9)

        def estimate_of(random):
            return estimates.slope([(work, work**-0.5 * numpy.exp(random.normal(0, 0.1, len(work)))) for _ in range(4)])

        self.assert_covers(-0.5, estimate_of)

    def test_slope_is_unbiased(self):
        random = numpy.random.default_rng(3)
        work = 2.0 ** numpy.arange(2, 9)
        fitted = [estimates.slope([(work, work**-0.62 * numpy.exp(random.normal(0, 0.1, len(work))))]).value
                  for _ in range(TRIALS)]
        self.assertLess(abs(numpy.mean(fitted) + 0.62), 5 * numpy.std(fitted) / math.sqrt(TRIALS))


class CurveTest(unittest.TestCase):
    WORK = [1.0, 2.0, 4.0, 8.0]
    ERROR = [1.0, 0.5, 0.25, 0.125]

    def test_error_lies_on_lines_in_logarithms(self):
        self.assertAlmostEqual(estimates.error_at(self.WORK, self.ERROR, 3), 1 / 3)
        self.assertIsNone(estimates.error_at(self.WORK, self.ERROR, 9))
        self.assertIsNone(estimates.error_at(self.WORK, self.ERROR, 0.5))

    def test_work_to_reach_an_error(self):
        for target, work, reached in ((2, 1, True), (0.3, 1 / 0.3, True), (0.125, 8, True), (0.01, 100, False)):
            found, was_reached = estimates.work_to_reach(self.WORK, self.ERROR, target)
            self.assertAlmostEqual(found, work)
            self.assertEqual(was_reached, reached)

    def test_one_run_has_no_interval(self):
        self.assertEqual(estimates.mean([3]), estimates.Estimate(3, None, None))

    def test_t_quantiles(self):
        for freedom, quantile in ((1, 12.706), (3, 3.182), (10, 2.228), (12, 2.179), (30, 2.042), (1000, 1.962)):
            self.assertAlmostEqual(estimates.t_limit(0.05, freedom), quantile, 2)


class SummaryTest(unittest.TestCase):
    @staticmethod
    def rendering(name, seed, relmse, seconds):
        """A run of 8 samples a pixel whose error falls as one over the samples."""
        points = [{"spp": n, "seconds": seconds * n / 8, "cpu_seconds": seconds * n / 4, "rmse": 1, "relmse": relmse * 8 / n} for n in (1, 2, 4, 8)]
        return {"scene": "s", "configuration": name, "seed": seed,
                "figures": {"error_curve": points, "camera_samples_per_second": 1000}}

    def test_efficiency_slope_and_times(self):
        effort = type("Effort", (), {"seconds": 2.0})
        runs = [self.rendering(name, seed, relmse, 2.0) for seed in (1, 2)
                for name, relmse in (("default", 0.02), ("twice", 0.01))]
        figures = summary.summarize(runs, REFERENCES, effort, "default")["s"]
        self.assertAlmostEqual(figures["default"]["efficiency"]["value"], 25)
        self.assertAlmostEqual(figures["twice"]["efficiency_ratio"]["value"], 2)
        relative = summary.summarize(runs, REFERENCES, effort, "twice")["s"]
        self.assertAlmostEqual(relative["default"]["efficiency_ratio"]["value"], 0.5)
        self.assertAlmostEqual(relative["default"]["cpu_efficiency_ratio"]["value"], 0.5)
        self.assertEqual(summary.verdict(relative)["best"], "twice")  # whatever ratios are to
        self.assertAlmostEqual(summary.verdict(relative)["advantage"]["value"], 2)
        self.assertAlmostEqual(figures["twice"]["slope"]["value"], -0.5)
        self.assertAlmostEqual(figures["default"]["at"]["1"]["value"], 0.04)
        self.assertIsNone(figures["default"]["at"]["10"])
        self.assertAlmostEqual(figures["default"]["to_target"]["value"], 4)
        self.assertFalse(figures["default"]["to_target"]["reached"])
        self.assertTrue(figures["twice"]["to_target"]["reached"])
        self.assertEqual([p["spp"] for p in figures["twice"]["curve"]], [1, 2, 4, 8])


    def test_errors_at_equal_samples(self):
        runs = [self.rendering(name, seed, relmse, 2.0) for seed in (1, 2) for name, relmse in (("default", 0.02), ("twice", 0.01))]
        runs[-1]["figures"]["error_curve"].pop()  # one run that ended before 8 samples
        figures = summary.summarize(runs, REFERENCES, type("Effort", (), {"seconds": 2.0}), "default")["s"]
        self.assertEqual([figures[name]["at_spp"]["spp"] for name in ("default", "twice")], [4, 4])
        self.assertAlmostEqual(figures["default"]["at_spp"]["value"] / figures["twice"]["at_spp"]["value"], 2)


class UnmeasuredTest(unittest.TestCase):
    """Points whose error the reference's own hides: below half of its squared error, or clamped to 0."""

    def figures(self, hidden):
        runs = [SummaryTest.rendering(name, seed, relmse, 2.0) for seed in (1, 2) for name, relmse in (("default", 0.02), ("twice", 0.01))]
        runs[1]["figures"]["error_curve"][-1]["relmse"] = hidden
        runs[3]["figures"]["error_curve"][-1]["relmse"] = hidden
        return summary.summarize(runs, REFERENCES, type("Effort", (), {"seconds": 2.0}), "default")["s"]["twice"]

    def test_they_are_left_out_everywhere(self):
        for hidden in (0, -1e-3, 0.49e-4):
            figures = self.figures(hidden)
            self.assertEqual(figures["unmeasured"], 2)
            self.assertEqual([p["spp"] for p in figures["curve"]], [1, 2, 4])
            self.assertAlmostEqual(figures["efficiency_ratio"]["value"], 2)  # by the point before: 1 s with 0.02
            self.assertAlmostEqual(figures["to_target"]["value"], 2)
            self.assertFalse(figures["to_target"]["reached"])
        self.assertEqual(self.figures(0.51e-4)["unmeasured"], 0)

    def test_without_any_point(self):
        runs = [SummaryTest.rendering("default", seed, 1e-6, 2.0) for seed in (1, 2)]
        figures = summary.summarize(runs, REFERENCES, type("Effort", (), {"seconds": 2.0}), "default")["s"]
        self.assertEqual([figures["default"][key] for key in ("efficiency", "slope", "to_target", "curve")], [None, None, None, []])
        self.assertIsNone(summary.verdict(figures))

    def test_a_busy_machine(self):
        runs = [SummaryTest.rendering("default", seed, 0.02, 2.0) for seed in (1, 2)]
        runs[0]["figures"]["error_curve"].pop()
        figures = summary.summarize(runs, REFERENCES, type("Effort", (), {"seconds": 2.0}), "default")["s"]
        self.assertEqual(figures["default"]["sample_spread"], 2)


class VerdictTest(unittest.TestCase):
    @staticmethod
    def verdict(low, value, high, peer=False):
        def figures(ratio, peer):
            return {"peer": peer, "advantage": dict(zip(("low", "value", "high"), ratio))}

        return summary.verdict({"default": figures((1, 1, 1), False), "other": figures((low, value, high), peer)})

    def test_words(self):
        for other, word, best in (((0.7, 0.8, 0.9), "best", "default"), ((1.01, 1.05, 1.09), "within 10 %", "other"),
                                  ((1.05, 1.2, 1.4), "open", "other"), ((1.12, 1.2, 1.3), "worse", "other"),
                                  ((None, 1.2, None), "open", "other")):
            found = self.verdict(*other)
            self.assertEqual((found["verdict"], found["best"]), (word, best), other)

    def test_other_renderers_do_not_count(self):
        self.assertEqual(self.verdict(3, 4, 5, peer=True)["verdict"], "best")


class RegressionTest(unittest.TestCase):
    """Runs of two configurations and a peer. Unchanged code gives the same errors; costs have the spread of a busy machine."""

    load = numpy.random.default_rng(7)

    @staticmethod
    def results(error=1.0, cost=1.0, machine=1.0, size="8x8", stream=1, spread=0.05, last=64, seeds=5, names=("default", "lights power")):
        """Of the last name the errors and costs are `error` and `cost` times those of unchanged code."""
        random = numpy.random.default_rng(stream)

        def figures(name):
            worse, noise = (error, cost) if name == names[-1] else (1, 1), random.normal(0, 0.1)
            points = [2**k for k in range(int(math.log2(last)) + 1)]
            each = 1e-6 * machine * worse[1] * math.exp(RegressionTest.load.uniform(-spread, spread))
            return {"error_curve": [{"spp": spp, "relmse": worse[0] * math.exp(noise) / spp, "seconds": 1,
                                     "cpu_seconds": 64 * spp * each} for spp in points]}

        renderings = [{"scene": "s", "configuration": name, "seed": seed, "peer": name == "peer", "embree_rate": 1e7 / machine,
                       "figures": figures(name)} for seed in range(1, seeds + 1) for name in (*names, "peer")]
        return {"machine": "m", "version": "v", "commit": "c", "date": "d", "renderings": renderings,
                "effort": {"size": size, "seconds": 1, "reference_spp": 64},
                "references": {"s": {"stats": {"estimated_error": {"relmse": {"value": 1e-6}}}}}}

    @staticmethod
    def compared(now, before):
        return regression.compared(regression.baseline_of(now), regression.baseline_of(before))

    def bad(self, now, before):
        return [row[1:3] for row in self.compared(now, before) if row[-1]]

    def test_unchanged_code_is_not_told(self):
        for last in (16, 64, 256):  # as many samples as a busy machine had time for
            rows = self.compared(self.results(last=last), self.results())
            self.assertEqual([row for row in rows if row[-1]], [])
            errors = [ratio.value for *_, what, ratio, _ in rows if what.startswith("relMSE")]
            self.assertEqual(len(errors), 3)
            self.assertTrue(all(abs(ratio - 1) < 1e-9 for ratio in errors), errors)

    def test_the_speed_of_the_machine_does_not_count(self):
        for machine in (0.3, 3):
            self.assertEqual(self.bad(self.results(machine=machine), self.results()), [])

    def test_noisier_images_are_told(self):
        self.assertEqual(self.bad(self.results(error=1.05), self.results())[0], ("lights power", "relMSE at 64 spp"))
        self.assertEqual(self.bad(self.results(error=1.01), self.results()), [])
        self.assertEqual(self.bad(self.results(error=0.5), self.results()), [])

    def test_slower_samples_are_told(self):
        self.assertEqual(self.bad(self.results(cost=1.6), self.results())[0], ("lights power", "time of a sample"))
        self.assertEqual(self.bad(self.results(cost=1.1), self.results()), [])
        self.assertEqual(self.bad(self.results(cost=0.5), self.results()), [])

    def test_other_random_numbers_are_told_at_the_stated_rate(self):
        """Errors of the same mean from other random numbers. All intervals together miss in 5 % of the runs: of 1000, in 79 or
        more with a chance of 1e-4 (binomial), and the allowance lets fewer be told."""
        before = regression.baseline_of(self.results(stream=0))
        told = sum(any(row[-1] for row in regression.compared(regression.baseline_of(self.results(stream=s)), before))
                   for s in range(1, 1001))
        self.assertLess(told, 79)

    def test_a_loss_of_all_is_told_as_one(self):
        names = tuple(map(str, range(20)))
        errors = numpy.random.default_rng(3)
        before = regression.baseline_of(self.results(names=names, stream=1))
        now = regression.baseline_of(self.results(names=names, stream=2))
        for figures in now["figures"]["s"].values():  # each within its own chance
            figures["relMSE"]["64"] = [1.3 * e * math.exp(errors.normal(0, 0.05)) for e in figures["relMSE"]["64"]]
        self.assertIn(("s", "all configurations", "relMSE"), [row[:3] for row in regression.compared(now, before) if row[-1]])

    def test_what_is_told_names_all(self):
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            code = regression.compare_with_baseline(*(regression.baseline_of(self.results(cost=c)) for c in (2, 1)))
        self.assertEqual(code, 3)
        self.assertRegex(out.getvalue(), r"(?m)^worse than the baseline: s, lights power: time of a sample [\d.]+ "
                                         r"\([\d.]+ to [\d.]+\) times; up to 1.15 is allowed$")

    def test_other_renderers_have_no_baseline(self):
        self.assertEqual(list(regression.baseline_of(self.results())["figures"]["s"]), ["default", "lights power"])

    def test_new_configurations_and_scenes_have_no_baseline(self):
        rows = self.compared(self.results(names=("default", "new")), self.results())
        self.assertEqual({row[1] for row in rows}, {"default", "all configurations"})
        self.assertEqual(regression.compared(regression.baseline_of(self.results()),
                                             {**regression.baseline_of(self.results()), "figures": {}}), [])

    def test_other_efforts_are_refused(self):
        with self.assertRaisesRegex(ValueError, "measured with"):
            self.compared(self.results(), self.results(size="9x9"))


class QuantileTest(unittest.TestCase):
    def test_limits_of_student(self):
        """Tables: 12.7062, 4.3027, 2.7764, 2.5706 and 1.9600 at 5 %; 63.6567 and 8.6103 at 1 % and 0.1 %."""
        for chance, freedom, limit in ((0.05, 1, 12.7062), (0.05, 2, 4.3027), (0.05, 4, 2.7764), (0.05, 5, 2.5706),
                                       (0.05, 100000, 1.9600), (0.01, 1, 63.6567), (0.001, 4, 8.6103)):
            self.assertAlmostEqual(estimates.t_limit(chance, freedom), limit, 4)


class TraversalTest(unittest.TestCase):
    def test_cases_are_the_scenes_of_the_run_and_its_own(self):
        def scene(path):
            return SimpleNamespace(path=path, name=path.name)

        own, other = scene(runs.PROJECT / "scenes/veach-mis"), scene(Path("/elsewhere/room"))
        self.assertEqual(measure.traversal_names(plan.QUICK, [own, other]),
                         {str(own.path): "veach-mis", "/elsewhere/room": "room", "interior": "interior"})
        self.assertEqual(measure.traversal_names(plan.QUICK, [other]),
                         {"/elsewhere/room": "room", "veach-mis": "veach-mis", "interior": "interior"})


class ReferenceTest(unittest.TestCase):
    def test_parts_are_equal_and_as_many_samples_as_asked(self):
        for spp, parts in ((64, [64]), (4096, [4096]), (8192, 2 * [4096]), (65536, 16 * [4096]), (6000, 2 * [3000])):
            self.assertEqual(measure.part_sizes(spp), parts)

    def test_mean_of_parts(self):
        def part(error):
            return {"spp": 10, "seed": 7, "estimated_error": {"relmse": {"value": error, "low": error / 2, "high": error * 2}}}

        stats = measure.mean_stats([part(0.01), part(0.03)])
        self.assertEqual((stats["spp"], stats["seed"]), (20, 7))
        self.assertAlmostEqual(stats["estimated_error"]["relmse"]["value"], 0.01)
        self.assertAlmostEqual(stats["estimated_error"]["relmse"]["high"], 0.02)

    def test_image_of_parts(self):
        """Pixels of two files averaged, and a quarter of the sum of their variances, under the names that lemma gives."""
        if not shutil.which("oiiotool"):
            self.skipTest("no oiiotool: apt install openimageio-tools")
        with tempfile.TemporaryDirectory(prefix="lemma-reference-") as folder:
            images = [str(Path(folder) / f"{i}.exr") for i in range(3)]
            for image, values in zip(images, ("1,2,3,0.4,0.8,4", "3,4,7,1.2,0.8,8")):
                subprocess.run(["oiiotool", "--pattern", f"constant:color={values}", "2x2", "6", "--chnames",
                                "R,G,B,variance.R,variance.G,variance.B", "-d", "float", "-o", image], check=True)
            subprocess.run(list(map(str, measure.mean_command(images[:2], images[2]))), check=True)
            told = subprocess.run(["oiiotool", "--info", "-v", "--dumpdata", images[2]], check=True, capture_output=True, text=True).stdout
        self.assertRegex(told, r"lemma:variance-parts: 31\n")  # 2 x 15 degrees of freedom
        self.assertIn("channel list: R, G, B, variance.R, variance.G, variance.B", told)
        pixel = re.search(r"Pixel \(1, 1\): ([\d. ]+)", told).group(1)
        numpy.testing.assert_allclose([float(x) for x in pixel.split()], [2, 3, 5, 0.4, 0.4, 3], rtol=1e-6)


class HardCaseTableTest(unittest.TestCase):
    def test_rows(self):
        text = ("[  OK  ] x (3 ms)\n"
                "case                                    backend  expected                 tried  faults  allowed\n"
                "1 edges and vertices of a closed mesh   grid     no ray leaves            16560       3        0\n"
                "16 closed meshes                        -        4 pi or 0                  120       0        0\n"
                "12 rays that leave surfaces, grazing    embree   none hits its own       300000       7    shown\n")
        rows = measure.hard_rows(text)
        self.assertEqual([row["backend"] for row in rows], ["grid", "-", "embree"])
        self.assertEqual(rows[0], {"case": "1 edges and vertices of a closed mesh", "backend": "grid", "expected": "no ray leaves",
                                   "tried": 16560, "faults": 3, "allowed": "0"})
        self.assertEqual((rows[2]["tried"], rows[2]["faults"], rows[2]["allowed"]), (300000, 7, "shown"))


class PlanTest(unittest.TestCase):
    def test_one_difference_at_a_time(self):
        names = [c.name for c in plan.configurations(cross=False)]
        others = [f"{name} {value}" for name, values in (plan.DIMENSIONS | plan.SINGLES).items() for value in values[1:]]
        self.assertEqual(names[0], "default")
        self.assertEqual(sorted(names[1:]), sorted(others))

    def test_all_combinations_have_an_effect(self):
        names = [c.name for c in plan.configurations(cross=True)]
        self.assertEqual(len(names), len(set(names)))
        self.assertIn("accel grid, integrator mis-report, lights power, mis balance, sampler independent", names)
        self.assertNotIn("integrator brdf, lights power", names)
        self.assertNotIn("integrator direct, mis balance", names)


if __name__ == "__main__":
    unittest.main()
