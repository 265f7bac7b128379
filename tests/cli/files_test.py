"""Files that stand already are replaced whole or not at all, and nothing else is left behind."""

import json
import os
import resource
import signal
import subprocess
import unittest

from lemma import BAD_INPUT, BINARY, CORNELL_BOX, DONE, LemmaTest

OLD = "what stood here before"
NOBODY = 65534
UNPRIVILEGED = {"user": NOBODY, "group": NOBODY, "extra_groups": []} if os.geteuid() == 0 else {}


class OldFilesTest(LemmaTest):
    def put_old(self, *names):
        for name in names:
            self.write(name, OLD)

    def assert_old(self, *names):
        """These files are as they were, and there are no others."""
        self.assertEqual(self.files(), set(names))
        for name in names:
            self.assertEqual((self.folder / name).read_text(), OLD)


class ReplaceTest(OldFilesTest):
    def test_good_run_replaces_old_files(self):
        names = ("a.exr", "a.png", "a.json")
        self.put_old(*names)
        self.render("-q", "-o", "a.exr", "-o", "a.png", "--stats", "a.json")
        self.assertEqual(self.files(), set(names))
        for name in names:
            self.assertNotEqual((self.folder / name).read_bytes(), OLD.encode())

    def test_bad_scene_leaves_old_files_alone(self):
        scene = self.copy_scene()
        (scene / "cornell-box.obj").write_text("no triangles here\n")
        broken = self.files()
        self.put_old("a.exr", "a.json")
        run = self.render("-o", "a.exr", "--stats", "a.json", scene=scene, expected=BAD_INPUT)
        self.assertIn("error: no triangle can be rendered", run.stderr)
        self.assertEqual(self.files() - broken, {"a.exr", "a.json"})
        self.assertEqual((self.folder / "a.exr").read_text(), OLD)


class FullDiskTest(OldFilesTest):
    """A limit on the size of files stands for the full disk."""

    def assert_fails_to_write(self, name, *arguments, size):
        def limit_file_size():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # so that writing fails, as it does on a full disk
            resource.setrlimit(resource.RLIMIT_FSIZE, (500, 500))

        self.put_old(name)
        run = self.render("-q", *arguments, size=size, expected=BAD_INPUT, preexec_fn=limit_file_size)
        self.assertIn(f"{name}: error: cannot be written: ", run.stderr)
        self.assertEqual((self.folder / name).read_text(), OLD)
        self.assertEqual([file for file in self.files() if ".tmp" in file], [])

    def test_image_that_does_not_fit(self):
        for name in ("a.exr", "a.png", "a.jpg", "a.tif"):
            with self.subTest(name):
                self.assert_fails_to_write(name, "-o", name, size="64x48")

    def test_figures_that_do_not_fit(self):
        """The image is small enough to fit."""
        self.assert_fails_to_write("a.json", "-o", "a.hdr", "--stats", "a.json", size="4x3")


class LinkTest(OldFilesTest):
    def test_figures_to_stdout(self):
        """Through a link of the test's own: a program that replaced it would not harm the system."""
        (self.folder / "stdout").symlink_to("/proc/self/fd/1")
        figures = json.loads(self.render("-q", "--stats", "stdout").stdout)
        self.assertEqual(figures["accel"], "embree")
        self.assertTrue((self.folder / "stdout").is_symlink())

    def test_files_go_where_links_lead(self):
        for option, name in (("-o", "a.png"), ("--stats", "a.json")):
            with self.subTest(option):
                self.put_old(f"elsewhere/{name}")
                (self.folder / name).symlink_to(f"elsewhere/{name}")
                self.render(option, name)
                self.assertTrue((self.folder / name).is_symlink())
                self.assertNotEqual((self.folder / "elsewhere" / name).read_bytes(), OLD.encode())


class KilledTest(OldFilesTest):
    def test_killed_run_leaves_old_files_alone(self):
        self.put_old("a.exr", "a.json")
        command = [BINARY, "render", CORNELL_BOX, "--spp", "100000", "-o", "a.exr", "--stats", "a.json"]
        with subprocess.Popen(command, cwd=self.folder, stderr=subprocess.PIPE, text=True) as process:
            process.stderr.readline()  # the scene is read
            process.kill()
        self.assertEqual(process.returncode, -signal.SIGKILL)
        self.assert_old("a.exr", "a.json")


class WriteProtectedTest(OldFilesTest):
    """As a user without privileges: those of the superuser are not bound by any protection."""

    def setUp(self):
        super().setUp()
        self.folder.chmod(0o777)
        if subprocess.run([BINARY, "--version"], capture_output=True, **UNPRIVILEGED).returncode != DONE:
            self.skipTest(f"{BINARY} is out of reach for user {NOBODY}")

    def assert_cannot_be_written(self, name, *arguments, why):
        before = self.files()
        run = self.render(*arguments, expected=BAD_INPUT, **UNPRIVILEGED)
        self.assertRegex(run.stderr, f"^{name}: error: cannot be written: {why}\n  hint: ")
        self.assertEqual(run.stdout, "")
        self.assertEqual(self.files(), before)

    def test_file(self):
        for name, option in (("a.exr", "-o"), ("a.json", "--stats")):
            self.put_old(name)
            (self.folder / name).chmod(0o444)
            self.assert_cannot_be_written(name, option, name, why="the file is write-protected")

    def test_folder(self):
        (self.folder / "locked").mkdir(mode=0o555)
        for name, option in (("locked/a.exr", "-o"), ("locked/a.json", "--stats")):
            self.assert_cannot_be_written(name, option, name, why="the folder locked does not exist or takes no files")

    def test_folder_of_the_default_output(self):
        self.folder.chmod(0o555)
        self.addCleanup(self.folder.chmod, 0o777)
        run = self.render(expected=BAD_INPUT, **UNPRIVILEGED)
        self.assertIn("cornell-box.exr: error: cannot be written: the folder . does not exist or", run.stderr)


if __name__ == "__main__":
    unittest.main()
