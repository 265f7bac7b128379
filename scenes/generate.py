#!/usr/bin/env python3
# SPDX-License-Identifier: CC0-1.0
"""Write Lemma's example scenes: veach-mis, cornell-box and cornell-coplanar.

Usage:  python3 scenes/generate.py [--out DIR]

Each scene becomes a folder NAME with NAME.xml (camera and lights), NAME.obj (geometry) and
NAME.mtl (materials). Every run, on every machine, writes the same bytes. Each scene is checked
before it is written: closed meshes, outward winding, unit normals, figures as published.

Sources, named below by their letters:
  [V] E. Veach, L. Guibas: Optimally Combining Sampling Techniques for Monte Carlo Rendering,
      SIGGRAPH 1995: four glossy plates below four spherical lights.
  [H] Hand-outs of a computer graphics course of Zhejiang University: figures (camera, sizes,
      places, materials, radiances) of its variants of [V], 2023, and of the Cornell box, 2022.
  [C] Cornell University Program of Computer Graphics: Cornell Box Data,
      https://www.graphics.cornell.edu/online/box/data.html (measured geometry and camera).
  [M] M. McGuire: Computer Graphics Archive, CornellBox-Original (public domain),
      https://casual-effects.com/data: RGB colours in common use for the spectra of [C].
"""

import argparse
import math
import textwrap
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

Vec3 = tuple[float, float, float]
Face = tuple[int, ...]

# ------------------------------------------------------------------------------------ vectors


def add(*vectors: Vec3) -> Vec3:
    x, y, z = (sum(components) for components in zip(*vectors, strict=True))
    return (x, y, z)


def scale(s: float, v: Vec3) -> Vec3:
    return (s * v[0], s * v[1], s * v[2])


def sub(a: Vec3, b: Vec3) -> Vec3:
    return add(a, scale(-1.0, b))


def dot(a: Vec3, b: Vec3) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vec3, b: Vec3) -> Vec3:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


# -------------------------------------------------------------------------------- scene model


@dataclass(frozen=True)
class Mesh:
    """Polygons of one material; normals[i], if there are any, belongs to positions[i]."""

    name: str
    material: str
    positions: list[Vec3]
    faces: list[Face]
    normals: list[Vec3] = field(default_factory=list)


@dataclass(frozen=True)
class Material:
    """Phong material of an MTL file."""

    name: str
    kd: Vec3
    ks: Vec3 = (0.0, 0.0, 0.0)
    ns: float = 1.0


@dataclass(frozen=True)
class Camera:
    """Perspective camera; fovy is the vertical field of view in degrees."""

    width: int
    height: int
    fovy: float
    eye: Vec3
    lookat: Vec3
    up: Vec3 = (0.0, 1.0, 0.0)


@dataclass(frozen=True)
class Scene:
    """All that goes into one folder; lights maps a material's name to its radiance."""

    name: str
    about: str
    camera: Camera
    lights: dict[str, Vec3]
    materials: list[Material]
    meshes: list[Mesh]


# ------------------------------------------------------------------------------------- checks


def require(condition: bool, what: str) -> None:
    """An assertion that python -O keeps."""
    if not condition:
        raise AssertionError(what)


def fan(face: Face) -> list[Face]:
    """The triangles of a convex polygon, as a loader makes them."""
    return [(face[0], face[i], face[i + 1]) for i in range(1, len(face) - 1)]


def triangles(mesh: Mesh) -> Iterator[tuple[Vec3, Vec3, Vec3]]:
    for face in mesh.faces:
        for a, b, c in fan(face):
            yield mesh.positions[a], mesh.positions[b], mesh.positions[c]


def triangle_count(meshes: Iterable[Mesh]) -> int:
    return sum(1 for mesh in meshes for _ in triangles(mesh))


def winding_normal(a: Vec3, b: Vec3, c: Vec3) -> Vec3:
    """Normal of a counter-clockwise triangle; its length is twice the triangle's area."""
    return cross(sub(b, a), sub(c, a))


def area(mesh: Mesh) -> float:
    return sum(math.hypot(*winding_normal(*t)) for t in triangles(mesh)) / 2.0


def volume(mesh: Mesh) -> float:
    """Volume enclosed (divergence theorem): positive if the winding is outward."""
    return sum(dot(a, cross(b, c)) for a, b, c in triangles(mesh)) / 6.0


