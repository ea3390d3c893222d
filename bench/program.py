# SPDX-License-Identifier: MIT
"""Runs `quadrille solve` and reads what it says; the tables of the runners."""
import argparse
import csv
import json
import os
import re
import shlex
import subprocess
import tempfile
import threading
from decimal import Decimal

EXIT_CODES = {0: "optimal", 10: "feasible", 20: "infeasible", 30: "unknown"}
SOLVED = ("optimal", "infeasible")


class BenchError(Exception):
    """Something that ends the experiment; the message says what and where."""


def run_child(command, wall_limit, prepare=None):
    """Exit code (-N for signal N), output, errors and CPU time (user and system, of the whole process).

    `prepare` runs in the child before the command: its limits.
    """
    with tempfile.TemporaryFile() as errors:
        child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                 stderr=errors, preexec_fn=prepare)
        timer = threading.Timer(wall_limit, child.kill)
        timer.start()
        try:
            output = child.stdout.read()
            _, status, usage = os.wait4(child.pid, 0)
        finally:
            timer.cancel()
            child.stdout.close()
        child.returncode = os.waitstatus_to_exitcode(status)
        errors.seek(0)
        return (child.returncode, output.decode(errors="replace"),
                errors.read().decode(errors="replace").strip(), usage.ru_utime + usage.ru_stime)


def solve_json(command, wall_limit):
    """Status, JSON result and CPU time of a `solve ... --json -`."""
    code, output, errors, cpu = run_child(command, wall_limit)
    where = shlex.join(command)
    if code not in EXIT_CODES:
        raise BenchError(f"exit code {code}: {where}\n{errors}")
    try:
        result = json.loads(output)
        status = result["status"]
        if "statistics" not in result:
            raise KeyError("statistics")
    except (ValueError, KeyError) as error:
        raise BenchError(f"no result in the output ({error!r}): {where}") from error
    if status != EXIT_CODES[code]:
        raise BenchError(f"exit code {code} with status '{status}': {where}")
    return status, result, cpu


def text(value):
    return "" if value is None else str(value)


def verify(command, plan, cost):
    """Replays a plan. Its cost has to be that of the answer."""
    code, output, errors, _ = run_child(command + [plan], 600)
    where = shlex.join(command)
    if code != 0:
        raise BenchError(f"WRONG PLAN, exit code {code}: {where}\n{output}{errors}")
    found = re.search(r"sum of costs ([0-9.]+)", output)
    if not found or Decimal(found[1]) != Decimal(cost):
        raise BenchError(f"WRONG COST, {cost}, of a plan that is verified as: {where}\n{output}")


def parse_program(argument):
    """'NAME=PATH [OPTION...]' -> name, path, options"""
    name, equals, command = argument.partition("=")
    words = shlex.split(command)
    if not name or not equals or not words:
        raise argparse.ArgumentTypeError(f"'{argument}' is not NAME=PATH")
    return name, words[0], words[1:]


def read_rows(path, columns):
    """The rows of a CSV file that a runner wrote."""
    with open(path, newline="", encoding="utf-8") as file:
        if not file.read().endswith("\n"):
            raise BenchError(f"{path}: the last line is incomplete; delete it")
        file.seek(0)
        reader = csv.DictReader(file)
        if reader.fieldnames != columns:
            raise BenchError(f"{path}:1: other columns than this runner's")
        for row in reader:
            if None in row or None in row.values():
                raise BenchError(f"{path}:{reader.line_num}: wrong number of fields")
            yield row


class Table:
    """A CSV file of runs. Each row is checked against all rows before it and written at once.

    `key` names the columns that tell runs apart, `instance` those of them that say what was solved.
    `known` maps instances to (optimal cost, who says so, tolerance).
    """

    def __init__(self, path, columns, key, instance, known):
        self.path, self.key, self.instance = path, key, instance
        self.rows, self.runs, self.proved = {}, {}, dict(known)
        self.lock = threading.Lock()
        new = not os.path.exists(path) or os.path.getsize(path) == 0
        if not new:
            for row in read_rows(path, columns):
                self._enter(row)
        self.file = open(path, "a", newline="", encoding="utf-8")
        self.writer = csv.DictWriter(self.file, columns, lineterminator="\n")
        if new:
            self.writer.writeheader()
            self.file.flush()

    def find(self, key):
        with self.lock:
            return self.rows.get(tuple(key))

    def append(self, row):
        with self.lock:
            self.writer.writerow(row)  # Written before it is checked: a wrong row is evidence.
            self.file.flush()
            self._enter(row)

    def _enter(self, row):
        key = tuple(row[name] for name in self.key)
        if key in self.rows:
            raise BenchError(f"{self.path}: two rows for {' '.join(key)}")
        self._check(row)
        self.rows[key] = row

    def _check(self, row):
        """Raises when the row contradicts another row or what is known."""
        instance = tuple(row[name] for name in self.instance)
        where = " ".join(row[name] for name in self.key)
        runs = self.runs.setdefault(instance, [])
        if row["status"] in SOLVED:
            answer = row["cost"] if row["status"] == "optimal" else "infeasible"
            if row["status"] == "optimal" and row["cost"] != row["lower_bound"]:
                raise BenchError(f"{where}: optimal with cost {answer}, but lower bound "
                                 f"{row['lower_bound']}")
            if instance in self.proved:
                known, who, tolerance = self.proved[instance]
                if answer != known and ("infeasible" in (answer, known) or
                                        abs(Decimal(answer) - Decimal(known)) > tolerance):
                    raise BenchError(f"{where}: WRONG ANSWER, {answer}, but {known} by {who}")
            # Of two runs, the costs are those of the same units: no tolerance.
            self.proved[instance] = (answer, where, Decimal(0))
        runs.append((where, row))
        if instance in self.proved:
            for other, seen in runs:
                self._check_bounds(other, seen, *self.proved[instance])

    @staticmethod
    def _check_bounds(where, row, answer, who, tolerance):
        if answer == "infeasible":
            if row["cost"] != "":
                raise BenchError(f"{where}: has a plan, but infeasible by {who}")
            return
        if row["lower_bound"] != "" and Decimal(row["lower_bound"]) > Decimal(answer) + tolerance:
            raise BenchError(f"{where}: WRONG BOUND, {row['lower_bound']} is above the optimal "
                             f"cost {answer} by {who}")
        if row["cost"] != "" and Decimal(row["cost"]) < Decimal(answer) - tolerance:
            raise BenchError(f"{where}: WRONG COST, {row['cost']} is below the optimal cost "
                             f"{answer} by {who}")


def read_grid_reference(data):
    """(map, scenario, agents) -> optimal sum of costs, found by other solvers; {} without a table."""
    path = os.path.join(data, "reference", "discrete_sum_of_costs.csv")
    if not os.path.exists(path):
        return {}
    with open(path, newline="", encoding="utf-8") as file:
        return {(row["map"], f"random-{row['random_scen']}", row["agents"]):
                row["optimal_sum_of_costs"]
                for row in csv.DictReader(file) if row["optimal_sum_of_costs"]}


def read_continuous_reference(data):
    """(family, task, agents) -> sum of costs of other solvers; {} without a table."""
    path = os.path.join(data, "reference", "continuous_sum_of_costs.csv")
    if not os.path.exists(path):
        return {}
    with open(path, newline="", encoding="utf-8") as file:
        return {(name, f"task-{row['task']}", row["agents"]): row["sum_of_costs"]
                for row in csv.DictReader(file) if row["sum_of_costs"]
                for name in (row["map"], f"{row['map']}:{row['k']}")}
