# SPDX-License-Identifier: MIT
"""Sessions: what they answer is what solve answers for the fleet as it is."""

import random

import pytest
from conftest import scaled
from test_execution import ROADS

import quadrille as q


def roads():
    xy = [(2 * (i % 4), 2 * (i // 4)) for i in range(12)]
    edges = [(i, i + 1) for i in range(12) if i % 4 < 3] + [(i, i + 4) for i in range(8)]
    return q.Roadmap(xy, edges, both_ways=True, resolution=0.001)


def test_answers_are_those_of_solve():
    compared = 0
    for seed in range(scaled(15)):
        draw, session = random.Random(seed), q.Session(roads())
        closed = set()
        for k in range(10):
            what = draw.randrange(5)
            if what == 0 and len(session) < 4 or len(session) == 0:
                session.add(f"robot {k}", draw.randrange(12), draw.randrange(12), radius=0.4, speed=draw.choice([1, 2]))
            elif what == 1 and len(session) > 1:
                session.remove(draw.choice(session.names))
            elif what == 2:
                u, v = draw.choice(roads().edges.tolist())
                if (u, v) in closed:
                    session.open(u, v)
                else:
                    session.close(u, v)
                closed ^= {(u, v)}
            elif what == 3:
                session.change(draw.choice(session.names), goals=[draw.randrange(12), draw.randrange(12)])
            else:
                start = q.Underway(*draw.choice(roads().edges.tolist()), draw.random())
                session.change(draw.choice(session.names), start=start)
            result, fresh = session.solve(), q.solve(session.fleet())
            assert (result.status, result.cost, result.lower_bound) == (fresh.status, fresh.cost, fresh.lower_bound)
            assert session.fleet().names == session.names
            if result.plan is not None:
                compared += 1
                assert result.plan.verify() and result.plan.names == session.names
    assert compared > 0


def test_grids_answer_like_solve_while_time_passes():
    compared = moments = 0
    for seed in range(scaled(15)):
        draw = random.Random(seed)
        grid = q.Grid([[draw.random() < 0.85 for _ in range(5)] for _ in range(5)])
        free = [(x, y) for y in range(5) for x in range(5) if grid.free[y][x]]
        session = q.Session(grid, now=seed % 3, whole_moves=seed % 4 == 0)
        for k, start in enumerate(draw.sample(free, 3)):
            session.add(f"robot {k}", start, draw.choice(free), leaves=draw.random() < 0.3)
        for _ in range(8):
            if len(session) > 0 and draw.random() < 0.5:
                session.change(draw.choice(session.names), goals=[draw.choice(free)])
            try:
                fleet = session.fleet()
            except q.InputError:  # two at one goal
                with pytest.raises(q.InputError):
                    session.solve()
                session.change(draw.choice(session.names), goals=[draw.choice(free)])
                continue
            result, fresh = session.solve(), q.solve(fleet)
            assert (result.status, result.cost, result.lower_bound) == (fresh.status, fresh.cost, fresh.lower_bound)
            compared += 1
            if result.plan is not None:
                assert result.plan.verify() and result.plan.names == session.names
                now = int(fleet.now) + draw.randrange(4)
                session.advance_to(now, result.plan)
                assert all(start in free for start in map(tuple, session.fleet().starts.tolist()))
                moments += 1
    assert compared > 0 and moments > 0


def test_grids_close_and_refuse():
    session = q.Session(q.Graph(3, [(0, 1), (1, 2)]))
    session.add("a", 0, 2)
    assert session.solve().cost == 2
    session.close(1)
    assert session.solve().status == "infeasible"
    session.open(1)
    session.close(2, 1)
    assert session.solve().status == "infeasible"
    with pytest.raises(q.InputError, match="closed already"):
        session.close(1, 2)
    session.open(1, 2)
    plan = session.solve().plan
    session.advance_to(1, plan)
    assert session.fleet().starts.tolist() == [1] and session.solve().cost == 1
    with pytest.raises(q.InputError, match="time goes back from 1 to 0"):
        session.advance_to(0, plan)
    with pytest.raises(q.InputError, match="an agent called 'a' already"):
        session.add("a", 0, 2)
    with pytest.raises(TypeError, match="has no 'radius'"):
        session.change("a", radius=1)


def test_whole_moves():
    grid = q.Fleet(q.Graph(3, [(0, 1), (1, 2)]), [0, 1], [1, 2], whole_moves=True)
    assert grid.whole_moves and q.solve(grid).cost == 3
    roads = q.Roadmap([(0, 0), (1, 0), (2, 0), (3, 0)], [(0, 1), (1, 2), (2, 3)])
    for whole, cost in ((False, 4), (True, 5)):
        fleet = q.Fleet(roads, [0, 1], [2, 3], radius=0.1, whole_moves=whole)
        assert fleet.whole_moves == whole and q.solve(fleet).cost == pytest.approx(cost)
        session = q.Session(roads, whole_moves=whole)
        for name, start, goal in (("a", 0, 2), ("b", 1, 3)):
            session.add(name, start, goal, radius=0.1)
        assert session.solve().cost == pytest.approx(cost)


def test_names_and_mistakes():
    session = q.Session(ROADS)
    session.add("amr", "west", "east", radius=0.3)
    assert "amr" in session and len(session) == 1
    result = session.solve(gap=0)
    assert result.cost == pytest.approx(2) and result.plan["amr"].places == ("west", "cross", "east")
    for call, why in (
        (lambda: session.add("amr", "west", "east", radius=0.3), "there is an agent called 'amr' already"),
        (lambda: session.add("b", "wets", "east", radius=0.3), "no vertex called 'wets'"),
        (lambda: session.add("b", "west", "east"), "'b' has no body"),
        (lambda: session.add("b", "west", "east", radius=-1), "'b' has a radius of -1"),
        (lambda: session.change("b", start="west"), "there is no agent called 'b'"),
        (lambda: session.change("amr", speed=0), "'amr' has a speed of 0"),
        (lambda: session.remove("b"), "there is no agent called 'b'"),
        (lambda: session.close("west", "east"), "there is no edge"),
        (lambda: session.open("west", "cross"), "edge"),
        (lambda: session.solve(gap=-1), "gap"),
        (lambda: session.solve(tie="any"), "tie"),
        (lambda: q.Session(3), "a session needs a grid, a graph or a roadmap"),
    ):
        with pytest.raises(q.InputError, match=why):
            call()
    with pytest.raises(TypeError, match="an agent has no 'colour'"):
        session.change("amr", colour="red")
    # What was refused has changed nothing.
    assert session.names == ["amr"] and session.solve().cost == pytest.approx(2)
    session.change("amr", polygon=[(-0.2, -0.2), (0.2, -0.2), (0.2, 0.2), (-0.2, 0.2)])
    assert session.fleet().bodies[0].shape == (4, 2)
    session.close("west", "cross")
    assert session.solve().explanation == "'amr' cannot get from 'west' to 'east'"
    session.open("west", "cross")
    assert session.solve().status == "optimal"


def test_time_goes_on():
    xy = [(5 * (i % 4), 5 * (i // 4)) for i in range(12)]
    edges = [(i, i + 1) for i in range(12) if i % 4 < 3] + [(i, i + 4) for i in range(8)]
    session = q.Session(q.Roadmap(xy, edges, both_ways=True))
    session.add("a", 0, 11, radius=0.6)
    session.add("b", 11, 0, radius=0.6)
    session.add("c", 3, 2, radius=0.6, leaves=True)
    plan = session.solve().plan
    for now in (3.0, 7.5, 12.0):
        session.advance_to(now, plan)
        assert session.now == now and ("c" in session) == (now < 5)
        starts = [session._agents[name]["start"] for name in session.names]
        goals = [{"a": 11, "b": 0, "c": 2}[name] for name in session.names]
        leaves = [name == "c" for name in session.names]
        fresh = q.Fleet(session.fleet().graph, starts, goals, radius=0.6, leaves=leaves, now=now)
        result = session.solve()
        assert result.status == "optimal" and result.cost == pytest.approx(q.solve(fresh).cost)
        plan = result.plan
    session.assign("b", 5)
    assert session.solve().plan["b"].stops["vertex"][-1] == 5
    with pytest.raises(q.InputError):
        session.advance_to(1.0, plan)
