# SPDX-License-Identifier: MIT
"""Plans that are carried out late: executors, releasers, simulations, and what is written for other systems."""

import csv
import io
import json
import random

import numpy as np
import pytest
from conftest import random_grid_fleet, random_roadmap_fleet, run_program, scaled

import quadrille as q

ROADS = q.Roadmap(
    [(0, 0), (1, 0), (2, 0), (1, 0.8)], [(0, 1), (1, 2), (1, 3)], both_ways=True, resolution=0.001,
    nodes=["west", "cross", "east", "bay"],
)


def siding(**more):
    given = dict(radius=[0.3, 0.25], speed=[1, 2], names=["slow", "fast"])
    return q.Fleet(ROADS, ["west", "east"], ["east", "west"], **{**given, **more})


def plans(make, count):
    for seed in range(scaled(count)):
        fleet = make(seed)
        plan = None if fleet is None else q.solve(fleet).plan
        if plan is not None and len(plan) > 1:
            yield seed, plan


def gap(plan, a, b, clocks):
    """The space between two bodies when agents have got to their clocks, by points of their paths alone."""
    places = [plan[agent].at(clocks[agent]) for agent in (a, b)]
    return float(np.linalg.norm(places[0] - places[1])) - plan._fleet.bodies[a] - plan._fleet.bodies[b]


def walk(plan, advance, seed, step):
    """Random delays; the clocks after each step, until all have arrived."""
    draw, clocks = random.Random(seed), np.full(len(plan), plan.now, dtype=float)
    for _ in range(5000):
        yield clocks
        if (clocks >= plan.now + plan.costs).all():
            return
        wanted = np.where([draw.random() < 0.3 for _ in range(len(plan))], clocks, clocks + step)
        clocks = advance(clocks, wanted)
    raise AssertionError("they do not arrive")


def test_agents_that_obey_never_touch():
    seen = 0
    for seed, plan in plans(random_roadmap_fleet, 60):
        if any(not isinstance(body, float) for body in plan._fleet.bodies):
            continue
        executor = q.Executor(plan)
        for clocks in walk(plan, executor.couple, seed, 0.05):
            for a in range(len(plan)):
                for b in range(a):
                    assert gap(plan, a, b, clocks) > -1e-3
        seen += 1
    assert seen >= scaled(60) // 6


def test_limits_do_what_couple_does_and_old_clocks_are_safe():
    plan = q.solve(siding()).plan
    executor = q.Executor(plan)
    limits = executor.limits([0, 0])
    # Somebody waits for somebody, and all may go on.
    assert (limits > 0).all() and np.isfinite(limits).any() and not limits.flags.writeable
    assert (executor.limits(limits.clip(max=plan.makespan)) >= limits).all()
    assert np.isinf(executor.limits([plan.makespan + 1] * 2)).all()
    with pytest.raises(q.InputError, match=r"clocks\[0\]: a clock never goes back"):
        executor.limits([0, 0])
    executor.reset()
    assert (executor.limits([0, 0]) == limits).all()
    with pytest.raises(q.InputError, match=r"targets\[0\]: it is before the clock"):
        executor.couple([1, 1], [0.5, 1])
    with pytest.raises(ValueError, match="expected an array of shape"):
        executor.limits([0, 0, 0])
    with pytest.raises(q.InputError, match="no time"):
        executor.limits([np.nan, 0])


def test_timesteps_too():
    for seed, plan in plans(random_grid_fleet, 40):
        executor = q.Executor(plan)
        for clocks in walk(plan, executor.couple, seed, 1):
            assert (clocks == np.floor(clocks)).all()
            places = [tuple(plan[agent].at(clocks[agent])) for agent in range(len(plan))]
            assert len(set(places)) == len(places)


def test_whole_moves():
    seen = 0
    for seed, plan in plans(random_roadmap_fleet, 30):
        order, releaser = plan.node_order(), q.Releaser(plan)
        moves = [len(path.stops) - 1 for path in plan]
        ended, news = [0] * len(plan), set()
        for _ in range(sum(moves) + 1):
            for agent in range(len(plan)):
                if ended[agent] < releaser.released(agent):
                    ended[agent] += 1
                    releaser.end_moves(agent, ended[agent])
                    news.update(releaser.take_news())
        assert (ended == moves) == order.acyclic
        assert order.cycle == plan.precedences().graph["cycle"]
        seen += 1
    assert seen > 0
    with pytest.raises(q.InputError, match="moves have ended, and 0 were released|were released"):
        releaser.end_moves(0, moves[0] + 1)


