# SPDX-License-Identifier: MIT
"""Runs `quadrille solve` and reads what it says; the tables of the runners."""
import csv
import json
import os
import shlex
import subprocess
import tempfile
import threading

EXIT_CODES = {0: "optimal", 10: "feasible", 20: "infeasible", 30: "unknown"}
SOLVED = ("optimal", "infeasible")


class BenchError(Exception):
    """Something that ends the experiment; the message says what and where."""


def run_child(command, wall_limit):
    """Exit code, output, errors and CPU time (user and system, of the whole process)."""
    with tempfile.TemporaryFile() as errors:
        child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                 stderr=errors)
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
