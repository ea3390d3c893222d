#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs bench/campaigns/movingai.yaml and prints a Markdown table of its maps.

usage: bench/movingai.py PROGRAM DATA FOLDER [OPTION of campaign run]..

What FOLDER has already is not run again. Its folder movingai/merged gets the rows (table.csv), the
bounds and plans for the MAPF tracker (tracker.csv) and a report for a browser.
"""
import collections
import pathlib
import statistics
import sys

import prepared
from prepared import gap_cell, is_closed


def time(row):
    return float(row["process_cpu_s"]) if is_closed(row) else 2 * float(row["cpu_limit"])


def show_map(name, rows):
    ladders = collections.defaultdict(list)
    for row in rows:
        ladders[row["scenario"]].append(row)
    largest = [max((int(row["agents"]) for row in ladder if is_closed(row)), default=0)
               for ladder in ladders.values()]
    span = str(min(largest)) if len(set(largest)) == 1 else f"{min(largest)} to {max(largest)}"
    cells = (name, len(ladders), len(rows), sum(map(is_closed, rows)), span,
             round(statistics.mean(largest)), f"{statistics.mean(map(time, rows)):.1f}",
             gap_cell(rows, statistics.median))
    print("| " + " | ".join(map(str, cells)) + " |")


def show(rows):
    maps = collections.defaultdict(list)
    for row in rows:
        maps[pathlib.PurePath(row["map"]).stem].append(row)
    print("| map | scenarios | jobs | solved | largest solved | mean | PAR-2 (s) | "
          "gap where it ended |")
    print("|---|---|---|---|---|---|---|---|")
    for name, found in sorted(maps.items(), key=lambda of: of[0].lower()):
        show_map(name, found)
    seconds = sum(float(row["process_cpu_s"]) for row in rows)
    print(f"\n{len(rows)} instances, {sum(map(is_closed, rows))} closed, "
          f"{sum(is_closed(row) and time(row) <= 1 for row in rows)} of them within a second; "
          f"{seconds / 60:.0f} minutes of CPU time")


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    program, data, folder = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    show(prepared.run(program, "movingai", folder, sys.argv[4:], data))


if __name__ == "__main__":
    main()
