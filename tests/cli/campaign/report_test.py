# SPDX-License-Identifier: MIT
"""The numbers and figures of a campaign's report.

usage: report_test.py <the program quadrille>
"""
import json
import os
import re
import sys
import unittest
import xml.etree.ElementTree

from support import CampaignCase

CampaignCase.program = os.path.abspath(sys.argv[1])
SVG = "{http://www.w3.org/2000/svg}"


class Reports(CampaignCase):
    def set_rows(self, change):
        rows = [json.loads(line) for line in self.lines()]
        for row in rows:
            change(row)
        self.write("m.campaign/results.jsonl", "".join(json.dumps(row) + "\n" for row in rows))

    def tables(self):
        """The cells of each table, row by row, without the heads."""
        text = self.read("m.campaign/merged/report.html")
        return [[re.findall(r"<td[^>]*>(.*?)</td>", row) for row in re.findall("<tr>.*?</tr>", body)]
                for body in re.findall("<tbody>(.*?)</tbody>", text, re.DOTALL)]

    def figure(self, title):
        text = self.read("m.campaign/merged/report.html")
        for svg in re.findall(r"<svg.*?</svg>", text, re.DOTALL):
            root = xml.etree.ElementTree.fromstring(svg)
            if root.find(SVG + "title").text == title:
                return root
        raise AssertionError(f"no figure {title}")

    def test_systems_are_compared_on_what_all_of_them_ran(self):
        # One gets to 7 agents on each scenario, the other one only to 4.
        systems = (self.fake("table:1:9,2:9") + "\n  "
                   + self.fake("table:1:1,2:1").replace("fake:", "weak:"))
        manifest = self.manifest("1:7:3", systems=systems)
        self.campaign("run", manifest, "--jobs", "2")
        jobs = self.jobs(manifest)
        # The limit is 20 s, and what is not solved counts as 40 s.
        self.set_rows(lambda row: row.update(
            process_cpu_s=8.0 if jobs[row["job"]][2] == 7 else 2.0))
        self.campaign("merge", manifest)
        systems, maps = self.tables()
        self.assertEqual([(row[0], row[1], row[7]) for row in systems],
                         [("fake", "12", "2.00"), ("weak", "8", "21.00")])
        self.assertIn("over the 8 runs", self.read("m.campaign/merged/report.html"))
        self.assertEqual([row[:2] + row[5:] for row in maps],
                         [["alpha", "fake", "2.00", "4"], ["", "weak", "21.00", "4"],
                          ["beta", "fake", "2.00", "4"], ["", "weak", "21.00", "4"]])

    def test_solvers_of_the_reference_are_in_the_cactus_plot(self):
        self.write("data/reference.csv", "map,scenario,agents,other_cpu_s,<b>_cpu_s\n"
                   "alpha,random-1,2,0.5,1\nalpha,random-2,2,1.5,>30\nbeta,random-1,2,,\n"
                   "elsewhere,random-1,2,7,7\n")
        manifest = self.manifest("2", more="reference: reference.csv\n")
        self.campaign("run", manifest)
        self.campaign("merge", manifest)
        figure = self.figure("instances solved within a time")
        names = [text.text for text in figure.findall(SVG + "text")]
        self.assertEqual(names[-3:], ["dpll", "other (reference)", "<b> (reference)"])
        curves = [curve.get("points").split() for curve in figure.findall(SVG + "polyline")]
        self.assertEqual([len(curve) for curve in curves], [4, 2, 1])
        self.assertIn(["", "other (reference)", "", "", "2 (0.50 s)", "", ""], self.tables()[1])

    def test_the_gap_over_time_is_in_the_clock_of_the_limit(self):
        for limits, clock, label in (("cpu: 20", "cpu", "CPU seconds"),
                                     ("wall: 20", "wall", "seconds by the clock on the wall")):
            manifest = self.manifest("6", limits=limits)
            self.campaign("run", manifest)
            for row in self.rows().values():
                if row["history_clock"] == clock:
                    used = row["statistics"][clock + "_s"]
                    self.assertAlmostEqual(row["history"][-1][0], used, delta=0.05 + used)
            self.campaign("merge", manifest)
            self.assertIn(label, [text.text for text in self.figure("dpll").findall(SVG + "text")])
            self.assertEqual({row["history_clock"] for row in self.rows().values()
                              if row["job"] in self.jobs(manifest)}, {clock})
            os.remove(self.path("m.campaign/results.jsonl"))

    def test_histories_of_older_versions_are_in_their_clock(self):
        manifest = self.manifest("6")
        self.campaign("run", manifest)
        self.set_rows(lambda row: row.pop("history_clock"))
        self.campaign("merge", manifest)
        words = [text.text for text in self.figure("dpll").findall(SVG + "text")]
        self.assertIn("seconds by the clock on the wall", words)
        self.assertIn("per cent of 4 runs", words)

    def test_long_names_are_broken_and_not_cut_off(self):
        name = "a-system-with-a-name-that-says-all-of-its-options, " * 2 + "x" * 90
        manifest = self.manifest("2", systems=f"dpll: ''\n  '{name}': --seed 0".replace(" --seed 0", " --audit"))
        self.campaign("run", manifest)
        self.campaign("merge", manifest)
        texts = [text.text for text in self.figure("alpha").findall(SVG + "text")]
        self.assertIn(name, "".join(texts))
        self.assertTrue(all(len(text) < 45 for text in texts), texts)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