def test_simulations():
    plan = q.solve(siding()).plan
    result = q.simulate(plan, runs=12, seed=3)
    assert result.arrived.all() and not result.contacts.any() and (result.clearance > -1e-6).all()
    assert result.finish.shape == result.held.shape == (12, 2)
    assert (result.makespans >= plan.makespan).all() and (result.sums_of_costs > plan.sum_of_costs).any()
    again = q.simulate(plan, runs=4, seed=5)
    assert (again.finish == result.finish[2:6]).all()
    assert q.simulate(plan, "naive", runs=20, delays=0.9, longest=5).contacts.any()
    assert not result.finish.flags.writeable
    steps = q.solve(q.Fleet(q.Grid([[1, 1, 1], [0, 1, 0]]), [(0, 0), (2, 0)], [(2, 0), (0, 0)])).plan
    assert q.simulate(steps, "gated", runs=3).arrived.all()
    for wrong in (dict(rule="slow"), dict(delays=2), dict(slow=0.99), dict(runs=0), dict(longest=0), dict(seed=-1)):
        with pytest.raises(q.InputError):
            q.simulate(plan, **wrong)


def test_simulations_are_those_of_the_program(tmp_path):
    fleet = siding()
    plan = q.solve(fleet).plan
    fleet.save(tmp_path / "i.json")
    plan.save(tmp_path / "p.json")
    done = run_program("simulate", "--instance", tmp_path / "i.json", tmp_path / "p.json", "--json", "-", "--quiet")
    for said in json.loads(done.stdout)["rules"]:
        result = q.simulate(plan, said["rule"])
        assert said["colliding_pairs"] == result.contacts.sum()
        assert said["endless_runs"] == (~result.arrived).sum()
        assert said["mean_makespan"] == pytest.approx(result.makespans.mean())
        assert said["mean_held"] == pytest.approx(result.held.sum(axis=1).mean())


def exported(tmp_path, plan, *arguments):
    plan._fleet.save(tmp_path / "i.json")
    plan.save(tmp_path / "p.json")
    done = run_program("export", "--instance", tmp_path / "i.json", tmp_path / "p.json", *arguments)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_exports_are_those_of_the_program(tmp_path):
    plan = q.solve(siding()).plan
    assert plan.to_csv(rate=5) == exported(tmp_path, plan, "--to", "csv", "--rate", "5")
    rows = list(csv.DictReader(io.StringIO(plan.to_csv())))
    assert {row["agent"] for row in rows} == {"0", "1"} and float(rows[-1]["x"]) in (0.0, 2.0)
    assert plan.to_ros() == json.loads(exported(tmp_path, plan, "--to", "multidof"))
    assert plan.to_ros("path", version=1) == json.loads(exported(tmp_path, plan, "--to", "path", "--ros", "1"))
    assert plan.to_ros()[0]["joint_names"] == ["slow"]
    orders = plan.to_vda5050(allow_cycles=True)
    assert orders == json.loads(exported(tmp_path, plan, "--to", "vda5050", "--allow-cycles"))
    assert [order["serialNumber"] for order in orders] == ["slow", "fast"]
    assert orders[0]["nodes"][0]["nodeId"] == "west"
    releaser = q.Releaser(plan)
    assert [sum(node["released"] for node in order["nodes"]) - 1 for order in orders] == [
        releaser.released(agent) for agent in range(2)
    ]
    update = plan.to_vda5050(first=[1, 0], released=[1, 0], update=4, allow_cycles=True)[0]
    assert (update["orderUpdateId"], update["nodes"][0]["sequenceId"]) == (4, 2)
    for wrong in (dict(version="1.1"), dict(time_stamp="now"), dict(released=[9, 9])):
        with pytest.raises(q.InputError):
            plan.to_vda5050(allow_cycles=True, **wrong)
    with pytest.raises(q.InputError, match="message"):
        plan.to_ros("csv")
    broken = siding().plan([["west", "cross", "east"], ["east", "cross", "west"]])
    with pytest.raises(q.InputError):
        broken.to_csv()
