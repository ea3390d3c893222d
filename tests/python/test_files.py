# SPDX-License-Identifier: MIT
"""What the package saves it reads again without a loss, and so does the program: random fleets with random
names, and their plans in all formats."""

import random

import numpy as np
import pytest
from conftest import random_grid_fleet, run_program, scaled
from test_rules import random_fleet

import quadrille as q

NAMES = ["a", "agent0", "agent1", "0", "1", "7", "", "null", "- x", "it's: \"#{", "ä€\U0001f600", "a\nb\\n",
         "\x01\x7f", "~", "[1]", "true", "!!str x", "\ufeff", "\u2028\x85"]
NODES = [*NAMES, 5, 0, 1, -3, (0, 1), ("a", (2, "b")), (), 10**18]


def renamed(fleet, rng):
    """The same agents with other names, of them and, on roadmaps, of nodes and groups."""
    names = rng.sample(NAMES, len(fleet)) if rng.random() < 0.8 else None
    graph = fleet.graph
    if not isinstance(graph, q.Roadmap):
        now = rng.choice([0, 0, 1, 10**9])
        return q.Fleet(graph, fleet.starts, fleet.goals, names=names, now=now)
    nodes = rng.sample(NODES, graph.num_vertices) if rng.random() < 0.7 else None
    groups = dict(zip(graph.groups, rng.sample(NAMES, len(graph.groups))))
    if rng.random() < 0.3:
        groups = {group: group for group in groups}
    renamed_groups = lambda entry: entry and tuple(group and groups[group] if group else None for group in entry)
    roadmap = q.Roadmap(
        graph.xy,
        graph.edges,
        durations=graph.durations,
        resolution=rng.choice([graph.resolution, (0.01, 0.001), (0.001, 0.01), 0.005]),
        nodes=nodes,
        only=[renamed_groups(entry) for entry in graph.only],
    )
    known = roadmap.groups
    of_agent = [groups[group] if group and groups[group] in known else None for group in fleet.groups]
    vertices = roadmap.nodes
    return q.Fleet(
        roadmap,
        [vertices[start] for start in fleet.starts],
        [vertices[goal] for goal in fleet.goals],
        radius=rng.uniform(0.1, 0.3),
        group=of_agent,
        release=fleet.releases,
        deadline=fleet.deadlines,
        leaves=fleet.leaves,
        names=names,
        now=fleet.now,
    )


def random_graph_fleet(seed):
    rng = random.Random(seed)
    n = rng.randint(2, 6)
    edges = sorted({(rng.randrange(v), v) for v in range(1, n)})
    count = rng.randint(0, min(n, 3))
    return q.Fleet(q.Graph(n, edges), np.array(rng.sample(range(n), count), dtype=int),
                   np.array(rng.sample(range(n), count), dtype=int))


def random_named_fleet(seed):
    """None if it cannot have a plan for all to see."""
    rng = random.Random(seed)
    try:
        make = rng.choice([random_grid_fleet, random_graph_fleet, random_fleet, random_fleet])
        fleet = make(seed)
        if fleet is None or (isinstance(fleet.graph, q.Roadmap) and fleet.under_way.any()):
            return fleet
        return renamed(fleet, rng)
    except q.NoPlanError:
        return None


def same(fleet, again):
    assert type(again.graph) is type(fleet.graph)
    assert again.names == fleet.names and again.now == fleet.now
    assert np.array_equal(fleet.starts, again.starts) and np.array_equal(fleet.goals, again.goals)
    if isinstance(fleet.graph, q.Roadmap):
        count = fleet.graph.num_vertices  # without the places of agents that are under way
        assert again.graph.nodes[:count] == fleet.graph.nodes
        assert [type(node) for node in again.graph.nodes[:count]] == [type(node) for node in fleet.graph.nodes]
        assert again.graph.groups == fleet.graph.groups and again.groups == fleet.groups
        assert again.graph.only[: len(fleet.graph.only)] == fleet.graph.only
        assert np.array_equal(again.graph.units[:count], fleet.graph.units)
        assert again.graph.resolution == fleet.graph.resolution
        assert np.array_equal(fleet.speeds, again.speeds)
        assert str(fleet.bodies) == str(again.bodies)
    elif isinstance(fleet.graph, q.Grid):
        assert np.array_equal(fleet.graph.free, again.graph.free)
    else:
        assert np.array_equal(fleet.graph.edges, again.graph.edges)


