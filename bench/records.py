#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs bench/campaigns/records.yaml and prints a Markdown table of maps, neighbourhoods and radii.

usage: bench/records.py PROGRAM DATA FOLDER [OPTION of campaign run]..

FOLDER gets the scenarios of empty-32-32, links to those of DATA, and the campaign. What it has
already is not run again.
"""
import collections
import pathlib
import sys

import prepared
from prepared import gap_cell, is_closed

SCENARIOS = range(1, 6)
RADII = {"0.3535533905932738": "√2/4", "0.1767766952966369": "√2/8", "0.08838834764831845": "√2/16"}


def double(source, target):
    """The scenario on a grid of twice the size, with every coordinate doubled."""
    lines = source.read_text().splitlines()
    doubled = [lines[0]]
    for line in lines[1:]:
        bucket, _, *numbers, distance = line.split("\t")
        doubled.append("\t".join([bucket, "empty-32-32.map"] + [str(2 * int(n)) for n in numbers]
                                 + [str(2 * float(distance))]))
    target.write_text("\n".join(doubled) + "\n")


def prepare(data, folder):
    """What the manifest's names are relative to."""
    link = prepared.link_data(data, folder)
    (folder / "doubled").mkdir(exist_ok=True)
    for k in SCENARIOS:
        double(link / "scens" / f"empty-16-16-random-{k}.scen",
               folder / "doubled" / f"empty-32-32-random-{k}.scen")


def cell(row):
    words = row["variant"].split()
    value = dict(zip(words[::2], words[1::2]))
    name = pathlib.PurePath(row["map"]).stem
    return name, int(value["--neighbourhood"]), RADII[value["--radius"]]


def left_open(rows):
    """Numbers of agents of which not all instances are closed, and how many are."""
    ladder = collections.defaultdict(list)
    for row in rows:
        ladder[int(row["agents"])].append(is_closed(row))
    return ", ".join(f"{agents}: {sum(closed)} of {len(closed)}"
                     for agents, closed in sorted(ladder.items()) if not all(closed))


def show(rows):
    groups = collections.defaultdict(list)
    for row in rows:
        groups[cell(row)].append(row)
    print("| map | k | radius | instances | closed | agents of which some stay open | "
          "mean CPU (s) | worst gap |")
    print("|---|---|---|---|---|---|---|---|")
    radii = list(RADII.values())
    by_size = sorted(groups.items(), key=lambda of: (*of[0][:2], radii.index(of[0][2])))
    for key, found in by_size:
        cpu = sum(float(row["process_cpu_s"]) for row in found) / len(found)
        cells = (*key, len(found), sum(map(is_closed, found)), left_open(found), f"{cpu:.1f}",
                 gap_cell(found, max))
        print("| " + " | ".join(map(str, cells)) + " |")


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    program, data, folder = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    prepare(data, folder)
    show(prepared.run(program, "records", folder, sys.argv[4:]))


if __name__ == "__main__":
    main()
