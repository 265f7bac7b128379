"""`lemma render --pixel`: one pixel and, with --explain, all that happens on its paths."""

import json
import unittest

from lemma import CORNELL_BOX, DONE, SCENES, LemmaTest, choices, image_pixels

SIZE, PIXEL = (16, 12), (9, 7)


class PixelTest(LemmaTest):
    def pixel(self, *arguments, scene=CORNELL_BOX, size="16x12", spp=4, at="9,7"):
        run = self.lemma("render", scene, "-q", "--size", size, "--spp", spp, "--pixel", at, *arguments)
        self.assertEqual((run.returncode, run.stderr), (DONE, ""))
        return run.stdout

    def test_is_that_of_the_image_for_every_integrator(self):
        for integrator in choices("--integrator"):
            with self.subTest(integrator):
                image = self.render_to("a.exr", "--integrator", integrator, spp=4)
                expected = image_pixels(image)[PIXEL[1] * SIZE[0] + PIXEL[0]]
                told = self.pixel("--integrator", integrator)
                self.assertRegex(told, r"^pixel 9,7: radiance \S+ \S+ \S+\n$")
                for a, b in zip(map(float, told.split()[-3:]), expected):
                    self.assertAlmostEqual(a, b, delta=1e-7 * abs(b))  # both print what rounds to the float
                self.assertEqual(self.files(), {"a.exr"})

    def test_explain_tells_surfaces_samples_densities_weights_and_roulette(self):
        text = self.pixel("--explain", "--rr", "fixed", scene=SCENES / "veach-mis", spp=8)
        for word in ("sample 0: radiance", "surface: triangle", "light sample: emitter", "densities [1/sr]: brdf",
                     "tree", "power", "solid-angle", "drawn with", "weight", "contributes", "BRDF sample: towards",
                     "roulette: goes on (probability to go on 0.6)"):
            self.assertIn(word, text)
        self.assertEqual(text.count("\nsample "), 7)

    def test_explain_tells_emitters_that_are_met_and_which_sample_goes_on(self):
        self.assertIn("  camera: emitter 0, radiance (17, 12, 4)\n", self.pixel("--explain", at="7,1", spp=1))
        text = self.pixel("--explain", "--integrator", "brdf", spp=256)
        self.assertRegex(text, r"    it meets an emitter: emitter [01], radiance \(17, 12, 4\)\n"
                               r"      densities \[1/sr\]: brdf .*\n      weight 1: contributes")
        text = self.pixel("--explain", "--integrator", "mis-report", spp=64)
        self.assertRegex(text, r"    goes on with the (light|BRDF) sample, chosen with probability ")

    def test_json_adds_up(self):
        self.pixel("--explain-json", "paths.json", spp=16)
        paths = json.loads((self.folder / "paths.json").read_text(encoding="utf-8"))
        self.assertEqual(paths["pixel"], list(PIXEL))
        self.assertEqual(len(paths["samples"]), 16)
        total = 0
        for sample in paths["samples"]:
            green = sum(event["contribution"][1] for event in sample["events"] if "contribution" in event)
            self.assertAlmostEqual(green, sample["radiance"][1], delta=1e-5)
            total += sample["radiance"][1]
        self.assertAlmostEqual(total / 16, paths["radiance"][1], delta=1e-6)
        self.assertEqual(set(paths["samples"][0]["events"][1]["densities"]), {"brdf", *choices("--lights")})

    def test_refusals(self):
        for arguments, message in (
                (("--pixel", "16,3"),
                 "--pixel: the image of 16x12 has no pixel 16,3\n  hint: expected X,Y from 0,0 (upper left) to 15,11"),
                (("--pixel", "-1,3"),
                 '--pixel: invalid value "-1,3"\n  hint: expected X,Y, e.g. 12,7; 0,0 is the upper left pixel'),
                (("--explain",), "--explain: which pixel?\n  hint: add --pixel X,Y; 0,0 is the upper left one"),
                (("--explain-json", "a.json"),
                 "--explain-json: which pixel?\n  hint: add --pixel X,Y; 0,0 is the upper left one"),
                (("--pixel", "1,1", "-o", "a.exr"), "--pixel writes no image and no figures\n"
                 "  hint: leave out --output and --stats, or --pixel")):
            with self.subTest(arguments):
                self.assert_refused(["render", CORNELL_BOX, "-q", "--size", "16x12", *arguments],
                                    "lemma: error: " + message)


if __name__ == "__main__":
    unittest.main()
