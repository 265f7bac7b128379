"""Reads a scene (XML, OBJ, MTL) for other renderers: its camera, and a mesh for each material. Apart from Lemma's own reader,
so that a mistake of that one would show as a difference of images. What other renderers would render by other
conventions (textures, glass, smooth normals) is refused, never left out. Needs Python alone."""

import math
import xml.etree.ElementTree as xml
from dataclasses import dataclass
from pathlib import Path

SMOOTH = 1e-3  # length of the difference of two unit normals from which a surface counts as smooth


class UnsupportedScene(Exception):
    """Says what in which file cannot be rendered by a peer under the same conventions."""


@dataclass(frozen=True)
class Camera:
    """A pinhole camera; fovy in degrees, as the image is high."""

    eye: tuple
    look_at: tuple
    up: tuple
    fovy: float
    width: int
    height: int


@dataclass(frozen=True)
class Material:
    """f = kd/pi + ks (ns+1)/(2 pi) cos^ns alpha on both sides, or, with a radiance, a light: it emits that on the
    side of its normals and reflects nothing."""

    kd: tuple
    ks: tuple
    ns: float
    radiance: tuple | None = None


@dataclass(frozen=True)
class Mesh:
    """The triangles of one material. Windings are counter-clockwise seen from the side of the normals."""

    material: str
    vertices: list  # of points
    triangles: list  # of three indices into vertices


@dataclass(frozen=True)
class Scene:
    camera: Camera
    materials: dict  # by name; those of the meshes
    meshes: list


def read_scene(path):
    """A scene by its XML file or the folder that holds one."""
    path = Path(path)
    if path.is_dir():
        found = sorted(path.glob("*.xml"))
        if len(found) != 1:
            raise UnsupportedScene(f"{path}: {len(found)} XML files; name one")
        path = found[0]
    camera, radiances = _read_xml(path)
    meshes, libraries = _read_obj(path.with_suffix(".obj"))
    materials = {}
    for library in libraries:
        materials.update(_read_mtl(library))
    used = {}
    for mesh in meshes:
        if mesh.material in radiances:
            used[mesh.material] = Material((0, 0, 0), (0, 0, 0), 1, radiances[mesh.material])
        elif mesh.material in materials:
            used[mesh.material] = _reflecting(*materials[mesh.material])
        else:
            raise UnsupportedScene(f"{path.with_suffix('.obj')}: no material {mesh.material!r}")
    meshes = [_flat(mesh, used[mesh.material].radiance is not None, path) for mesh in meshes]
    return Scene(camera, used, meshes)


def _numbers(text):
    return tuple(float(word) for word in text.replace(",", " ").split())


def _property(element, name):
    """Numbers of a property, by any of the dialects: attributes x, y, z of a child, its value, or an attribute."""
    child = element.find(name)
    if child is None:
        return _numbers(element.attrib[name])
    if "value" in child.attrib:
        return _numbers(child.attrib["value"])
    return tuple(float(child.attrib[axis]) for axis in "xyz")


def _read_xml(path):
    """Camera, and radiance by material name."""
    text = path.read_text(encoding="utf-8")
    if text.lstrip().startswith("<?xml"):
        text = text[text.index("?>") + 2:]
    root = xml.fromstring(f"<all>{text}</all>")  # some files have no root of their own
    if root.find(".//sphere") is not None:
        raise UnsupportedScene(f"{path}: spheres")
    camera = root.find(".//camera")
    size = [int(_property(camera, name)[0]) for name in ("width", "height")]
    places = [_property(camera, name) for name in ("eye", "lookat", "up")]
    lights = {light.attrib["mtlname"]: _property(light, "radiance") for light in root.iter("light")}
    return Camera(*places, _property(camera, "fovy")[0], *size), lights


def _lines(path):
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words and not words[0].startswith("#"):
            yield words


def _read_mtl(path):
    """By name (path, properties), the properties by keyword."""
    materials, properties = {}, {}
    for keyword, *words in _lines(path):
        if keyword == "newmtl":
            properties = {}
            materials.setdefault(" ".join(words), (path, properties))
        else:
            properties[keyword] = words
    return materials


def _reflecting(path, properties):
    """The material of MTL properties, where all of them mean what they mean to Lemma."""
    def color(keyword):
        values = tuple(map(float, properties.get(keyword, ["0"])))
        return values if len(values) == 3 else 3 * values

    for refused, why in (("map_Kd", "textures"), ("Ni", "glass")):
        if refused in properties and (refused != "Ni" or float(properties["Ni"][0]) > 1):
            raise UnsupportedScene(f"{path}: {refused}: {why}")
    if any(color("Ke")):
        raise UnsupportedScene(f"{path}: Ke: lights that the XML does not name")
    return Material(color("Kd"), color("Ks"), float(properties.get("Ns", ["1"])[0]))


class _Corner:
    """Indices of a face's corner, from 0; those of the file are from 1, or negative from the end."""

    def __init__(self, word, counts):
        parts = (word.split("/") + ["", ""])[:3]
        resolve = [int(p) + (-1 if int(p) > 0 else n) if p else None for p, n in zip(parts, counts)]
        self.vertex, self.normal = resolve[0], resolve[2]


def _read_obj(path):
    """Meshes by material, in the order of the file, whose triangles are pairs of (vertices, normals or Nones), polygons
    being fans around their first corner; and the paths of material libraries."""
    points, normals, texture_count = [], [], 0
    libraries, faces, material = [], {}, None
    for keyword, *words in _lines(path):
        if keyword == "v":
            points.append(tuple(map(float, words[:3])))
        elif keyword == "vn":
            normals.append(tuple(map(float, words[:3])))
        elif keyword == "vt":
            texture_count += 1
        elif keyword == "mtllib":
            libraries.append(path.parent / " ".join(words))
        elif keyword == "usemtl":
            material = " ".join(words)
        elif keyword == "f":
            corners = [_Corner(word, (len(points), texture_count, len(normals))) for word in words]
            for second, third in zip(corners[1:], corners[2:]):
                triangle = [(points[c.vertex], normals[c.normal] if c.normal is not None else None)
                            for c in (corners[0], second, third)]
                faces.setdefault(material, []).append(triangle)
    return [Mesh(name, [], triangles) for name, triangles in faces.items()], libraries


def _sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def _cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def _unit(a):
    length = math.sqrt(_dot(a, a))
    return tuple(x / length for x in a)


def _flat(mesh, is_light, path):
    """A mesh of points and indices. Windings follow the mean of the normals given, as in Lemma; of triangles that reflect,
    all three must be the triangle's own, since conventions differ on what smooth normals do at the horizon."""
    index, triangles = {}, []
    for corners in mesh.triangles:
        points = [point for point, _ in corners]
        normal = _cross(_sub(points[1], points[0]), _sub(points[2], points[0]))
        if not any(normal):
            continue  # nothing is seen of it
        given = [n for _, n in corners if n is not None and any(n)]
        if _dot(normal, [sum(n[axis] for n in given) for axis in range(3)]) < 0:
            points[1], points[2] = points[2], points[1]
            normal = tuple(-x for x in normal)
        for n in () if is_light else given:
            if math.dist(_unit(n), _unit(normal)) > SMOOTH:
                raise UnsupportedScene(f"{path.with_suffix('.obj')}: smooth normals on {mesh.material}")
        triangles.append(tuple(index.setdefault(p, len(index)) for p in points))
    return Mesh(mesh.material, list(index), triangles)
