"""The build refuses includes and links against the order of the folders, shown on small made-up trees."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
CMAKE = os.environ.get("CMAKE", "cmake")
GENERATOR = os.environ.get("GENERATOR", "Ninja")


class TreeTest(unittest.TestCase):
    """A test with a source tree of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="lemma-layers-")
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def cmake(self, *arguments):
        """Runs CMake and returns what came of it, with errors unwrapped: they are broken at 80 columns."""
        run = subprocess.run([CMAKE, *map(str, arguments)], capture_output=True, text=True)
        run.message = " ".join((run.stdout + run.stderr).split())
        return run

    def assert_accepted(self, run):
        self.assertEqual(run.returncode, 0, run.message)

    def assert_refused(self, run, message):
        self.assertNotEqual(run.returncode, 0)
        self.assertIn(message, run.message)


class CheckTest(TreeTest):
    """A test of cmake/CheckLayers.cmake, run as the build does it: on the files of one folder."""

    def check(self, name, text, visible="src/scene;src/core"):
        """Checks a file of that name and text, whose folder may include the folders `visible`."""
        self.stamp = self.root / "stamp"
        return self.cmake("-D", f"FILES={self.write(name, text)}", "-D", f"VISIBLE={visible}", "-D", f"ROOT={self.root}",
                          "-D", f"STAMP={self.stamp}", "-P", PROJECT / "cmake/CheckLayers.cmake")


class IncludeTest(CheckTest):
    """A file includes its own folder and those below it."""

    def test_accepts_folders_below_and_the_standard_library(self):
        self.assert_accepted(self.check("src/scene/a.cpp", '#include "src/scene/a.h"\n#include <vector>\n\n'
                                                           '  #  include "src/core/vec.h"\n// #include "above.h"\n'))
        self.assertTrue(self.stamp.exists())

    def test_refuses_a_folder_above(self):
        run = self.check("src/scene/a.h", '#include "src/core/vec.h"\n#include "src/render/film.h"\n')
        self.assert_refused(run, 'src/scene/a.h: includes "src/render/film.h", which its layer may not see.')
        self.assertIn("It may include: src/scene;src/core.", run.message)
        self.assertFalse(self.stamp.exists(), "the build takes a stamp as a sign that all is well")

    def test_refuses_an_include_that_does_not_name_its_folder(self):
        for header in ("a.h", "../render/film.h", "src/core/../render/film.h"):
            with self.subTest(header):
                run = self.check("src/scene/a.cpp", f'#include "{header}"\n')
                self.assert_refused(run, f'src/scene/a.cpp: includes "{header}", which its layer may not see.')

    def test_refuses_a_folder_above_in_angle_brackets(self):
        self.assert_refused(self.check("src/scene/a.cpp", "#include <src/render/film.h>\n"), '"src/render/film.h"')

    def test_refuses_an_include_with_blanks_of_a_folder_above(self):
        self.assert_refused(self.check("src/scene/a.cpp", ' #\tinclude"src/render/film.h"\n'), '"src/render/film.h"')


class LibraryTest(CheckTest):
    """Each third-party library is included by the files that wrap it alone."""

    WRAPPED = {
        "embree3/rtcore.h": "accel/embree_bvh.cpp",
        "embree4/rtcore.h": "accel/embree_api.h",
        "tiny_obj_loader.h": "tests/unit/obj_reference_test.cpp",
        "hwy/highway.h": "accel/grid_trace.cpp",
        "boost/math/distributions/normal.hpp": "src/measure/significance.cpp",
        "boost/multiprecision/gmp.hpp": "src/oracle/exact.cpp",
        "pugixml.hpp": "src/scene/read_xml.cpp",
        "OpenImageIO/imageio.h": "src/render/image_file.cpp",
        "CLI/CLI.hpp": "src/app/options.cpp",
        "nlohmann/json.hpp": "src/app/summary.cpp",
        "tbb/parallel_for.h": "src/core/tbb_loop.cpp",
        "oneapi/tbb/parallel_for.h": "src/core/tbb_loop.cpp",
    }
    OUTSIDE = ("accel/grid.cpp", "src/core/vec.h", "src/lights/power.cpp", "integrators/mis.cpp")

    def test_accepts_it_in_the_file_that_wraps_it(self):
        for header, wrapper in self.WRAPPED.items():
            with self.subTest(header):
                self.assert_accepted(self.check(wrapper, f"#include <{header}>\n"))

    def test_refuses_it_elsewhere(self):
        for header in self.WRAPPED:
            for file in self.OUTSIDE:
                with self.subTest(header, file=file):
                    run = self.check(file, f"#include <vector>\n#include <{header}>\n")
                    self.assert_refused(run, f"{file}: #include <{header}>: this library is wrapped by the files ")

    def test_refuses_it_in_quotes(self):
        self.assert_refused(self.check("accel/grid.cpp", '#include "embree3/rtcore.h"\n', "accel;src/core"),
                            'accel/grid.cpp: includes "embree3/rtcore.h"')


