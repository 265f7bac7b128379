"""`lemma compare`: figures, difference images, verdicts, and what it refuses."""

import json
import math
import struct
import subprocess
import unittest

from lemma import BAD_INPUT, DONE, LemmaTest, image_format, image_pixels

COMPARISON_FAILED = 3
FIGURES = ["rmse", "relmse", "trimmed-relmse", "smape", "flip"]


def luminance(color):
    return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]


class CompareTest(LemmaTest):
    def compare(self, *arguments, expected=DONE):
        run = self.lemma("compare", *arguments)
        self.assertEqual((run.returncode, run.stderr), (expected, ""))
        return run.stdout

    def compare_json(self, *arguments, **options):
        self.compare(*arguments, "-q", "--json", "compare.json", **options)
        return json.loads((self.folder / "compare.json").read_text(encoding="utf-8"))


class FigureTest(CompareTest):
    def test_image_against_itself(self):
        image = self.render_to("a.exr", spp=2)
        figures = self.compare_json(image, image)
        self.assertEqual([figures[name] for name in FIGURES], [0] * len(FIGURES))
        self.assertEqual(figures["mean_difference"], [0, 0, 0])

    def test_figures_are_those_of_the_pixels(self):
        image, reference = self.render_to("a.exr", "--seed", 1), self.render_to("r.exr", "--seed", 2)
        pairs = list(zip(sum(image_pixels(image), ()), sum(image_pixels(reference), ())))
        figures = self.compare_json(image, reference)
        self.assertAlmostEqual(figures["rmse"] ** 2, sum((i - r) ** 2 for i, r in pairs) / len(pairs), 5)
        self.assertAlmostEqual(figures["relmse"], sum((i - r) ** 2 / (r * r + 0.01) for i, r in pairs) / len(pairs), 3)
        self.assertGreater(figures["flip"], 0)

    def test_text_shows_figures_and_pixels(self):
        image, reference = self.render_to("a.exr", "--seed", 1), self.render_to("r.exr", "--seed", 2)
        text = self.compare(image, reference, "--largest", 2)
        for name in FIGURES:
            self.assertRegex(text, rf"(?m)^{name} +[\d.e-]+$")
        self.assertEqual(text.count("  pixel "), 2)

    def test_pixels_that_do_not_differ_are_not_shown(self):
        image = self.render_to("a.exr")
        self.assertNotIn("  pixel ", self.compare(image, image))

    def test_equal_seeds_are_told(self):
        """What two images with the same random numbers err alike is in none of the figures."""
        image, same, other = (self.render_to(f"{i}.exr", "--seed", seed) for i, seed in enumerate((1, 1, 2)))
        told = "both were rendered with --seed 1"
        self.assertTrue(self.compare(image, same).startswith(told))
        self.assertNotIn("seed", self.compare(image, other))
        self.assertEqual([self.compare_json(image, to)["same_seed"] for to in (same, other)], [True, False])

    def test_pictures_are_compared_as_pictures(self):
        self.render("-o", "a.png", "-o", "b.jpg", spp=4)
        self.assertLess(self.compare_json("b.jpg", "a.png")["rmse"], 0.2)

    def test_limits(self):
        image, reference = self.render_to("a.exr", "--seed", 1), self.render_to("r.exr", "--seed", 2)
        self.compare(image, reference, "--fail-above", "smape=2", "--fail-above", "flip=1")
        text = self.compare(image, reference, "--fail-above", "smape=2", "--fail-above", "rmse=1e-9",
                            expected=COMPARISON_FAILED)
        self.assertTrue(text.endswith("rmse is above 1e-09\n"), text)

    def test_json_tells_limits(self):
        image, reference = self.render_to("a.exr", "--seed", 1), self.render_to("r.exr", "--seed", 2)
        told = self.compare_json(image, reference, "--fail-above", "smape=2", "--fail-above", "rmse=1e-9",
                                 expected=COMPARISON_FAILED)
        self.assertEqual(told["limits"], [{"figure": "smape", "most": 2, "value": told["smape"], "exceeded": False},
                                          {"figure": "rmse", "most": 1e-9, "value": told["rmse"], "exceeded": True}])
        self.assertEqual(told["exceeded"], ["rmse"])
        self.assertEqual(self.compare_json(image, reference)["limits"], [])

    def test_json_tells_settings(self):
        """Exposures: those that make the curve 0.85 of the brightest and of the median pixel differ by the stops between both."""
        self.render("-o", "a.png", "--seed", 1)
        image, reference = self.render_to("a.exr", "--seed", 1), self.render_to("r.exr", "--seed", 2)
        settings = self.compare_json(image, reference)["settings"]
        self.assertEqual(settings["relmse"], {"epsilon": 0.01})
        self.assertEqual(settings["trimmed-relmse"], {"epsilon": 0.01, "left_out": 0.001})
        self.assertAlmostEqual(settings["flip"]["pixels_per_degree"], 3840 * math.pi / 180)
        lit = sorted(filter(None, map(luminance, image_pixels(reference))))
        stops = settings["flip"]["last_exposure"] - settings["flip"]["first_exposure"]
        black = len(image_pixels(reference)) - len(lit)
        ranked = [0.0] * black + lit
        middle = len(ranked) // 2
        median = (ranked[(len(ranked) - 1) // 2] + ranked[middle]) / 2 or lit[len(lit) // 2]
        self.assertAlmostEqual(stops, math.log2(lit[-1] / median), 3)
        self.assertEqual(settings["flip"]["exposures"], max(2, math.ceil(stops)))
        self.assertEqual(list(self.compare_json("a.png", "a.png")["settings"]["flip"]), ["pixels_per_degree"])


class DifferenceImageTest(CompareTest):
    def test_exr_holds_the_signed_difference(self):
        image, reference = self.render_to("a.exr", "--seed", 1), self.render_to("r.exr", "--seed", 2)
        self.compare(image, reference, "-o", "d.exr")
        for i, r, d in zip(image_pixels(image), image_pixels(reference), image_pixels(self.folder / "d.exr")):
            for c in range(3):
                self.assertAlmostEqual(d[c], i[c] - r[c], 5)

    def test_picture_is_white_where_nothing_differs(self):
        image = self.render_to("a.exr")
        self.compare(image, image, "-o", "d.png")
        self.assertEqual(set(image_pixels(self.folder / "d.png")), {(255.0, 255.0, 255.0)})
        self.assertEqual(image_format(self.folder / "d.png"), "uint8 png")

    def test_json_tells_what_colours_mean(self):
        """The picture's levels are those mixed from the map, but for rounding to 8 bits and the 6 digits of the listing."""
        image, reference = self.render_to("a.exr", "--seed", 1), self.render_to("r.exr", "--seed", 2)
        told = self.compare_json(image, reference, "-o", "d.png")["difference_image"]
        self.assertEqual((told["file"], told["of"]), ("d.png", "luminance"))
        places = [entry["difference"] for entry in told["colors"]]
        self.assertEqual((places[0], places[-1]), (-told["scale"], told["scale"]))

        def mixed(difference, channel):
            levels = [255 * entry["color"][channel] for entry in told["colors"]]
            place = (min(max(difference / told["scale"], -1), 1) + 1) / 2 * (len(levels) - 1)
            below = min(int(place), len(levels) - 2)
            return levels[below] + (place - below) * (levels[below + 1] - levels[below])

        for i, r, d in zip(image_pixels(image), image_pixels(reference), image_pixels(self.folder / "d.png")):
            for c in range(3):
                self.assertAlmostEqual(d[c], mixed(luminance(i) - luminance(r), c), delta=0.6)

    def test_pictures_can_share_a_scale(self):
        """Twice the scale: what was full is mixed half."""
        image, reference = self.render_to("a.exr", "--seed", 1), self.render_to("r.exr", "--seed", 2)
        own = self.compare_json(image, reference, "-o", "d.png")["difference_image"]["scale"]
        told = self.compare_json(image, reference, "-o", "e.png", "--scale", 2 * own)["difference_image"]
        self.assertEqual(told["scale"], 2 * own)
        self.assertEqual(told["colors"][-1]["difference"], 2 * own)
        pairs = list(zip(image_pixels(self.folder / "d.png"), image_pixels(self.folder / "e.png")))
        self.assertTrue(all(e >= d for one, other in pairs for d, e in zip(one, other)), "nearer to white")
        self.assertNotEqual(*map(list, zip(*pairs)))

    def test_bad_scales_are_refused(self):
        for scale in ("0", "-1", "inf", "x"):
            run = self.lemma("compare", "a.exr", "b.exr", "--scale", scale)
            self.assertEqual((run.returncode, run.stdout), (BAD_INPUT, ""))
            self.assertEqual(run.stderr, f'lemma: error: --scale: invalid value "{scale}"\n  hint: expected a number above 0\n')

    def test_json_of_signed_difference_has_no_colours(self):
        image = self.render_to("a.exr")
        self.assertEqual(self.compare_json(image, image, "-o", "d.exr")["difference_image"], {"file": "d.exr", "of": "channels"})
        self.assertNotIn("difference_image", self.compare_json(image, image))


class StatisticalTest(CompareTest):
    def test_other_seeds_and_lights_have_the_same_mean(self):
        image = self.render_to("a.exr", "--seed", 1, spp=16, size="32x32")
        for options in (["--seed", 2], ["--seed", 3, "--lights", "solid-angle"], ["--seed", 4, "--replicates", 4]):
            other = self.render_to("r.exr", *options, spp=16, size="32x32")
            text = self.compare(image, other, "--statistical")
            self.assertIn("verdict: no difference found", text)

    def test_missing_light_is_found(self):
        image = self.render_to("a.exr", "--seed", 1, "--max-depth", 2, spp=16, size="32x32")
        reference = self.render_to("r.exr", "--seed", 2, spp=16, size="32x32")
        result = self.compare_json(image, reference, "--statistical", expected=COMPARISON_FAILED)["statistical"]
        self.assertTrue(result["different"])
        self.assertLess(min(result["global_z"]), -result["global_limit"], "the image is too dark")

    def test_needs_variances(self):
        self.render_to("a.exr", spp=1)
        self.render_to("b.exr", spp=2)
        for pair in (("a.exr", "b.exr"), ("b.exr", "a.exr")):
            self.assert_refused(["compare", *pair, "--statistical"],
                                'a.exr: error: no layer "variance", which --statistical needs\n'
                                "  hint: .exr files that lemma render writes with --spp 2 or more have it")

    def test_standard_error_of_the_mean_difference_is_told_with_variances(self):
        image, reference = self.render_to("a.exr", spp=4), self.render_to("r.exr", "--seed", 2, spp=4)
        figures = self.compare_json(image, reference)
        for difference, error in zip(figures["mean_difference"], figures["mean_difference_standard_error"]):
            self.assertLess(abs(difference), 6 * error)
        self.assertLess(figures["relmse_without_noise"], figures["relmse"])


class RefusalTest(CompareTest):
    def test_what_cannot_be_compared(self):
        image = self.render_to("a.exr")
        other = self.render_to("b.exr", size="8x8")
        self.render_to("a.png")
        self.write("notes.txt", "no image")
        self.assert_refused(["compare", image, other],
                            f"{image}: error: 16x12 pixels cannot be compared with the 8x8 of {other}\n"
                            "  hint: compare images of the same size; lemma render takes --size")
        self.assert_refused(["compare", "a.exr", "a.png"],
                            "a.exr: error: radiance cannot be compared with the picture of a.png\n"
                            "  hint: compare two .exr files, or two pictures")
        self.assert_refused(["compare", "a.exr", "none.exr"], "none.exr: error: no such file\n  hint: check the name")
        self.assert_refused(["compare", ".", "a.exr"], ".: error: this is a folder\n  hint: name an image file")
        run = self.lemma("compare", "notes.txt", "a.exr")
        self.assertRegex(run.stderr, r"\Anotes\.txt: error: no image can be read from it: .*\n  hint: name an image as ")

    def test_negative_variances(self):
        layers = "R,G,B,variance.R,variance.G,variance.B"
        subprocess.run(["oiiotool", "--create", "4x4", "6", "--chnames", layers, "--addc", "0,0,0,1,-1,1",
                        "-o", self.folder / "a.exr"], check=True)
        self.assert_refused(["compare", "a.exr", "a.exr"],
                            "a.exr: error: the layer variance is negative at 0,0\n"
                            "  hint: expected the variance of each value's mean, as lemma render writes it")

    def test_other_channels(self):
        for names in ("Y", "R,G,B,variance.R"):
            count = names.count(",") + 1
            subprocess.run(["oiiotool", "--create", "4x4", str(count), "--chnames", names, "-o", self.folder / "a.exr"],
                           check=True)
            self.assert_refused(["compare", "a.exr", "a.exr"],
                                f"a.exr: error: it has the channels {names.replace(',', ', ')}\n"
                                "  hint: expected R, G, B, and all or none of variance.R, variance.G, variance.B")

    def test_broken_files(self):
        """One whose second value of red is not a number, and one that ends too soon."""
        file = self.folder / "a.exr"
        subprocess.run(["oiiotool", "--pattern", "constant:color=0.123,0.5,0.25", "4x4", "3", "-d", "float",
                        "--compression", "none", "-o", file], check=True)
        whole, red = file.read_bytes(), struct.pack("<f", 0.123)
        second = whole.find(red, whole.find(red) + 1)
        file.write_bytes(whole[:second] + struct.pack("<f", math.nan) + whole[second + 4:])
        self.assert_refused(["compare", "a.exr", "a.exr"],
                            "a.exr: error: 1 of 16 pixels not finite, the first at 1,0\n"
                            "  hint: an image with NaN or infinite values has no error figures")
        file.write_bytes(whole[:-60])
        run = self.lemma("compare", "a.exr", "a.exr")
        self.assertEqual(run.returncode, BAD_INPUT)
        self.assertRegex(run.stderr, r"(?s)\Aa\.exr: error: it cannot be read to its end: .*\n  hint: the file may be broken")

    def test_options(self):
        hint = "expected NAME=X with X at least 0 and NAME one of: rmse, relmse, trimmed-relmse, smape, flip"
        for value in ("0.1", "rmse", "rmse=", "rmse=-1", "psnr=1", "rmse=nan"):
            self.assert_refused(["compare", "a.exr", "b.exr", "--fail-above", value],
                                f'lemma: error: --fail-above: invalid value "{value}"\n  hint: {hint}')
        self.assert_refused(["compare", "a.exr"],
                            "lemma: error: REFERENCE: missing value\n  hint: expected an image file")


if __name__ == "__main__":
    unittest.main()
