# SPDX-License-Identifier: MIT
"""Arrays in and out: shapes, types, who owns the memory."""

import gc
import sys
import warnings
import weakref

import numpy as np
import pytest
from conftest import assert_no_plan, need, random_grid_fleet, random_roadmap_fleet

import quadrille as q


@pytest.fixture
def siding():
    roadmap = q.Roadmap([(0, 0), (1, 0), (2, 0), (1, 0.8)], [(0, 1), (1, 2), (1, 3)],
                        both_ways=True, resolution=0.001)
    return q.Fleet(roadmap, [0, 2], [2, 0], radius=[0.3, 0.25], speed=[1, 2], names=["slow", "fast"])


def test_shapes_and_types_on_grids():
    fleet = q.Fleet(q.Grid([[True, True, True], [False, True, False]]), [(0, 0), (2, 0)], [(2, 0), (0, 0)])
    plan = q.solve(fleet).plan
    assert plan.paths.dtype == np.int32 and plan.paths.shape == (2, plan.makespan + 1, 2)
    assert plan.costs.dtype == np.int64 and plan.costs.sum() == 7
    assert fleet.graph.free.dtype == np.bool_ and fleet.graph.shape == (2, 3)
    assert fleet.starts.tolist() == [[0, 0], [2, 0]] and plan.paths[:, -1].tolist() == fleet.goals.tolist()
    assert plan.paths is plan.paths and not plan.paths.flags.writeable
    # Each move is to a neighbour, or none.
    assert (np.abs(np.diff(plan.paths, axis=1)).sum(axis=2) <= 1).all()


def test_graphs_have_vertices_instead_of_cells():
    # A star: two leaves change places with the help of the third.
    fleet = q.Fleet(q.Graph(4, [(0, 1), (0, 2), (3, 0)]), [1, 2], [2, 1], names=["a", "b"])
    result = q.solve(fleet)
    assert (result.status, result.cost) == ("optimal", 7)
    assert result.plan.paths.shape == (2, result.plan.makespan + 1)
    assert fleet.graph.edges.tolist() == [[0, 1], [0, 2], [0, 3]]
    with pytest.raises(ValueError, match="no coordinates"):
        result.plan.sample(2)


def test_goals_to_choose_from():
    # Agent 0 takes the one that agent 1, who has no other one, leaves.
    grid = q.Grid([[True, True, True, True]])
    fleet = q.Fleet(grid, [(1, 0), (3, 0)], [[(0, 0), (2, 0)], (2, 0)])
    result = q.solve(fleet)
    assert (result.status, result.cost) == ("optimal", 2)
    assert result.plan.paths[:, -1].tolist() == [[0, 0], [2, 0]]
    assert [goals.tolist() for goals in fleet.goal_sets] == [[[0, 0], [2, 0]], [[2, 0]]]
    with pytest.raises(ValueError, match="goal_sets"):
        fleet.goals
    again = q.Fleet(grid, fleet.starts, fleet.goal_sets)
    assert q.solve(again).cost == 2
    line = q.Graph(3, [(0, 1), (1, 2)])
    assert q.solve(q.Fleet(line, [0, 1], [[1, 2], [1, 2]])).cost == 2
    assert q.solve(q.Fleet(line, [0, 1, 2], [[0, 1], [0, 1], [0, 1]])).status == "infeasible"
    # The same with bodies; names may be tuples.
    nodes = ["a", "b", "c", ("d", 1)]
    docks = q.Roadmap([(v, 0) for v in range(4)], [(0, 1), (1, 2), (2, 3)], both_ways=True, nodes=nodes)
    fleet = q.Fleet(docks, ["a", "b"], [["c", ("d", 1)], [("d", 1), "c"]], radius=0.3)
    result = q.solve(fleet)
    assert (result.status, result.cost) == ("optimal", 4)
    assert [goals.tolist() for goals in fleet.goal_sets] == [[2, 3], [2, 3]]
    with pytest.raises(ValueError, match="goal_sets"):
        fleet.goals
    with pytest.raises(q.InputError, match="no goal"):
        q.Fleet(docks, ["a"], [[]], radius=0.3)
    for goals, error in [([[], [1]], q.InputError), ([[1, 2]], ValueError), ([[1, 7], [0]], q.InputError)]:
        with pytest.raises(error):
            q.Fleet(line, [0, 1], goals)


