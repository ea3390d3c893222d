# SPDX-License-Identifier: MIT
"""What the tests of the package share. ctest sets PYTHONPATH, QUADRILLE_PROGRAM and QUADRILLE_SOURCE."""

import importlib
import json
import os
import pathlib
import random
import subprocess

import numpy as np
import pytest

import quadrille as q

PROGRAM = os.environ["QUADRILLE_PROGRAM"]
SOURCE = pathlib.Path(os.environ["QUADRILLE_SOURCE"])


def scaled(count):
    return max(1, round(count * float(os.environ.get("QUADRILLE_TEST_SCALE", "1"))))


def need(module):
    """A module that users need not have: its tests are skipped without it, but not in CI."""
    if "CI" in os.environ:
        return importlib.import_module(module)
    return pytest.importorskip(module)


def run_program(*arguments):
    return subprocess.run(
        [PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=300, check=False
    )


def solve_by_program(file, *arguments):
    """The result that the program writes for an instance file, as a dict."""
    done = run_program("solve", "--instance", file, "--quiet", "--json", "-", *arguments)
    assert done.returncode in (0, 10, 20, 30), done.stderr
    return json.loads(done.stdout)


def if_possible(fleet):
    """The fleet; None if it is seen without a search that it has no plan."""
    return fleet if fleet.no_plan is None else None


def assert_no_plan(fleet, why):
    """It is infeasible, and `why` is all of the explanation."""
    result = q.solve(fleet)
    assert (result.status, result.plan, result.cost, result.lower_bound) == ("infeasible", None, None, None)
    assert result.explanation == fleet.no_plan == why


def random_grid_fleet(seed, agents=4, size=6):
    """Agents on a small grid with obstacles; often crowded, sometimes without a plan."""
    rng = random.Random(seed)
    width, height = rng.randint(2, size), rng.randint(2, size)
    free = np.array([[rng.random() < 0.85 for _ in range(width)] for _ in range(height)])
    cells = [(x, y) for y in range(height) for x in range(width) if free[y, x]]
    n = min(rng.randint(1, agents), len(cells))
    return q.Fleet(q.Grid(free), rng.sample(cells, n) or np.empty((0, 2), int),
                   rng.sample(cells, n) or np.empty((0, 2), int))


def random_roadmap_fleet(seed, agents=4):
    """Bodies of several sizes, shapes and speeds on a small roadmap; None if starts or goals overlap."""
    rng = random.Random(seed)
    side = rng.randint(2, 3)
    xy = [(x + rng.uniform(-0.1, 0.1), y + rng.uniform(-0.1, 0.1)) for x in range(side + 1) for y in range(side)]
    edges = [
        (u, v)
        for u in range(len(xy))
        for v in range(u)
        if np.hypot(xy[u][0] - xy[v][0], xy[u][1] - xy[v][1]) < 1.3 and rng.random() < 0.9
    ]
    roadmap = q.Roadmap(xy, edges, both_ways=True, resolution=0.001)
    n = rng.randint(1, agents)
    square = np.array([(-0.2, -0.2), (0.2, -0.2), (0.2, 0.2), (-0.2, 0.2)])
    polygons = [square * rng.uniform(0.5, 1) if rng.random() < 0.3 else None for _ in range(n)]
    return if_possible(
        q.Fleet(
            roadmap,
            rng.sample(range(len(xy)), n),
            rng.sample(range(len(xy)), n),
            radius=[rng.uniform(0.1, 0.35) for _ in range(n)],
            speed=[rng.choice([0.5, 1, 2]) for _ in range(n)],
            polygon=polygons if any(p is not None for p in polygons) else None,
        )
    )


def saved_fleets(make, count, file):
    """(seed, fleet) of the first `count` seeds that give one; the file has the same instance."""
    for seed in range(scaled(count)):
        fleet = make(seed)
        if fleet is not None:
            fleet.save(file)
            yield seed, fleet


@pytest.fixture
def crowd():
    """Too hard to be solved in the time that a test has."""
    fleet = random_crowd()
    return fleet


def random_crowd(n=120, size=20, seed=1):
    rng = random.Random(seed)
    free = np.array([[rng.random() < 0.9 for _ in range(size)] for _ in range(size)])
    # Of the largest part of the grid only, so that there is a plan.
    cells, todo = set(), [tuple(reversed(cell)) for cell in np.argwhere(free)[:1]]
    while todo:
        x, y = todo.pop()
        if (x, y) in cells or not (0 <= x < size and 0 <= y < size and free[y, x]):
            continue
        cells.add((x, y))
        todo += [(x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)]
    cells = sorted(cells)
    return q.Fleet(q.Grid(free), rng.sample(cells, n), rng.sample(cells, n))
