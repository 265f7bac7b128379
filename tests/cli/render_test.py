"""What `lemma render` writes: images, their headers, and the figures of the run."""

import itertools
import json
import re
import subprocess
import unittest

from lemma import (CORNELL_BOX, DONE, INVALID_SAMPLES, SCENES, LemmaTest, choices, image_format, image_header,
                   image_pixels, image_size, options_with_choices)

CORNELL_RADIANCE = (17.0, 12.0, 4.0)  # of the light, as scenes/cornell-box/cornell-box.xml says


class ImageTest(LemmaTest):
    def test_writes_every_format_asked_for_and_nothing_else(self):
        formats = {"a.exr": "float openexr", "a.png": "uint8 png", "a.jpg": "uint8 jpeg", "a.tif": "uint8 tiff"}
        self.render(*(argument for name in formats for argument in ("-o", name)))
        self.assertEqual(self.files(), set(formats))
        self.assertEqual({name: image_format(self.folder / name) for name in formats}, formats)

    def test_renders_all_our_scenes(self):
        for scene in ("cornell-box", "cornell-coplanar", "veach-mis"):
            with self.subTest(scene):
                image = self.render_to(f"{scene}.exr", scene=SCENES / scene, spp=4)
                self.assertGreater(max(map(max, image_pixels(image))), 0, "the image is black")

    def test_scene_is_the_folder_the_xml_or_the_obj(self):
        images = [self.render_to(f"{number}.exr", scene=CORNELL_BOX / name)
                  for number, name in enumerate((".", "cornell-box.xml", "cornell-box.obj"))]
        self.assert_same_pixels(images[0], images[1])
        self.assert_same_pixels(images[0], images[2])

    def test_output_is_named_after_the_scene_by_default(self):
        for scene in (CORNELL_BOX, CORNELL_BOX / "cornell-box.xml", CORNELL_BOX / "cornell-box.obj"):
            with self.subTest(scene):
                self.render(scene=scene)
                self.assertEqual(self.files(), {"cornell-box.exr"})
                (self.folder / "cornell-box.exr").unlink()

    def test_an_output_before_the_scene_does_not_swallow_it(self):
        run = self.lemma("render", "-q", "--size", "4x3", "--spp", "1", "-o", "a.exr", CORNELL_BOX)
        self.assertEqual((run.returncode, run.stderr), (DONE, ""))
        self.assertEqual(self.files(), {"a.exr"})

    def test_size_is_that_of_the_scene_unless_told(self):
        self.assertEqual(image_size(self.render_to("told.exr", size="23x7")), (23, 7))
        scene = self.copy_scene()
        xml = scene / "cornell-box.xml"
        xml.write_text(xml.read_text().replace('width="512" height="512"', 'width="13" height="9"'))
        run = self.lemma("render", scene, "-q", "--spp", 1, "-o", "own.exr")
        self.assertEqual(run.returncode, DONE, run.stderr)
        self.assertEqual(image_size(self.folder / "own.exr"), (13, 9))

    def test_without_scattering_only_emitters_are_seen(self):
        pixels = image_pixels(self.render_to("a.exr", "--max-depth", 0, size="32x32"))
        self.assertEqual(set(pixels), {(0.0, 0.0, 0.0), CORNELL_RADIANCE})

    def test_direct_light_is_less_than_all_light(self):
        def total(*options):
            return sum(map(sum, image_pixels(self.render_to("a.exr", *options, size="32x32", spp=16))))

        self.assertLess(total("--max-depth", 1), total())


