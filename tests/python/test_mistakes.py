# SPDX-License-Identifier: MIT
"""What beginners get wrong: each message names the thing by the user's own name, with the user's own number."""

import json

import numpy as np
import pytest
from conftest import SOURCE, assert_no_plan, run_program

import quadrille as q

GRID = q.Grid([[1, 1, 0], [1, 1, 1]])
NAMES = ["dock", "hall", "desk", "attic"]
ROADS = q.Roadmap([(0, 0), (4, 0), (8, 0), (8, 9)], [(0, 1), (1, 2)], both_ways=True, nodes=NAMES)


def fleet(starts=("dock",), goals=("desk",), **more):
    given = dict(radius=0.3, speed=1, names=["amr", "cart"][: len(starts)])
    return q.Fleet(ROADS, list(starts), list(goals), **{**given, **more})


@pytest.mark.parametrize("make, message", [
    # On roadmaps, with names.
    (lambda: fleet(["dok"]), "starts[0]: the roadmap has no vertex called 'dok'"),
    (lambda: fleet(["dock"], ["dek"]), "goals[0]: the roadmap has no vertex called 'dek'"),
    (lambda: fleet([["dock"]]), "starts[0]: the roadmap has no vertex called ['dock']"),
    (lambda: fleet([q.Underway("dock", "hal", 0.5)]), "starts[0]: the roadmap has no vertex called 'hal'"),
    (lambda: fleet([q.Underway("dock", "hall", 40)]),
     "'amr' has a part of its move behind it of 40, which is not from 0 to 1"),
    (lambda: fleet(radius=-0.3), "'amr' has a radius of -0.3, which is not positive, or too large"),
    (lambda: fleet(radius=[np.nan]), "'amr' has a radius of nan, which is not positive, or too large"),
    (lambda: fleet(["dock", "desk"], ["desk", "dock"], speed=[1, 0]), "'cart' has a speed of 0, which is not supported"),
    (lambda: fleet(speed=-1.5), "'amr' has a speed of -1.5, which is not supported"),
    (lambda: fleet(radius=None), "'amr' has no body: on a roadmap give a radius or a polygon"),
    (lambda: fleet(radius=None, polygon=[(0, 0), (1, 0), (2, 0)]),
     "'amr' has a polygon that is not supported at a resolution of 1e-06: polygon: three consecutive corners are on a line"),
    (lambda: fleet(release=-2), "'amr' is released at -2, which is negative, or too late"),
    (lambda: fleet(deadline=-2), "'amr' has its deadline at -2, which is negative, or too late"),
    (lambda: fleet(speed=1e6, radius=0.3, names=None) and q.Fleet(
        q.Roadmap([(0, 0), (4, 0)], [(0, 1)], nodes=["a", "b"], resolution=0.01), ["a"], ["b"], radius=0.3,
        speed=10000, names=["amr"]), "the lane from 'a' to 'b' takes 'amr' less than half a step of 0.01, or too long"),
    (lambda: fleet(radius=[0.3, 0.3]), "radius: expected an array of shape (1), not (2,)"),
    (lambda: fleet(radius=["wide"]), "radius: expected numbers, not <U4"),
    (lambda: fleet(names=["amr", "cart"]), "names: 2 names for 1 agents"),
    (lambda: fleet(group="small"), "group: the roadmap has no group 'small'"),
    (lambda: q.Fleet(ROADS, ["dock"], ["desk"], radius=0), "agent 0 has a radius of 0, which is not positive, or too large"),
    # Roadmaps themselves.
    (lambda: q.Roadmap([(0, 0), (4, 0)], [(0, 0)]), "edges[0] leads from vertex 0 to itself"),
    (lambda: q.Roadmap([(0, 0), (4, 0)], [(0, 1)], nodes=["a", "a"]), "nodes: two vertices are called 'a'"),
    (lambda: q.Roadmap([(0, 0), (4, 0), (4, 1)], [(0, 1), (0, 3)], both_ways=True), "edges[1]: there is no vertex 3 among 3"),
    (lambda: q.Roadmap([(0, 0), (4, 0), (4, 0)], [(0, 1), (1, 2)], both_ways=True),
     "edges[1] leads from vertex 1 to vertex 2, which is in the same place at this resolution"),
    (lambda: q.Roadmap([(0, 0), (4, 0)], [(0, 1), (0, 1)], durations=[1, -1], both_ways=True),
     "durations[1]: the duration is less than one tick, or too long"),
    (lambda: q.Roadmap([0, 0], [(0, 1)]), "xy: expected an array of shape (n, 2), not (2,)"),
    (lambda: q.Roadmap([(0, 0), (4, 0)], [(0.5, 1)]), "edges: expected integers, not float64"),
    # Grids.
    (lambda: q.Fleet(GRID, [(0, 0)], [(2, 0)]), "agent 0: goal: the cell (2, 0) is blocked, or outside of the grid"),
    (lambda: q.Fleet(GRID, [(0, 0)], [(2, 0)], names=["amr"]), "'amr': goal: the cell (2, 0) is blocked, or outside of the grid"),
    (lambda: q.Fleet(GRID, [(0, 0), (0, 0)], [(0, 1), (1, 1)], names=["amr", "cart"]),
     "'amr' and 'cart' have the same start (0, 0)"),
    (lambda: q.Fleet(GRID, [(0, 0), (1, 0)], [(1, 1), (1, 1)]), "agents 0 and 1 have the same goal (1, 1)"),
    (lambda: q.Fleet(GRID, np.zeros((1, 3), int), [(0, 1)]), "starts: expected an array of shape (n, 2), not (1, 3)"),
    (lambda: q.Fleet(GRID, [(0, 0)], [(0, 1)], speed=1), "speed is for roadmaps"),
    # Files.
    (lambda: q.read("none.json"), "none.json: cannot be opened: No such file or directory"),
    (lambda: q.read(SOURCE / "README.md"), None),
    (lambda: q.solve(fleet(), gap="small"), None),
])
def test_mistakes(make, message):
    with pytest.raises((ValueError, TypeError)) as raised:
        make()
    if message is not None:
        assert str(raised.value) == message
    assert "\n" not in str(raised.value) and "quadrille._core" not in str(raised.value)