def open_edges(mesh: Mesh) -> list[tuple[Vec3, Vec3]]:
    """Directed edges, compared by position, that are not met once in the opposite direction."""
    edges: Counter[tuple[Vec3, Vec3]] = Counter()
    for a, b, c in triangles(mesh):
        edges.update([(a, b), (b, c), (c, a)])
    return [(a, b) for (a, b), n in edges.items() if n != 1 or edges[b, a] != 1]


def check_closed(mesh: Mesh, expected_volume: float, tolerance: float) -> None:
    """A closed surface, wound outward, of the volume expected."""
    require(not open_edges(mesh), f"{mesh.name} is not closed")
    error = abs(volume(mesh) / expected_volume - 1.0)
    require(error < tolerance, f"{mesh.name}: volume {volume(mesh)}, not {expected_volume}")


def check_normals(mesh: Mesh) -> None:
    """One unit normal per position, on the side the winding calls the front."""
    require(len(mesh.normals) == len(mesh.positions), f"{mesh.name}: normals missing")
    for n in mesh.normals:
        require(abs(math.hypot(*n) - 1.0) < 1e-6, f"{mesh.name}: normal {n} is not unit")
    for face in mesh.faces:
        front = winding_normal(*(mesh.positions[i] for i in face[:3]))
        agree = all(dot(front, mesh.normals[i]) > 0.0 for i in face)
        require(agree, f"{mesh.name}: a normal opposes its face {face}")


def check_faces_point(mesh: Mesh, target: Vec3) -> None:
    """Every triangle turns its front to the target."""
    for a, b, c in triangles(mesh):
        facing = dot(winding_normal(a, b, c), sub(target, a)) > 0.0
        require(facing, f"{mesh.name} turns away from {target}")


# ------------------------------------------------------------------------------------- shapes

DECIMALS = 7  # of computed coordinates: float32's own spacing for magnitudes of 1 and above


def snap(x: float) -> float:
    """Round a computed coordinate, and make sure every machine rounds it alike.

    Mathematical libraries differ in the last bit of a sine. That bit is lost in the rounding
    unless the value is as good as half-way between two neighbours, which is refused here.
    """
    steps = x * 10.0**DECIMALS
    require(abs(steps - math.floor(steps) - 0.5) > 1e-6, f"{x} is a rounding tie")
    return round(x, DECIMALS) + 0.0  # the sum turns -0.0 into 0.0


def snap_point(p: Vec3) -> Vec3:
    return (snap(p[0]), snap(p[1]), snap(p[2]))


def sphere_directions(slices: int, stacks: int) -> Iterator[Vec3]:
    """Unit vectors: the north pole (+y), the circles of latitude, the south pole."""
    yield (0.0, 1.0, 0.0)
    for i in range(1, stacks):
        polar = math.pi * i / stacks
        for j in range(slices):
            azimuth = 2.0 * math.pi * j / slices
            ring = math.sin(polar)
            yield (ring * math.sin(azimuth), math.cos(polar), ring * math.cos(azimuth))
    yield (0.0, -1.0, 0.0)


def sphere_faces(slices: int, stacks: int) -> Iterator[Face]:
    """Outward triangles over the points of sphere_directions."""
    south = 1 + (stacks - 1) * slices
    for j in range(slices):
        k = (j + 1) % slices
        yield (0, 1 + j, 1 + k)
        for north_west in range(1 + j, south - slices, slices):
            north_east = north_west - j + k
            yield from fan((north_west, north_west + slices, north_east + slices, north_east))
        yield (south, south - slices + k, south - slices + j)


def sphere(name: str, centre: Vec3, radius: float, slices: int = 20, stacks: int = 20) -> Mesh:
    """Latitude-longitude mesh with smooth normals; its material has its name."""
    directions = list(sphere_directions(slices, stacks))
    mesh = Mesh(
        name,
        name,
        positions=[snap_point(add(centre, scale(radius, d))) for d in directions],
        faces=list(sphere_faces(slices, stacks)),
        normals=[snap_point(d) for d in directions],
    )
    check_closed(mesh, 4.0 / 3.0 * math.pi * radius**3, tolerance=0.03)
    check_normals(mesh)
    return mesh