class HeaderTest(LemmaTest):
    def test_tells_what_made_the_image(self):
        header = image_header(self.render_to("a.exr", "--seed", 7, "--accel", "grid", spp=3))
        version = self.lemma("--version").stdout.split()[1]
        self.assertEqual(header["Software"], f"Lemma {version}")
        self.assertEqual(header["lemma:version"], version)
        self.assertEqual(header["lemma:scene"], str(CORNELL_BOX))
        self.assertEqual(header["lemma:seed"], "7")
        self.assertEqual(header["lemma:spp"], "3")
        for option in ("--seed 7", "--accel grid", "--spp 3", "--size 16x12"):
            self.assertIn(option, header["lemma:options"])

    def test_its_options_make_the_same_file_again(self):
        """Every option is set to what is not its default, so that none is left out of the header unseen."""
        unusual = {option: choices(option)[-1] for option in options_with_choices()
                   if option not in ("--tonemap", "--progress")}
        scene = SCENES / "veach-mis"
        first = self.render_to("first.exr", *itertools.chain(*unusual.items()), "--max-depth", 3, "--seed", 5,
                               scene=scene, spp=2)
        header = image_header(first)
        for option, name in unusual.items():
            self.assertIn(f"{option} {name} ", header["lemma:options"])
        run = self.lemma("render", header["lemma:scene"], "-q", "-o", "again.exr", *header["lemma:options"].split())
        self.assertEqual(run.returncode, DONE, run.stderr)
        self.assertEqual((self.folder / "again.exr").read_bytes(), first.read_bytes())

    def test_does_not_depend_on_the_time(self):
        self.assertNotIn("DateTime", image_header(self.render_to("a.exr")))
        self.assertNotIn("DateTime", image_header(self.render_to("a.tif")))


class ToneMapTest(LemmaTest):
    """Pictures hold the tone-mapped values of the linear image."""

    def assert_picture(self, expected, *options, scene=CORNELL_BOX):
        """Every value of the PNG is round(255 * expected(L)) of that in the EXR."""
        self.render("-o", "a.exr", "-o", "a.png", *options, scene=scene, spp=8)
        linear = image_pixels(self.folder / "a.exr")
        picture = image_pixels(self.folder / "a.png")
        self.assertEqual(len(linear), len(picture))
        for radiance, stored in zip(sum(linear, ()), sum(picture, ())):
            self.assertLess(abs(255 * expected(radiance) - stored), 0.501, f"radiance {radiance}")

    def test_gamma_is_the_reports_curve(self):
        self.assert_picture(lambda radiance: (radiance / 380) ** 0.25,
                            "--tonemap", "gamma", "--max-radiance", 380, "--gamma", 0.25, scene=SCENES / "veach-mis")

    def test_radiance_beyond_the_largest_is_white(self):
        self.assert_picture(lambda radiance: min(radiance / 0.1, 1) ** 0.5,
                            "--tonemap", "gamma", "--max-radiance", 0.1, "--gamma", 0.5)

    def test_default_is_srgb_and_exposure_counts_stops(self):
        def srgb(radiance):
            x = min(4 * radiance, 1)
            return 12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055

        self.assert_picture(srgb, "--exposure", 2)

    def test_does_not_change_the_linear_image(self):
        plain = self.render_to("plain.exr")
        mapped = self.render_to("mapped.exr", "--tonemap", "gamma", "--max-radiance", 9, "--exposure", 3)
        self.assertEqual(plain.read_bytes(), mapped.read_bytes())


class StatsTest(LemmaTest):
    def stats(self, *arguments, **options):
        self.render_to("a.exr", "--stats", "stats.json", *arguments, **options)
        return json.loads((self.folder / "stats.json").read_text(encoding="utf-8"))

    def test_holds_the_figures_of_the_run(self):
        stats = self.stats("--accel", "grid", "--threads", 3, "--seed", 4, size="20x10", spp=5)
        self.assertEqual(stats["accel"], "grid")
        self.assertEqual(stats["threads"], 3)
        self.assertEqual(stats["seed"], 4)
        self.assertEqual((stats["width"], stats["height"], stats["spp"]), (20, 10, 5))
        self.assertEqual(stats["camera_samples"], 20 * 10 * 5)
        self.assertGreater(stats["rays"], stats["camera_samples"])
        self.assertEqual(stats["invalid_samples"], 0)
        self.assertEqual(stats["scene"], str(CORNELL_BOX))
        self.assertEqual(stats["model"], "Lambert, opaque, no textures, flat normals, 1 light (2 triangles)")

    def test_rates_are_counts_over_seconds(self):
        stats = self.stats(size="64x48", spp=4)
        self.assertGreater(stats["render_seconds"], 0)
        self.assertGreaterEqual(stats["accel_build_seconds"], 0)
        for count in ("camera_samples", "rays"):
            self.assertAlmostEqual(stats[f"{count}_per_second"] * stats["render_seconds"] / stats[count], 1)

    def test_names_each_accelerator_and_counts_the_same_rays(self):
        runs = {accel: self.stats("--accel", accel) for accel in ("grid", "brute")}
        self.assertEqual({accel: stats["accel"] for accel, stats in runs.items()}, {"grid": "grid", "brute": "brute"})
        self.assertEqual(runs["grid"]["rays"], runs["brute"]["rays"])

    def test_scene_whose_name_is_no_utf_8(self):
        scene = self.copy_scene("sc\udce8ne")
        self.assertEqual(self.stats(scene=scene.name)["scene"], "sc\ufffdne")


