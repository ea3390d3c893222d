#!/usr/bin/env -S python3 -I -S
# SPDX-License-Identifier: MIT
"""Plays `quadrille solve` in the tests of campaigns: what it does stands in its option --fake.

Each start appends a line with the instance to the file of --log, so that a test can count them.
"""
import os
import signal
import sys
import time


def value(option, default=None):
    return sys.argv[sys.argv.index(option) + 1] if option in sys.argv else default


def answer(status, stop="none"):
    """No plan is needed for these two."""
    bound = "null" if status == "infeasible" else "0"
    print(f'{{"status": "{status}", "cost": null, "lower_bound": {bound}, "stop_reason": "{stop}", '
          '"explanation": "", "plan": null, "version": "fake", "statistics": {"conflicts": 7}}')
    sys.exit({"infeasible": 20, "unknown": 30}[status])


def is_solved(behaviour, scenario, agents):
    """Whether a table "random-1:5,random-2:3" has so many agents or more for the scenario."""
    table = dict(entry.split(":") for entry in behaviour.split(","))
    return agents <= int(table[scenario.rsplit("-random-", 1)[1]])


def main():
    behaviour = value("--fake")
    scenario = os.path.splitext(os.path.basename(value("--scen", "")))[0]
    agents = int(value("--agents", "0"))
    log = value("--log")
    tries = 0
    if behaviour == "polite":  # before anybody can know that it runs
        signal.signal(signal.SIGTERM, lambda *_: answer("unknown", stop="interrupt"))
    if log:
        with open(log, "a+", encoding="utf-8") as file:
            file.write(f"{scenario} {agents}\n")
            file.flush()
            file.seek(0)
            tries = file.read().count(f"{scenario} {agents}\n")
    if behaviour == "crash-at-first" and tries == 1:
        print("bad luck", file=sys.stderr)
        sys.exit(70)
    elif behaviour == "sleep-at-first" and tries == 1:
        time.sleep(60)
    elif behaviour in ("sleep", "polite"):
        time.sleep(60)
    elif behaviour == "nap":
        time.sleep(0.1)
    elif behaviour == "deaf":
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        time.sleep(60)
    elif behaviour == "spin":
        signal.signal(signal.SIGXCPU, signal.SIG_IGN)
        while True:
            pass
    elif behaviour == "hog":
        kept = []
        while True:
            kept.append(b"x" * (16 << 20))
    elif behaviour == "nonsense":
        print("no JSON")
        sys.exit(0)
    elif behaviour == "crash":
        sys.exit("bad luck")
    elif behaviour.startswith("table:"):
        if not is_solved(behaviour[6:], scenario, agents):
            answer("unknown", stop="cpu-time")
    answer("infeasible")


main()