def box(name: str, centre: Vec3, axes: tuple[Vec3, Vec3, Vec3], size: Vec3) -> Mesh:
    """Closed box with flat normals over orthonormal right-handed axes, named as its material."""
    positions: list[Vec3] = []
    normals: list[Vec3] = []
    faces: list[Face] = []
    for i in range(3):
        for sign in (1.0, -1.0):
            u, v, w = (scale(size[k % 3] / 2.0, axes[k % 3]) for k in (i, i + 1, i + 2))
            middle = add(centre, scale(sign, u))
            for s, t in ((-sign, -1.0), (sign, -1.0), (sign, 1.0), (-sign, 1.0)):
                positions.append(snap_point(add(middle, scale(s, v), scale(t, w))))
            normals += [snap_point(scale(sign, axes[i]))] * 4
            first = len(positions) - 4
            faces += fan((first, first + 1, first + 2, first + 3))
    mesh = Mesh(name, name, positions, faces, normals)
    check_closed(mesh, math.prod(size), tolerance=1e-5)
    check_normals(mesh)
    return mesh


def rectangle(name: str, material: str, corners: list[Vec3], normal: Vec3) -> Mesh:
    """Two triangles with flat normals."""
    mesh = Mesh(name, material, corners, fan((0, 1, 2, 3)), [normal] * 4)
    check_normals(mesh)
    return mesh


# ---------------------------------------------------------------------------------- veach-mis


@dataclass(frozen=True)
class Plate:
    """A glossy plate: shininess, and bounding box in x and y."""

    name: str
    ns: float
    x: tuple[float, float]
    y: tuple[float, float]

    @property
    def centre(self) -> Vec3:
        return (sum(self.x) / 2.0, sum(self.y) / 2.0, 0.0)


# [H] From the farthest and shiniest plate to the nearest and roughest.
PLATES = [
    Plate("plate1", 5000.0, x=(-0.6379, 1.1660), y=(3.3097, 4.8864)),
    Plate("plate2", 1000.0, x=(2.0329, 4.0904), y=(2.1812, 3.2529)),
    Plate("plate3", 500.0, x=(6.0402, 8.1594), y=(1.4774, 2.1604)),
    Plate("plate4", 100.0, x=(9.6165, 11.7374), y=(0.9569, 1.5106)),
]
PLATE_THICKNESS = 0.3  # [H]
PLATE_LENGTH = 2.1  # [H] down the slope; used as a check only
PLATE_WIDTH = 2.0 * 6.76049  # [H] along z

# [H] The lights hang in a row along z: name -> (z, radius, radiance).
LIGHT_ROW = (0.0, 6.5)  # x and y of their centres
SPHERE_LIGHTS = {
    "light1": (4.7, 0.05, 300.0),
    "light2": (2.10872, 0.25, 50.0),
    "light3": (-1.1579, 0.5, 20.0),
    "light4": (-4.362, 1.0, 10.0),
}

VEACH_CAMERA = Camera(
    width=1280,
    height=720,
    fovy=20.1143,  # [H]; 35 degrees across the width
    eye=(28.2792, 5.2, 1.23612e-06),  # [H]
    lookat=(0.0, 2.8, 0.0),  # [H]
)


def plate_tilt(width: float, height: float, thickness: float) -> float:
    """The tilt a of a rectangle of known thickness t whose bounding box is known.

    Its length L is the other unknown: width = L cos a + t sin a, height = L sin a + t cos a.
    Without L, that is width sin a - height cos a + t cos 2a = 0, whose left side rises from
    t - height < 0 at 0 to width - t > 0 at 90 degrees: bisect.
    """
    low, high = 0.0, math.pi / 2.0
    for _ in range(60):
        a = (low + high) / 2.0
        if width * math.sin(a) - height * math.cos(a) + thickness * math.cos(2.0 * a) < 0.0:
            low = a
        else:
            high = a
    return low


def plate_mesh(plate: Plate) -> Mesh:
    """The plate as a box: tilted about z, sloping down towards the camera."""
    width, height = plate.x[1] - plate.x[0], plate.y[1] - plate.y[0]
    tilt = plate_tilt(width, height, PLATE_THICKNESS)
    s, c = math.sin(tilt), math.cos(tilt)
    length = math.hypot(width - PLATE_THICKNESS * s, height - PLATE_THICKNESS * c)
    require(abs(length - PLATE_LENGTH) < 5e-4, f"{plate.name} is {length} long")
    axes = ((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0))
    mesh = box(plate.name, plate.centre, axes, (length, PLATE_THICKNESS, PLATE_WIDTH))
    check_bounds(mesh, plate)
    check_mirror(plate, up=axes[1])
    return mesh


