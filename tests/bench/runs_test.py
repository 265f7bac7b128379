"""Jobs are done once, and the time that is left is told by those that were done now."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

import runs


class JobsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="lemma-jobs-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.clock = 0.0

    def jobs(self, identity="one program"):
        return runs.Jobs(self.folder, identity)

    def work(self, seconds):
        def done(_):
            self.clock += seconds
            return seconds

        return done

    def test_a_result_is_made_once_for_a_program(self):
        first, again, other = self.jobs(), self.jobs(), self.jobs("another program")
        for jobs in (first, again, other):
            self.assertEqual(jobs.result(["a"], self.work(3)), 3)
        self.assertEqual((first.made, again.made, other.made), (1, 0, 1))

    def test_an_interrupted_job_leaves_nothing(self):
        def fails(_):
            raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            self.jobs().result(["a"], fails)
        self.assertEqual(self.jobs().result(["a"], self.work(3)), 3)

    def test_time_to_go_of_a_run_that_goes_on(self):
        """Two of eight jobs are there; the others take 3 s where 2 are expected."""
        for key in range(2):
            self.jobs().result([key], self.work(3))
        jobs, lines = self.jobs(), io.StringIO()
        progress = runs.Progress(16, jobs, lambda: self.clock)
        with contextlib.redirect_stderr(lines):
            for key in range(8):
                jobs.result([key], self.work(3))
                progress.done(f"job {key}", 2)
        told = lines.getvalue().splitlines()
        self.assertEqual(told[0], " 12 %  0 s, 14 s to go  job 0")  # no pace known yet: as expected
        self.assertEqual(told[2], " 38 %  3 s, 15 s to go  job 2")
        self.assertEqual(told[7], "100 %  18 s, 0 s to go  job 7")


if __name__ == "__main__":
    unittest.main()
