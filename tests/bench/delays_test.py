# SPDX-License-Identifier: MIT
"""bench/delays on small roadmaps.

usage: delays_test.py <the program quadrille> <bench/delays>
"""
import csv
import os
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

QUADRILLE, DELAYS = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])


def run(*options, program=QUADRILLE):
    return subprocess.run([DELAYS, "--program", program, *options], capture_output=True, text=True,
                          check=False)


class Delays(unittest.TestCase):
    def test_measures_and_draws(self):
        with tempfile.TemporaryDirectory() as folder:
            table, picture = os.path.join(folder, "a.csv"), os.path.join(folder, "a.svg")
            done = run("--output", table, "--picture", picture, "--seeds", "3", "--vertices", "20",
                       "--agents", "6", "--runs", "4", "--shares", "0.1,0.5")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            with open(table, encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            seeds = {row["seed"] for row in rows}
            self.assertTrue(seeds)
            self.assertEqual(len(rows), len(seeds) * 2 * 3)
            of = {rule: [row for row in rows if row["rule"] == rule]
                  for rule in ("naive", "gated", "coupled")}
            for row in of["gated"] + of["coupled"]:
                self.assertEqual((row["runs"], row["colliding_pairs"]), ("4", "0"))
            self.assertGreater(sum(int(row["colliding_pairs"]) for row in of["naive"]), 0)
            self.assertEqual(sum(int(row["endless_runs"]) for row in of["coupled"]), 0)
            # What is drawn is what was measured: the last point of the first curve.
            late = {share: [float(r["colliding_pairs"]) / 4 for r in of["naive"]
                            if r["share"] == share] for share in ("0.1", "0.5")}
            means = [sum(values) / len(values) for values in late.values()]
            with open(picture, encoding="utf-8") as file:
                svg = file.read()
            xml.etree.ElementTree.fromstring(svg)
            curve = [[float(c) for c in point.split(",")]
                     for point in re.search(r'<polyline points="([^"]*)"', svg)[1].split()]
            self.assertEqual(len(curve), 2)
            # Zero is where the curve of `coupled` is.
            zero = float(re.findall(r'<polyline points="[^ ]*,([\d.]+) ', svg)[2])
            heights = [zero - y for _, y in curve]
            self.assertAlmostEqual(heights[0] * means[1], heights[1] * means[0],
                                   delta=0.2 * max(means))
            self.assertIn("coupled", svg)

    def test_refuses_what_it_cannot_run(self):
        with tempfile.TemporaryDirectory() as folder:
            table = os.path.join(folder, "a.csv")
            for shares in ("0.5", "0.5,0.1", "0.1,2", "0,0.5"):
                self.assertEqual(run("--output", table, "--shares", shares).returncode, 2, shares)
            done = run("--output", table, "--seeds", "1", program="/bin/false")
            self.assertEqual(done.returncode, 1)
            self.assertIn("exit code 1: /bin/false generate", done.stderr)
            self.assertFalse(os.path.exists(table))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
