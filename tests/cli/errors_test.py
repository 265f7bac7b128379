"""What the program says to a command line or a scene that it cannot use."""

import resource
import unittest

from lemma import BAD_INPUT, CORNELL_BOX, LemmaTest, choices, options_with_choices, render_options

SEE_RENDER_HELP = "lemma render --help tells what it takes"
SEE_HELP = "expected one of: render, trace, parity, check, compare; lemma --help tells more"


class ErrorTest(LemmaTest):
    def assert_argument_error(self, arguments, what, hint):
        with self.subTest(what):
            self.assert_refused(arguments, f"lemma: error: {what}\n  hint: {hint}")

    def assert_option_error(self, options, what, hint):
        """As assert_argument_error, with the options of a command line that is right but for them."""
        self.assert_argument_error(["render", CORNELL_BOX, *options], what, hint)

    def assert_file_error(self, arguments, file, what, hint):
        with self.subTest(what):
            self.assert_refused(["render", *arguments], f"{file}: error: {what}\n  hint: {hint}")


class CommandTest(ErrorTest):
    def test_no_command(self):
        self.assert_argument_error([], "no command", SEE_HELP)

    def test_unknown_command(self):
        self.assert_argument_error(["rendre", CORNELL_BOX], 'unknown command "rendre"', SEE_HELP)

    def test_unknown_option_in_place_of_a_command(self):
        self.assert_argument_error(["--fast"], 'unknown option "--fast"', SEE_HELP)

    def test_option_before_its_command(self):
        self.assert_argument_error(["--seed", "1", "render", CORNELL_BOX], "--seed stands before the command",
                                   "the options of a command follow it: lemma render ... --seed")


class OptionTest(ErrorTest):
    def test_unknown_option(self):
        hint = "expected one of: " + ", ".join(render_options())
        for option in ("--acel", "--acel=grid", "-z"):
            self.assert_option_error([option], f'unknown option "{option.split("=")[0]}"', hint)
        self.assert_argument_error(["render", "--acel", "grid", CORNELL_BOX], 'unknown option "--acel"', hint)

    def test_argument_too_many(self):
        self.assert_option_error(["another"], 'unexpected argument "another"', SEE_RENDER_HELP)

    def test_unknown_name(self):
        for option in options_with_choices():
            for name in ("Grid", "gri"):
                self.assert_option_error([option, name], f'{option}: invalid value "{name}"',
                                         "expected one of: " + ", ".join(choices(option)))

    def test_number_out_of_range_or_none(self):
        whole = {"--spp": (1, 2**30, "0"), "--seed": (0, 2**64 - 1, "-1"), "--threads": (0, 1024, "1025"),
                 "--max-depth": (0, 1000, "1001"), "--replicates": (1, 64, "65")}
        for option, (least, most, beyond) in whole.items():
            for value in (beyond, "many", "2.5", "99999999999999999999"):
                self.assert_option_error([option, value], f'{option}: invalid value "{value}"',
                                         f"expected a whole number from {least} to {most}")

    def test_real_number_out_of_range_or_none(self):
        for option in ("--gamma", "--max-radiance", "--time", "--target-error"):
            for value in ("0", "nan", "inf", "1e999", "1,5"):
                self.assert_option_error([option, value], f'{option}: invalid value "{value}"',
                                         "expected a number above 0")
        self.assert_option_error(["--exposure", "nan"], '--exposure: invalid value "nan"', "expected a number")

    def test_size(self):
        for size in ("640", "640x", "x480", "0x480", "640x-1", "65537x1", "640X480", "640x480x3"):
            self.assert_option_error(["--size", size], f'--size: invalid value "{size}"',
                                     "expected WIDTHxHEIGHT, each from 1 to 65536, e.g. 1280x720")

    def test_grid_cells(self):
        for cells in ("0", "28n", "268435457"):
            self.assert_option_error(["--grid-cells", cells], f'--grid-cells: invalid value "{cells}"',
                                     "expected one of: density, 27n, or a whole number from 1 to 268435456")

    def test_missing_value(self):
        accelerators = "expected one of: " + ", ".join(choices("--accel"))
        for options in (["--accel"], ["--accel", ""], ["--accel="]):
            self.assert_option_error(options, "--accel: missing value", accelerators)
        self.assert_option_error(["--spp"], "--spp: missing value", "expected a whole number from 1 to 1073741824")
        self.assert_option_error(["-o"], "--output: missing value", "expected an image file's name, with its ending")
        self.assert_option_error(["--stats"], "--stats: missing value", "expected a file's name")

    def test_option_in_place_of_a_value(self):
        self.assert_option_error(["--stats", "--quiet"], '--stats: invalid value "--quiet"', "expected a file's name")
        self.assert_option_error(["--spp", "--quiet"], '--spp: invalid value "--quiet"',
                                 "expected a whole number from 1 to 1073741824")

    def test_option_given_twice(self):
        self.assert_option_error(["--spp", "1", "--spp", "2"], "--spp: given twice", "keep one of them")


