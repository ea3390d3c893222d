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
        (lambda: q.Session(q.Grid([[1]])), "a session needs a roadmap"),
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
