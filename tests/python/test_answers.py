# SPDX-License-Identifier: MIT
"""The package gives the same answers as the program: status, costs, bound and plan."""

import random

import numpy as np
import pytest
from conftest import random_grid_fleet, random_roadmap_fleet, saved_fleets, scaled, solve_by_program

import quadrille as q

SYSTEMS = ["dpll", "dpll-mdd", "smt-cbs", "mdd-sat"]


@pytest.mark.parametrize("objective", ["sum-of-costs", "makespan"])
def test_on_random_grids(tmp_path, objective):
    seen = set()
    for seed, fleet in saved_fleets(random_grid_fleet, 40, tmp_path / "i.json"):
        system = SYSTEMS[seed % 4]
        theirs = solve_by_program(
            tmp_path / "i.json", "--objective", objective, "--system", system, "--seed", seed
        )
        ours = q.solve(fleet, objective=objective, system=system, seed=seed)
        assert ours.internal_error is None
        assert (ours.status, ours.cost, ours.lower_bound) == (
            theirs["status"], theirs["cost"], theirs["lower_bound"]), seed
        if ours.plan is not None:
            report = ours.plan.verify()
            assert report.valid and ours.cost in (report.sum_of_costs, report.makespan)
            paths = [np.array(path) for path in theirs["plan"]]
            for path, (ours_, cost) in zip(paths, zip(ours.plan.paths, ours.plan.costs)):
                assert np.array_equal(path, ours_[: cost + 1]), seed
        else:
            assert ours.explanation == theirs["explanation"]
        seen.add(ours.status)
    assert "optimal" in seen and (len(seen) == 2 or scaled(40) < 40)


def plain(attribution, cost):
    """As the program writes it, reasons apart. `cost`: to timesteps or ticks."""

    def place(at):
        write = lambda v: list(v) if isinstance(v, tuple) else v
        return at and {"kind": at.kind, "from": write(at.start), "to": write(at.end)}

    return {
        "free_bound": cost(attribution.free_bound),
        "lower_bound": cost(attribution.lower_bound),
        "agents": [{"free_cost": cost(a.free_cost), "cost": cost(a.cost)} for a in attribution.agents],
        "raises": [{"kind": r.kind, "amount": cost(r.amount), "agents": list(r.agents),
                    "bystanders": list(r.bystanders)} for r in attribution.raises],
        "sites": [{"agents": list(s.agents), "place": place(s.place), "other": place(s.other),
                   "begin": cost(s.begin), "end": cost(s.end), "lemmas": s.lemmas}
                  for s in attribution.sites],
    }


@pytest.mark.parametrize("make", [random_grid_fleet, random_roadmap_fleet])
def test_attributions(tmp_path, make):
    raised = 0
    for seed, fleet in saved_fleets(make, 24, tmp_path / "i.json"):
        options = {"objective": ("sum-of-costs", "makespan")[seed % 2], "seed": seed}
        theirs = solve_by_program(tmp_path / "i.json", "--objective", options["objective"], "--seed", seed,
                                  "--explain", "--conflict-limit", 300)
        ours = q.solve(fleet, explain=True, conflict_limit=300, **options)
        if theirs["attribution"] is None:
            assert ours.attribution is None
            continue
        tick = theirs["cost"] / theirs["cost_ticks"] if theirs.get("cost_ticks") else 1
        attribution = ours.attribution
        assert plain(attribution, lambda c: None if c is None else round(c / tick)) == theirs["attribution"]
        total = sum(reason.amount for reason in attribution.reasons)
        assert total == pytest.approx(attribution.lower_bound - attribution.free_bound)
        assert all(site in attribution.sites for reason in attribution.reasons for site in reason.sites)
        assert str(attribution).startswith(f"bound {attribution.lower_bound:g}")
        raised += bool(attribution.raises)
        assert q.solve(fleet, conflict_limit=300, **options).attribution is None
    assert raised > 1 or scaled(24) < 24


def test_an_attribution_needs_a_system_that_has_one():
    fleet = random_grid_fleet(1)
    with pytest.raises(q.InputError):
        q.solve(fleet, explain=True, system="mdd-sat")


