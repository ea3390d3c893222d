#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Orders of `quadrille export --to vda5050` against a schema of the message in each version, and against
the precedences that `quadrille execute-check` lists.

usage: vda5050_test.py <quadrille> <schema>
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import jsonschema

program, schema_file = sys.argv[1:]
schema = json.loads(pathlib.Path(schema_file).read_text())
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)


def run(*arguments, codes=(0,)):
    done = subprocess.run([program, *arguments], capture_output=True, text=True, check=False)
    assert done.returncode in codes, (arguments, done.returncode, done.stderr)
    return done.stdout


def check_order(order, precedences, agent):
    """The order of one agent at the start, when nobody has ended a move."""
    validator.validate(order)
    nodes, edges = order["nodes"], order["edges"]
    moves = precedences["moves"][agent]
    assert len(nodes) == len(edges) + 1 == len(moves) + 1
    assert [node["sequenceId"] for node in nodes] == list(range(0, 2 * len(nodes), 2))
    assert [edge["sequenceId"] for edge in edges] == list(range(1, 2 * len(edges), 2))
    led = [p["follower"]["move"] for p in precedences["precedences"] if p["follower"]["agent"] == agent]
    released = min(led, default=len(moves))
    assert [edge["released"] for edge in edges] == [k < released for k in range(len(edges))]
    assert [node["released"] for node in nodes] == [k <= released for k in range(len(nodes))]
    for move, edge in zip(moves, edges):
        assert edge["edgeId"] == f"v{move['from']}-v{move['to']}"


def in_version(order, version):
    """An order of 3.0 as the other versions have it."""
    names = [node["nodeId"] for node in order["nodes"]]
    edges = [dict(edge) for edge in order["edges"]]
    for edge, start, end in zip(edges, names, names[1:]):
        if version.startswith("2"):
            edge.update(startNodeId=start, endNodeId=end, maxSpeed=edge.pop("maximumSpeed"))
    return {**order, "version": version + ".0", "edges": edges}


def check_versions(orders, exported):
    """`exported`: what is written with these arguments."""
    for version in ("2.0", "2.1", "3.0"):
        assert exported("--vda-version", version) == [in_version(order, version) for order in orders]
        for order in orders:
            validator.validate(in_version(order, version))
            other = {**order, "version": "2.1.0"} if version == "3.0" else {
                **in_version(order, version), "version": "3.0.0"}
            assert not order["edges"] or not validator.is_valid(other), "fields of another version"


def check_refusals(order):
    """The schema is one that can fail."""
    position = order["nodes"][0]["nodePosition"]
    for broken in (
        {**order, "version": "1.1.0"},
        {**order, "serialNumber": "a robot"},
        {**order, "nodes": [{**order["nodes"][0], "nodePosition": {**position, "theta": 3.2}}]},
        {**order, "orderUpdateId": -1},
        {**order, "nodes": []},
        {key: value for key, value in order.items() if key != "edges"},
        {**order, "nodes": [{**order["nodes"][0], "sequenceId": 1}]},
        {**order, "nodes": [{**order["nodes"][0], "released": 1}]},
    ):
        assert not validator.is_valid(broken), broken


with tempfile.TemporaryDirectory() as folder:
    instance, plan = f"{folder}/instance.json", f"{folder}/plan.json"
    held = locked = 0
    for seed in range(5):
        run("generate", "--kind", "roadmap", "--vertices", "30", "--agents", "8", "--mixed", "--seed",
            str(seed), "--instance-output", instance)
        run("solve", "--instance", instance, "--gap", "1000", "--quiet", "--plan", plan, codes=(0, 10))
        export = ["export", "--instance", instance, "--to", "vda5050"]
        precedences = json.loads(
            run("execute-check", "--instance", instance, "--json", "-", plan, codes=(0, 1)))
        if not precedences["acyclic"]:
            locked += 1
            assert run(*export, plan, codes=(1,)) == "", "orders that lock up, without a word"
            export.append("--allow-cycles")
        orders = json.loads(run(*export, plan))
        assert len(orders) == 8
        check_versions(orders, lambda *more: json.loads(run(*export, *more, plan)))
        for agent, order in enumerate(orders):
            check_order(order, precedences, agent)
            check_refusals(order)
            held += any(not edge["released"] for edge in order["edges"])
    assert held >= 5, "hardly anybody follows anybody"
    print(f"{locked} of 5 plans lock up")
