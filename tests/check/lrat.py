#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether an LRAT file, without RAT steps, refutes a DIMACS formula: each hint is used, none is missing.

usage: lrat.py A.cnf A.lrat        exit status 0 if it does
"""
import sys


def main(cnf, lrat):
    clauses = {}
    with open(cnf, encoding="ascii") as file:
        head = file.readline().split()
        for number, line in enumerate(file, 1):
            clauses[number] = {int(word) for word in line.split()[:-1]}
    if head[:2] != ["p", "cnf"] or int(head[3]) != len(clauses):
        sys.exit("the head does not fit")
    with open(lrat, encoding="ascii") as file:
        for line in file:
            name, *rest = (int(word) for word in line.split())
            end = rest.index(0)
            clause, hints = set(rest[:end]), rest[end + 1 : -1]
            false = set(clause)
            for at, hint in enumerate(hints):
                left = clauses[hint] - false
                if not left and at == len(hints) - 1:
                    break
                if len(left) != 1:
                    sys.exit(f"step {name}: hint {hint} implies nothing")
                false.add(-left.pop())
            else:
                sys.exit(f"step {name}: no hint is false")
            if name in clauses:
                sys.exit(f"step {name} has the number of another clause")
            clauses[name] = clause
            if not clause:
                return
    sys.exit("the empty clause is missing")


main(*sys.argv[1:])