@pytest.mark.parametrize("objective", ["sum-of-costs", "makespan"])
def test_on_random_roadmaps(tmp_path, objective):
    solved = 0
    for seed, fleet in saved_fleets(random_roadmap_fleet, 16, tmp_path / "i.json"):
        # A limit that does not depend on time: some of them cannot be solved.
        limits = {"conflict_limit": 300}
        theirs = solve_by_program(
            tmp_path / "i.json", "--objective", objective, "--conflict-limit", 300, "--seed", seed
        )
        ours = q.solve(fleet, objective=objective, seed=seed, **limits)
        assert (ours.status, ours.cost, ours.lower_bound) == (
            theirs["status"], theirs["cost"], theirs["lower_bound"]), seed
        if ours.plan is None:
            continue
        solved += 1
        report = ours.plan.verify()
        assert report.valid
        assert ours.cost == (report.makespan if objective == "makespan" else report.sum_of_costs)
        for path, stops in zip(theirs["plan"], ours.plan):
            ticks = stops.ticks
            assert [stop["vertex"] for stop in path] == ticks["vertex"].tolist()
            assert [stop["arrive_ticks"] for stop in path] == ticks["arrive"].tolist()
            assert [stop["arrive"] for stop in path] == stops.stops["arrive"].tolist()
            assert [stop["at"] for stop in path] == np.stack(
                [stops.stops["x"], stops.stops["y"]], axis=1).tolist()
    assert solved > 0


def test_gap_and_limits_and_threads(tmp_path):
    fleet = random_grid_fleet(3, agents=6, size=8)
    fleet.save(tmp_path / "i.json")
    for arguments, options in [
        (dict(gap=50), ("--gap", 50)),
        (dict(conflict_limit=0), ("--conflict-limit", 0)),
        (dict(time_limit=0), ("--time-limit", 0)),
        (dict(threads=3), ("--threads", 3)),
        (dict(first_plan=False), ("--no-first-plan",)),
        (dict(cost_search="iterative"), ("--cost-search", "iterative")),
        (dict(forbid_first=True, chronological=True),
         ("--forbid-first", "--backtracking", "chronological")),
        (dict(system="dpll-mdd", check="1/2,3/4", mdd_growth="full"),
         ("--system", "dpll-mdd", "--check", "1/2,3/4", "--mdd-growth", "full")),
    ]:
        theirs = solve_by_program(tmp_path / "i.json", *options)
        ours = q.solve(fleet, **arguments)
        assert (ours.status, ours.cost, ours.lower_bound, ours.stop) == (
            theirs["status"], theirs["cost"], theirs["lower_bound"], theirs["stop_reason"]), options


def test_written_plans_are_read_back_and_verified(tmp_path):
    grids = [random_grid_fleet(seed) for seed in range(8)]
    for fleet in grids:
        plan = q.solve(fleet).plan
        for name in ("p.json", "p.yaml", "p.txt"):
            if plan is None:
                continue
            format = {"p.txt": random.Random(len(plan)).choice(["cbsh2", "visualizer"])}.get(name)
            plan.save(tmp_path / name, format)
            again = fleet.read_plan(tmp_path / name)
            assert again == plan and again.verify()
    for fleet in filter(None, map(random_roadmap_fleet, range(8))):
        plan = q.solve(fleet, conflict_limit=300).plan
        for name in ("p.json", "p.xml"):
            if plan is None:
                continue
            plan.save(tmp_path / name)
            again = fleet.read_plan(tmp_path / name)
            assert again == plan and again.verify()


def test_broken_plans_are_found_out():
    fleet = q.Fleet(q.Grid(np.ones((1, 3))), [(0, 0), (2, 0)], [(2, 0), (0, 0)])
    plan = fleet.plan([[(0, 0), (1, 0), (2, 0)], [(2, 0), (1, 0), (0, 0)]])
    report = plan.verify()
    assert not report and [v.kind for v in report.violations] == ["vertex-conflict"]
    violation = report.violations[0]
    assert (violation.agent, violation.other, violation.time) == (0, 1, 1)
    assert "(1, 0)" in violation.message
    assert q.solve(fleet).status == "infeasible"
    assert q.solve(fleet).lower_bound is None
