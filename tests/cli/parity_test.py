"""`lemma parity`: the table, the JSON, and its errors."""

import json
import subprocess
import unittest

from lemma import BINARY, DONE, SCENES, LemmaTest

KINDS = ["camera", "bounce", "shadow", "vertex", "edge", "cell", "axis", "grazing", "coplanar", "surface", "far"]


class ParityTest(LemmaTest):
    def parity(self, scene, *options):
        run = self.lemma("parity", scene, "--progress", "off", *(options if "--rays" in options else ("--rays", 4000, *options)))
        self.assertEqual((run.returncode, run.stderr), (DONE, ""))
        return run.stdout

    def test_table_has_a_row_for_each_accelerator_and_kind(self):
        table = [line.split() for line in self.parity(SCENES / "cornell-box").splitlines()]
        rows = [row[:2] for row in table if row and row[0] in ("embree", "grid", "brute")]
        self.assertEqual(rows, [[accel, kind] for accel in ("embree", "grid", "brute") for kind in KINDS + ["all"]])

    def test_json_holds_the_counts_and_ours_are_right(self):
        self.parity(SCENES / "cornell-coplanar", "--json", "parity.json", "-q")
        report = json.loads((self.folder / "parity.json").read_text())
        for accel in report["accelerators"]:
            total = accel["total"]
            self.assertEqual(total["rays"], 4000)
            self.assertEqual(total["decided"] + sum(total["ambiguous"].values()), 4000)
            if accel["accel"] != "embree":
                self.assertEqual((total["wrong"], total["missed"], total["wrong_occlusion"]), (0, 0, 0))
                self.assertLess(total["largest_t_error"], 1)

    def test_result_depends_on_the_seed_but_not_on_the_threads(self):
        scene = SCENES / "cornell-box" / "cornell-box.obj"
        once = self.parity(scene, "--seed", 3, "--threads", 1)
        self.assertEqual(self.parity(scene, "--seed", 3, "--threads", 2), once)
        self.assertNotEqual(self.parity(scene, "--seed", 4), once)

    def test_replay_line_shows_the_same_answer_again(self):
        """Embree leaks at vertices: its faults are there to be replayed."""
        self.parity(SCENES / "veach-mis", "--json", "parity.json", "--rays", 20000)
        accels = json.loads((self.folder / "parity.json").read_text())["accelerators"]
        fault = next(f for a in accels if a["accel"] == "embree" for f in a["faults"] if f["what"] == "wrong")
        command = fault["replay"].replace("lemma trace", f"'{BINARY}' trace")
        run = subprocess.run(["bash", "-c", command], cwd=self.folder, capture_output=True, text=True, check=True)
        self.assertIn("1 rays, 1 of them hit", run.stdout)

    def test_errors(self):
        self.assert_refused(["parity", "none.xml"],
                            "none.xml: error: no such file or folder\n"
                            "  hint: name the XML, the OBJ, or the folder that holds both")
        self.assert_refused(["parity", SCENES / "cornell-box", "--rays", "0"],
                            'lemma: error: --rays: invalid value "0"\n'
                            "  hint: expected a whole number from 20 to 4000000000")


if __name__ == "__main__":
    unittest.main()
