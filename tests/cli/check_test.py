"""`lemma check`: what it tells of a scene, and of one that cannot be rendered."""

import json
import unittest

from lemma import BAD_INPUT, CORNELL_BOX, DONE, LemmaTest


class CheckTest(LemmaTest):
    def check(self, *arguments):
        return self.lemma("check", *arguments, "--json", "check.json")

    def report(self):
        return json.loads((self.folder / "check.json").read_text())

    def test_a_good_scene(self):
        run = self.check(CORNELL_BOX)
        self.assertEqual((run.returncode, run.stderr), (DONE, ""))
        self.assertRegex(run.stdout, r"\Afiles: cornell-box\.xml \(XML, no root, attributes\), cornell-box\.obj, "
                                     r"cornell-box\.mtl\n"
                                     r"model: Lambert, opaque, no textures, .* 1 light \(2 triangles\)\n"
                                     r"camera: 512x512, fovy 39\.3077, from \(278, 273, -800\) to .*\n"
                                     r"geometry: 32 triangles of 40 vertices, from .*\n"
                                     r"  dropped: 0 of zero area, 0 not finite\n"
                                     r"  duplicate: 0; normals against the winding: 0; under a light in their plane: 0; "
                                     r"without texture coordinates: 0\n"
                                     r"lights: 1\n"
                                     r"  light: radiance 17 12 4 by XML, 2 triangles, area 1\.365e\+04, power [\d.e+]+, "
                                     r"faces \(0, -1, 0\)\n"
                                     r"materials: 4\n(?s:.*)"
                                     r"costs, from a few thousand samples on this machine:\n"
                                     r"(?:  (?:embree|grid|brute): [\d.]+ MB, built in [\d.]+ s, [\d.]+ us a sample: 512x512 "
                                     r"with 16 samples a pixel in about .* s\n){3}"
                                     r"warnings: 0\n\Z")
        report = self.report()
        self.assertTrue(report["renderable"])
        self.assertEqual([cost["accel"] for cost in report["costs"]], ["embree", "grid", "brute"])
        self.assertEqual((report["triangles"], report["lights"][0]["radiance"]), (32, [17, 12, 4]))

    def test_what_is_odd_is_counted_and_named(self):
        scene = self.copy_scene()
        with open(scene / "cornell-box.obj", "a", encoding="utf-8") as obj:
            obj.write("vn 0 1 0\nvn 0 -1 0\nv 1 1 1\nv 2 1 1\nv 2 1 2\nusemtl glass\nf -3//-2 -2//-2 -1//-2\n"
                      "f -3//-1 -2//-1 -1//-1\nf -3 -3 -1\nusemtl nowhere\nf -3 -2 -1\n")
        with open(scene / "cornell-box.mtl", "a", encoding="utf-8") as mtl:
            mtl.write("\nnewmtl glass\nNi 1.5\nTr 0.8 1 0.95\nnewmtl spare\nKd 1 1 1\n")
        run = self.check("scene")
        report = self.report()
        self.assertEqual(run.returncode, DONE)
        self.assertEqual((report["dropped_zero_area"], report["duplicates"], report["opposed_normals"]), (1, 2, 1))
        meanings = {(m["name"], m["meaning"]) for m in report["materials"]}
        glass = "glass, Ni 1.5, transmittance 0.8 1 0.95 (Tr of three numbers)"
        self.assertLessEqual({("glass", glass), ("glass", glass + ", winding turned round"), ("spare", "unused"),
                              ("nowhere", "Lambert, not defined in any MTL")}, meanings)
        self.assertEqual(len(report["warnings"]), 1)

    def test_a_light_in_the_plane_of_the_ceiling(self):
        self.check(CORNELL_BOX.parent / "cornell-coplanar")
        self.assertEqual(self.report()["under_lights"], 2)

    def test_a_light_that_faces_away_from_all(self):
        scene = self.copy_scene()
        obj = scene / "cornell-box.obj"
        with open(obj, "a", encoding="utf-8") as file:
            file.write("v 0 9000 0\nv 1 9000 0\nv 1 9000 -1\nusemtl lamp\nf -3 -2 -1\n")
        with open(scene / "cornell-box.xml", "a", encoding="utf-8") as xml:
            xml.write('<light mtlname="lamp" radiance="1,1,1"/>\n')
        self.check("scene")
        self.assertEqual([light["faces_away"] for light in self.report()["lights"]], [False, True])

    def test_a_scene_that_cannot_be_rendered_is_shown_as_far_as_it_goes(self):
        xml = self.copy_scene() / "cornell-box.xml"
        text = xml.read_text()
        xml.write_text(text[:text.index("<light")])
        run = self.check("scene")
        self.assertEqual(run.returncode, BAD_INPUT)
        self.assertRegex(run.stdout, r"\nlights: 0\nmaterials: 4\n")
        self.assertRegex(run.stderr, r"\Ascene/cornell-box.xml: error: no emitters found: the image would be black\n"
                                     r'  hint: candidates: "light" \(Ka [\d. ]+\); write .*, or let --emission name take .*\n\Z')
        self.assertFalse(self.report()["renderable"])
        self.assertEqual(self.lemma("check", "scene", "--emission", "name", "-q").returncode, DONE)

    def test_files_that_cannot_be_read(self):
        run = self.check("nowhere")
        self.assertEqual((run.returncode, run.stdout), (BAD_INPUT, ""))
        self.assertEqual(run.stderr, "nowhere: error: no such file or folder\n"
                                     "  hint: name the XML, the OBJ, or the folder that holds both\n")
        self.assertEqual(self.report()["error"] + "\n", run.stderr)

    def test_strict(self):
        scene = self.copy_scene()
        with open(scene / "cornell-box.xml", "a", encoding="utf-8") as xml:
            xml.write("<fog/>\n")
        self.assertEqual(self.check("scene").returncode, DONE)
        run = self.check("scene", "--strict")
        self.assertEqual(run.returncode, BAD_INPUT)
        self.assertIn("1 warning, which --strict takes for errors", run.stderr)


if __name__ == "__main__":
    unittest.main()