def test_no_agents():
    empty = q.Fleet(q.Grid(np.ones((2, 2))), [], [])
    result = q.solve(empty)
    assert (result.status, result.cost) == ("optimal", 0)
    assert result.plan.paths.shape == (0, 1, 2) and result.plan.sample(5).shape == (0, 1, 2)
    empty = q.Fleet(q.Roadmap([(0, 0)], []), [], [])
    assert q.solve(empty).plan.sample(5).shape == (0, 1, 2)


def test_stops_on_roadmaps(siding):
    plan = q.solve(siding).plan
    stops, ticks = plan[0].stops, plan[0].ticks
    assert stops.dtype.names == ("vertex", "x", "y", "arrive", "depart")
    assert ticks["arrive"].dtype == np.int64 and len(stops) == len(ticks)
    assert np.array_equal(stops["arrive"], ticks["arrive"] / 1000)
    assert plan[-1].name == "fast" and plan[0].cost == stops["arrive"][-1]
    with pytest.raises(IndexError):
        plan[2]


def test_lengths_and_times_may_have_units_of_their_own():
    millimetres = q.Roadmap([(0, 0), (2000, 0)], [(0, 1)], resolution=(1, 0.001))
    assert millimetres.resolution == (1, 0.001) and millimetres.units.tolist() == [[0, 0], [2000, 0]]
    result = q.solve(q.Fleet(millimetres, [0], [1], radius=100, speed=500))
    assert result.cost == 4 and result.plan[0].ticks["arrive"].tolist() == [0, 4000]
    assert result.plan.sample(1)[0].tolist() == [[0, 0], [500, 0], [1000, 0], [1500, 0], [2000, 0]]


def test_samples_are_where_the_paths_are(siding):
    for fleet in [siding, *filter(None, map(random_roadmap_fleet, range(6)))]:
        plan = q.solve(fleet, conflict_limit=300).plan
        if plan is None:
            continue
        samples, hz = plan.sample(1000), 1000
        assert samples.dtype == np.float64
        for agent, path in enumerate(plan):
            ticks = path.ticks
            # At a resolution of a millisecond each stop is a sample.
            for stop, tick in zip(path.stops, ticks):
                for t in {int(tick["arrive"]), int(tick["depart"])}:
                    assert np.allclose(samples[agent, t], (stop["x"], stop["y"]), atol=1e-9)
        report = plan.verify(num_clearances=None)
        if len(fleet) < 2 or any(not isinstance(body, float) for body in fleet.bodies):
            continue
        # The least distance of the samples is no less than the clearance that verify finds, and
        # near it: in one sample nobody moves further than 2 * speed / hz.
        for agent, other, gap, _ in report.clearances:
            distance = np.linalg.norm(samples[agent] - samples[other], axis=1).min()
            distance -= fleet.bodies[agent] + fleet.bodies[other]
            assert gap - 1e-6 <= distance <= gap + 4 / hz


def test_heights():
    roadmap = q.Roadmap([(0, 0, 0), (0, 3, 4), (0, 3, 8)], [(0, 1), (1, 2)], both_ways=True, resolution=0.001)
    assert roadmap.xy.tolist() == [[0, 0, 0], [0, 3, 4], [0, 3, 8]]
    assert roadmap.units.tolist() == [[0, 0, 0], [0, 3000, 4000], [0, 3000, 8000]]
    fleet = q.Fleet(roadmap, [0], [2], radius=0.3)
    plan = q.solve(fleet).plan
    assert plan.sum_of_costs == 9 and plan.verify().valid
    assert plan[0].stops["z"].tolist() == [0, 4, 8]
    samples = plan.sample(1)
    assert samples.shape == (1, 10, 3)
    np.testing.assert_allclose(samples[0, [1, 5, 6]], [[0, 0.6, 0.8], [0, 3, 4], [0, 3, 5]])
    # What another fleet has to keep clear of.
    obstacle = plan.obstacle(0)
    assert np.asarray(obstacle.path).tolist() == [[0, 0, 0, 0, 0], [0, 3, 4, 5, 5], [0, 3, 8, 9, 9]]
    other = q.Fleet(roadmap, [1], [1], radius=0.3, obstacles=[obstacle])
    assert q.solve(other).plan is None
    with pytest.raises(q.InputError, match="spheres"):
        q.Fleet(roadmap, [0], [2], polygon=[(-1, -1), (1, -1), (0, 1)])
    with pytest.raises(ValueError, match="shape"):
        q.Roadmap([(0, 0, 0, 0)], np.empty((0, 2), dtype=int))
    flat = q.Roadmap([(0, 0, 0), (1, 0, 0)], [(0, 1)])
    assert flat.xy.shape == (2, 2)


