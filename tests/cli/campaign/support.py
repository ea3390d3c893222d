# SPDX-License-Identifier: MIT
"""What the tests of campaigns share: a folder with tiny instances, and ways to run the program."""
import csv
import json
import os
import subprocess
import tempfile
import unittest

FAKE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "fake_solver.py")
PATIENCE = 120  # seconds; for what takes a second or two on an idle machine


class CampaignCase(unittest.TestCase):
    """Two maps with two scenarios of eight agents each."""

    program = None  # set by the main program

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.data = os.path.join(self.folder, "data")
        os.mkdir(self.data)
        for name, seed in (("alpha", 1), ("beta", 2)):
            grid = os.path.join(self.data, name + ".map")
            self.quadrille("generate", "--kind", "random", "--width", "7", "--height", "6",
                           "--obstacles", "0.15", "--seed", str(seed), "--map-output", grid)
            for number in (1, 2):
                self.quadrille("generate", "--map", grid, "--agents", "8", "--seed", str(number),
                               "--scen-output",
                               os.path.join(self.data, f"{name}-random-{number}.scen"))

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def read(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()

    def manifest(self, agents="2:8:3", stop="first", systems="dpll: ''", limits="cpu: 20",
                 more="", name="m.yaml"):
        """A manifest over both maps and all scenarios."""
        return self.write(name, f"""data: data
instances:
  - maps: "*.map"
    scenarios: "{{map}}-random-*.scen"
    agents: {agents}
stop: {stop}
systems:
  {systems}
limits: {{{limits}, grace: 0.5}}
{more}""")

    def fake(self, behaviour):
        """A system of the manifest: the program that only pretends."""
        return (f"fake: {{program: {FAKE}, options: [--fake, '{behaviour}', --log, "
                f"{self.path('starts')}]}}")

    def start(self, *words, **more):
        return subprocess.Popen([self.program, *words], stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **more)

    def quadrille(self, *words, code=0, **more):
        """Runs the program, and checks its exit code. Returns what it printed, errors last."""
        process = self.start(*words, **more)
        try:
            out, err = process.communicate(timeout=PATIENCE)
        finally:
            process.kill()
        self.assertEqual(process.returncode, code, f"{words}\n{out}{err}")
        return out + err

    def campaign(self, action, manifest, *more, code=0, **extra):
        return self.quadrille("campaign", action, manifest, *more, code=code, **extra)

    def lines(self, folder="m.campaign"):
        path = self.path(os.path.join(folder, "results.jsonl"))
        if not os.path.exists(path):
            return []
        with open(path, "rb") as file:
            text = file.read()
        return [line.decode() for line in text.split(b"\n")[:-1]]

    def rows(self, folder="m.campaign"):
        """The rows by the name of the job; each is there once."""
        rows = [json.loads(line) for line in self.lines(folder)]
        by_name = {row["job"]: row for row in rows}
        self.assertEqual(len(by_name), len(rows), "a job has two rows")
        return by_name

    def jobs(self, manifest):
        """(map, scenario, agents, system) by the name of the job."""
        out = self.campaign("list", manifest)
        table = [line.split("\t") for line in out.splitlines()]
        return {row[0]: (row[1], row[2], int(row[3]), row[4]) for row in table}

    def table(self, folder="m.campaign"):
        with open(self.path(os.path.join(folder, "merged", "table.csv")), newline="",
                  encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def starts(self):
        """How often each instance was started, by the fake solver."""
        counts = {}
        if os.path.exists(self.path("starts")):
            for line in self.read("starts").splitlines():
                counts[line] = counts.get(line, 0) + 1
        return counts
