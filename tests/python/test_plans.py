# SPDX-License-Identifier: MIT
"""What one asks of plans: by name, where an agent is, plans of one's own; and that nothing of it changes."""

import copy
import pickle

import numpy as np
import pytest
from conftest import random_grid_fleet, random_roadmap_fleet, scaled
from test_execution import ROADS, siding

import quadrille as q


def test_agents_have_names():
    plan = q.solve(siding()).plan
    assert plan["fast"].name == plan[1].name == plan[-1].name == "fast"
    assert plan.names == ["slow", "fast"] and plan.start_at("slow", 0) == "west"
    assert plan.to_svg(agents=["fast"]) == plan.to_svg(agents=[1])
    for agent in ("quick", "0"):
        with pytest.raises(q.InputError, match=f"there is no agent called '{agent}'"):
            plan[agent]
    with pytest.raises(IndexError, match="there is no agent 2 among 2"):
        plan[2]
    with pytest.raises(TypeError):
        plan[0.0]
    steps = q.solve(q.Fleet(q.Grid([[1, 1]]), [(0, 0)], [(1, 0)], names=["amr1"])).plan
    assert steps["amr1"].cost == 1


def test_where_an_agent_is_and_why_it_is_late():
    plan = q.solve(siding()).plan
    assert plan["slow"].free_cost == pytest.approx(2) and plan["fast"].free_cost == pytest.approx(1)
    assert plan.delay == pytest.approx(plan.sum_of_costs - 3) and plan.delay > 0
    for path in plan:
        assert path.delay == pytest.approx(path.cost - path.free_cost)
        times = np.linspace(-1, plan.makespan + 1, 97)
        places = np.array([path.at(time) for time in times])
        stops = path.stops
        knots = np.stack([stops["arrive"], stops["depart"]], axis=1).ravel()
        for axis, name in enumerate("xy"):
            assert places[:, axis] == pytest.approx(np.interp(times, knots, np.repeat(stops[name], 2)))
        for time in times:
            ahead = (path.at(time + 1e-7) - path.at(time)) / 1e-7
            assert path.velocity(time) == pytest.approx(ahead, abs=1e-4)
        assert sum(wait.end - wait.begin for wait in path.waits()) == pytest.approx(
            sum(stop["depart"] - stop["arrive"] for stop in stops[:-1]))
        assert all(wait.place in ROADS.nodes for wait in path.waits())
        assert (path.at(-5) == path.at(0)).all() and not path.at(0).flags.writeable


def test_the_same_in_timesteps():
    for seed in range(scaled(30)):
        fleet = random_grid_fleet(seed)
        plan = q.solve(fleet).plan
        if plan is None:
            continue
        for agent, path in enumerate(plan):
            alone = q.solve(q.Fleet(fleet.graph, fleet.starts[[agent]], fleet.goals[[agent]])).cost
            assert (path.free_cost, path.delay) == (alone, path.cost - alone)
            stays = sum((plan.paths[agent, t] == plan.paths[agent, t + 1]).all() for t in range(path.cost))
            assert sum(wait.end - wait.begin for wait in path.waits()) == stays
            for t in range(path.cost):
                middle = (plan.paths[agent, t] + plan.paths[agent, t + 1]) / 2
                assert path.at(t + 0.5).tolist() == middle.tolist()


def test_plans_of_ones_own_on_roadmaps():
    fleet = siding()
    # The slow one waits in the west, where the fast one goes to.
    met = fleet.plan([[("west", 2.0), "cross", "east"], ["east", "cross", "west"]])
    assert not met.verify()
    late = fleet.plan([["west", "cross", ("bay", 4.0), "cross", "east"], [("east", 2.0), "cross", "west"]])
    assert late.verify(), late.verify().violations
    assert late.costs.tolist() == pytest.approx([5.8, 3.0])
    assert late["slow"].waits() == [q.Wait("bay", 1.8, 4.0)]
    assert q.solve(fleet, initial=late).status == "optimal"
    assert len(late.precedences()) == 6 and q.Executor(late).limits([0, 0]).shape == (2,)
    # What a plan says of itself gives it again.
    best = q.solve(fleet).plan
    assert fleet.plan([path.stops for path in best]) == best
    assert fleet.plan([[(path.places[k], s["arrive"], s["depart"]) for k, s in enumerate(path.stops)] for path in best]) == best
    for wrong, why in (
        ([["west"]], "1 paths for 2 agents"),
        ([["west", "east"], ["east"]], "'slow', stop 1: no edge leads there"),
        ([["west", "nowhere"], ["east"]], "no vertex called 'nowhere'"),
        ([[], ["east"]], r"paths\[0\]: a path has at least one stop"),
        ([[("west", 0, 0, 0)], ["east"]], "a stop is a vertex"),
        ([[("west", -3)], ["east"]], "negative, or too late"),
    ):
        with pytest.raises(q.InputError, match=why):
            fleet.plan(wrong)


