# SPDX-License-Identifier: MIT
"""quadrille campaign with goals that agents share: instances of their own, compared with nothing
else, in all tables.

usage: sharing_test.py <the program quadrille>
"""
import os
import sys
import unittest

from support import CampaignCase

CampaignCase.program = os.path.abspath(sys.argv[1])


class Sharing(CampaignCase):
    def sharing(self, values, more=""):
        return self.write("m.yaml", f"""data: data
instances:
  - {{maps: alpha.map, scenarios: "{{map}}-random-*.scen", agents: "2,4,6"}}
  - {{maps: alpha.map, scenarios: "{{map}}-random-*.scen", agents: "2,4,6", share-goals: {values}}}
stop: never
systems:
  dpll: ""
  mdd: --system mdd-sat
limits: {{cpu: 20}}
{more}""")

    def test_each_way_to_share_is_an_instance_of_its_own(self):
        manifest = self.sharing("[all, 2]")
        self.assertIn("alpha, goals shared by each 2", self.campaign("list", manifest))
        self.campaign("run", manifest, "--jobs", "2")
        self.campaign("merge", manifest)
        table = self.table()
        self.assertEqual(len(table), 3 * 2 * 3 * 2)
        costs = {}
        for row in table:
            self.assertEqual(row["status"], "optimal")
            key = row["scenario"], row["agents"], row["share_goals"]
            self.assertEqual(costs.setdefault(key, row["cost"]), row["cost"])
            self.assertEqual("--share-goals" in row["options"], False)  # of the instance
        self.assertEqual({key[2] for key in costs}, {"", "2", "all"})
        fewer = 0
        for (scenario, agents, shared), cost in costs.items():
            if shared == "all":
                pairs, alone = costs[scenario, agents, "2"], costs[scenario, agents, ""]
                self.assertLessEqual(int(cost), int(pairs))
                self.assertLessEqual(int(pairs), int(alone))
                fewer += int(cost) < int(alone)
        self.assertGreater(fewer, 0)
        report = self.read("m.campaign/merged/report.html")
        self.assertIn("alpha, goals shared by all", report)
        # That is another problem than the tracker's.
        self.assertEqual(self.read("m.campaign/merged/tracker.csv").count("alpha,random,"), 6)

    def test_more_agents_may_cost_less(self):
        """They bring more goals: that is no contradiction."""
        self.write("data/line.map", "type octile\nheight 1\nwidth 9\nmap\n.........\n")
        rows = "".join(f"0\tline.map\t9\t1\t{start}\t0\t{goal}\t0\t1\n"
                       for start, goal in ((0, 8), (7, 1)))
        self.write("data/line-random-1.scen", "version 1\n" + rows)
        manifest = self.write("m.yaml", """data: data
instances: [{maps: line.map, scenarios: "{map}-*.scen", agents: "1,2", share-goals: all}]
stop: never
""")
        self.campaign("run", manifest)
        self.assertIn("no contradictions", self.campaign("merge", manifest))
        self.assertEqual([row["cost"] for row in self.table()], ["8", "2"])

    def test_the_reference_says_who_shares(self):
        head = "map,scenario,share_goals,agents,cost,other_cpu_s\n"
        self.write("data/reference.csv", head + "alpha,random-1,all,4,0,0.25\n")
        manifest = self.sharing("all", more="reference: reference.csv\n")
        self.campaign("run", manifest, "--jobs", "2")
        out = self.campaign("merge", manifest, code=1)
        self.assertIn("goals shared by all", out)
        self.assertNotIn("alpha random-1, 4 agents", out)
        self.write("data/reference.csv", head + "alpha,random-1,7,4,0,0.25\n")
        self.campaign("merge", manifest)
        # Beside the manifest, wherever the data is.
        self.write("beside.csv", head + "alpha,random-1,all,4,0,0.25\n")
        manifest = self.sharing("all", more="reference: ./beside.csv\n")
        self.campaign("run", manifest)
        self.campaign("merge", manifest, code=1)

    def test_options_of_instances_make_others(self):
        self.write("data/reference.csv", "map,scenario,variant,agents,cost\nalpha,random-1,,4,1\n")
        manifest = self.write("m.yaml", """data: data
reference: reference.csv
instances:
  - {maps: alpha.map, scenarios: "{map}-random-*.scen", agents: "4", options: --leave}
  - {maps: alpha.map, scenarios: "{map}-random-*.scen", agents: "4", options: --robust 1}
""")
        self.assertIn("alpha --robust 1", self.campaign("list", manifest))
        self.campaign("run", manifest, "--jobs", "2")
        self.campaign("merge", manifest)  # The reference is about neither.
        costs = {(row["variant"], row["scenario"]): int(row["cost"]) for row in self.table()}
        self.assertEqual(len(costs), 4)
        for (variant, scenario), cost in costs.items():
            if variant == "--leave":
                self.assertLessEqual(cost, costs["--robust 1", scenario])
        self.assertIn("alpha --leave", self.read("m.campaign/merged/report.html"))
        self.assertEqual(self.read("m.campaign/merged/tracker.csv").count("alpha,random,"), 0)
        self.write("data/reference.csv",
                   "map,scenario,variant,agents,cost\nalpha,random-1,--leave,4,1\n")
        self.campaign("run", manifest)
        self.campaign("merge", manifest, code=1)

    def test_what_is_wrong_is_named_with_its_line(self):
        for values, message in (
                ("some", "share-goals has to be all, or a whole number from 1 on"),
                ("0", "share-goals has to be all, or a whole number from 1 on"),
                ("[2, 2]", "share-goals has the same value twice")):
            out = self.campaign("list", self.sharing(values), code=65)
            self.assertIn("m.yaml:4: " + message, out)
        self.write("data/one.json", "{}")
        manifest = self.write("m.yaml", "instances:\n  - {files: data/one.json, share-goals: all}\n")
        self.assertIn("m.yaml:2: the goals of files are in the files",
                      self.campaign("list", manifest, code=65))
        manifest = self.manifest(systems="dpll: --share-goals all")
        self.assertIn("the option --share-goals is the campaign's own",
                      self.campaign("list", manifest, code=65))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