def check_bounds(mesh: Mesh, plate: Plate) -> None:
    """The box fills the bounding box its tilt and length were derived from."""
    for k, bounds in enumerate((plate.x, plate.y, (-PLATE_WIDTH / 2.0, PLATE_WIDTH / 2.0))):
        made = [p[k] for p in mesh.positions]
        error = max(abs(min(made) - bounds[0]), abs(max(made) - bounds[1]))
        require(error < 1e-5, f"{mesh.name}: bounding box off by {error} along axis {k}")


def check_mirror(plate: Plate, up: Vec3) -> None:
    """Seen from the camera, the middle of the plate mirrors the row of lights."""
    top = add(plate.centre, scale(PLATE_THICKNESS / 2.0, up))
    view = sub(top, VEACH_CAMERA.eye)
    ray = sub(view, scale(2.0 * dot(view, up), up))
    to_row = sub((*LIGHT_ROW, 0.0), top)
    miss = abs(cross(ray, to_row)[2]) / math.hypot(ray[0], ray[1])
    require(miss < 1.0, f"{plate.name} mirrors a point {miss} off the row of lights")


def sphere_light_meshes() -> list[Mesh]:
    """The lights; a mesh inscribed in its sphere has 1.1 % less area."""
    meshes = []
    for name, (z, radius, _) in SPHERE_LIGHTS.items():
        mesh = sphere(name, (*LIGHT_ROW, z), radius)
        ratio = area(mesh) / (4.0 * math.pi * radius**2)
        require(0.988 < ratio < 0.990, f"{name}: {ratio} of the sphere's area")
        meshes.append(mesh)
    return meshes


def room_meshes() -> list[Mesh]:
    """[H] The floor y = 0 and, at its far end, the wall x = -5."""
    x0, x1, top, z = -5.0, 14.8, 19.8, 23.76
    floor = [(x0, 0.0, z), (x1, 0.0, z), (x1, 0.0, -z), (x0, 0.0, -z)]
    wall = [(x0, 0.0, z), (x0, 0.0, -z), (x0, top, -z), (x0, top, z)]
    return [
        rectangle("wall", "room", wall, (1.0, 0.0, 0.0)),
        rectangle("floor", "room", floor, (0.0, 1.0, 0.0)),
    ]


def veach_mis() -> Scene:
    blue = (0.1, 0.2, 0.3)  # [H] both diffuse and specular
    meshes = [plate_mesh(p) for p in PLATES] + sphere_light_meshes() + room_meshes()
    require(triangle_count(meshes) == 3092, "veach-mis has 3,092 triangles")
    return Scene(
        "veach-mis",
        "Four glossy plates mirror four spherical lights: which way of sampling serves best? "
        "After E. Veach and L. Guibas, SIGGRAPH 1995. Rebuilt from the figures (camera, sizes, "
        "places, materials, radiances) of a course hand-out, Zhejiang University, 2023.",
        VEACH_CAMERA,
        {name: (r, r, r) for name, (_, _, r) in SPHERE_LIGHTS.items()},
        [
            Material("room", kd=(0.5, 0.5, 0.5)),
            *(Material(p.name, kd=blue, ks=blue, ns=p.ns) for p in PLATES),
            *(Material(name, kd=(0.0, 0.0, 0.0)) for name in SPHERE_LIGHTS),
        ],
        meshes,
    )


# -------------------------------------------------------------------------------- cornell-box

TOP = 548.8  # [C] height of the ceiling, and of the light

