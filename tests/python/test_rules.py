# SPDX-License-Identifier: MIT
"""Groups, releases, deadlines, moves in progress and obstacles: each does what it says, and the program
reads what the package writes."""

import random

import numpy as np
import pytest
from conftest import assert_no_plan, if_possible, saved_fleets, scaled, solve_by_program

import quadrille as q

LINE = [(0, 0), (1, 0), (2, 0), (1, 1)]


def line(only=None):
    """0 - 1 - 2, and 3 beside 1."""
    return q.Roadmap(LINE, [(0, 1), (1, 2), (1, 3)], both_ways=True, resolution=(0.001, 0.01), only=only)


def alone(**rules):
    return q.Fleet(line(), [0], [2], radius=0.2, **rules)


def random_fleet(seed):
    """With some of the rules, on a small roadmap; None if it cannot have a plan for all to see."""
    rng = random.Random(seed)
    n = rng.randint(1, 3)
    xy = [(x, y) for x in range(4) for y in range(2)]
    edges = [(u, v) for u in range(8) for v in range(u) if abs(u - v) in (1, 2) and rng.random() < 0.9]
    only = [rng.choice([None, None, None, "a", ("a", "b"), ("b", None)]) for _ in edges]
    roadmap = q.Roadmap(xy, edges, both_ways=True, resolution=0.01, only=only)
    groups = [rng.choice([None, *roadmap.groups]) for _ in range(n)]
    starts = rng.sample(range(8), n)
    under_way = rng.random() < 0.4
    if under_way:
        starts[0] = q.Underway(*rng.choice(edges), rng.random())
    path, now = [], rng.choice([0, rng.uniform(0, 3)])
    for _ in range(rng.randint(1, 3)):
        path.append((rng.uniform(0, 3), rng.uniform(0, 1), now, now + rng.choice([0, 0.5])))
        now = path[-1][3] + rng.uniform(0.1, 3)
    square = [(-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1)]
    shape = rng.choice([dict(radius=rng.uniform(0.05, 0.2)), dict(polygon=square), dict(radius=0.1)])
    obstacle = q.Obstacle(path, leaves=len(path) > 1 and rng.random() < 0.6, **shape)
    return if_possible(
        q.Fleet(
            roadmap,
            starts,
            rng.sample(range(8), n),
            radius=rng.uniform(0.1, 0.3),
            group=groups,
            release=None if under_way else [rng.choice([0, rng.uniform(0, 3)]) for _ in range(n)],
            deadline=[rng.choice([None, rng.uniform(4, 20)]) for _ in range(n)],
            leaves=[rng.random() < 0.3 for _ in range(n)],
            obstacles=[obstacle] if rng.random() < 0.5 else [],
            now=rng.choice([0, 0, rng.uniform(0, 3)]),
        )
    )


def same_obstacle(a, b):
    shape = lambda o: o.radius if o.polygon is None else o.polygon.tolist()
    return np.array_equal(a.path, b.path) and a.leaves == b.leaves and shape(a) == shape(b)


def test_files_keep_the_rules_and_the_program_gives_the_same_answers(tmp_path):
    solved = 0
    for seed, fleet in saved_fleets(random_fleet, 60, tmp_path / "i.json"):
        again = q.read(tmp_path / "i.json")
        for rule in ("releases", "deadlines", "leaves", "under_way", "starts", "now"):
            assert np.array_equal(getattr(fleet, rule), getattr(again, rule), equal_nan=rule == "deadlines"), rule
        assert again.groups == fleet.groups and again.graph.groups == fleet.graph.groups
        assert again.graph.only[: len(fleet.graph.only)] == fleet.graph.only
        assert len(fleet.obstacles) == len(again.obstacles)
        assert all(map(same_obstacle, fleet.obstacles, again.obstacles))
        theirs = solve_by_program(tmp_path / "i.json", "--conflict-limit", 300)
        ours = q.solve(fleet, conflict_limit=300)
        assert (ours.status, ours.cost, ours.lower_bound) == (
            theirs["status"], theirs["cost"], theirs["lower_bound"]), seed
        if ours.plan is None:
            continue
        solved += 1
        assert ours.plan.verify()
        known = ~np.isnan(fleet.deadlines)
        assert ours.plan.now == fleet.now
        assert (fleet.now + ours.plan.costs[known] <= fleet.deadlines[known] + 0.005).all()
        for path, release in zip(ours.plan, fleet.releases):
            assert len(path.stops) == 1 or path.stops["depart"][0] >= release
    assert solved > 10 or scaled(60) < 60


