# SPDX-License-Identifier: MIT
"""bench/suite on tiny instances: its figures, its resumption, and that it notices wrong answers.

usage: suite_test.py <the program quadrille> <bench/suite>
"""
import csv
import os
import subprocess
import sys
import tempfile
import unittest

QUADRILLE, SUITE = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])

FAMILIES = """# Tiny ones.
grid tiny 3 4 5
roadmap square:2 1 2 3
scale tiny* 6
"""
GRID = ("<root><map><width>4</width><height>4</height><grid>"
        + "<row>0 0 0 0</row>" * 4 + "</grid></map></root>")
TASK = ('<root><agent id="0" start_i="0" start_j="0" goal_i="3" goal_j="3"/>'
        '<agent id="1" start_i="3" start_j="0" goal_i="0" goal_j="3"/>'
        '<agent id="2" start_i="0" start_j="3" goal_i="3" goal_j="0"/></root>')
# Runs the program and changes one thing in its answer: a liar.
LIAR = """#!/usr/bin/env python3
import json, subprocess, sys
run = subprocess.run([{program!r}] + sys.argv[1:], capture_output=True, text=True)
out = run.stdout
if sys.argv[1] == "solve":
    result = json.loads(out)
    lie = {lie!r}
    if lie == "plan":
        path = sys.argv[sys.argv.index("--plan") + 1]
        plan = json.load(open(path))
        plan["plan"][0] = plan["plan"][0][:1]
        json.dump(plan, open(path, "w"))
    elif lie == "no optimum" and result["status"] == "optimal":
        # A bound above the optimum, in an answer that does not claim to be optimal.
        result["status"], result["lower_bound"] = "feasible", result["cost"] + 1
        run.returncode = 10
    out = json.dumps(result)
sys.stdout.write(out)
sys.exit(run.returncode)
"""


class SuiteTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        maps, scens, square = (os.path.join(self.folder, *part) for part in (
            ("movingai", "maps"), ("movingai", "scens"), ("mapf_r", "square")))
        for path in (maps, scens, square):
            os.makedirs(path)
        self.map = os.path.join(maps, "tiny.map")
        subprocess.run([QUADRILLE, "generate", "--kind", "random", "--width", "6", "--height", "6",
                        "--seed", "1", "--map-output", self.map], check=True)
        for number in range(1, 6):
            scen = os.path.join(scens, f"tiny-random-{number}.scen")
            subprocess.run([QUADRILLE, "generate", "--map", self.map, "--agents", "6", "--seed",
                            str(number), "--scen-output", scen], check=True)
            self.write(os.path.join(square, f"task_{number}.xml"), TASK)
        self.write(os.path.join(square, "map.xml"), GRID)
        self.families = os.path.join(self.folder, "families.txt")
        self.write(self.families, FAMILIES)
        self.csv = os.path.join(self.folder, "out.csv")

    @staticmethod
    def write(path, content):
        with open(path, "w", encoding="utf-8") as file:
            file.write(content)

    def suite(self, *arguments, programs=None):
        programs = programs or [f"a={QUADRILLE}", f"b={QUADRILLE} --seed 1"]
        return subprocess.run(
            [sys.executable, SUITE, "--data", self.folder, "--families", self.families, "--output",
             self.csv] + [word for program in programs for word in ("--program", program)]
            + list(arguments), capture_output=True, text=True, check=False)

    def rows(self):
        with open(self.csv, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def liar(self, lie):
        path = os.path.join(self.folder, "liar")
        self.write(path, LIAR.format(program=QUADRILLE, lie=lie))
        os.chmod(path, 0o755)
        return path

    def reference(self, change):
        """A table of other solvers, wrong by `change`, of what has been solved so far."""
        os.makedirs(os.path.join(self.folder, "reference"), exist_ok=True)
        lines = ["map,random_scen,agents,optimal_sum_of_costs"]
        lines += [f"{row['family']},{row['scenario'][7:]},{row['agents']},{int(row['cost']) + change}"
                  for row in self.rows() if row["kind"] == "grid" and row["program"] == "a"]
        self.write(os.path.join(self.folder, "reference", "discrete_sum_of_costs.csv"),
                   "\n".join(lines) + "\n")

    def test_daily_sample_runs_pair_by_pair_and_resumes(self):
        done = self.suite("--daily")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = self.rows()
        # Two instances of each of two families, and the large one, by two programs.
        self.assertEqual(len(rows), 10)
        self.assertEqual({row["status"] for row in rows}, {"optimal"})
        for first, second in zip(rows[::2], rows[1::2]):
            self.assertEqual({first["program"], second["program"]}, {"a", "b"})
            self.assertEqual(*([r["family"], r["scenario"], r["agents"], r["cost"]]
                               for r in (first, second)))
        self.assertEqual([row["program"] for row in rows[:4]], ["a", "b", "b", "a"])
        self.assertIn("| **all of grid** | 2 | 2 | 2 |", done.stdout)
        self.assertIn("| **all** | 4 | 4 | 4 |", done.stdout)

        # Without its last three rows the file is completed; then there is nothing left to do.
        with open(self.csv, encoding="utf-8") as file:
            lines = file.readlines()
        self.write(self.csv, "".join(lines[:-3]))
        resumed = self.suite("--daily")
        self.assertEqual(resumed.returncode, 0, resumed.stderr)
        self.assertEqual(resumed.stderr.count(" optimal "), 3)
        self.assertEqual(self.suite("--daily").stderr, "")

    def test_the_whole_has_all_scenarios_and_rungs(self):
        done = self.suite("--whole", programs=[f"a={QUADRILLE}"])
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = self.rows()
        self.assertEqual(len(rows), 2 * 5 * 3 + 1)
        self.assertEqual(len({(r["kind"], r["family"], r["scenario"], r["agents"]) for r in rows}), 31)

    def test_wrong_plans_are_noticed(self):
        done = self.suite("--daily", "--verifier", QUADRILLE, programs=[f"a={self.liar('plan')}"])
        self.assertEqual(done.returncode, 1)
        self.assertIn("WRONG PLAN", done.stderr)

    def test_bounds_above_the_optimum_are_noticed(self):
        done = self.suite("--daily", "--kinds", "grid",
                          programs=[f"a={QUADRILLE}", f"b={self.liar('no optimum')}"])
        self.assertEqual(done.returncode, 1)
        self.assertIn("WRONG BOUND", done.stderr)

    def test_costs_are_those_of_the_reference(self):
        self.assertEqual(self.suite("--daily").returncode, 0)
        self.reference(0)
        os.remove(self.csv)
        self.assertEqual(self.suite("--daily", "--reference").returncode, 0)
        self.reference(1)
        done = self.suite("--daily", "--reference")
        self.assertEqual(done.returncode, 1)
        self.assertIn("WRONG ANSWER", done.stderr)

    def test_figures(self):
        # Two instances by two programs: one solved by both, one by the second only.
        table = ("program,kind,family,scenario,agents,cpu_limit,status,stop_reason,cost,lower_bound,"
                 "cpu_s,conflicts,cores,peak_rss_mib,version,options\n"
                 "a,grid,m,random-1,5,10,optimal,none,7,7,2.0,0,0,1,x,\n"
                 "b,grid,m,random-1,5,10,optimal,none,7,7,0.5,3,0,1,x,\n"
                 "a,grid,m,random-2,5,10,feasible,cpu-time,11,10,10.1,0,0,1,x,\n"
                 "b,grid,m,random-2,5,10,optimal,none,10,10,4.0,0,0,1,x,\n")
        self.write(self.csv, table)
        done = self.suite("--report-only", programs=["a=x", "b=x"])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("| grid m | 2 | 1 | 2 | 11.00 | 2.25 | 0.25 (1) |", done.stdout)
        self.assertIn("b needs as many conflicts as a on 0 of 1 instances", done.stdout)
        self.assertIn("| grid m, random-2 | 5 | 11 | 10 | 10 | 10 | 10.00 | 0.00 |", done.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