class SceneTest(ErrorTest):
    def test_no_scene(self):
        for arguments in ([], ["-q"], [""]):
            self.assert_argument_error(["render", *arguments], "SCENE: missing value",
                                       "expected an XML file, an OBJ file, or the folder that holds both")

    def test_missing_scene(self):
        self.assert_file_error(["nowhere"], "nowhere", "no such file or folder",
                               "name the XML, the OBJ, or the folder that holds both")

    def test_file_that_is_no_scene(self):
        self.write("notes.txt", "no scene")
        self.assert_file_error(["notes.txt"], "notes.txt", "this is neither XML nor OBJ",
                               "name the XML, the OBJ, or the folder that holds both")

    def test_error_in_a_scene_is_located(self):
        xml = self.copy_scene() / "cornell-box.xml"
        text = xml.read_text()
        xml.write_text(text.replace('fovy="39.3077"', 'fovy="wide"'))
        line = 1 + text[:text.index("<camera")].count("\n")
        self.assert_file_error(["scene"], f"scene/cornell-box.xml:{line}:1", 'fovy is "wide": a number is needed',
                               'for example fovy="40"')


class StrictTest(ErrorTest):
    def test_warnings_are_errors(self):
        xml = self.copy_scene() / "cornell-box.xml"
        with open(xml, "a", encoding="utf-8") as file:
            file.write("<fog/><smoke/>\n")
        line = xml.read_text().count("\n")
        warnings = "".join(f"scene/cornell-box.xml:{line}:{column}: warning: <{name}> is unknown and left out\n"
                           for column, name in ((1, "fog"), (7, "smoke")))
        self.assert_refused(["render", "-q", "scene", "--strict"],
                            f"{warnings}lemma: error: 2 warnings, which --strict takes for errors\n"
                            "  hint: mend the scene, or leave --strict out")

    def test_a_scene_without_warnings_renders(self):
        self.render("--strict")


class MemoryTest(ErrorTest):
    def test_images_that_the_machine_cannot_hold_are_refused(self):
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (2**32, 2**32))
        run = self.lemma("render", CORNELL_BOX, "--size", "16384x16384", "-q", preexec_fn=limit)
        self.assertEqual((run.returncode, run.stderr),
                         (BAD_INPUT, "lemma: error: an image of 16384x16384 needs 52 GB of memory; there are 4 GB\n"
                                     "  hint: choose a smaller one with --size\n"))


class OutputTest(ErrorTest):
    """Outputs that cannot be are refused before anything is read or rendered."""

    def assert_output_error(self, option, file, what, hint):
        self.assert_file_error([CORNELL_BOX, option, file], file, what, hint)

    def test_unknown_ending(self):
        for file, ending in (("a.picture", ".picture"), ("a", ""), (".exr", "")):
            self.assert_output_error("-o", file, f'no image format for the ending "{ending}"',
                                     "use .exr for linear radiance, or .png, .jpg, .tif ... for a picture")

    def test_missing_folder(self):
        what = "cannot be written: the folder nowhere does not exist or takes no files"
        for option, file in (("-o", "nowhere/a.exr"), ("--stats", "nowhere/a.json")):
            self.assert_output_error(option, file, what, "make the folder, or choose another name")

    def test_folder_in_place_of_a_file(self):
        (self.folder / "a.exr").mkdir()
        for option in ("-o", "--stats"):
            self.assert_output_error(option, "a.exr", "cannot be written: it is a folder",
                                     "name a file, for example one in this folder")

    def test_one_bad_output_among_good_ones(self):
        self.assert_file_error([CORNELL_BOX, "-o", "good.exr", "--stats", "good.json", "-o", "a.picture"], "a.picture",
                               'no image format for the ending ".picture"',
                               "use .exr for linear radiance, or .png, .jpg, .tif ... for a picture")


if __name__ == "__main__":
    unittest.main()