def test_lanes_for_some():
    small = line(only=[None, None, "small"])
    assert small.groups == ["small"]
    assert small.only == [None, None, None, None, ("small",), ("small",)]
    cost = lambda group: q.solve(q.Fleet(small, [0, 2], [2, 0], radius=0.2, group=group)).cost
    assert cost("small") == cost([None, "small"]) < 10
    assert q.solve(q.Fleet(small, [0, 2], [2, 0], radius=0.2)).status == "infeasible"
    assert_no_plan(q.Fleet(small, [0], [3], radius=0.2), "agent 0 cannot get from vertex 0 to vertex 3")
    assert q.Fleet(small, [0], [3], radius=0.2, group="small").groups == ["small"]
    networkx = pytest.importorskip("networkx")
    G = networkx.Graph()
    for node, pos in enumerate(LINE):
        G.add_node(node, pos=pos)
    G.add_edge(0, 1)
    G.add_edge(1, 3, kind={"small"})
    assert q.Roadmap.from_networkx(G, only="kind").only == [None, None, ("small",), ("small",)]


def test_releases_deadlines_and_leaving():
    assert q.solve(alone()).cost == 2
    assert q.solve(alone(release=1.5)).cost == 3.5
    assert q.solve(alone(release=[1.5], deadline=[3.5])).cost == 3.5
    assert_no_plan(alone(deadline=1.99), "agent 0 cannot arrive before 2, and its deadline is 1.99")
    assert np.isnan(alone(deadline=[None]).deadlines).all()
    # One after the other to the same goal, which the first one has left by then.
    after = lambda leaves: q.Fleet(line(), [1, 0], [2, 2], radius=0.2, leaves=leaves)
    assert q.solve(after([True, False])).cost == 3
    assert_no_plan(after(False), "the goals of agent 0 at vertex 2 and agent 1 at vertex 2 overlap")


def test_obstacles():
    # On the middle of the road from 1 to 2.
    cart = q.Obstacle([(1, 0, 1, 2), (1, 1, 3, 3)], radius=0.2, leaves=True)
    fleet = alone(obstacles=[cart])
    assert q.solve(fleet).cost > 2
    assert same_obstacle(fleet.obstacles[0], cart)
    # One agent after the other, the second around the first: no cheaper than both together.
    tasks = [(0, 2), (3, 0)]
    carts, costs = [], []
    for start, goal in tasks:
        one = q.Fleet(line(), [start], [goal], radius=0.1, obstacles=carts, leaves=True)
        result = q.solve(one)
        carts.append(result.plan.obstacle(0))
        costs.append(result.cost)
    assert costs[1] > q.solve(q.Fleet(line(), [3], [0], radius=0.1)).cost
    together = q.Fleet(line(), *zip(*tasks), radius=0.1, leaves=True)
    assert q.solve(together).cost <= sum(costs) + 1e-9
    assert q.solve(q.Fleet(line(), [0], [0], radius=0.1, leaves=True)).plan.obstacle(0) is None


def test_moves_in_progress_are_finished():
    named = q.Roadmap(LINE, [(0, 1), (1, 2)], both_ways=True, resolution=(0.001, 0.01), nodes="abcd")
    fleet = q.Fleet(named, [q.Underway("a", "b", 0.3)], ["a"], radius=0.2)
    assert fleet.under_way.all() and fleet.starts.tolist() == [4]
    stops = q.solve(fleet).plan[0].stops
    assert stops["vertex"].tolist() == [4, 1, 0] and stops["arrive"].tolist() == [0, 0.7, 1.7]
    assert stops["x"].tolist() == [0.3, 1, 0]
    assert q.solve(fleet).plan.sample(10)[0, 7].tolist() == [1, 0]
    # And again, as often as there is need, also within the same move.
    plan = q.solve(fleet).plan
    halfway = plan.start_at(0, 1.2)
    assert (halfway.source, halfway.target, halfway.fraction) == ("b", "a", pytest.approx(0.5))
    assert plan.start_at(0, 0.7) == "b" and plan.start_at(0, 99) == "a"
    assert plan.start_at(0, -1) == plan.start_at(0, 0) == q.Underway("a", "b", 0.3)
    for step, left in enumerate((0.5, 0.3, 0.1)):
        again = q.Fleet(named, [plan.start_at(0, 0.2)], ["a"], radius=0.2)
        plan = q.solve(again).plan
        assert plan[0].stops["arrive"].tolist() == pytest.approx([0, left, left + 1]), step
    # By the duration of the edge, if it has one.
    slow = q.Roadmap(LINE, [(0, 1)], durations=[4], resolution=(0.001, 0.01))
    assert q.solve(q.Fleet(slow, [q.Underway(0, 1, 0.5)], [1], radius=0.2)).cost == 2
    for fraction in (-0.1, 1.1, float("nan")):
        with pytest.raises(q.InputError, match="agent 0 has a part of its move behind it of"):
            q.Fleet(named, [q.Underway("a", "b", fraction)], ["a"], radius=0.2)
    with pytest.raises(q.InputError, match="agent 0: start: there is no vertex 9"):
        q.Fleet(line(), [q.Underway(9, 1, 0.5)], [1], radius=0.2)
    with pytest.raises(q.InputError, match="under way, and cannot be released later"):
        q.Fleet(named, [q.Underway("a", "b", 0.3)], ["a"], radius=0.2, release=1)


