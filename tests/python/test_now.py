# SPDX-License-Identifier: MIT
"""Fleets that begin at another moment than 0: all is as from 0, but for the times."""

import numpy as np
import pytest
from conftest import assert_no_plan, need, random_grid_fleet, run_program, scaled
from test_rules import random_fleet

import quadrille as q

ROADS = q.Roadmap([(0, 0), (4, 0), (8, 0)], [(0, 1), (1, 2)], both_ways=True, nodes="abc", resolution=(0.001, 0.01))


def robot(start="a", **more):
    return q.Fleet(ROADS, [start], ["c"], radius=0.3, names=["amr"], **more)


def later_by(fleet, now):
    """The same fleet, all of whose times are later."""
    graph = fleet.graph
    if not isinstance(graph, q.Roadmap):
        return q.Fleet(graph, fleet.starts, fleet.goals, now=fleet.now + now)
    obstacles = [
        q.Obstacle(o.path + np.array([0, 0, now, now]), radius=o.radius, polygon=o.polygon, leaves=o.leaves)
        for o in fleet.obstacles
    ]
    return q.Fleet(graph, fleet.starts, fleet.goals, radius=fleet.bodies, group=fleet.groups,
                   release=fleet.releases + now, deadline=fleet.deadlines + now, leaves=fleet.leaves,
                   obstacles=obstacles, now=fleet.now + now)


def test_timesteps(tmp_path):
    solved = 0
    for seed in range(scaled(60)):
        fleet = random_grid_fleet(seed)
        later = later_by(fleet, 120)
        assert (fleet.now, later.now) == (0, 120)
        told = []
        ours, theirs = q.solve(later, on_plan=told.append, plan_interval=0), q.solve(fleet)
        assert (ours.status, ours.cost, ours.lower_bound) == (theirs.status, theirs.cost, theirs.lower_bound), seed
        if ours.plan is None:
            continue
        solved += 1
        plan = ours.plan
        assert all(one.now == 120 for one in told) and (plan.now, theirs.plan.now) == (120, 0)
        assert np.array_equal(plan.paths, theirs.plan.paths) and np.array_equal(plan.costs, theirs.plan.costs)
        assert plan.makespan == theirs.plan.makespan and plan != theirs.plan
        assert np.array_equal(plan.sample(4), theirs.plan.sample(4))
        assert plan.verify() and later.plan(plan.paths) == plan
        plan.save(tmp_path / "p.json")
        assert later.read_plan(tmp_path / "p.json") == plan
        assert q.solve(later, initial=plan).cost == ours.cost
        with pytest.raises(q.InputError, match="initial plan"):
            q.solve(later, initial=theirs.plan)
        later.save(tmp_path / "i.json")
        assert q.read(tmp_path / "i.json").now == 120
        assert run_program("verify", "--instance", tmp_path / "i.json", tmp_path / "p.json").returncode == 0
    assert solved > 20 or scaled(60) < 60


def test_roadmaps():
    solved = 0
    for seed in range(scaled(60)):
        fleet = random_fleet(seed)
        if fleet is None or fleet.under_way.any():
            continue
        later = later_by(fleet, 1000)
        assert later.now == pytest.approx(fleet.now + 1000) and later.no_plan is None
        ours, theirs = q.solve(later, conflict_limit=300), q.solve(fleet, conflict_limit=300)
        assert (ours.status, ours.cost, ours.lower_bound) == (theirs.status, theirs.cost, theirs.lower_bound), seed
        if ours.plan is None:
            continue
        solved += 1
        assert ours.plan.verify() and ours.plan.now == later.now
        assert np.array_equal(ours.plan.costs, theirs.plan.costs)
        for path, other in zip(ours.plan, theirs.plan):
            assert path.cost == other.cost
            assert np.array_equal(path.ticks["arrive"], other.ticks["arrive"] + 100_000)
        assert np.allclose(ours.plan.sample(7), theirs.plan.sample(7), atol=1e-6)
    assert solved > 10 or scaled(60) < 60


