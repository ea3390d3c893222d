# SPDX-License-Identifier: MIT
"""quadrille campaign where files are damaged, changed or cannot be written: what is wrong is named
with file and line, and the exit code says of what kind it is.

usage: trust_test.py <the program quadrille>
"""
import json
import os
import random
import sys
import unittest

from support import CampaignCase

CampaignCase.program = os.path.abspath(sys.argv[1])

# What a value may be replaced by.
STRANGE = [None, -1, 1e300, 2 ** 70, "x", "", [], {}, [[]], [None], ["x"], [[1, 2, 3, 4]], True]


def places(value, path=()):
    """The paths of all values inside a JSON value."""
    items = ()
    if isinstance(value, dict):
        items = value.items()
    elif isinstance(value, list):
        items = enumerate(value)
    for key, inner in items:
        yield path + (key,)
        yield from places(inner, path + (key,))


def replaced(value, path, strange):
    if not path:
        return strange
    copy = dict(value) if isinstance(value, dict) else list(value)
    copy[path[0]] = replaced(value[path[0]], path[1:], strange)
    return copy


class Folders(CampaignCase):
    def test_a_folder_that_cannot_be_written_is_an_output(self):
        manifest = self.manifest("1")
        self.write("file", "")
        for action in ("run", "submit"):
            out = self.campaign(action, manifest, "--folder", self.path("file/results"), code=74)
            self.assertIn("file/results: the folder cannot be made: Not a directory", out)
        os.mkdir(self.path("taken.campaign"))
        os.mkdir(self.path("taken.campaign/jobs.json"))
        out = self.campaign("run", manifest, "--folder", self.path("taken.campaign"), code=74)
        self.assertIn("jobs.json: cannot write: Is a directory", out)

    def test_results_and_tables_that_cannot_be_written_are_outputs(self):
        manifest = self.manifest("1")
        self.campaign("run", manifest)
        self.write("m.campaign/merged", "")
        self.assertIn("m.campaign/merged: the folder cannot be made",
                      self.campaign("merge", manifest, code=74))
        os.remove(self.path("m.campaign/merged"))
        self.campaign("merge", manifest)
        os.rename(self.path("m.campaign/results.jsonl"), self.path("kept"))
        os.mkdir(self.path("m.campaign/results.jsonl"))
        for action in ("run", "resume", "status", "merge", "reopen"):
            self.assertIn("results.jsonl: cannot open: Is a directory",
                          self.campaign(action, manifest, code=74))


class Damage(CampaignCase):
    def write_results(self, lines):
        self.write("m.campaign/results.jsonl", "".join(line + "\n" for line in lines))

    def test_damaged_rows_are_named_with_their_line(self):
        manifest = self.manifest("2,5")
        self.campaign("run", manifest)
        good = self.lines()
        for damage in (lambda line: line[:40], lambda line: line.replace('"status"', '"state"'),
                       lambda line: json.dumps({**json.loads(line), "plan": [7]}),
                       lambda line: json.dumps({**json.loads(line), "history": [["x"]]}),
                       lambda line: json.dumps({**json.loads(line), "status": "odd"})):
            self.write_results(good[:2] + [damage(good[2])] + good[3:])
            out = self.campaign("merge", manifest, code=65)
            self.assertIn("m.campaign/results.jsonl:3: not a row: ", out)
            self.assertFalse(os.path.exists(self.path("m.campaign/merged")))
            self.assertIn("results.jsonl:3: ", self.campaign("status", manifest, code=30))
        # Once its job has a row, the line has nothing to say any more; it is still named.
        self.assertIn("results.jsonl:3: ", self.campaign("run", manifest))
        self.assertIn("results.jsonl:3: ", self.campaign("merge", manifest))

    def test_no_row_however_strange_is_more_than_the_program_can_take(self):
        manifest = self.manifest("2", more="seeds: 0\n")
        self.campaign("run", manifest)
        good = self.lines()
        rows = [json.loads(line) for line in good]
        numbers = random.Random(20261126)
        for _ in range(120):
            number = numbers.randrange(len(rows))
            path = numbers.choice(list(places(rows[number])))
            strange = json.dumps(replaced(rows[number], path, numbers.choice(STRANGE)))
            with self.subTest(path=path, row=strange[:300]):
                self.write_results(good[:number] + [strange] + good[number + 1:])
                for action in ("status", "merge"):
                    process = self.start("campaign", action, manifest)
                    out, err = process.communicate()
                    # Contradictions, bad input, or a job to be run again; or the change did not matter.
                    self.assertIn(process.returncode, (0, 1, 30, 65), out + err)

    def test_damaged_lists_of_jobs_are_named_with_their_line(self):
        manifest = self.manifest("2,5")
        self.campaign("run", manifest)
        good = self.read("m.campaign/jobs.json")
        line = 1 + good[:good.index('"job":')].count("\n")
        for old, new, message in (('"job":"', '"job":"x', "16 hexadecimal digits"),
                                  ('"objective":"sum', '"objective":"some', "the objective is none"),
                                  ('"agents":2', '"agents":-2', "the number of agents is none"),
                                  ('"agents":2', '"agents":2.5', "2.5 is no whole number"),
                                  ('"seed":0', '"seed":1e300', "1e+300 is no whole number"),
                                  ('"agents":2', '"agents":', "not valid JSON")):
            self.assertIn(old, good)
            self.write("m.campaign/jobs.json", good.replace(old, new, 1))
            for action in ("resume", "status", "merge", "reopen"):
                out = self.campaign(action, manifest, code=65)
                self.assertIn(f"m.campaign/jobs.json:{line}: ", out)
                self.assertIn(message, out)

    def test_no_list_of_jobs_however_strange_is_more_than_the_program_can_take(self):
        manifest = self.manifest("2")
        self.campaign("run", manifest)
        good = json.loads(self.read("m.campaign/jobs.json"))
        numbers = random.Random(20261127)
        for _ in range(150):
            path = numbers.choice(list(places(good)))
            strange = replaced(good, path, numbers.choice(STRANGE))
            with self.subTest(path=path):
                self.write("m.campaign/jobs.json", json.dumps(strange, indent=1))
                process = self.start("campaign", "status", manifest)
                out, err = process.communicate()
                self.assertIn(process.returncode, (0, 30, 65), out + err)
                if process.returncode == 65:
                    self.assertRegex(err, r"jobs\.json:[1-9][0-9]*: ")


