#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page on accuracy, written from made-up tables."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

REPORT = pathlib.Path(__file__).resolve().parents[2] / "benchmarks" / "accuracy" / "report"
RUNS = ("item,source,garment,setting,knob,value,nodes,residual,status,cpu_ms,sewing_ms,peak_mb,mean_mm,p95_mm,max_mm,"
        "hem_mm,waist_mm,chest_mm,iou,landmark_mm,seam_gap_mm,penetration_mm,estimate_mm,spread_mm")
FIDELITY = ("item,garment,status,iou_posed,turn_deg,leg_swing,iou,iou_marked,iou_uniform,iou_true_size,width,height,"
            "uniform_scale,landmark_mean_mm,landmark_max_mm,worst_landmark")
EXTREMES = "group,case,status_or_code,residual,gap_mm,penetration_mm,stretch_p99,finite,cpu_ms,note"


def run_row(item, setting, ms, error, estimate=""):
    return f"{item},real,vest,{setting},,,300,1e-3,OK,{ms},1,9,{error},1,1,1,1,,,,0,0,{estimate},0.9"


class Report(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tables, self.out = pathlib.Path(folder.name) / "tables", pathlib.Path(folder.name) / "out"
        self.tables.mkdir()

    def keep(self, name, *lines):
        (self.tables / name).write_text("\n".join(lines) + "\n", encoding="utf-8")

    def report(self, *flags):
        return subprocess.run([sys.executable, REPORT, "--tables", self.tables, "--out", self.out, *flags],
                              capture_output=True, text=True, check=False)

    def row(self, beginning):
        self.assertEqual(self.report().returncode, 0)
        page = (self.out / "ACCURACY.md").read_text(encoding="utf-8")
        found = [line for line in page.splitlines() if line.startswith(f"| {beginning}")]
        self.assertTrue(found, f"no row {beginning!r} in\n{page}")
        return found[0]

    def test_what_was_not_measured_is_neither_met_nor_missed(self):
        self.assertIn("| not measured |", self.row("silhouette over the photo's"))

    def test_an_error_that_rises_with_the_quality_is_missed(self):
        self.keep("runs.csv", RUNS, run_row("a", "draft", 9, 3), run_row("a", "standard", 9, 2), run_row("a", "fine", 9, 1))
        self.assertIn("| met |", self.row("error against the reference"))
        self.keep("runs.csv", RUNS, run_row("a", "draft", 9, 3), run_row("a", "standard", 9, 1), run_row("a", "fine", 9, 2))
        self.assertIn("**missed**", self.row("error against the reference"))

    def test_an_estimate_below_half_of_the_error_is_missed(self):
        self.keep("runs.csv", RUNS, run_row("a", "standard", 9, 2, 1.1))
        self.assertIn("| met |", self.row("the estimate below half"))
        self.keep("runs.csv", RUNS, run_row("a", "standard", 9, 2, 0.9))
        self.assertIn("**missed**", self.row("the estimate below half"))

    def test_the_budget_is_judged_by_the_true_error_not_by_what_the_program_says(self):
        self.keep("budget.csv", "item,asked_mm,estimated_mm,true_mm,cpu_ms,fine_cpu_ms,met", "a,3,2,5,100,900,1")
        self.assertIn("**missed**", self.row("--max-error 3 |"))

    def test_refused_photos_are_named_and_in_no_mean(self):
        self.keep("fidelity.csv", FIDELITY, "a,vest,OK,0.95,2,0,0.93,0.94,0.8,0.7,0.7,1,0.8,9,9,hem",
                  "b,dress,NO_OUTLINE,,,,,,,,,,,,,")
        self.assertIn("0.950 over 1 items", self.row("real items"))
        page = (self.out / "ACCURACY.md").read_text(encoding="utf-8")
        self.assertIn("Without that pose the mean is 0.930", page)
        self.assertIn("b (NO_OUTLINE)", page)

    def test_a_crash_or_a_position_that_is_no_number_is_a_bug(self):
        for case in ("photo,x,CRASH,,,,,1,9,", "photo,x,OK,1e-3,0,0,0,0,9,", "photo,x,OK,1e-3,0,0.7,0,1,9,"):
            self.keep("extremes.csv", EXTREMES, "photo,y,LOW_CONTRAST,,,,,,9,", case)
            self.assertIn("1 of 2", self.row("extremes:"))

    def test_the_same_tables_give_the_same_bytes_and_check_sees_a_change(self):
        self.keep("extremes.csv", EXTREMES, "k and m,k=1e0 m=1e-4,OK,1e-3,0,0,0.3,1,9,")
        self.keep("machine.json", json.dumps({"date": "2001-02-03"}))
        self.assertEqual(self.report().returncode, 0)
        self.assertEqual(self.report("--check").returncode, 0)
        page = self.out / "ACCURACY.md"
        self.assertIn("2001-02-03", page.read_text(encoding="utf-8"))
        page.write_text(page.read_text(encoding="utf-8") + "by hand\n", encoding="utf-8")
        self.assertEqual(self.report("--check").returncode, 1)

    def test_a_table_without_its_columns_is_named(self):
        self.keep("runs.csv", "item,setting", "a,draft")
        ended = self.report()
        self.assertEqual(ended.returncode, 1)
        self.assertIn("runs.csv lacks the columns", ended.stderr)


if __name__ == "__main__":
    unittest.main()
