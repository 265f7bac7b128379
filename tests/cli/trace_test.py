"""`lemma trace`: rays from a file, hits into a file."""

import math
import struct
import unittest

from lemma import DONE, LemmaTest, SCENES

# A square as one polygon (triangles 0 and 1 of its fan), a triangle of zero area (2, dropped), and one behind (3).
SQUARE = """v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
v 0 0 3
v 4 0 3
v 0 4 3
f 1 2 3 4
f 1 2 2
f 5 6 7
"""
UP = (0, 0, 1)
INFINITY = math.inf


def ray(origin, direction, t_min=0.0, t_max=INFINITY):
    return struct.pack("<8f", *origin, t_min, *direction, t_max)


class TraceTest(LemmaTest):
    def trace(self, rays, *options, scene=None):
        """The hits of `rays` as (triangle, t, b1, b2)."""
        (self.folder / "in.f32").write_bytes(b"".join(rays))
        scene = scene or self.write("square.obj", SQUARE)
        run = self.lemma("trace", scene, "--rays", "in.f32", "-o", "hits.bin", "-q", *options)
        self.assertEqual((run.returncode, run.stdout, run.stderr), (DONE, "", ""))
        return list(struct.iter_unpack("<i3f", (self.folder / "hits.bin").read_bytes()))

    def test_triangles_are_counted_in_file_order_with_the_dropped_ones(self):
        for accel in ("grid", "embree", "brute"):
            hits = self.trace([ray((0.75, 0.25, 0), UP), ray((0.25, 0.75, 0), UP), ray((1.5, 1.5, 0), UP),
                               ray((9, 9, 0), UP)], "--accel", accel)
            self.assertEqual([hit[:2] for hit in hits], [(0, 1), (1, 1), (3, 3), (-1, 0)], accel)

    def test_barycentric_coordinates_belong_to_the_second_and_third_vertex(self):
        (hit,) = self.trace([ray((0.75, 0.25, 0), UP)])
        self.assertEqual(hit, (0, 1, 0.5, 0.25))

    def test_range_is_open_and_in_units_of_the_direction(self):
        hits = self.trace([ray((0.75, 0.25, 0), (0, 0, 2), 0, 0.5), ray((0.75, 0.25, 0), (0, 0, 2), 0, 0.51),
                           ray((0.75, 0.25, 0), UP, 1, 2)])
        self.assertEqual([hit[:2] for hit in hits], [(-1, 0), (0, 0.5), (-1, 0)])

    def test_any_tells_only_whether(self):
        hits = self.trace([ray((1.5, 1.5, 0), UP), ray((9, 9, 0), UP)], "--any")
        self.assertEqual(hits, [(0, 0, 0, 0), (-1, 0, 0, 0)])

    def test_rays_that_are_not_finite_hit_nothing(self):
        self.assertEqual(self.trace([ray((math.nan, 0, 0), UP)]), [(-1, 0, 0, 0)])

    def test_scene_may_be_a_folder_with_camera_and_lights(self):
        hits = self.trace([ray((0, 5, 1), (-1, 0, 0))], scene=SCENES / "veach-mis")
        self.assertGreaterEqual(hits[0][0], 0)

    def test_prints_what_it_did(self):
        (self.folder / "in.f32").write_bytes(ray((0.75, 0.25, 0), UP))
        run = self.lemma("trace", self.write("a.obj", SQUARE), "--rays", "in.f32", "-o", "o", "--accel", "brute")
        self.assertEqual(run.stdout, "brute force over 3 triangles\n1 rays, 1 of them hit\n")


class BadRaysTest(LemmaTest):
    FORMAT = "rays are 8 float32 each: ox oy oz tmin dx dy dz tmax"

    def assert_bad(self, name, what, hint):
        scene = SCENES / "cornell-box" / "cornell-box.obj"
        self.assert_refused(["trace", scene, "--rays", name, "-o", "hits.bin"],
                            f"{name}: error: {what}\n  hint: {hint}")

    def test_no_such_file(self):
        self.assert_bad("none.f32", "no such file", "check the name")

    def test_empty_file(self):
        (self.folder / "empty.f32").write_bytes(b"")
        self.assert_bad("empty.f32", "the file is empty", self.FORMAT)

    def test_part_of_a_ray(self):
        (self.folder / "part.f32").write_bytes(bytes(33))
        self.assert_bad("part.f32", "33 bytes are no whole number of rays of 32", self.FORMAT)

    def test_folder(self):
        (self.folder / "rays").mkdir()
        self.assert_bad("rays", "this is a folder", "name a file")

    def test_no_scene(self):
        (self.folder / "in.f32").write_bytes(bytes(32))
        self.assert_refused(["trace", "none.obj", "--rays", "in.f32", "-o", "hits.bin"],
                            "none.obj: error: no such file or folder\n"
                            "  hint: name the XML, the OBJ, or the folder that holds both")

    def test_missing_options(self):
        self.assert_refused(["trace", "a.obj", "-o", "o"],
                            "lemma: error: --rays: missing value\n  hint: expected a file of rays")


if __name__ == "__main__":
    unittest.main()