class StopTest(LemmaTest):
    """Rendering until an error or a time is reached, and what tells how far it came."""

    def stats(self, *arguments):
        """Renders without --spp, which has a default."""
        run = self.lemma("render", CORNELL_BOX, "--size", "32x32", "-o", "a.exr", "--stats", "stats.json", "-q", *arguments)
        self.assertEqual(run.returncode, DONE, run.stderr)
        return json.loads((self.folder / "stats.json").read_text(encoding="utf-8"))

    def assert_same_as_with_spp(self, stats):
        """The file tells the number of samples, and that number makes the same file."""
        header = image_header(self.folder / "a.exr")
        self.assertEqual(header["lemma:spp"], str(stats["spp"]))
        run = self.lemma("render", CORNELL_BOX, "-q", "-o", "again.exr", *header["lemma:options"].split())
        self.assertEqual(run.returncode, DONE, run.stderr)
        self.assertEqual((self.folder / "again.exr").read_bytes(), (self.folder / "a.exr").read_bytes())

    def test_target_error(self):
        stats = self.stats("--target-error", 0.01)
        self.assertLessEqual(stats["estimated_error"]["relmse"]["value"], 0.01)
        self.assertGreater(stats["spp"], 16)
        self.assertTrue(stats["target_reached"])
        self.assert_same_as_with_spp(stats)
        self.assertEqual(self.stats("--target-error", 0.01)["spp"], stats["spp"], "it does not depend on the time")

    def test_target_error_is_not_looked_at_too_early(self):
        self.assertEqual(self.stats("--target-error", 1000)["spp"], 16)

    def test_a_target_that_is_missed_is_told(self):
        for target, spp in ((1e-9, 20), (1000, 8)):
            run = self.render("--target-error", target, "--stats", "stats.json", spp=spp)
            self.assertIn(" not reached: more samples or time are needed\n", run.stdout)
            self.assertFalse(json.loads((self.folder / "stats.json").read_text())["target_reached"])
        self.assertNotIn("target_reached", self.stats("--spp", 2))

    def test_time(self):
        stats = self.stats("--time", 0.5)
        self.assertLess(stats["render_seconds"], 5)  # far more than it takes: the machine may be busy
        self.assert_same_as_with_spp(stats)

    def test_spp_is_the_most_there_is(self):
        self.assertEqual(self.stats("--time", 1000, "--spp", 5)["spp"], 5)
        self.assertEqual(self.stats("--target-error", 1e-9, "--spp", 40)["spp"], 40)

    def test_reference(self):
        self.render("-q", "-o", "reference.exr", "--seed", 2, size="32x32", spp=64)
        stats = self.stats("--reference", "reference.exr", "--spp", 12)
        curve = stats["error_curve"]
        self.assertEqual([point["spp"] for point in curve], [1, 2, 4, 8, 12])
        self.assertEqual(sorted(point["seconds"] for point in curve), [point["seconds"] for point in curve])
        self.assertGreater(curve[0]["relmse"], curve[-1]["relmse"])
        self.assertTrue(all(abs(point["rmse"] ** 2 / point["mse"] - 1) < 1e-9 for point in curve))
        self.assertEqual(stats["reference"], "reference.exr")
        self.assert_same_as_with_spp(stats)
        comparison = self.lemma("compare", "a.exr", "reference.exr", "-q", "--json", "compare.json")
        self.assertEqual(comparison.returncode, DONE, comparison.stderr)
        relmse = json.loads((self.folder / "compare.json").read_text())["relmse_without_noise"]
        self.assertAlmostEqual(curve[-1]["relmse"] / relmse, 1, 6)

    def test_errors_below_the_noise_of_the_reference_are_none(self):
        """The same image as a reference: all that differs from it is subtracted twice."""
        self.render("-q", "-o", "reference.exr", spp=4)
        run = self.render("--reference", "reference.exr", "--stats", "stats.json", "-o", "a.exr", spp=4)
        self.assertRegex(run.stdout, r"against the reference, whose own noise is subtracted \(RMSE \S+, relMSE \S+\):\n")
        self.assertRegex(run.stdout, r"\n +4 +[\d.]+ +below noise +below noise\n")
        stats = json.loads((self.folder / "stats.json").read_text())
        last = stats["error_curve"][-1]
        self.assertEqual((last["mse"], last["relmse"], last["rmse"]),
                         (-stats["reference_noise"]["mse"], -stats["reference_noise"]["relmse"], None))

    def test_reference_of_the_same_seed_is_warned_of(self):
        self.render("-q", "-o", "reference.exr", "--seed", 2, size="8x8", spp=2)
        for seed, told in ((2, ["reference.exr: warning: it was rendered with --seed 2, too"]), (3, [])):
            done = self.lemma("render", CORNELL_BOX, "--size", "8x8", "--spp", "2", "--seed", str(seed),
                              "--reference", "reference.exr", "-o", "a.exr", "--progress", "off")
            self.assertEqual(done.returncode, DONE, done.stderr)
            self.assertEqual(re.findall(r"reference.exr: warning: [^:]*", done.stderr), told)

    def test_reference_that_is_none(self):
        self.render("-q", "-o", "a.exr", "-o", "a.png", size="8x8", spp=2)
        self.assert_refused(["render", "-q", CORNELL_BOX, "--size", "9x8", "--reference", "a.exr"],
                            "a.exr: error: 8x8 pixels are no reference for 9x8\n  hint: render with --size 8x8")
        self.assert_refused(["render", "-q", CORNELL_BOX, "--size", "8x8", "--reference", "a.png"],
                            "a.png: error: a picture is no reference\n  hint: name an .exr file")