# [C] Name -> material and corners, counter-clockwise seen from the inside. The box as measured
# is not quite rectangular: the left wall's corners do not even lie in one plane. Left and right
# are as the camera sees them.
CORNELL_WALLS: dict[str, tuple[str, list[Vec3]]] = {
    "floor": (
        "white",
        [(552.8, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 559.2), (549.6, 0.0, 559.2)],
    ),
    "ceiling": (
        "white",
        [(556.0, TOP, 0.0), (556.0, TOP, 559.2), (0.0, TOP, 559.2), (0.0, TOP, 0.0)],
    ),
    "back_wall": (
        "white",
        [(549.6, 0.0, 559.2), (0.0, 0.0, 559.2), (0.0, TOP, 559.2), (556.0, TOP, 559.2)],
    ),
    "right_wall": (
        "green",
        [(0.0, 0.0, 559.2), (0.0, 0.0, 0.0), (0.0, TOP, 0.0), (0.0, TOP, 559.2)],
    ),
    "left_wall": (
        "red",
        [(552.8, 0.0, 0.0), (549.6, 0.0, 559.2), (556.0, TOP, 559.2), (556.0, TOP, 0.0)],
    ),
}

# [C] Height, and corners (x, z) in the order of the top faces.
SHORT_BLOCK = (165.0, [(130.0, 65.0), (82.0, 225.0), (240.0, 272.0), (290.0, 114.0)])
TALL_BLOCK = (330.0, [(423.0, 247.0), (265.0, 296.0), (314.0, 456.0), (472.0, 406.0)])

# [C] Corners (x, z) of the light.
CORNELL_LIGHT = [(343.0, 227.0), (343.0, 332.0), (213.0, 332.0), (213.0, 227.0)]

CORNELL_MATERIALS = [
    Material("white", kd=(0.725, 0.71, 0.68)),  # [M]
    Material("red", kd=(0.63, 0.065, 0.05)),  # [M]
    Material("green", kd=(0.14, 0.45, 0.091)),  # [M]
    Material("light", kd=(0.0, 0.0, 0.0)),
]


def cornell_camera(size: int) -> Camera:
    """[C] Position 278 273 -800, direction 0 0 1, focal length 0.035, film 0.025 x 0.025.

    That is a field of view of 39.30765 degrees; 39.3077 is the figure in common use.
    """
    fovy = 39.3077
    exact = math.degrees(2.0 * math.atan(0.025 / 2.0 / 0.035))
    require(abs(fovy - exact) < 1e-4, f"fovy is {exact}")
    return Camera(size, size, fovy, eye=(278.0, 273.0, -800.0), lookat=(278.0, 273.0, -799.0))


def wall_mesh(name: str, material: str, corners: list[Vec3]) -> Mesh:
    """One quadrilateral that faces the room."""
    mesh = Mesh(name, material, corners, [(0, 1, 2, 3)])
    check_faces_point(mesh, target=(278.0, 274.4, 279.6))
    return mesh


def block_mesh(name: str, height: float, corners: list[tuple[float, float]]) -> Mesh:
    """[C] Top and four sides; nothing below, where the block stands on the floor."""
    positions: list[Vec3] = [(x, y, z) for y in (height, 0.0) for x, z in corners]
    sides = [((i + 1) % 4 + 4, (i + 1) % 4, i, i + 4) for i in range(4)]
    mesh = Mesh(name, "white", positions, [(0, 1, 2, 3), *sides])
    rim = open_edges(mesh)
    require(len(rim) == 4 and all(a[1] == b[1] == 0.0 for a, b in rim), f"{name} has a hole")
    require(volume(mesh) > 0.0, f"{name} is inside out")  # the plane y = 0 adds nothing
    return mesh


def cornell_meshes(light_height: float) -> list[Mesh]:
    walls = [wall_mesh(name, *wall) for name, wall in CORNELL_WALLS.items()]
    light = wall_mesh("light", "light", [(x, light_height, z) for x, z in CORNELL_LIGHT])
    blocks = [block_mesh("short_block", *SHORT_BLOCK), block_mesh("tall_block", *TALL_BLOCK)]
    meshes = [*walls, light, *blocks]
    require(triangle_count(meshes) == 32, "the Cornell box has 32 triangles")
    return meshes


def cornell_box() -> Scene:
    return Scene(
        "cornell-box",
        "The Cornell box: geometry and camera as measured at Cornell University, "
        "https://www.graphics.cornell.edu/online/box/data.html; RGB colours and radiance in "
        "common use with these data (McGuire's Computer Graphics Archive, casual-effects.com). "
        "The data have the light in the plane of the ceiling, y = 548.8; here it lies at 548.7, "
        "so that the two do not overlap.",
        cornell_camera(512),
        {"light": (17.0, 12.0, 4.0)},  # [M]
        CORNELL_MATERIALS,
        cornell_meshes(light_height=TOP - 0.1),
    )


