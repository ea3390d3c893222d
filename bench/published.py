#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs bench/campaigns/published.yaml and published-makespan.yaml and prints Markdown tables: how
the published systems compare.

usage: bench/published.py PROGRAM DATA FOLDER [OPTION of campaign run]..

FOLDER gets five scenarios of DATA and five by `quadrille generate` for each map, and the campaigns.
What it has already is not run again.
"""
import collections
import math
import pathlib
import subprocess
import sys

import prepared
from report import solved

MAPS = {"empty-16-16": 90, "random-32-32-20": 120, "maze-32-32-4": 40}
LEAST = 0.1  # seconds; of less much is start-up


def gather(program, data, folder):
    """The scenarios of both kinds in one folder."""
    link = prepared.link_data(data, folder)
    reference, scenarios = folder / "reference", folder / "scenarios"
    if not reference.exists():
        reference.symlink_to((data / "reference").resolve())
    scenarios.mkdir(exist_ok=True)
    for name, agents in MAPS.items():
        for number in range(1, 6):
            known = scenarios / f"{name}-random-{number}.scen"
            if not known.exists():
                known.symlink_to((link / "scens" / known.name).resolve())
            made = scenarios / f"{name}-seed-{number}.scen"
            if not made.exists():
                subprocess.run([program, "generate", "--map", str(link / "maps" / f"{name}.map"),
                                "--scen-output", str(made), "--agents", str(agents),
                                "--seed", str(number)], check=True)


def ratio(times, base):
    """Of all times to those of the base, in the geometric mean."""
    logs = [math.log(a / b) for a, b in zip(times, base)]
    return math.exp(sum(logs) / len(logs)) if logs else float("nan")


def show(rows):
    """Solved instances, and the times where all solve and somebody needs LEAST, against the first
    system's."""
    systems = list(dict.fromkeys(row["system"] for row in rows))
    maps = collections.defaultdict(lambda: collections.defaultdict(dict))
    for row in rows:
        key = (row["scenario"], int(row["agents"]))
        maps[pathlib.PurePath(row["map"]).stem][key][row["system"]] = row
    print("| map | | " + " | ".join(f"`{system}`" for system in systems) + " |")
    print("|---|---|" + "---|" * len(systems))
    for name, instances in maps.items():
        count = collections.Counter(system for found in instances.values()
                                    for system, row in found.items() if solved(row))
        print(f"| {name} | solved | " + " | ".join(str(count[s]) for s in systems) + " |")
        common = [found for found in instances.values()
                  if all(s in found and solved(found[s]) for s in systems)
                  and max(float(row["process_cpu_s"]) for row in found.values()) >= LEAST]
        times = {s: [max(float(found[s]["process_cpu_s"]), 0.01) for found in common]
                 for s in systems}
        print(f"| | times ({len(common)}) | " +
              " | ".join(f"{ratio(times[s], times[systems[0]]):.2f}" for s in systems) + " |")
        conflicts = {s: sum(int(found[s]["conflicts"]) for found in common) for s in systems}
        base = max(conflicts[systems[0]], 1)
        print("| | conflicts | " +
              " | ".join(f"{conflicts[s] / base:.2f}" for s in systems) + " |")


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    program, data, folder = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    gather(program, data, folder)
    for name, objective in (("published", "sum of costs"), ("published-makespan", "makespan")):
        rows = prepared.run(program, name, folder, sys.argv[4:])
        print(f"\n{objective}\n")
        show(rows)


if __name__ == "__main__":
    main()