def test_tables_and_precedences():
    fleet = q.Fleet(q.Grid(np.ones((2, 3), bool)), [(0, 0), (2, 0)], [(2, 0), (0, 0)], now=50)
    plan = q.solve(fleet).plan
    need("networkx")
    graph = plan.precedences()
    assert min(begin for _, begin in graph.nodes(data="begin")) == 50
    assert max(end for _, end in graph.nodes(data="end")) == 50 + plan.makespan
    need("pandas")
    table = plan.to_pandas()
    assert table.t.min() == 50 and table.t.max() == 50 + plan.makespan
    assert q.solve(robot(now=5)).plan.to_pandas().arrive.tolist() == [5, 9, 13]


def test_plans_are_made_again_while_robots_are_under_way():
    first = q.solve(robot(now=100)).plan
    assert first[0].cost == first.makespan == 8 and first[0].stops["arrive"].tolist() == [100, 104, 108]
    assert first.start_at(0, 99) == "a" and first.start_at(0, 104) == "b"
    again = robot(first.start_at(0, 103), now=103, obstacles=[])
    assert again.under_way.all() and again.now == 103
    second = q.solve(again).plan
    assert second[0].stops["arrive"].tolist() == [103, 104, 108] and second[0].cost == 5
    assert second.start_at(0, 103.5) == q.Underway("a", "b", pytest.approx(0.875))
    # What it does is an obstacle for others at the same times.
    assert np.asarray(second.obstacle(0).path)[:, 2].tolist() == [103, 104, 108]


def test_what_is_asked_before_it_begins():
    # A release before then says nothing, and obstacles only where they are by then.
    assert q.solve(robot(now=100, release=50)).cost == 8 and q.solve(robot(now=100, release=101)).cost == 9
    gone = q.Obstacle([(0, 0, 0, 50)], radius=0.3, leaves=True)
    assert q.solve(robot(now=100, obstacles=[gone])).cost == 8
    there = q.Obstacle([(0, 0, 0, 150)], radius=0.3, leaves=True)
    assert_no_plan(robot(now=100, obstacles=[there]), "obstacle 0 is at the start of 'amr' at 'a'")
    assert_no_plan(robot(now=100, deadline=105), "'amr' cannot arrive before 108, and its deadline is 105")
    assert robot(now=100, deadline=105).now == 100


def test_formats_that_cannot_say_it(tmp_path):
    fleet = q.Fleet(q.Grid(np.ones((1, 3), bool)), [(0, 0)], [(2, 0)], now=3)
    for what, name in ((fleet, "i.yaml"), (q.solve(fleet).plan, "p.yaml"), (q.solve(robot(now=3)).plan, "p.xml")):
        with pytest.raises(q.InputError):
            what.save(tmp_path / name)


@pytest.mark.parametrize("now, message", [
    (-1, "now: the fleet begins at timestep -1, not 0 .. 1000000000"),
    (2**40, "now: the fleet begins at timestep 1099511627776, not 0 .. 1000000000"),
    (0.5, "now: expected integers, not float64"),
    ([1], "now: expected an array of shape (), not (1,)"),
])
def test_moments_that_are_none_in_timesteps(now, message):
    with pytest.raises(ValueError) as raised:
        q.Fleet(q.Grid([[1, 1]]), [(0, 0)], [(1, 0)], now=now)
    assert str(raised.value) == message


@pytest.mark.parametrize("now, message", [
    (-1, "now: the fleet begins at -1, which is negative, or too late"),
    (1e300, "now: the fleet begins at 1e+300, which is negative, or too late"),
    (float("nan"), "now: the time at which the fleet begins is not a number"),
    ("soon", "now: expected numbers, not <U4"),
])
def test_moments_that_are_none_on_roadmaps(now, message):
    with pytest.raises(ValueError) as raised:
        robot(now=now)
    assert str(raised.value) == message