def cornell_coplanar() -> Scene:
    """The data of [C] taken literally, as [H] has it; radiance and image size are of [H]."""
    return Scene(
        "cornell-coplanar",
        "The Cornell box with its light exactly in the plane of a ceiling without a hole: a ray "
        "upwards meets both at the same distance. A test of ties and of shadow rays. Sources: as "
        "for cornell-box; radiance and image size from a course hand-out, Zhejiang University, "
        "2022.",
        cornell_camera(1024),
        {"light": (34.0, 24.0, 8.0)},
        CORNELL_MATERIALS,
        cornell_meshes(light_height=TOP),
    )


# ------------------------------------------------------------------------------------- output


def number(x: float) -> str:
    """Nine significant digits at most: enough to name every float32."""
    return format(x, ".9g")


def numbers(values: Iterable[float], separator: str = " ") -> str:
    return separator.join(number(x) for x in values)


def head(scene: Scene) -> list[str]:
    """The lines each file starts with, to be put into a comment."""
    about = textwrap.wrap(scene.about, width=88, break_on_hyphens=False)
    return [f"{scene.name}: made by scenes/generate.py. Licence: CC0 1.0.", *about]


def xml_lines(scene: Scene) -> Iterator[str]:
    camera = scene.camera
    yield '<?xml version="1.0" encoding="utf-8"?>'
    yield "<!--"
    yield from (f"  {line}" for line in head(scene))
    yield "-->"
    size = f'width="{camera.width}" height="{camera.height}"'
    yield f'<camera type="perspective" {size} fovy="{number(camera.fovy)}">'
    for tag, vector in (("eye", camera.eye), ("lookat", camera.lookat), ("up", camera.up)):
        x, y, z = map(number, vector)
        yield f'  <{tag} x="{x}" y="{y}" z="{z}"/>'
    yield "</camera>"
    for name, radiance in scene.lights.items():
        yield f'<light mtlname="{name}" radiance="{numbers(radiance, ",")}"/>'


def mtl_lines(scene: Scene) -> Iterator[str]:
    yield from (f"# {line}" for line in head(scene))
    for material in scene.materials:
        yield ""
        yield f"newmtl {material.name}"
        yield f"Kd {numbers(material.kd)}"
        yield f"Ks {numbers(material.ks)}"
        yield f"Ns {number(material.ns)}"
        yield "Ni 1"


def obj_lines(scene: Scene) -> Iterator[str]:
    yield from (f"# {line}" for line in head(scene))
    yield f"mtllib {scene.name}.mtl"
    base = 1  # OBJ counts from one, over all meshes
    for mesh in scene.meshes:
        corner = "{0}//{0}" if mesh.normals else "{0}"
        yield ""
        yield f"o {mesh.name}"
        yield from (f"v {numbers(p)}" for p in mesh.positions)
        yield from (f"vn {numbers(n)}" for n in mesh.normals)
        yield f"usemtl {mesh.material}"
        for face in mesh.faces:
            yield "f " + " ".join(corner.format(base + i) for i in face)
        base += len(mesh.positions)


def write(scene: Scene, out: Path) -> None:
    folder = out / scene.name
    folder.mkdir(parents=True, exist_ok=True)
    for suffix, lines in (("xml", xml_lines), ("mtl", mtl_lines), ("obj", obj_lines)):
        text = "\n".join(lines(scene)) + "\n"
        (folder / f"{scene.name}.{suffix}").write_bytes(text.encode("utf-8"))


def summary(scene: Scene) -> str:
    lights = [mesh for mesh in scene.meshes if mesh.material in scene.lights]
    areas = ", ".join(f"{mesh.name} {area(mesh):.5g}" for mesh in lights)
    total, emitting = triangle_count(scene.meshes), triangle_count(lights)
    return f"{scene.name}: {total:,} triangles, {emitting:,} of them emit; areas: {areas}"


def main() -> None:
    parser = argparse.ArgumentParser(description="Write Lemma's example scenes.")
    here = Path(__file__).resolve().parent
    parser.add_argument("--out", type=Path, default=here, help="default: this script's folder")
    out = parser.parse_args().out
    for scene in (veach_mis(), cornell_box(), cornell_coplanar()):
        write(scene, out)
        print(summary(scene))


if __name__ == "__main__":
    main()