def test_plans_of_ones_own_are_those_of_solve():
    for seed in range(scaled(40)):
        fleet = random_roadmap_fleet(seed)
        plan = None if fleet is None else q.solve(fleet).plan
        if plan is not None:
            again = fleet.plan([path.stops for path in plan])
            assert again == plan and again.verify()


def same(a, b):
    assert type(a) is type(b)
    assert a.names == b.names and len(a) == len(b) and a.now == b.now
    if isinstance(a, q.Fleet):
        for name in ("starts", "releases", "leaves"):
            assert (getattr(a, name) == getattr(b, name)).all()
        assert [g.tolist() for g in a.goal_sets] == [g.tolist() for g in b.goal_sets]


def test_pickles_and_copies():
    fleets = [random_grid_fleet(seed) for seed in range(scaled(20))]
    fleets += [f for f in (random_roadmap_fleet(seed) for seed in range(scaled(20))) if f is not None]
    fleets.append(siding(release=[0.5, 0], deadline=[None, 90], leaves=[True, False], now=0.25))
    fleets.append(q.Fleet(ROADS, [q.Underway("west", "cross", 0.4), "east"], ["east", ["west", "bay"]], radius=0.2))
    fleets.append(q.Fleet(q.Graph(3, [(0, 1), (1, 2)]), [0], [2], names=["a"], now=4, robust=1))
    for fleet in fleets:
        again = pickle.loads(pickle.dumps(fleet))
        same(fleet, again)
        a, b = q.solve(fleet), q.solve(again)
        assert (a.status, a.cost) == (b.status, b.cost)
        assert copy.deepcopy(fleet) is fleet
        if a.plan is None:
            continue
        assert a.plan._content() == b.plan._content()
        c = pickle.loads(pickle.dumps(a.plan))
        same(a.plan, c)
        assert c == a.plan and c.verify()
        assert pickle.loads(pickle.dumps(a)).plan == a.plan
        assert copy.deepcopy(a.plan) is a.plan and copy.copy(fleet) is fleet


def test_places_and_fleets_without_a_plan_are_pickled(tmp_path):
    poses = q.Grid([[1, 1, 0], [1, 1, 1]]).with_headings(turn=2)
    again = pickle.loads(pickle.dumps(poses))
    assert again.nodes == poses.nodes and again.turn == 2 and (again.edges == poses.edges).all()
    assert (again.durations == poses.durations).all() and (again.xy == poses.xy).all()
    roads = q.Roadmap([(0, 0, 1), (4, 0, 2.5)], [(0, 1)], durations=[2.25], only=["small"], nodes=["a", ("b", 1)])
    again = pickle.loads(pickle.dumps(roads))
    assert (again.xy == roads.xy).all() and again.durations.tolist() == [2.25]
    assert again.only == [("small",)] and again.nodes == ["a", ("b", 1)] and again.resolution == roads.resolution
    grid = pickle.loads(pickle.dumps(q.Grid([[1, 0], [1, 1]])))
    assert grid.free.tolist() == [[True, False], [True, True]] and not grid.free.flags.writeable
    hopeless = siding(deadline=0.5)
    again = pickle.loads(pickle.dumps(hopeless))
    assert again.no_plan == hopeless.no_plan and q.solve(again).status == "infeasible"
    for living in (q.Executor(q.solve(siding()).plan), q.Session(ROADS)):
        for copied in (copy.copy, copy.deepcopy, pickle.dumps):
            with pytest.raises(TypeError):
                copied(living)


def test_nothing_that_comes_out_can_be_written_to():
    fleet = siding()
    for plan in (q.solve(fleet).plan, pickle.loads(pickle.dumps(q.solve(fleet).plan))):
        path, report = plan[0], plan.verify()
        arrays = [path.stops, path.ticks, plan.costs, plan.sample(3), report.clearances, fleet.starts, fleet.goals,
                  fleet.speeds, fleet.releases, fleet.deadlines, fleet.leaves, fleet.under_way, ROADS.xy, ROADS.units,
                  ROADS.edges, ROADS.durations, plan.obstacle(0).path, pickle.loads(pickle.dumps(path)).stops]
        for array in arrays:
            assert not array.flags.writeable
            with pytest.raises(ValueError):
                array[...] = array
    steps = q.solve(random_grid_fleet(1)).plan
    for plan in (steps, copy.deepcopy(steps), pickle.loads(pickle.dumps(steps))):
        for array in (plan.paths, plan[0].places, plan.costs, plan.sample(2)):
            assert not array.flags.writeable