def test_lanes_have_limits_and_nobody_waits_where_nobody_may():
    roads = dict(xy=[(0, 0), (1, 0), (2, 0)], edges=[(0, 1), (1, 2), (1, 2)], nodes=["a", "b", "c"],
                 only=[None, None, "slow"], resolution=(0.001, 0.01))
    with pytest.raises(q.InputError, match="no_waiting"):
        q.Roadmap(**roads, no_waiting=["d"])
    roads["only"] = [None, [None, "fast"], "slow"]
    roadmap = q.Roadmap(**roads, speed_limits=[0.5, np.nan, 0.25], no_waiting=["b"])
    assert roadmap.no_waiting.tolist() == [1]
    assert roadmap.speed_limits[[0, 2]].tolist() == [0.5, 0.25] and np.isnan(roadmap.speed_limits[1])
    assert q.solve(q.Fleet(roadmap, ["a"], ["c"], radius=0.2)).cost == 3
    assert q.solve(q.Fleet(roadmap, ["a"], ["c"], radius=0.2, group=["slow"])).cost == 6
    halfway = q.Fleet(roadmap, [q.Underway("b", "c", 0.5)], ["c"], radius=0.2, group=["slow"])
    assert q.solve(halfway).cost == 2
    with pytest.raises(q.InputError, match="'0' would stay at 'b', where nobody may wait|stay at"):
        q.solve(q.Fleet(roadmap, ["a"], ["b"], radius=0.2))
    with pytest.raises(q.InputError, match="a duration and a speed limit"):
        q.Roadmap(LINE, [(0, 1)], durations=[4], speed_limits=[1])
    with pytest.raises(q.InputError, match=r"speed_limits\[0\]: the speed is not supported"):
        q.Roadmap(LINE, [(0, 1)], speed_limits=[0])
    with pytest.raises(q.InputError, match=r"no_waiting\[1\]: vertex 1 is there twice"):
        q.Roadmap(LINE, [(0, 1)], no_waiting=[1, 1])


def test_an_initial_plan_has_to_keep_the_rules():
    plan = q.solve(alone()).plan
    assert q.solve(alone(deadline=2), initial=plan).cost == 2
    with pytest.raises(q.InputError, match="initial plan"):
        q.solve(alone(release=1), initial=plan)


@pytest.mark.parametrize("rules, message", [
    (dict(group="large"), "has no group 'large'"),
    (dict(group=[None, None]), "group: 2 entries for 1 agents"),
    (dict(release=-1), "^agent 0 is released at -1, which is negative, or too late$"),
    (dict(release=[1, 2]), "release: expected an array of shape"),
    (dict(deadline=float("inf")), "^agent 0 has its deadline at inf, which is negative, or too late$"),
    (dict(leaves="yes"), "leaves: expected booleans"),
    (dict(obstacles=[q.Obstacle([], radius=0.2)]), "obstacle 0 has no stops"),
    (dict(obstacles=[q.Obstacle([(0, 1, 0, 0)], leaves=True, radius=0.2)]), "obstacle 0 vanishes at the moment"),
    (dict(obstacles=[q.Obstacle([(0, 1, 2, 1)], radius=0.2)]), "obstacle 0 has times that do not increase"),
    (dict(obstacles=[q.Obstacle([(0, 1, float("nan"), 1)], radius=0.2)]), "obstacle 0 has a time that is not a number"),
    (dict(obstacles=[q.Obstacle([(0, 1e300, 0, 1)], radius=0.2)]), "obstacle 0 has a stop that is too far away"),
    (dict(obstacles=[q.Obstacle([(0, 1, 0)], radius=0.2)]), r"path: expected an array of shape \(n, 4\)"),
    (dict(obstacles=[q.Obstacle([(0, 1, 0, 0)], radius=0)]), "obstacle 0 has a radius of 0, which is not positive"),
    (dict(obstacles=[q.Obstacle([(0, 1, 0, 0)], radius=1, polygon=[(0, 0)])]), "either a radius or a polygon"),
    (dict(obstacles=[q.Obstacle([(0, 1, 0, 0)])]), "no body"),
])
def test_bad_rules(rules, message):
    with pytest.raises(ValueError, match=message):
        alone(**rules)


