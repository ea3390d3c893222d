#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether a proof for VeriPB refutes an OPB formula. Knows the steps that quadrille-check exports: `pol` (sums, multiples, divisions,
saturation, literal axioms) and `red` of variables that are new or defined by the step before.

usage: pseudo_boolean.py A.opb A.pbp ...        pairs; exit status 0 if all do
"""
import sys


def normal(terms, degree):
    """Positive factors, each variable once."""
    sums = {}
    for factor, lit in terms:
        if lit < 0:
            factor, lit, degree = -factor, -lit, degree - factor
        sums[lit] = sums.get(lit, 0) + factor
    degree -= sum(factor for factor in sums.values() if factor < 0)
    return {lit if factor > 0 else -lit: abs(factor) for lit, factor in sums.items() if factor}, degree


def literal(word):
    return -int(word[2:]) if word[0] == "~" else int(word[1:])


def constraint(words):
    end = words.index(">=")
    terms = [(int(words[k]), literal(words[k + 1])) for k in range(0, end, 2)]
    return normal(terms, int(words[end + 1]))


def combined(a, b):
    return normal([(factor, lit) for terms, _ in (a, b) for lit, factor in terms.items()], a[1] + b[1])


def polish(words, known):
    stack = []
    for at, word in enumerate(words):
        if word == "+":
            stack[-2:] = [combined(*stack[-2:])]
        elif word in "*d":
            number = stack.pop()
            terms, degree = stack.pop()
            if number < 1:
                sys.exit("a factor below 1")
            stack.append(({lit: factor * number for lit, factor in terms.items()}, degree * number) if word == "*" else
                         ({lit: -(-factor // number) for lit, factor in terms.items()}, -(-degree // number)))
        elif word == "s":
            terms, degree = stack.pop()
            stack.append(({lit: min(factor, degree) for lit, factor in terms.items() if min(factor, degree) > 0}, degree))
        elif word.lstrip("~").startswith("x"):
            stack.append(({literal(word): 1}, 0))
        else:
            is_factor = at + 1 < len(words) and words[at + 1] in "*d"
            stack.append(int(word) if is_factor else known[int(word)])
    if len(stack) != 1:
        sys.exit("a sum without end")
    return stack[0]


def define(words, known, users):
    """A constraint with a witness for one variable: what is known of that follows if the constraint is false."""
    split = words.index(";")
    terms, degree = made = constraint(words[:split])
    variable, _, value = words[split + 1 :]
    variable = int(variable[1:])
    witness = variable if value == "1" else -variable
    if terms.get(witness, 0) < degree:
        sys.exit("a witness that does not make its constraint true")
    opposite = normal([(-factor, lit) for lit, factor in terms.items()], 1 - degree)
    for user in users.get(variable, ()):
        left, need = known[user]
        if witness in left:
            need -= left[witness]
        rest = {lit: factor for lit, factor in left.items() if abs(lit) != variable}
        # The opposite says enough even if it gives all that it has of other literals.
        slack = sum(max(0, factor - rest.get(lit, 0)) for lit, factor in opposite[0].items())
        if need > 0 and opposite[1] - slack < need:
            sys.exit("a variable that has another meaning")
    return made


def check(opb, pbp):
    known, users = {}, {}

    def add(made):
        known[len(known) + 1] = made
        for lit in made[0]:
            users.setdefault(abs(lit), []).append(len(known))

    with open(opb, encoding="ascii") as file:
        for line in file:
            if not line.startswith("*"):
                add(constraint(line.split()))
    with open(pbp, encoding="ascii") as file:
        lines = file.read().splitlines()
    if lines[:2] != ["pseudo-Boolean proof version 2.0", f"f {len(known)}"]:
        sys.exit("the head does not fit")
    if lines[-3] != "output NONE" or lines[-1] != "end pseudo-Boolean proof":
        sys.exit("the end is missing")
    for line in lines[2:-3]:
        rule, *words = line.split()
        if rule not in ("pol", "red"):
            sys.exit(f"no such rule: {rule}")
        add(polish(words, known) if rule == "pol" else define(words, known, users))
    *words, number = lines[-2].split()
    terms, degree = known[int(number)]
    if words != ["conclusion", "UNSAT", ":"] or sum(terms.values()) >= degree:
        sys.exit("there is no contradiction")


for k in range(1, len(sys.argv), 2):
    check(sys.argv[k], sys.argv[k + 1])
