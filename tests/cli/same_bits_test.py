"""Same input, same bits: what the image may depend on, and what not."""

import unittest

from lemma import SCENES, LemmaTest, choices


class SameBitsTest(LemmaTest):
    def exr(self, *arguments, **options):
        return self.render_to("a.exr", *arguments, **{"size": "48x40", "spp": 2, **options}).read_bytes()

    def assert_threads_do_not_matter(self, *arguments, **options):
        files = {threads: self.exr("--threads", threads, *arguments, **options) for threads in (1, 2, 7)}
        self.assertEqual(files[1], files[2])
        self.assertEqual(files[1], files[7])

    def test_threads_do_not_matter_to_any_accelerator(self):
        for accel in choices("--accel"):
            with self.subTest(accel):
                self.assert_threads_do_not_matter("--accel", accel)

    def test_threads_do_not_matter_to_any_estimator(self):
        for integrator in choices("--integrator"):
            for lights in choices("--lights"):
                with self.subTest(integrator=integrator, lights=lights):
                    self.assert_threads_do_not_matter("--integrator", integrator, "--lights", lights,
                                                      scene=SCENES / "veach-mis", spp=1)

    def test_one_technique_alone_is_the_integrator_of_its_samples(self):
        for technique, integrator in (("light", "direct"), ("brdf", "brdf")):
            self.assert_same_pixels(self.render_to("technique.exr", "--technique", technique, spp=4),
                                    self.render_to("integrator.exr", "--integrator", integrator, spp=4))

    def test_grid_and_brute_force_give_the_same_pixels(self):
        for scene in ("cornell-box", "cornell-coplanar", "veach-mis"):
            with self.subTest(scene):
                images = [self.render_to(f"{accel}.exr", "--accel", accel, scene=SCENES / scene, spp=2)
                          for accel in ("grid", "brute")]
                self.assert_same_pixels(*images)

    def test_the_seed_matters(self):
        self.assertEqual(self.exr("--seed", 1), self.exr("--seed", 1))
        self.assert_different_pixels(self.render_to("1.exr", "--seed", 1), self.render_to("2.exr", "--seed", 2))

    def test_the_seed_is_0_by_default(self):
        self.assertEqual(self.exr(), self.exr("--seed", 0))


if __name__ == "__main__":
    unittest.main()
