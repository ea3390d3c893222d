# SPDX-License-Identifier: MIT
"""bench/gaps on tiny instances with rivals that say what they are told to.

usage: gaps_test.py <the program quadrille> <bench/gaps>
"""
import csv
import os
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

QUADRILLE, GAPS = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])

# rival MAP SCENARIO AGENTS SECONDS FOLDER DOES... ; each run leaves a line in a file beside it.
RIVAL = """#!/usr/bin/env python3
import os, sys
grid, scenario, agents, seconds, folder, *does = sys.argv[1:]
assert os.path.exists(grid) and os.path.exists(scenario) and os.path.isdir(folder)
assert int(agents) == 4 and float(seconds) > 0
with open(__file__ + ".runs", "a") as file:
    file.write(seconds + chr(10))
for word in does:
    what, _, value = word.partition(":")
    if what == "print":
        print(value, flush=True)
    elif what == "file":
        with open(os.path.join(folder, "out"), "w") as file:
            file.write(value)
    elif what == "exit":
        sys.exit(int(value))
    elif what == "abort":
        os.abort()
    elif what == "forever":
        while True:
            pass
"""
# Quadrille, but each plan is said to cost one more than it does.
LIAR = """#!/usr/bin/env python3
import json, subprocess, sys
run = subprocess.run([{program!r}] + sys.argv[1:], capture_output=True, text=True)
out = run.stdout
if sys.argv[1] == "solve":
    result = json.loads(out)
    result["cost"] += 1
    out = json.dumps(result)
sys.stdout.write(out)
sys.exit(run.returncode)
"""
# Quadrille, but it goes on for two seconds, or says that it took a lot of memory.
GREEDY = """#!/usr/bin/env python3
import json, subprocess, sys, time
run = subprocess.run([{program!r}] + sys.argv[1:], capture_output=True, text=True)
out = run.stdout
if sys.argv[1] == "solve":
    result = json.loads(out)
    result["statistics"]["peak_rss_mib"] += {mib}
    out = json.dumps(result)
    while time.process_time() < {seconds}:
        pass
sys.stdout.write(out)
sys.exit(run.returncode)
"""
HEAD = ("program,rival,measure,family,scenario,agents,cpu_limit,status,stop_reason,cost,lower_bound,"
        "cpu_s,version,options\n")
# Two limits; the rival is dearer, has none, and once as good.
MEASURED = HEAD + """a,no,sum-of-costs,m,random-1,50,2,feasible,cpu-time,1100,1000,2.0,x,
r,yes,sum-of-costs,m,random-1,50,2,feasible,none,1200,,2.0,,
"r, loss",yes,loss,m,random-1,50,2,feasible,none,900,,2.0,,
a,no,sum-of-costs,m,random-1,50,10,feasible,cpu-time,1050,1024,10.0,x,
r,yes,sum-of-costs,m,random-1,50,10,feasible,none,1050,,10.0,,
"r, loss",yes,loss,m,random-1,50,10,feasible,none,1040,,10.0,,
b,no,sum-of-costs,m,random-1,50,10,feasible,cpu-time,1040,1030,10.0,x,
a,no,sum-of-costs,n,random-2,70,2,unknown,cpu-time,,500,2.0,x,
r,yes,sum-of-costs,n,random-2,70,2,unknown,no plan,,,2.0,,
a,no,sum-of-costs,n,random-2,70,10,feasible,cpu-time,600,500,10.0,x,
r,yes,sum-of-costs,n,random-2,70,10,unknown,signal 6,,,10.0,,
"""


class GapsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        maps, scens = (os.path.join(self.folder, "movingai", part) for part in ("maps", "scens"))
        os.makedirs(maps)
        os.makedirs(scens)
        grid = os.path.join(maps, "tiny.map")
        subprocess.run([QUADRILLE, "generate", "--kind", "random", "--width", "6", "--height", "6",
                        "--seed", "1", "--map-output", grid], check=True)
        for number, agents in ((1, 4), (2, 3)):
            scen = os.path.join(scens, f"tiny-random-{number}.scen")
            subprocess.run([QUADRILLE, "generate", "--map", grid, "--agents", str(agents), "--seed",
                            str(number), "--scen-output", scen], check=True)
        self.families = self.write("families.txt", "grid tiny 2 3 4\nscale tiny* 4\n")
        self.csv = os.path.join(self.folder, "out.csv")
        self.rival = self.executable("rival", RIVAL)

    def write(self, name, content):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(content)
        return path

    def executable(self, name, content):
        path = self.write(name, content)
        os.chmod(path, 0o755)
        return path

    def gaps(self, *arguments, does=None, program=f"q={QUADRILLE}"):
        """Runs bench/gaps with one program and, if it `does` something, one rival."""
        command = [sys.executable, GAPS, "--data", self.folder, "--families", self.families,
                   "--output", self.csv, "--limits", "1"]
        if program:
            command += ["--program", program]
        if does is not None:
            words = " ".join(f"'{word}'" for word in does)
            command += ["--rival", f"r={self.rival} {{map}} {{scenario}} {{agents}} {{seconds}} "
                        f"{{folder}} {words}", "--rival-cost", r"r=^cost (\S+)$"]
        return subprocess.run(command + list(arguments), capture_output=True, text=True, check=False)

    def rows(self):
        with open(self.csv, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def runs(self):
        with open(self.rival + ".runs", encoding="utf-8") as file:
            return file.read().split()

    def rival_row(self):
        return next(row for row in self.rows() if row["program"] == "r")

    def test_rows_are_written_once(self):
        does = ["print:cost 5000", "print:loss 4000"]
        more = ["--limits", "1,2.5", "--rival-cost", r"r:sum of loss=^loss (\S+)$"]
        done = self.gaps(*more, does=does)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = self.rows()
        self.assertEqual([(row["program"], row["cpu_limit"]) for row in rows],
                         [("q", "1"), ("r", "1"), ("r, sum of loss", "1"), ("r", "2.5"),
                          ("r, sum of loss", "2.5"), ("q", "2.5")])
        self.assertEqual({(row["status"], row["lower_bound"] == row["cost"]) for row in rows
                          if row["program"] == "q"}, {("optimal", True)})
        self.assertEqual([row["cost"] for row in rows if row["rival"] == "yes"],
                         ["5000", "4000"] * 2)
        self.assertEqual(self.runs(), ["1", "2.5"])
        self.assertNotIn(self.folder, "".join(row["options"] for row in rows))

        # Without its last two rows the file is completed; the rival runs again for its second reading.
        with open(self.csv, encoding="utf-8") as file:
            lines = file.readlines()
        self.write("out.csv", "".join(lines[:-2]))
        self.assertEqual(self.gaps(*more, does=does).returncode, 0)
        self.assertEqual(len(self.rows()), 6)
        self.assertEqual(self.runs(), ["1", "2.5", "2.5"])
        again = self.gaps(*more, does=does)
        self.assertEqual((again.returncode, again.stderr), (0, ""))
        self.assertEqual(self.runs(), ["1", "2.5", "2.5"])

        # Another program beside the rows of the rivals, which stay.
        self.assertEqual(self.gaps(program=f"after={QUADRILLE}").returncode, 0)
        self.assertEqual([row["program"] for row in self.rows()][6:], ["after"])
        self.assertEqual(self.runs(), ["1", "2.5", "2.5"])

    def test_the_last_cost_counts_and_files_come_after_the_output(self):
        self.assertEqual(self.gaps(does=["print:cost 7000", "print:cost 6000"]).returncode, 0)
        self.assertEqual(self.rival_row()["cost"], "6000")
        os.remove(self.csv)
        self.assertEqual(self.gaps(does=["file:cost 5000", "print:cost 7000"]).returncode, 0)
        self.assertEqual(self.rival_row()["cost"], "5000")

    def test_a_plan_below_the_bound_is_a_contradiction(self):
        self.assertEqual(self.gaps().returncode, 0)
        optimum = int(self.rows()[0]["cost"])
        # As cheap as the bound is no contradiction, nor is another sum below it.
        self.assertEqual(self.gaps("--rival-cost", r"r:loss=^loss (\S+)$", does=[
            f"print:cost {optimum}", "print:loss 1"]).returncode, 0)
        for _ in range(2):  # The row stays, and is found again.
            done = self.gaps("--limits", "2", does=[f"print:cost {optimum - 1}"])
            self.assertEqual(done.returncode, 1)
            self.assertIn("WRONG BOUND", done.stderr)
            self.assertEqual(sum(row["cost"] == str(optimum - 1) for row in self.rows()), 1)

    def test_rivals_without_a_plan(self):
        self.assertEqual(self.gaps(does=["print:nothing"]).returncode, 0)
        self.assertEqual([self.rival_row()[c] for c in ("status", "cost", "stop_reason")],
                         ["unknown", "", "no plan"])
        os.remove(self.csv)
        self.assertEqual(self.gaps(does=["print:cost 5000", "abort"]).returncode, 0)
        self.assertEqual([self.rival_row()[c] for c in ("cost", "stop_reason")], ["", "signal 6"])
        os.remove(self.csv)
        # A wrong command is not a rival without a plan.
        done = self.gaps(does=["print:unknown option", "exit:2"])
        self.assertEqual(done.returncode, 1)
        self.assertIn("unknown option", done.stderr)
        self.assertFalse([row for row in self.rows() if row["rival"] == "yes"])

    def test_rivals_are_ended_at_the_limit(self):
        done = self.gaps("--limits", "0.1", does=["print:cost 5000", "forever"])
        self.assertEqual(done.returncode, 0, done.stderr)
        row = self.rival_row()
        self.assertEqual([row["cost"], row["stop_reason"]], ["", "limit"])
        self.assertLess(float(row["cpu_s"]), 4.5)

    def test_plans_of_quadrille_are_replayed(self):
        liar = self.executable("liar", LIAR.format(program=QUADRILLE))
        done = self.gaps("--verifier", QUADRILLE, program=f"q={liar}")
        self.assertEqual(done.returncode, 1)
        self.assertIn("WRONG COST", done.stderr)

    def test_quadrille_keeps_its_limits(self):
        for mib, seconds, code in ((0, 0, 0), (200, 0, 1), (0, 1.7, 1)):
            greedy = self.executable(
                "greedy", GREEDY.format(program=QUADRILLE, mib=mib, seconds=seconds))
            done = self.gaps("--limits", "0.5", "--memory-limit", "100", "--verifier", QUADRILLE,
                             program=f"q{mib}-{seconds}={greedy}")
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(" MiB: " if mib else "of CPU time: " if seconds else "", done.stderr)

    def test_scenarios_that_are_not_there_are_left_out(self):
        done = self.gaps("--scenarios", "1,2,3")
        self.assertEqual(done.returncode, 0)
        self.assertEqual([row["scenario"] for row in self.rows()], ["random-1"])
        self.assertEqual(re.findall("left out: tiny, (random-.)", done.stderr),
                         ["random-2", "random-3"])
        self.assertEqual(self.gaps("--maps", "tiny:5").returncode, 1)

    def test_tables(self):
        self.write("out.csv", MEASURED)
        done = self.gaps("--report-only", "--limits", "2,10", "--scenarios", "1,2", program=None)
        self.assertEqual(done.returncode, 0, done.stderr)
        first, second = done.stdout.split("CPU limit 10 s")
        self.assertIn("| m, 50 | **1100** | 1000 | 10.00 | - | - | - | 1200 | 900 |", first)
        self.assertIn("| n, 70, random-2 | none | 500 | - | - | - | - | none | - |", first)
        self.assertIn("| m, 50 | 1050 | 1024 | 2.54 | **1040** | 1030 | 0.97 | 1050 | 1040 |", second)
        self.assertIn("| n, 70, random-2 | **600** | 500 | 20.00 | - | - | - | failed | - |", second)
        self.assertIn("- a beside r: cheaper on 1, equal on 1, dearer on 0 of 2 rows", second)
        self.assertIn("- a beside r, loss: cheaper on 0, equal on 0, dearer on 1 of 1 rows", second)
        # A program and a part of the rows.
        done = self.gaps("--report-only", "--limits", "10", program="b=x")
        self.assertIn("| m, 50 | **1040** | 1030 | 0.97 | 1050 | 1040 |", done.stdout)
        self.assertNotIn("n, 70", done.stdout)

    def test_picture(self):
        self.write("out.csv", MEASURED)
        picture = os.path.join(self.folder, "gaps.svg")
        done = self.gaps("--report-only", "--limits", "2,10", "--scenarios", "1,2", "--picture",
                         picture, program="a=x")
        self.assertEqual(done.returncode, 0, done.stderr)
        root = xml.etree.ElementTree.parse(picture).getroot()
        space = "{http://www.w3.org/2000/svg}"
        texts = [node.text for node in root.iter(f"{space}text")]
        for title in ("m, 50 agents", "n, 70 agents, random-2", "a", "r", "a, best bound"):
            self.assertIn(title, texts)
        curves = [[tuple(map(float, point.split(","))) for point in node.get("points").split()]
                  for node in root.iter(f"{space}polyline")]
        # a to its own bound, a to its best bound, r to a's best bound; then the same of the other map.
        own, best, rival = curves[:3]
        self.assertEqual([len(curve) for curve in curves[:3]], [2, 2, 2])
        self.assertEqual([x for x, _ in own], [x for x, _ in rival])
        # At 10 s all have the same plan and bound; at 2 s, a's bound was lower, and r's plan dearer.
        self.assertEqual(own[1], best[1])
        self.assertEqual(own[1], rival[1])
        self.assertLess(own[0][1], best[0][1])
        self.assertLess(rival[0][1], own[0][1])
        # Of the other map there is one plan, at 10 s: four hollow markers at the edge, and no curve.
        self.assertEqual(len(curves), 3)
        frame = next(node for node in root.iter(f"{space}rect") if node.get("fill") == "none")
        edge = float(frame.get("y"))
        self.assertEqual(sum(float(node.get("cy")) == edge for node in root.iter(f"{space}circle")), 2)
        done = self.gaps("--report-only", "--limits", "2", "--picture", picture, program="a=x")
        self.assertEqual(done.returncode, 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