def test_bad_lanes_and_grids():
    for only, message in [([None], "only: 1 entries for 3 edges"), ([None, None, 3], "not iterable"),
                          ([None, None, [3]], "a group is called by a string"),
                          ([None, None, []], "the edge is open to nobody"),
                          ([None, None, [str(k) for k in range(64)]], "more than 63 groups")]:
        with pytest.raises((ValueError, TypeError), match=message):
            line(only=only)
    for rule in ("group", "obstacles"):
        with pytest.raises(ValueError, match=f"{rule} is for roadmaps"):
            q.Fleet(q.Grid([[1, 1]]), [(0, 0)], [(1, 0)], **{rule: [1]})


def test_rules_of_grids_and_graphs():
    lane = q.Grid([[1, 1, 1, 1]])

    def fleet(**rules):
        return q.Fleet(lane, [(0, 0), (1, 0)], [(3, 0), (3, 0)], leaves=True, **rules)

    assert q.solve(fleet()).cost == 5
    assert q.solve(fleet(robust=1)).cost == 6
    assert q.solve(fleet(release=[None, 2])).cost == 9
    late = q.solve(fleet(release=[None, 2], deadline=[4, None]))
    assert late.status == "infeasible"
    ours = fleet(release=[0, 2], deadline=[None, 9], robust=2, now=1)
    assert ours.releases.tolist() == [0, 2] and ours.robust == 2
    assert np.isnan(ours.deadlines[0]) and ours.deadlines[1] == 9
    assert ours.leaves.tolist() == [True, True]
    with pytest.raises(q.InputError, match="'b' have the same goal"):
        q.Fleet(lane, [(0, 0), (1, 0)], [(3, 0), (3, 0)], names=["a", "b"])
    for rules, message in [(dict(release=1.5), "release: timesteps are whole numbers"),
                           (dict(deadline=-3), "deadline of -3"), (dict(robust=-1), "robust"),
                           (dict(release=[1]), "release")]:
        with pytest.raises((ValueError, q.InputError), match=message):
            fleet(**rules)
    roads = q.Roadmap([(0, 0), (1, 0)], [(0, 1)])
    with pytest.raises(ValueError, match="robust is for grids and graphs"):
        q.Fleet(roads, [0], [1], radius=0.2, robust=1)


def test_one_way_edges_of_files(tmp_path):
    path = tmp_path / "ring.json"
    path.write_text("""{"quadrille": "instance", "version": 1,
        "graph": {"vertices": 3, "edges": [[0, 1], [1, 2], [2, 0]], "directed": true},
        "agents": [{"start": 0, "goal": 2}]}""")
    fleet = q.read(path)
    assert fleet.graph.edges.tolist() == [[0, 1], [1, 2], [2, 0]]
    assert q.solve(fleet).cost == 2


def test_the_fewest_moves():
    # Two have to change places in a lane with a bay.
    grid = q.Grid([[1, 1, 1, 1], [0, 0, 1, 0]])
    fleet = q.Fleet(grid, [(0, 0), (3, 0)], [(3, 0), (0, 0)])
    result = q.solve(fleet, tie="fewest-moves")
    assert result.status == "optimal" and result.cost == q.solve(fleet).cost
    moves = sum(int(np.any(path[1:] != path[:-1], axis=1).sum()) for path in result.plan.paths)
    assert result.moves == q.Moves(moves, moves, True)
    assert q.solve(fleet).moves is None and q.solve(fleet, tie="any").moves is None
    assert q.solve(fleet, tie="fewest-moves", time_limit=0).moves is None
    with pytest.raises(q.InputError, match="gap"):
        q.solve(fleet, tie="fewest-moves", gap=1)
    with pytest.raises(q.InputError, match="tie"):
        q.solve(fleet, tie="fewest")
    with pytest.raises(q.InputError, match="tie does not apply to roadmaps"):
        q.solve(alone(), tie="any")


def test_parked_nearer_than_bodies(tmp_path):
    bays = q.Roadmap([(0, 0), (0.5, 0), (0, 2), (0.5, -2)], [(0, 2), (1, 3)], resolution=0.001)

    def fleet(**rules):
        return q.Fleet(bays, [0, 1], [2, 3], radius=0.3, **rules)

    assert fleet().no_plan is not None and q.solve(fleet()).status == "infeasible"
    assert fleet(overlap_at_start=[True, False]).no_plan is not None
    parked = fleet(overlap_at_start=True)
    assert parked.overlap_at_start.tolist() == [True, True]
    result = q.solve(parked)
    assert result.status == "optimal" and 4 < result.cost < 5
    assert result.plan.verify().valid
    parked.save(tmp_path / "parked.json")
    assert q.solve(q.read(tmp_path / "parked.json")).cost == result.cost
    with pytest.raises(ValueError, match="overlap_at_start is for roadmaps"):
        q.Fleet(q.Grid([[1, 1]]), [(0, 0)], [(1, 0)], overlap_at_start=True)
