# SPDX-License-Identifier: MIT
"""The figures of bench/suite as Markdown tables.

- solved: instances proved optimal (or infeasible) within the limit
- PAR-2: mean CPU seconds, where an instance that is not solved counts as twice the limit
- ratio: geometric mean of the CPU ratios to the first program, over the instances that both solve;
  times below 0.05 s, which are start-up, count as 0.05 s
- conflicts: where they are equal on all instances, the search is the same
- gap: (plan - bound) / bound at the limit, of instances that are not solved
"""
import math

from program import SOLVED

LEAST = 0.05


def solved(row):
    return row["status"] in SOLVED


def par2(rows):
    return sum(float(row["cpu_s"]) if solved(row) else 2 * float(row["cpu_limit"])
               for row in rows) / len(rows)


def gap(row):
    """In per cent; None without a plan or a bound."""
    if solved(row):
        return 0.0
    if row["cost"] == "" or row["lower_bound"] in ("", "0"):
        return None
    return 100 * (float(row["cost"]) / float(row["lower_bound"]) - 1)


def ratio(pairs):
    """Geometric mean of CPU ratios (second to first) and their number."""
    logs = [math.log(max(float(b["cpu_s"]), LEAST) / max(float(a["cpu_s"]), LEAST))
            for a, b in pairs if solved(a) and solved(b)]
    return (math.exp(sum(logs) / len(logs)), len(logs)) if logs else (None, 0)


def show_ratio(pairs):
    value, count = ratio(pairs)
    return f"{value:.2f} ({count})" if count else "-"


def line(cells):
    return "| " + " | ".join(cells) + " |\n"


def figures(title, rows_of, names):
    """One line: solved and PAR-2 of each program, ratio of each but the first."""
    cells = [title, str(len(rows_of[names[0]]))]
    cells += [str(sum(map(solved, rows_of[name]))) for name in names]
    cells += [f"{par2(rows_of[name]):.2f}" for name in names]
    cells += [show_ratio(list(zip(rows_of[names[0]], rows_of[name]))) for name in names[1:]]
    return line(cells)


def show_gap(row):
    value = gap(row)
    return "no plan" if value is None else f"{value:.2f}"


def write_report(rows, names, file):
    """Of the instances that all programs `names` have run, with each limit on its own."""
    for limit in sorted({row["cpu_limit"] for row in rows}, key=float):
        by_instance = {}
        for row in rows:
            if row["cpu_limit"] == limit and row["program"] in names:
                key = (row["kind"], row["family"], row["scenario"], int(row["agents"]))
                by_instance.setdefault(key, {})[row["program"]] = row
        complete = {key: found for key, found in by_instance.items() if len(found) == len(names)}
        missing = len(by_instance) - len(complete)
        file.write(f"CPU limit {limit} s, {len(complete)} instances"
                   + (f" ({missing} more are not run by all programs)" if missing else "") + "\n\n")
        write_solved(complete, names, file)
        write_gaps(complete, names, file)


def write_solved(complete, names, file):
    exact = {key: found for key, found in complete.items() if key[0] != "scale"}
    if not exact:
        return
    groups = {}
    for key, found in exact.items():
        for title in (f"{key[0]} {key[1]}", f"**all of {key[0]}**", "**all**"):
            groups.setdefault(title, {n: [] for n in names})
            for name in names:
                groups[title][name].append(found[name])
    for name in names[1:]:
        both = [f for f in exact.values() if solved(f[names[0]]) and solved(f[name])]
        same = sum(f[names[0]]["conflicts"] == f[name]["conflicts"] for f in both)
        file.write(f"{name} needs as many conflicts as {names[0]} on {same} of {len(both)} instances "
                   "that both solve.\n\n")
    file.write(line(["family", "instances"] + [f"solved {n}" for n in names]
                    + [f"PAR-2 {n}" for n in names] + [f"CPU {n} / {names[0]}" for n in names[1:]]))
    file.write("|" + "---|" * (1 + 2 * len(names) + len(names)) + "\n")
    for title in sorted(groups, key=lambda title: (title == "**all**", title.startswith("**"))):
        file.write(figures(title, groups[title], names))
    file.write("\n")


def write_gaps(complete, names, file):
    open_ones = {key: found for key, found in complete.items()
                 if key[0] == "scale" or not all(solved(row) for row in found.values())}
    if not open_ones:
        return
    file.write(line(["not solved by all", "agents"] + [f"{n}: plan" for n in names]
                    + [f"{n}: bound" for n in names] + [f"{n}: gap, per cent" for n in names]))
    file.write("|" + "---|" * (2 + 3 * len(names)) + "\n")
    for key, found in sorted(open_ones.items(), key=lambda item: item[0][0] == "scale"):
        file.write(line([f"{key[0]} {key[1]}, {key[2]}", str(key[3])]
                        + [found[n]["cost"] or "-" for n in names]
                        + [found[n]["lower_bound"] or "-" for n in names]
                        + [show_gap(found[n]) for n in names]))
    gaps = {n: [gap(found[n]) for found in open_ones.values()] for n in names}
    known = {n: [g for g in values if g is not None] for n, values in gaps.items()}
    means = [f"{sum(g) / len(g):.2f} ({len(g)})" if (g := known[n]) else "-" for n in names]
    file.write(line(["**mean gap (instances with a plan)**", ""] + [""] * (2 * len(names)) + means))
    file.write("\n")