def test_samples_on_grids():
    plan = q.solve(random_grid_fleet(5)).plan
    assert np.array_equal(plan.sample(1).transpose(1, 0, 2), plan.paths.transpose(1, 0, 2))
    half = plan.sample(2)
    assert np.array_equal(half[:, ::2], plan.paths)
    assert np.allclose(half[:, 1::2], (plan.paths[:, 1:] + plan.paths[:, :-1]) / 2)
    for hz in (0, -1, float("nan"), float("inf")):
        with pytest.raises(ValueError, match="rate"):
            plan.sample(hz)


def test_views_keep_their_owner_alive_and_cannot_be_written_to(siding):
    units = siding.graph.units
    ticks = q.solve(siding).plan[0].ticks
    for view in (units, ticks):
        assert view.base is not None and not view.flags.owndata
        with pytest.raises(ValueError):
            view[0] = 0
    expected = units.tolist(), ticks.tolist()
    del siding
    gc.collect()
    other = [q.solve(random_grid_fleet(seed)) for seed in range(3)]  # uses the memory again
    assert (units.tolist(), ticks.tolist()) == expected
    del other


def test_nothing_is_left_behind(siding):
    fleet = random_grid_fleet(7)

    class Callback:
        def __call__(self, _):
            pass

    callback = Callback()
    count = sys.getrefcount(callback)
    plans = []
    for _ in range(20):
        result = q.solve(fleet, progress=callback, on_plan=callback)
        plans.append(weakref.ref(result.plan))
        paths = result.plan.paths
        assert sys.getrefcount(paths) == 3  # here, in the plan, and the argument
        timed = q.solve(siding, progress=callback).plan
        plans.append(weakref.ref(timed))
        ticks = timed[0].ticks
        assert sys.getrefcount(ticks) == 2
    del result, timed, paths, ticks
    gc.collect()
    assert all(plan() is None for plan in plans)
    assert sys.getrefcount(callback) == count
    # What is passed in is copied, not kept.
    free = np.ones((3, 3), dtype=bool)
    count = sys.getrefcount(free)
    grid = q.Grid(free)
    assert sys.getrefcount(free) == count
    free[1, 1] = False
    assert grid.free.all()


def test_networkx():
    nx = need("networkx")
    G = nx.grid_2d_graph(3, 2)
    nx.set_node_attributes(G, {node: node for node in G}, "pos")
    roadmap = q.Roadmap.from_networkx(G)
    assert roadmap.num_vertices == 6 and len(roadmap.edges) == 2 * G.number_of_edges()
    fleet = q.Fleet(roadmap, [(0, 0), (2, 1)], [(2, 1), (0, 0)], radius=0.3)
    result = q.solve(fleet)
    assert (result.status, result.cost) == ("optimal", 6)
    same = q.Roadmap.from_networkx(G, pos={node: node for node in G})
    assert np.array_equal(same.xy, roadmap.xy) and same.nodes == list(G)
    one_way = nx.DiGraph([("a", "b"), ("b", "c")])
    one_way.edges["b", "c"]["seconds"] = 2.5
    places = {"a": (0, 0), "b": (1, 0), "c": (2, 0)}
    roadmap = q.Roadmap.from_networkx(one_way, places, duration="seconds")
    assert roadmap.edges.tolist() == [[0, 1], [1, 2]]
    assert np.isnan(roadmap.durations[0]) and roadmap.durations[1] == 2.5
    assert q.solve(q.Fleet(roadmap, ["a"], ["c"], radius=0.3)).cost == 3.5
    assert_no_plan(q.Fleet(roadmap, ["c"], ["a"], radius=0.3), "agent 0 cannot get from 'c' to 'a'")
    with pytest.raises(ValueError, match=r"starts\[0\]: the roadmap has no vertex called 'z'"):
        q.Fleet(roadmap, ["z"], ["a"], radius=0.3)
    with pytest.raises(ValueError, match="'c' has no place"):
        q.Roadmap.from_networkx(one_way, {"a": (0, 0), "b": (1, 0)})


def test_pandas(siding):
    need("pandas")
    plan = q.solve(siding).plan
    table = plan.to_pandas()
    assert list(table.columns) == ["agent", "vertex", "x", "y", "arrive", "depart"]
    assert (table.groupby("agent")["arrive"].max().sum()) == pytest.approx(plan.sum_of_costs)
    plan = q.solve(random_grid_fleet(5)).plan
    table = plan.to_pandas()
    assert list(table.columns) == ["agent", "t", "x", "y"]
    assert table.groupby("agent")["t"].max().sum() == plan.sum_of_costs


