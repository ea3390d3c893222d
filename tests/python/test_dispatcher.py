# SPDX-License-Identifier: MIT
"""Live fleets, and moves in progress that are told exactly."""

import copy
import random

import numpy as np
import pytest
from conftest import scaled

import quadrille as q


def crossings(**kwargs):
    xy = [(5 * (i % 4), 5 * (i // 4)) for i in range(12)]
    edges = [(i, i + 1) for i in range(12) if i % 4 < 3] + [(i, i + 4) for i in range(8)]
    return q.Roadmap(xy, edges, both_ways=True, **kwargs)


def standing(starts=(0, 1, 2, 3), **kwargs):
    return q.Fleet(crossings(), list(starts), list(starts), radius=0.6, **kwargs)


def least_distance(before, after):
    """Of two points that go straight from one time to the other: each float[2, 2]."""
    start, way = before[1] - before[0], (after[1] - after[0]) - (before[1] - before[0])
    square = float(way @ way)
    share = min(1.0, max(0.0, -float(start @ way) / square)) if square > 0 else 0.0
    return float(np.linalg.norm(start + share * way))


def test_robots_that_are_late_never_touch():
    dispatcher, draw = q.Dispatcher(standing(), effort=0.005, improves=False), random.Random(1)
    served = 0
    for _ in range(400):
        for robot in range(4):
            if dispatcher.num_tasks(robot) == 0:
                dispatcher.assign(robot, draw.randrange(12), service=draw.random())
        orders = dispatcher.tick(0.5)
        served += len(orders.served)
        assert orders.gap_percent >= 0
        clocks = [dispatcher.clock(robot) for robot in range(4)]
        places = [dispatcher.at(robot, clocks[robot]) for robot in range(4)]
        is_late = [draw.random() < 0.3 for _ in range(4)]
        for _ in range(5):
            for robot in range(4):
                if not is_late[robot]:
                    clocks[robot] = min(clocks[robot] + 0.1, dispatcher.limit(robot))
            after = [dispatcher.at(robot, clocks[robot]) for robot in range(4)]
            for i in range(4):
                for j in range(i):
                    pair = np.array([places[i], places[j]]), np.array([after[i], after[j]])
                    assert least_distance(*pair) > 1.2 - 1e-6
            places = after
        for robot in range(4):
            dispatcher.report(robot, clocks[robot])
    assert served > 20


def test_first_tasks_names_and_turns():
    fleet = q.Fleet(crossings(), [0, 3], [3, 0], radius=0.6, names=["amr", "agv"])
    dispatcher = q.Dispatcher(fleet)
    assert len(dispatcher) == 2
    assert dispatcher.num_tasks("amr") == 1
    dispatcher.assign("agv", [5, 6], service=1, deadline=60)
    served = []
    for _ in range(200):
        served += dispatcher.tick(0.5).served
        for robot in range(2):
            dispatcher.report(robot, dispatcher.limit(robot))
    assert sorted(served) == [0, 1, 1]
    stops = dispatcher.course("agv")
    assert stops["source"][-1] in (5, 6) and stops["source"][-1] == stops["target"][-1]
    assert dispatcher.now == pytest.approx(100)
    with pytest.raises(ValueError):
        stops["arrive"] = 0


def test_what_makes_no_sense_is_refused():
    dispatcher = q.Dispatcher(standing())
    with pytest.raises(q.InputError, match="there is no vertex 12 among 12"):
        dispatcher.assign(0, 12)
    with pytest.raises(IndexError, match="there is no agent 4 among 4"):
        dispatcher.assign(4, 0)
    with pytest.raises(q.InputError, match="there is no agent called 'x'"):
        dispatcher.clock("x")
    with pytest.raises(q.InputError, match="1 is beyond 0, as far as the agent was allowed to go"):
        dispatcher.report(0, 1)
    with pytest.raises(q.InputError, match="time has to go on"):
        dispatcher.tick(0)
    with pytest.raises(q.InputError, match="a Dispatcher needs a roadmap; on grids and graphs there is GridDispatcher"):
        q.Dispatcher(q.Fleet(q.Grid(np.ones((2, 2), dtype=bool)), [(0, 0)], [(1, 0)]))
    with pytest.raises(q.InputError, match="in the middle of a move"):
        q.Dispatcher(q.Fleet(crossings(), [q.Underway(0, 1, 0.5)], [1], radius=0.6))


def test_what_is_not_heeded_is_refused():
    fleet = dict(radius=0.6, names=["amr", "agv"])
    for more, why in (
        (dict(whole_moves=True), "plans for whole moves are not supported here"),
        (dict(now=5), "a live fleet begins at time 0"),
        (dict(release=[0, 4]), "'agv' is released later"),
        (dict(leaves=[True, False]), "'amr' leaves at its goal"),
        (dict(obstacles=[q.Obstacle([(90, 90, 0, 1)], radius=1)]), "they wait for nobody"),
    ):
        with pytest.raises(q.InputError, match=why):
            q.Dispatcher(q.Fleet(crossings(), [0, 3], [1, 2], **fleet, **more))
    graph = q.Graph(3, [(0, 1), (1, 2)])
    for more, why in ((dict(now=5), "begin at timestep 0"), (dict(whole_moves=True), "know no rules")):
        with pytest.raises(q.InputError, match=why):
            q.GridDispatcher(q.Fleet(graph, [0], [2], **more))


@pytest.mark.parametrize("urgent", [False, True])
def test_deadlines_of_first_tasks_are_heeded(urgent):
    fleet = q.Fleet(crossings(), [0, 2], [1, 2], radius=0.6, deadline=[50, np.nan] if urgent else None)
    dispatcher = q.Dispatcher(fleet)
    dispatcher.assign(1, 1, deadline=60)  # the same place: one after the other
    dispatcher.tick(0.5)
    assert [dispatcher.course(agent)["source"][-1] for agent in range(2)] == ([1, 2] if urgent else [0, 1])


def test_who_obeys_the_order_needs_no_limits():
    waits = 0
    for seed in range(scaled(8)):
        dispatcher, draw = q.Dispatcher(standing(), effort=0.005, improves=False), random.Random(seed)
        for robot, goal in enumerate(draw.sample(range(4), 4)):
            dispatcher.assign(robot, goal)
        for _ in range(draw.randrange(1, 6)):
            dispatcher.tick(0.5)
            for robot in range(4):
                dispatcher.report(robot, dispatcher.limit(robot) if draw.random() < 0.7 else dispatcher.clock(robot))
        order = dispatcher.order()
        after = [(order.nodes[a], order.nodes[b], a[0], b[0], kind["slack"])
                 for a, b, kind in order.edges(data=True) if kind["kind"] == "after"]
        courses = [dispatcher.course(robot) for robot in range(4)]
        for robot, move in order.nodes:
            end = order.nodes[robot, move]["end"]
            assert order.nodes[robot, move]["target"] in courses[robot]["target"][courses[robot]["arrive"] == end]
        clocks, ends = [dispatcher.clock(robot) for robot in range(4)], [c["arrive"][-1] for c in courses]
        places = [dispatcher.at(robot, clocks[robot]) for robot in range(4)]
        for step in range(2000):
            if all(clock >= end for clock, end in zip(clocks, ends)):
                break
            now = list(clocks)
            for robot in range(4):
                if draw.random() < 0.4 or robot == seed % 4 and step < 100:
                    continue
                clocks[robot] = min(now[robot] + 0.25, ends[robot])
                for leader, follower, first, second, slack in after:
                    most = max(follower["begin"], now[first] + slack)
                    if second == robot and now[first] < leader["end"] and most < follower["end"]:
                        waits += clocks[robot] > most
                        clocks[robot] = max(now[robot], min(clocks[robot], most))
            moved = [dispatcher.at(robot, clocks[robot]) for robot in range(4)]
            for i in range(4):
                for j in range(i):
                    pair = np.array([places[i], places[j]]), np.array([moved[i], moved[j]])
                    assert least_distance(*pair) > 1.2 - 1e-6
            places = moved
        assert all(clock >= end for clock, end in zip(clocks, ends))
    assert waits > 0


def test_the_order_of_a_grid_is_that_of_its_paths():
    fleet = q.Fleet(q.Grid(np.ones((4, 4), dtype=bool)), [(0, 0), (3, 0), (0, 3)], [(3, 3), (0, 2), (2, 0)])
    dispatcher = q.GridDispatcher(fleet, effort=0.002, window=8)
    dispatcher.tick(held=[1])
    order, compared = dispatcher.order(), 0
    for agent in range(3):
        path, number = dispatcher.path(agent).tolist(), 0
        for step, (before, after) in enumerate(zip(path, path[1:])):
            if before == after:
                continue
            move = order.nodes[agent, number]
            assert (move["begin"], move["end"]) == (dispatcher.now + step, dispatcher.now + step + 1)
            assert (move["source"], move["target"]) == (before[0] + 4 * before[1], after[0] + 4 * after[1])
            number, compared = number + 1, compared + 1
    assert compared == len(order) > 6


def test_lanes_are_closed():
    dispatcher = q.Dispatcher(standing(), effort=0.005, improves=False)
    dispatcher.assign(0, 8)
    dispatcher.tick(0.5)
    for source, target in ((4, 8), (9, 8)):
        dispatcher.close(source, target)
    served = []
    for _ in range(100):
        served += dispatcher.tick(0.5).served
        for robot in range(4):
            dispatcher.report(robot, dispatcher.limit(robot))
    assert not served and dispatcher.course(0)["source"][-1] != 8
    dispatcher.open(9, 8)
    for _ in range(100):
        served += dispatcher.tick(0.5).served
        for robot in range(4):
            dispatcher.report(robot, dispatcher.limit(robot))
    assert served == [0]
    with pytest.raises(q.InputError, match="is closed already"):
        dispatcher.close(4, 8)
    with pytest.raises(q.InputError, match="there is not the lane"):
        dispatcher.open(0, 7)


def test_grids():
    free = np.ones((5, 6), dtype=bool)
    free[2, 1:4] = False
    fleet = q.Fleet(q.Grid(free), [(0, 0), (5, 0), (0, 4), (5, 4)], [(5, 0), (0, 0), (0, 4), (5, 4)],
                    names=["a", "b", "c", "d"])
    dispatcher, draw = q.GridDispatcher(fleet, effort=0.002, window=8), random.Random(1)
    assert len(dispatcher) == 4 and dispatcher.num_tasks("a") == 1 and dispatcher.num_tasks("c") == 0
    dispatcher.close((2, 0), (3, 0))
    served, before = 0, dispatcher.places
    for step in range(150):
        for agent in range(4):
            if dispatcher.num_tasks(agent) == 0:
                dispatcher.assign(agent, [(draw.randrange(6), 0), (5, draw.randrange(5))], service=1)
        held = [agent for agent in "abcd" if draw.random() < 0.1]
        orders = dispatcher.tick(held)
        served += len(orders.served)
        places = dispatcher.places
        assert dispatcher.now == step + 1 and len({tuple(place) for place in places}) == 4
        assert np.abs(places - before).sum(axis=1).max() <= 1 and free[places[:, 1], places[:, 0]].all()
        for who, agent in enumerate("abcd"):
            assert agent not in held or tuple(places[who]) == tuple(before[who])
            assert {tuple(places[who]), tuple(before[who])} != {(2, 0), (3, 0)}
        before = places
    assert served > 30
    assert dispatcher.path("a").shape == (8, 2) and tuple(dispatcher.path("a")[0]) == tuple(places[0])
    dispatcher.open((3, 0), (2, 0))
    dispatcher.cancel("a")
    assert dispatcher.num_tasks("a") == 0
    with pytest.raises(q.InputError, match="is blocked, or outside"):
        dispatcher.assign(0, (1, 2))
    with pytest.raises(q.InputError, match="is not closed"):
        dispatcher.open((3, 0), (2, 0))
    with pytest.raises(q.InputError, match="at least one timestep"):
        q.GridDispatcher(fleet, window=0)
    with pytest.raises(q.InputError, match="on roadmaps there is Dispatcher"):
        q.GridDispatcher(standing())
    with pytest.raises(TypeError, match="a GridDispatcher has a state of its own"):
        copy.copy(dispatcher)
    graph = q.GridDispatcher(q.Fleet(q.Graph(3, [(0, 1), (1, 2)]), [0], [2]))
    assert [int(place) for _ in range(3) for place in (graph.tick(), graph.places)[1]] == [1, 2, 2]


def test_moves_are_told_by_when_they_began():
    roads = q.Roadmap([(0, 0), (5, 0)], [(0, 1)])
    fleet = q.Fleet(roads, [q.Underway(0, 1, begun=-1.25)], [1], radius=0.3)
    assert q.solve(fleet).cost == pytest.approx(3.75)
    later = q.Fleet(roads, [q.Underway(0, 1, begun=98)], [1], radius=0.3, now=100)
    plan = q.solve(later).plan
    assert plan[0].cost == pytest.approx(3)
    again = plan.start_at(0, 101)
    assert (again.source, again.target) == (0, 1)
    assert again.fraction == pytest.approx(0.6)
    with pytest.raises(q.InputError, match="began its move at 90, and is not within it at 100: it takes 5"):
        q.Fleet(roads, [q.Underway(0, 1, begun=90)], [1], radius=0.3, now=100)


def test_who_stands_within_its_lane_may_wait():
    roads = q.Roadmap([(0, 0), (5, 0), (5, 5), (10, 0)], [(0, 1), (1, 2), (1, 3)])

    def solved(may_wait):
        start = q.Underway(0, 1, begun=-3.5, may_wait=may_wait)
        return q.solve(q.Fleet(roads, [start, 1], [3, 2], radius=0.5, release=[0, 4]))

    assert solved(False).status == "infeasible"
    plan = solved(True).plan
    assert plan[0].stops["depart"][0] > 3
    assert plan.start_at(0, 1).may_wait
    assert not plan.start_at(0, plan[0].stops["depart"][0] + 0.5).may_wait
    assert copy.copy(plan.start_at(0, 1)) == plan.start_at(0, 1)