class Changes(CampaignCase):
    def test_resume_names_the_input_that_has_changed(self):
        manifest = self.manifest("2,5", more="\n")
        self.campaign("run", manifest)
        for name, text in (("data/alpha.map", "\n"), ("data/beta-random-2.scen", "\n"),
                           ("m.yaml", "# more\n")):
            good = self.read(name)
            self.write(name, good + text)
            out = self.campaign("resume", manifest, code=65)
            self.assertIn(f"{self.path(name)}: the file has changed since the jobs were made", out)
            if name != "m.yaml":
                self.assertIn(self.path(name), self.campaign("merge", manifest, code=65))
            os.remove(self.path(name))
            self.assertIn(f"{self.path(name)}: cannot be opened",
                          self.campaign("resume", manifest, code=65))
            self.write(name, good)
            self.campaign("resume", manifest)
        self.campaign("merge", manifest)

    def test_all_kinds_of_inputs_are_known(self):
        self.quadrille("generate", "--kind", "roadmap", "--vertices", "12", "--agents", "2",
                       "--instance-output", self.path("data/discs.json"))
        grid = "<row>0 0</row>" * 2
        self.write("data/map.xml", "<root><map><width>2</width><height>2</height>"
                   f"<grid>{grid}</grid></map></root>")
        self.write("data/task.xml", '<root><agent start_i="0" start_j="0" goal_i="1" goal_j="1"/></root>')
        manifest = self.write("m.yaml", """data: data
instances:
  - {roadmaps: map.xml, tasks: task.xml}
  - {files: discs.json}
""")
        self.campaign("run", manifest)
        for name in ("data/map.xml", "data/task.xml", "data/discs.json"):
            good = self.read(name)
            self.write(name, good + " ")
            self.assertIn(f"{self.path(name)}: the file has changed",
                          self.campaign("resume", manifest, code=65))
            self.write(name, good)

    def test_the_hash_of_a_content_is_always_the_same(self):
        self.write("data/one.map", "type octile\nheight 1\nwidth 2\nmap\n..\n")
        self.write("data/one-random-1.scen", "version 1\n0\tone.map\t2\t1\t0\t0\t1\t0\t1\n")
        manifest = self.write("m.yaml", 'data: data\ninstances: [{maps: one.map, '
                              'scenarios: "{map}-*.scen", agents: [1]}]\n')
        self.campaign("run", manifest)
        jobs = json.loads(self.read("m.campaign/jobs.json"))
        # If this fails, campaigns of users take their inputs for changed.
        self.assertEqual([item["hash"] for item in jobs["inputs"]],
                         ["213988cd980ae3d9", "c0f5acb8fecf43a0"])

    def test_folders_of_older_versions_are_read(self):
        manifest = self.manifest("2,5")
        self.campaign("run", manifest)
        jobs = json.loads(self.read("m.campaign/jobs.json"))
        del jobs["inputs"], jobs["manifest"]
        self.write("m.campaign/jobs.json", json.dumps(jobs))
        rows = [json.loads(line) for line in self.lines()]
        for row in rows:
            del row["history_clock"]
        self.write("m.campaign/results.jsonl", "".join(json.dumps(row) + "\n" for row in rows[1:]))
        self.assertIn("left       at most", self.campaign("status", manifest, code=30))
        self.campaign("resume", manifest)
        self.campaign("merge", manifest)


class Failures(CampaignCase):
    def test_the_exit_code_says_that_every_job_failed(self):
        manifest = self.manifest("2", systems=self.fake("crash"))
        for action in ("run", "resume", "status", "merge"):
            self.assertIn("every job failed", self.campaign(action, manifest, code=1))
        calm = self.fake("nap").replace("fake:", "calm:").replace("starts", "others")
        manifest = self.manifest("2", systems=self.fake("crash") + "\n  " + calm)
        for action in ("run", "resume", "status", "merge"):
            self.assertNotIn("every job failed", self.campaign(action, manifest))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