def test_precedences(siding):
    nx = need("networkx")
    corridor = q.Fleet(q.Grid(np.ones((1, 4))), [(1, 0), (0, 0)], [(3, 0), (2, 0)])
    graph = q.solve(corridor).plan.precedences()
    # The second agent comes to each cell after the first one has left it.
    after = [(u, v) for u, v, kind in graph.edges(data="kind") if kind == "after"]
    assert after and all((u[0], v[0]) == (0, 1) for u, v in after)
    assert nx.is_directed_acyclic_graph(graph) and graph.graph["cycle"] == []
    # Four discs that turn in a square: released as a whole, each move waits for the next one.
    corners = q.Roadmap([(0, 0), (2, 0), (2, 2), (0, 2)], [(0, 1), (1, 2), (2, 3), (3, 0)])
    turning = q.solve(q.Fleet(corners, range(4), [1, 2, 3, 0], radius=0.5)).plan.precedences()
    assert sorted(turning.graph["cycle"]) == [(0, 0), (1, 0), (2, 0), (3, 0)]
    assert not nx.is_directed_acyclic_graph(turning)
    plan = q.solve(siding).plan
    graph = plan.precedences()
    assert len(graph) == sum(len(path.stops) - 1 for path in plan)
    # What the plan does obeys them.
    for u, v, data in graph.edges(data=True):
        if data["kind"] == "after":
            assert data["slack"] >= 0
        else:
            assert graph.nodes[u]["end"] <= graph.nodes[v]["begin"]
            assert graph.nodes[u]["target"] == graph.nodes[v]["source"]
    broken = corridor.plan([[(1, 0), (3, 0)], [(0, 0), (2, 0)]])
    with pytest.raises(q.InputError):
        broken.precedences()


def test_no_body_is_smaller_than_given():
    line = q.Roadmap([(0, 0), (2, 0)], [(0, 1)], resolution=0.001)
    body = lambda **given: q.Fleet(line, [0], [1], **given).bodies[0]
    for radius, rounded in ((0.3, 0.3), (0.35, 0.35), (0.3001, 0.301), (0.3009, 0.301), (1e-6, 0.001)):
        assert body(radius=radius) == pytest.approx(rounded, abs=1e-12)
        assert body(radius=body(radius=radius)) == body(radius=radius)
    fleet = q.Fleet(line, [0], [1], radius=0.1, obstacles=[q.Obstacle([(9, 9, 0, 0)], radius=0.2001)])
    assert fleet.obstacles[0].radius == pytest.approx(0.201, abs=1e-12)


def test_polygons_are_not_smaller_than_given():
    line = q.Roadmap([(0, 0), (3, 0)], [(0, 1)], resolution=0.001)
    corners = [(-0.3001, -0.2), (0.3009, -0.2), (0.3001, 0.2004), (-0.3001, 0.2004)]
    wide = [[-0.301, -0.2], [0.301, -0.2], [0.301, 0.201], [-0.301, 0.201]]
    fleet = q.Fleet(line, [0], [1], polygon=corners, obstacles=[q.Obstacle([(9, 9, 0, 0)], polygon=corners)])
    for body in fleet.bodies[0], fleet.obstacles[0].polygon:
        assert np.array(sorted(body.tolist())) == pytest.approx(np.array(sorted(wide)), abs=1e-12)
    again = q.Fleet(line, [0], [1], polygon=fleet.bodies[0])
    assert again.bodies[0].tolist() == fleet.bodies[0].tolist()


def test_rounded_durations_are_told():
    lanes = lambda tick: q.Roadmap([(0.1 * i, 0) for i in range(41)], [(i, i + 1) for i in range(40)],
                                   resolution=(0.001, tick))
    slow = q.Fleet(lanes(0.05), [0], [40], radius=0.3, speed=1.4, names=["amr"])
    assert slow.duration_error == pytest.approx(0.3)
    with pytest.warns(q.RoundingWarning, match=r"by up to 30 %: from vertex 0 to 1, agent amr is planned "
                                               r"to take 0\.05 instead of 0\.07143"):
        assert q.solve(slow).cost == 2
    fine = q.Fleet(lanes(0.0001), [0], [40], radius=0.3, speed=1.4)
    assert 0 < fine.duration_error < 0.01
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert q.solve(fine).cost == pytest.approx(4 / 1.4, rel=0.01)
        assert q.solve(q.Fleet(q.Grid([[1, 1]]), [(0, 0)], [(1, 0)])).cost == 1