@pytest.mark.parametrize("make, why", [
    (lambda: fleet(["dock"], ["attic"]), "'amr' cannot get from 'dock' to 'attic'"),
    (lambda: fleet(deadline=7.5), "'amr' cannot arrive before 8, and its deadline is 7.5"),
    (lambda: fleet(["dock", "dock"], ["desk", "hall"]), "the starts of 'amr' at 'dock' and 'cart' at 'dock' overlap"),
    (lambda: fleet(["dock", "hall"], ["desk", "desk"]), "the goals of 'amr' at 'desk' and 'cart' at 'desk' overlap"),
    (lambda: fleet(["dock", "hall"], ["hall", "dock"], radius=3),
     "the starts of 'amr' at 'dock' and 'cart' at 'hall' overlap"),
    (lambda: fleet(obstacles=[q.Obstacle([(0.1, 0, 0, 9)], radius=0.3)]), "obstacle 0 is at the start of 'amr' at 'dock'"),
])
def test_no_plan_is_an_outcome(make, why, tmp_path):
    made = make()
    assert_no_plan(made, why)
    assert len(made) == len(made.names) == len(made.starts) == len(made.bodies)
    with pytest.raises(q.NoPlanError):
        made.save(tmp_path / "i.json")
    with pytest.raises(ValueError, match="system"):
        q.solve(made, system="cbs")
    seen = []
    assert q.solve(made, progress=seen.append, on_plan=seen.append, known_bound=1, time_limit=1).status == "infeasible"


def test_violations_are_told_in_names():
    made = fleet(["dock", "desk"], ["desk", "dock"])
    broken = made.plan([["dock", "hall", "desk"], ["desk", "hall", "dock"]]).verify()
    assert "'amr' and 'cart' collide" in broken.violations[0].message and "agent" not in broken.violations[0].message
    away = made.plan([["dock", "hall"], ["desk"]]).verify()
    messages = " ".join(violation.message for violation in away.violations)
    assert "'amr'" in messages and "agent " not in messages and "vertex " not in messages, messages
    steps = q.Fleet(GRID, [(0, 0), (1, 0)], [(1, 0), (0, 0)], names=["amr", "cart"])
    swap = steps.plan([[(0, 0), (1, 0)], [(1, 0), (0, 0)]]).verify()
    assert swap.violations[0].message.startswith("'amr' and 'cart'")
    # Without names they are called by their numbers.
    assert q.Fleet(GRID, [(0, 0)], [(1, 0)]).plan([[(0, 0)]]).verify().violations[0].message.startswith("agent 0")


@pytest.mark.parametrize("make, message", [
    (lambda: q.Executor(fleet(["dock", "hall"], ["hall", "desk"]).plan([["dock", "hall"], ["hall"]])), "'cart'"),
    (lambda: q.Executor(fleet().plan([["dock"]])), "'amr'"),
    (lambda: q.simulate(fleet().plan([["dock", "hall", "desk"]]), "coupeled"), "rule: 'coupeled' is not naive, gated or coupled"),
    (lambda: fleet().plan([["dock", "desk"]]), "'amr', stop 1: no edge leads there from the stop before"),
    (lambda: fleet().plan(["dock"]), "no vertex called"),
    (lambda: q.solve(fleet()).plan["arm"], "there is no agent called 'arm'"),
    (lambda: q.solve(fleet()).plan.to_vda5050(version="2"), "version: '2' is not 3.0, 2.1 or 2.0"),
    (lambda: q.Dispatcher(q.Fleet(GRID, [(0, 0)], [(1, 0)])), "a Dispatcher needs a roadmap"),
    (lambda: q.Dispatcher(fleet()).assign("amr", "attic"), "amr"),
    (lambda: q.Dispatcher(fleet()).report("amr", 5), "clock"),
])
def test_mistakes_with_plans_and_live_fleets(make, message):
    with pytest.raises(ValueError) as raised:
        make()
    assert message in str(raised.value), raised.value
    assert "agent 0" not in str(raised.value), raised.value


def test_files_without_a_plan_end_as_in_the_program(tmp_path):
    file = tmp_path / "i.json"
    fleet(["dock", "hall"], ["desk", "dock"]).save(file)
    instance = json.loads(file.read_text())
    instance["agents"][1]["start"] = instance["agents"][0]["start"]
    file.write_text(json.dumps(instance))
    done = run_program("solve", "--instance", file, "--quiet", "--json", "-")
    assert done.returncode == 20
    unread = q.read(file)
    assert q.solve(unread).status == json.loads(done.stdout)["status"] == "infeasible"
    assert q.solve(unread).explanation == json.loads(done.stdout)["explanation"]
    assert "has no plan" in repr(unread)
    for ask in (len, lambda f: f.graph, lambda f: f.names, lambda f: f.starts, lambda f: f.save(tmp_path / "j.json")):
        with pytest.raises(q.NoPlanError, match="overlap"):
            ask(unread)


def test_files_without_bodies_are_told():
    cells, tasks = SOURCE / "tests/data/roadmaps/cells.xml", SOURCE / "tests/data/roadmaps/tasks.xml"
    with pytest.warns(q.BodyWarning, match=r"discs of radius sqrt\(2\)/4; give a radius"):
        assert len(q.read(cells, tasks, agents=1)) == 1
