"""What other renderers are given is our scene: its camera, triangles, sides, materials and lights. Without any other renderer."""

import math
import tempfile
import unittest
from pathlib import Path

from course_scene import Material, UnsupportedScene, read_scene

SCENES = Path(__file__).resolve().parents[2] / "scenes"

XML = """<?xml version="1.0"?>
<scene><camera><eye value="1, 2, 3"/><lookat value="0, 0, 0"/><up value="0, 1, 0"/><fovy value="40"/>
<width value="8"/><height value="6"/></camera><light mtlname="lamp" radiance="3, 2, 1"/></scene>"""
MTL = "newmtl paint\nKd 0.5\nKs 0.1 0.2 0.3\nNs 50\nNi 1\nnewmtl lamp\nKd 1 1 1\n"
OBJ = """mtllib a.mtl
v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 2\nv 1 0 2\nv 0 1 2
vn 0 0 1\nvn 0 0 -1\nvt 0 0
usemtl paint
f 1 2 3 4
usemtl lamp
f -3//2 -2//2 -1//2
"""


def area(scene, name):
    """Of a material's triangles, and the sum of their normals times area."""
    total, direction = 0.0, [0.0, 0.0, 0.0]
    for mesh in scene.meshes:
        for triangle in mesh.triangles if mesh.material == name else ():
            a, b, c = (mesh.vertices[i] for i in triangle)
            u, v = ([q - p for p, q in zip(a, other)] for other in (b, c))
            normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
            total += math.hypot(*normal) / 2
            direction = [d + n / 2 for d, n in zip(direction, normal)]
    return total, direction


class OwnScenesTest(unittest.TestCase):
    def test_veach(self):
        scene = read_scene(SCENES / "veach-mis")
        self.assertEqual(sum(len(mesh.triangles) for mesh in scene.meshes), 3092)
        # Radius, radiance, area of the mesh: scenes/README.md.
        for name, radiance, expected in (("light1", 300, 0.031062), ("light2", 50, 0.77656), ("light3", 20, 3.1062),
                                         ("light4", 10, 12.425)):
            self.assertEqual(scene.materials[name], Material((0, 0, 0), (0, 0, 0), 1, 3 * (radiance,)))
            total, direction = area(scene, name)
            self.assertAlmostEqual(total / expected, 1, 4)
            self.assertLess(math.hypot(*direction), 1e-4 * total, "closed")
        self.assertEqual(scene.materials["plate1"], Material((0.1, 0.2, 0.3), (0.1, 0.2, 0.3), 5000))
        camera = scene.camera
        self.assertEqual((camera.eye, camera.fovy, camera.width, camera.height), ((28.2792, 5.2, 1.23612e-06), 20.1143, 1280, 720))

    def test_cornell_box(self):
        scene = read_scene(SCENES / "cornell-box" / "cornell-box.xml")
        self.assertEqual(sum(len(mesh.triangles) for mesh in scene.meshes), 32)
        total, direction = area(scene, "light")
        self.assertAlmostEqual(total, 130 * 105, 3)  # of the measured data
        self.assertAlmostEqual(direction[1] / total, -1, 6)  # it shines down
        self.assertEqual(scene.materials["light"].radiance, (17, 12, 4))
        self.assertEqual(scene.materials["red"].kd, (0.63, 0.065, 0.05))


class SmallSceneTest(unittest.TestCase):
    def read(self, xml=XML, mtl=MTL, obj=OBJ):
        with tempfile.TemporaryDirectory(prefix="lemma-peer-") as folder:
            for ending, text in (("xml", xml), ("mtl", mtl), ("obj", obj)):
                (Path(folder) / f"a.{ending}").write_text(text)
            return read_scene(folder)

    def test_polygons_are_fans_and_windings_follow_the_normals(self):
        paint, lamp = self.read().meshes
        self.assertEqual([[paint.vertices[i] for i in t] for t in paint.triangles],
                         [[(0, 0, 0), (1, 0, 0), (1, 1, 0)], [(0, 0, 0), (1, 1, 0), (0, 1, 0)]])
        self.assertEqual([lamp.vertices[i] for i in lamp.triangles[0]], [(0, 0, 2), (0, 1, 2), (1, 0, 2)])

    def test_values_of_children_and_single_numbers(self):
        scene = self.read()
        self.assertEqual((scene.camera.eye, scene.camera.fovy, scene.camera.width), ((1, 2, 3), 40, 8))
        self.assertEqual(scene.materials["paint"], Material((0.5, 0.5, 0.5), (0.1, 0.2, 0.3), 50))
        self.assertEqual(scene.materials["lamp"].radiance, (3, 2, 1))

    def test_what_is_meant_otherwise_elsewhere_is_refused(self):
        for what, changed in (("textures", {"mtl": MTL.replace("Ns 50", "map_Kd wood.png")}),
                              ("glass", {"mtl": MTL.replace("Ni 1", "Ni 1.5")}),
                              ("lights", {"mtl": MTL.replace("Ni 1", "Ke 1 0 0")}),
                              ("spheres", {"xml": XML.replace("</scene>", "<sphere/></scene>")}),
                              ("smooth normals", {"obj": OBJ.replace("f 1 2 3 4", "vn 0 1 1\nf 1//3 2//3 3//3")}),
                              ("no material", {"obj": OBJ.replace("usemtl paint", "usemtl nothing")})):
            with self.subTest(what), self.assertRaisesRegex(UnsupportedScene, what):
                self.read(**changed)


if __name__ == "__main__":
    unittest.main()