class VarianceTest(LemmaTest):
    def test_exr_holds_the_variance_if_there_are_two_samples(self):
        def channels(**options):
            listing = subprocess.run(["oiiotool", "--info", "-v", self.render_to("a.exr", **options)],
                                     check=True, capture_output=True, text=True).stdout
            return re.search(r"channel list: (.*)", listing).group(1)

        self.assertEqual(channels(spp=1), "R, G, B")
        self.assertEqual(channels(spp=2), "R, G, B, variance.R, variance.G, variance.B")

    def test_replicates_change_scrambled_samples_alone(self):
        for sampler in ("independent", "sobol"):
            one, two = (self.render_to(f"{sampler}{n}.exr", "--sampler", sampler, "--replicates", n, spp=4)
                        for n in (1, 2))
            same = image_pixels(one) == image_pixels(two)
            self.assertEqual(same, sampler == "independent")


class InvalidSampleTest(LemmaTest):
    """A light of nearly the largest radiance, so close above the floor that direct light overflows."""

    XML = """<camera width="8" height="8" fovy="60">
               <eye x="0" y="0.5" z="0"/> <lookat x="1" y="0" z="0"/> <up x="0" y="1" z="0"/>
             </camera>
             <light mtlname="light" radiance="3e38, 3e38, 3e38"/>"""
    MTL = "newmtl floor\nKd 1 1 1\nnewmtl light\nKd 0 0 0\n"
    OBJ = """mtllib bright.mtl
             v -50 0 -50
             v -50 0 50
             v 50 0 50
             v 50 0 -50
             v -50 1 -50
             v 50 1 -50
             v 50 1 50
             v -50 1 50
             usemtl floor
             f 1 2 3 4
             usemtl light
             f 5 6 7 8
             """

    def test_are_counted_located_and_told_by_the_exit_code(self):
        self.write("bright/bright.xml", self.XML)
        self.write("bright/bright.mtl", self.MTL)
        self.write("bright/bright.obj", self.OBJ)
        run = self.render("--integrator", "direct", "--lights", "power", "--stats", "stats.json",
                          scene="bright", size="8x8", spp=16, expected=INVALID_SAMPLES)
        count = json.loads((self.folder / "stats.json").read_text())["invalid_samples"]
        self.assertGreater(count, 0)
        self.assertRegex(run.stdout, rf"(?m)^invalid samples: {count}\n  pixel \d,\d sample \d+: \(.*inf.*\)$")
        self.assertLess(max(map(max, image_pixels(self.folder / "bright.exr"))), float("inf"))


if __name__ == "__main__":
    unittest.main()
