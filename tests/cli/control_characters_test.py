# SPDX-License-Identifier: MIT
"""Whatever stands in files, in their names and in what other programs say: no control character of
it reaches a terminal. Each kind of input is damaged many times, and the streams are looked at.

usage: control_characters_test.py <the program quadrille> <folder of the sources>
"""
import json
import os
import pty
import random
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(sys.argv[1])
DATA = os.path.join(os.path.abspath(sys.argv[2]), "tests", "data")

CONTROLS = ["\x1b[31m", "\x1b]0;owned\x07", "\x07", "\r", "\x08", "\x7f", "\x01", "\x0b", "\x9b31m",
            "\x85", "\x90", *"\u061c\u200e\u200f\u2028\u2029\u202a\u202b\u202c\u202d\u202e",
            *"\u2066\u2067\u2068\u2069"]
# As bytes they are no UTF-8, and a terminal that takes Latin-1 obeys them.
RAW = [control.encode() for control in CONTROLS] + [b"\x9b31m", b"\xff", b"\xc2", b"\xed\xa0\x80"]
MUTANTS = 12  # of each kind of file

GRAPHML = """<graphml><key id="key0" attr.name="coords" for="node"/><graph edgedefault="directed">
<node id="n0"><data key="key0">0,0</data></node><node id="n1"><data key="key0">4,0</data></node>
<edge id="e0" source="n0" target="n1"/><edge id="e1" source="n1" target="n0"/></graph></graphml>
"""
TASK = '<root><agent start_id="0" goal_id="1"/></root>\n'
GRID_TASK = '<root><agent start_i="0" start_j="0" goal_i="0" goal_j="1"/></root>\n'
MANIFEST = """title: tiny
data: .
reference: reference.csv
instances: [{maps: small.map, scenarios: small.scen, agents: 1}]
systems: {dpll: --audit, other: {program: ./noisy, options: --fake}}
limits: {cpu: 20}
"""
# A program that says what no terminal should hear.
NOISY = "#!/bin/sh\nprintf 'a \\033[31m\\302\\233 b\\007\\342\\200\\256' | tee /dev/stderr\nexit 65\n"
STATE = '{"serialNumber": "agent0", "orderId": "x", "lastNodeSequenceId": 0}\n'


def is_forbidden(character):
    return (not character.isprintable() and character not in "\n\t ") and (
        ord(character) < 0xa0 or character in "".join(CONTROLS))


def complaint(stream):
    """What must not be in it; None if all is well."""
    try:
        text = stream.decode()
    except UnicodeDecodeError as error:
        return f"no UTF-8: {error}"
    found = [character for character in text if is_forbidden(character)]
    return f"{found!r} in {text!r}" if found else None


