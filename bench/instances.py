# SPDX-License-Identifier: MIT
"""The instances of the suite: where their files are, and the list of families."""
import os
import re

from program import BenchError

KINDS = ("grid", "roadmap", "scale")


class Instance:
    """One row of the suite, for each program."""

    def __init__(self, kind, family, scenario, agents, rung):
        self.kind, self.family, self.scenario = kind, family, scenario
        self.agents, self.rung = agents, rung

    def values(self):
        scenario = f"task-{self.scenario}" if self.kind == "roadmap" else f"random-{self.scenario}"
        return [self.kind, self.family, scenario, str(self.agents)]

    def files(self, data):
        """The options that name the instance."""
        if self.kind == "roadmap":
            name, _, neighbourhood = self.family.partition(":")
            folder = os.path.join(data, "mapf_r", name)
            return (["--roadmap", os.path.join(folder, "map.xml"),
                     "--task", os.path.join(folder, f"task_{self.scenario}.xml")]
                    + (["--neighbourhood", neighbourhood] if neighbourhood else [])
                    + ["--agents", str(self.agents)])
        grid, scenario = self.paths(data)
        return ["--map", grid, "--scen", scenario, "--agents", str(self.agents)]

    def paths(self, data):
        """Map and scenario of a grid."""
        folder = os.path.join(data, "movingai")
        return (os.path.join(folder, "maps", f"{self.family}.map"),
                os.path.join(folder, "scens", f"{self.family}-random-{self.scenario}.scen"))


def read_families(path):
    """(kind, family, numbers of agents, in the daily sample) of each line."""
    families = []
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            words = line.split("#")[0].split()
            if not words:
                continue
            kind, name, rungs = words[0], words[1] if len(words) > 1 else "", words[2:]
            if kind not in KINDS or not rungs or not all(re.fullmatch(r"[1-9]\d*", n) for n in rungs):
                raise BenchError(f"{path}:{number}: neither grid, roadmap nor scale with a map and "
                                 "numbers of agents")
            families.append((kind, name.rstrip("*"), [int(n) for n in rungs],
                             kind != "scale" or name.endswith("*")))
    return families