def formats_of(fleet):
    """(format or None, ending) of plans."""
    if fleet.now > 0:
        return [(None, ".json"), (None, ""), ("json", ".txt")]
    if isinstance(fleet.graph, q.Roadmap):
        return [(None, ".json"), (None, ".xml"), (None, ""), ("json", ".txt"), ("ccbs", ""), ("ccbs", ".json")]
    found = [(None, ".json"), (None, ".yaml"), (None, ".yml"), (None, ""), ("yaml", ".json"), ("json", ".csv")]
    of_grids = [("cbsh2", ".txt"), ("lns2", ""), ("visualizer", ""), ("lacam", "")]
    return found + (of_grids if isinstance(fleet.graph, q.Grid) else [])


def test_what_is_saved_is_read(tmp_path):
    plans = 0
    for seed in range(scaled(150)):
        fleet = random_named_fleet(seed)
        if fleet is None:
            continue
        rng = random.Random(seed)
        ways = [(None, ".json"), (None, ""), ("json", ".dat")]
        if isinstance(fleet.graph, q.Grid) and fleet.now == 0:
            ways += [(None, ".yaml"), (None, ".yml"), ("yaml", ".dat"), ("json", ".yaml"), ("yaml", ".json")]
        format, ending = rng.choice(ways)
        file = tmp_path / f"i{ending}"
        fleet.save(file, format)
        again = q.read(file)
        same(fleet, again)
        twice = tmp_path / "twice.json"
        again.save(twice)
        same(again, q.read(twice))
        # The program keeps names, too.
        done = run_program("convert", "--instance", file, "--to", "json", "--output", tmp_path / "c.json")
        assert done.returncode == 0, (seed, done.stderr)
        same(again, q.read(tmp_path / "c.json"))
        plan = q.solve(fleet, conflict_limit=100).plan
        if plan is None:
            continue
        plans += 1
        format, ending = rng.choice(formats_of(fleet))
        plan_file = tmp_path / f"p{ending}"
        plan.save(plan_file, format)
        assert fleet.read_plan(plan_file) == plan
        assert again.read_plan(plan_file, format) == plan
        done = run_program("verify", "--instance", file, plan_file)
        assert done.returncode == 0, (seed, done.stdout, done.stderr)
        file.unlink()
        plan_file.unlink()
    assert plans > 30 or scaled(150) < 150


@pytest.mark.parametrize("ending", [".csv", ".txt", ".map", ".JSON", ".gz"])
def test_an_ending_that_is_no_format_is_refused(tmp_path, ending):
    grid = q.Fleet(q.Grid(np.ones((1, 3), bool)), [(0, 0)], [(2, 0)])
    road = q.Fleet(q.Roadmap([(0, 0), (1, 0)], [(0, 1)]), [0], [1], radius=0.1)
    file = tmp_path / f"x{ending}"
    for fleet in (grid, road):
        for what in (fleet, q.solve(fleet).plan):
            with pytest.raises(q.InputError, match="stands for none of the formats"):
                what.save(file)
            assert not file.exists()
            what.save(file, "json")
            file.unlink()


def test_formats_belong_to_one_kind_of_graph(tmp_path):
    road = q.Fleet(q.Roadmap([(0, 0), (1, 0)], [(0, 1)]), [0], [1], radius=0.1)
    steps = q.Fleet(q.Graph(2, [(0, 1)]), [0], [1])
    for what, name in ((road, "x.yaml"), (q.solve(road).plan, "x.yaml"), (q.solve(steps).plan, "x.xml"),
                       (steps, "x.yaml")):
        with pytest.raises(q.InputError):
            what.save(tmp_path / name)
        assert not (tmp_path / name).exists()


def test_what_cannot_be_written_leaves_the_file(tmp_path):
    file = tmp_path / "p"
    file.write_text("old")
    steps = q.Fleet(q.Graph(2, [(0, 1)]), [0], [1])
    with pytest.raises(q.InputError):
        q.solve(steps).plan.save(file, "cbsh2")
    road = q.Fleet(q.Roadmap([(0, 0), (1, 0)], [(0, 1)], nodes=[0.5, None]), [0.5], [None], radius=0.1)
    with pytest.raises(q.InputError, match="the node 0.5 cannot be written"):
        road.save(file)
    assert file.read_text() == "old"


def test_two_names_that_are_one_are_refused(tmp_path):
    file = tmp_path / "i.json"
    q.Fleet(q.Grid(np.ones((1, 3), bool)), [(0, 0), (1, 0)], [(1, 0), (2, 0)], names=["1", "x"]).save(file)
    file.write_text(file.read_text().replace('"x"', '"1"'))
    with pytest.raises(q.InputError, match="agents 0 and 1 are both called '1'"):
        q.read(file)