class ControlCharacters(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        for source in ("valid", "roadmaps"):
            for name in os.listdir(os.path.join(DATA, source)):
                shutil.copy(os.path.join(DATA, source, name), self.path(name))
        for name, text in (("roadmap.graphml", GRAPHML), ("task.xml", TASK), ("m.yaml", MANIFEST),
                           ("grid_task.xml", GRID_TASK), ("state.jsonl", STATE), ("noisy", NOISY),
                           ("reference.csv", "map,scenario,agents,x_cpu_s\nsmall,small,1,0.5\n")):
            with open(self.path(name), "w", encoding="utf-8") as file:
                file.write(text)
        os.chmod(self.path("noisy"), 0o755)
        self.random = random.Random(20261126)

    def path(self, name):
        return os.path.join(self.folder, name)

    def look(self, *words, name=""):
        """Runs the program; both streams have to be clean."""
        finished = subprocess.run([PROGRAM, *words], cwd=self.folder, stdin=subprocess.DEVNULL,
                                  capture_output=True, timeout=120, check=False)
        self.assertIn(finished.returncode, (0, 1, 10, 20, 30, 64, 65, 74), (name, words, finished))
        for stream in (finished.stdout, finished.stderr):
            self.assertIsNone(complaint(stream), (name, words))
        return finished

    def damaged(self, data):
        """With a control character or a few in it, often inside a text or a name."""
        for _ in range(self.random.randint(1, 3)):
            places = range(len(data) + 1)
            if self.random.random() < 0.5:
                places = [i for i in places if i > 0 and data[i - 1:i].isalnum()] or places
            at = self.random.choice(places)
            data = data[:at] + self.random.choice(RAW) + data[at:]
        return data

    def check_kind(self, file, *commands):
        """Each command, with each damaged version of the file."""
        with open(self.path(file), "rb") as original:
            good = original.read()
        for number in range(MUTANTS):
            with open(self.path(file), "wb") as changed:
                changed.write(self.damaged(good))
            for command in commands:
                self.look(*command, name=f"{file} {number}")
        with open(self.path(file), "wb") as restored:
            restored.write(good)

    def test_maps_and_scenarios(self):
        grid = ("--map", "small.map", "--scen", "small.scen", "--agents", "2")
        for file in ("small.map", "small.scen"):
            self.check_kind(file, ("solve", *grid), ("info", *grid))

    def test_instances(self):
        for file in ("grid.json", "grid.yaml", "graph.json", "discs.json", "fleet.json"):
            self.check_kind(file, ("solve", "--instance", file, "--explain"),
                            ("info", "--instance", file))

    def test_roadmaps_and_tasks(self):
        for roadmap, task in (("roadmap.graphml", "task.xml"), ("cells.xml", "grid_task.xml"),
                              ("nav.yaml", None)):
            words = ("--roadmap", roadmap, *(("--task", task) if task else ()))
            for file in filter(None, (roadmap, task)):
                self.check_kind(file, ("solve", *words), ("info", *words))

    def test_plans(self):
        grid = ("--instance", "grid.json")
        for file in ("plan.json", "plan.cbsh2", "plan.visualizer", "plan.yaml", "result.json"):
            self.check_kind(file, ("verify", *grid, file), ("execute-check", *grid, file),
                            ("simulate", *grid, "--runs", "1", file),
                            ("solve", *grid, "--initial-plan", file))
        discs = ("--instance", "discs.json")
        self.look("solve", *discs, "--explain", "--quiet", "--json", "discs.result")
        for file in ("discs-log.xml", "discs-plan.json", "discs.result"):
            self.check_kind(file, ("verify", *discs, file),
                            ("view", *discs, "--output", "page.html", file),
                            ("export", *discs, "--to", "csv", "--output", "samples", file))

    def test_states(self):
        self.check_kind("state.jsonl", ("export", "--instance", "discs.json", "--to", "vda5050",
                                        "--states", "state.jsonl", "discs-plan.json"))

    def test_campaigns(self):
        campaign = ("campaign", "run", "m.yaml")
        self.check_kind("m.yaml", ("campaign", "list", "m.yaml"))
        self.assertEqual(self.look(*campaign).returncode, 0)
        actions = [("campaign", action, "m.yaml") for action in ("status", "merge")]
        for file in ("jobs.json", "results.jsonl"):
            self.check_kind(os.path.join("m.campaign", file), *actions)
        self.check_kind("reference.csv", ("campaign", "merge", "m.yaml"))
        # What the solver said is in the table, too, where a merge has made one.
        self.look("campaign", "merge", "m.yaml")

    def test_names_of_campaigns_systems_and_maps(self):
        for number, control in enumerate(CONTROLS):
            name = f"a{control}b"
            shutil.copy(self.path("small.map"), self.path(name + ".map"))
            shutil.copy(self.path("small.scen"), self.path(name + ".scen"))
            manifest = f"{name}{number}.yaml"
            with open(self.path(manifest), "w", encoding="utf-8") as file:
                json.dump({"title": name, "data": ".",
                           "instances": [{"maps": name + ".map", "scenarios": name + ".scen",
                                          "agents": 1}],
                           "systems": {name: {"program": "./noisy", "options": "--x"}}}, file)
            for action in ("list", "run", "status", "merge", "reopen"):
                self.look("campaign", action, manifest)

    def test_names_of_files_and_words_of_the_command_line(self):
        for control in CONTROLS:
            name = f"a{control}\nb"
            shutil.copy(self.path("grid.json"), self.path(name + ".json"))
            self.look("solve", "--instance", name + ".json", "--plan", name + ".plan")
            self.look("solve", "--instance", name + ".none")
            self.look("verify", "--instance", name + ".json", name + ".plan")
            self.look("solve", "--instance", "grid.json", "--plan", f"no{control}ne/plan")
            self.look("solve", "--agents", name)
            self.look(name)
            self.look("solve", "--" + name)

    def test_files_on_a_terminal(self):
        """Written to a terminal, files have nothing raw in them either, and stay what they are."""
        self.assertEqual(self.look("solve", "--instance", "grid.json", "--plan", "good.json").returncode, 0)
        for control in CONTROLS:
            plan = f"a{control}b.json"
            shutil.copy(self.path("good.json"), self.path(plan))
            master, slave = pty.openpty()
            words = ["solve", "--instance", "grid.json", "--json", "-", "--initial-plan", plan]
            process = subprocess.Popen([PROGRAM, *words], cwd=self.folder, stdout=slave,
                                       stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            os.close(slave)
            out = b""
            try:
                while block := os.read(master, 65536):
                    out += block
            except OSError:  # The terminal has gone.
                pass
            process.wait()
            os.close(master)
            out = out.replace(b"\r\n", b"\n")
            self.assertIsNone(complaint(out), control)
            self.assertEqual(json.loads(out)["options"]["initial_plan"], plan)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