def rules_of_the_project():
    """The lines of the project's CMakeLists.txt that set properties of the whole build."""
    lines = (PROJECT / "CMakeLists.txt").read_text(encoding="utf-8").splitlines()
    return [line for line in lines if line.startswith("set_property(GLOBAL")]


class BuildTest(TreeTest):
    """A project of two folders, low and high, that uses cmake/Layers.cmake."""

    IN_ORDER = ("lemma_folder(low low)", "lemma_folder(high high USES low)")

    def setUp(self):
        super().setUp()
        for script in ("Layers.cmake", "CheckLayers.cmake"):
            self.write(f"cmake/{script}", (PROJECT / "cmake" / script).read_text(encoding="utf-8"))
        self.write("low/low.h", "int low();\n")
        self.write("low/low.cpp", '#include "low/low.h"\n')
        self.write("high/high.h", '#include "low/low.h"\n')
        self.write("high/high.cpp", '#include "high/high.h"\n')

    def configure(self, *folders):
        """Writes a project of these lines and configures it under the rules of this one."""
        lines = ["cmake_minimum_required(VERSION 3.25)", "project(tiny LANGUAGES CXX)", *rules_of_the_project(),
                 "add_library(lemma_compiler INTERFACE)", "include(cmake/Layers.cmake)", *folders]
        self.write("CMakeLists.txt", "\n".join(lines) + "\n")
        return self.cmake("-G", GENERATOR, "-S", self.root, "-B", self.root / "build")

    def build_layers(self):
        return self.cmake("--build", self.root / "build", "--target", "lemma_low_layer", "lemma_high_layer")

    def test_accepts_folders_in_order(self):
        self.assert_accepted(self.configure(*self.IN_ORDER))
        self.assert_accepted(self.build_layers())

    def test_refuses_an_include_upwards(self):
        self.write("low/low.cpp", '#include "high/high.h"\n')
        self.assert_accepted(self.configure(*self.IN_ORDER))
        self.assert_refused(self.build_layers(), 'low/low.cpp: includes "high/high.h", which its layer may not see.')

    def test_refuses_an_include_of_a_folder_that_is_not_used(self):
        self.assert_accepted(self.configure("lemma_folder(low low)", "lemma_folder(high high)"))
        self.assert_refused(self.build_layers(), 'includes "low/low.h", which its layer may not see.')

    def test_checks_again_when_a_file_changes(self):
        self.assert_accepted(self.configure(*self.IN_ORDER))
        self.assert_accepted(self.build_layers())
        self.write("low/low.h", '#include "high/high.h"\n')
        self.assert_refused(self.build_layers(), 'low/low.h: includes "high/high.h", which its layer may not see.')

    def test_refuses_a_cycle_of_links(self):
        """Static libraries may depend on each other in a circle unless GLOBAL_DEPENDS_NO_CYCLES forbids it."""
        run = self.configure("lemma_folder(low low LINKS lemma_high)", "lemma_folder(high high USES low)")
        self.assert_refused(run, "The inter-target dependency graph contains the following strongly connected component")


if __name__ == "__main__":
    unittest.main()
