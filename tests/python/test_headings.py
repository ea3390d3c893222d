# SPDX-License-Identifier: MIT
"""Robots that turn on a roadmap, in the units of its user, and roadmaps of files of others."""

import json
import math
import pathlib
import pickle
import warnings
from typing import Any

import numpy as np
import pytest

import quadrille as q

# An L: from a along x to b, from there along y to c; each 2 m.
CORNER = [(0, 0), (2, 0), (2, 2)]
ROADS = [(0, 1), (1, 2)]
LIFT = [(-0.6, -0.4), (0.6, -0.4), (0.6, 0.4), (-0.6, 0.4)]


def corner(**more: Any) -> q.Roadmap:
    return q.Roadmap(CORNER, ROADS, both_ways=True, resolution=(0.001, 0.1), nodes=list("abc"), **more)


def cost(poses: q.PoseRoadmap, start: Any, goals: Any, **more: Any) -> Any:
    result = q.solve(q.Fleet(poses, [start], [goals], radius=0.3, **more))
    assert result.plan is None or result.plan.verify().valid
    return result.cost


def test_poses() -> None:
    poses = corner().with_headings(90, headings=[("a", -22.5), ("a", 360)])
    assert poses.nodes == [
        *[("a", heading) for heading in (0, 180, 337.5)],
        *[("b", heading) for heading in (0, 90, 180, 270)],
        *[("c", heading) for heading in (90, 270)],
    ]
    assert [poses.place(v) for v in range(9)] == list("aaabbbbcc")
    assert poses.place(("b", 90)) == "b"
    assert poses.headings.tolist() == [node[1] for node in poses.nodes]  # type: ignore[index]
    assert poses.facing("b", 100) == ("b", 90)
    assert poses.facing("b", -50) == ("b", 270)
    assert poses.any_heading("c") == [("c", 90), ("c", 270)]
    assert poses.places.nodes == list("abc")
    assert repr(poses) == "<quadrille.PoseRoadmap 9 poses of 3 places>"
    with pytest.raises(q.InputError, match="no vertex called 'd'"):
        poses.facing("d", 0)
    with pytest.raises(q.InputError, match="poses already"):
        poses.with_headings(90)
    numbers = q.Roadmap(CORNER, ROADS, both_ways=True).with_headings(90)
    assert numbers.nodes[0] == (0, 0) and numbers.facing(1, 90) == (1, 90)
    with pytest.raises(q.InputError, match="no place 3 among 3"):
        numbers.any_heading(3)


def test_turns_take_angle_by_rate_rounded_up() -> None:
    poses = corner().with_headings(40)
    # 2 s, then 90 degrees in 2.25 s, which are 23 ticks, and 2 s.
    assert cost(poses, ("a", 0), poses.any_heading("c")) == pytest.approx(6.3)
    # Half a turn first: 4.5 s.
    assert cost(poses, ("a", 180), poses.any_heading("b")) == pytest.approx(6.5)
    assert cost(poses, ("a", 0), ("c", 270)) == pytest.approx(6.3 + 4.5)


def test_kinds() -> None:
    roadmap = q.Roadmap(
        [*CORNER, (4, 0.5)],
        [*ROADS, (1, 3), (2, 1)],
        both_ways=True,
        resolution=(0.001, 0.1),
        only=[None, None, ("slow", "car"), None],
    )
    poses = roadmap.with_headings(90, kinds={"slow": 45, "car": q.Car(20)})
    start, end = poses.facing(0, 0), poses.any_heading(2)
    assert cost(poses, start, end) == pytest.approx(5)
    assert cost(poses, start, end, group="slow") == pytest.approx(6)
    assert cost(poses, start, end, group="car") is None
    assert cost(poses, start, poses.any_heading(3), group="car") == pytest.approx(4.1)
    assert cost(corner().with_headings(q.Car(90)), ("a", 0), ("c", 90)) == pytest.approx(4)


def test_lanes_stands_and_turns() -> None:
    back = corner().with_headings(90, lanes=[("a", "b", 180), ("a", "b", 0)])
    assert cost(back, ("a", 180), back.any_heading("b")) == pytest.approx(2)  # backwards
    assert cost(back, ("a", 0), ("b", 0)) == pytest.approx(2)
    # Who comes to b turns to 180 degrees there, whatever comes next.
    stands = corner().with_headings(90, stands=[("b", 180)])
    assert stands.any_heading("b") == [("b", 180)]
    assert cost(stands, ("a", 0), stands.any_heading("b")) == pytest.approx(2 + 2)
    assert cost(stands, ("a", 0), stands.any_heading("c")) == pytest.approx(2 + 2 + 1 + 2)
    assert ("b", 90, "leaving") in stands.nodes
    left = corner().with_headings(90, turns=[("b", "ccw")])
    right = corner().with_headings(90, turns=[("b", "cw")])
    never = corner().with_headings(90, turns=[("b", "none")])
    assert cost(left, ("a", 0), left.any_heading("c")) == pytest.approx(5)
    assert cost(right, ("a", 0), right.any_heading("c")) == pytest.approx(7)
    assert cost(never, ("a", 0), never.any_heading("c")) is None


def test_polygons_turn_with_their_robots() -> None:
    # A lane beside another one, 0.9 m away: robots 1.2 m long pass each other, 0.8 m wide.
    beside = q.Roadmap([(0, 0), (4, 0), (0, 0.9), (8, 0.9)], [(0, 1), (3, 2)], resolution=(0.001, 0.1))
    poses = beside.with_headings(90)
    fleet = q.Fleet(poses, [(0, 0), (3, 180)], [(1, 0), (2, 180)], polygon=LIFT)
    result = q.solve(fleet)
    assert result.status == "optimal" and result.cost == pytest.approx(12)
    assert result.plan is not None and result.plan.verify().valid
    # The discs around them do not fit.
    assert q.solve(q.Fleet(poses, [(0, 0), (3, 180)], [(1, 0), (2, 180)], radius=0.7)).status == "infeasible"
    across = beside.with_headings(90, headings=[(1, 90)])
    # Who stands across the lanes has to turn for the other, and back.
    result = q.solve(q.Fleet(across, [(1, 90), (3, 180)], [(1, 90), (2, 180)], polygon=LIFT))
    assert result.status == "optimal" and result.cost > 8 + 2
    # The same agents one by one.
    session = q.Session(poses)
    session.add("one", start=(0, 0), goals=(1, 0), polygon=LIFT)
    session.add("other", start=(3, 180), goals=(2, 180), polygon=LIFT)
    assert session.solve().cost == pytest.approx(12)


def test_pickles_and_files(tmp_path: pathlib.Path) -> None:
    poses = corner().with_headings(90, headings=[("a", 22.5)], stands=[("c", 90)])
    fleet = q.Fleet(poses, [("a", 22.5)], [poses.any_heading("c")], polygon=LIFT)
    again = pickle.loads(pickle.dumps(fleet))
    assert again.graph.nodes == poses.nodes
    assert again.graph.facing("b", 90) == ("b", 90)
    assert q.solve(again).cost == q.solve(fleet).cost
    fleet.save(tmp_path / "poses.json")
    read = q.read(tmp_path / "poses.json")
    assert q.solve(read).cost == pytest.approx(q.solve(fleet).cost / 0.1 * 0.1)
    assert read.graph.nodes[1] == ("a", "22.5")


def test_what_is_wrong() -> None:
    roadmap = corner()
    for call, match in [
        (lambda: roadmap.with_headings(0), "turning: robots turn by more than 0 degrees"),
        (lambda: roadmap.with_headings(math.nan), "turning: robots turn"),
        (lambda: roadmap.with_headings(q.Car(181)), "a car steers by 0 to 180 degrees, not by 181"),
        (lambda: roadmap.with_headings(1, kinds={"x": 1}), "kinds: the roadmap has no group 'x'"),
        (lambda: roadmap.with_headings(1, headings=[("x", 0)]), r"headings\[0\]: .* no vertex called 'x'"),
        (lambda: roadmap.with_headings(1, headings=[("a", math.inf)]), r"headings\[0\]: inf is no heading"),
        (lambda: roadmap.with_headings(1, lanes=[("a", "c", 0)]), "on a lane that the roadmap does not have"),
        (lambda: roadmap.with_headings(1, turns=[("a", "left")]), "'left' is not none, ccw, cw or both"),
        (
            lambda: roadmap.with_headings(1, stands=[("b", 0), ("b", 90)]),
            "vertex 'b' is told twice|'b' is told twice",
        ),
        (lambda: roadmap.with_headings(1e-12), "a rate of turns is not supported"),
    ]:
        with pytest.raises(q.InputError, match=match):
            call()
    lift = q.Roadmap([(0, 0, 0), (0, 0, 3)], [(0, 1)])
    with pytest.raises(q.InputError, match="goes straight up or down"):
        lift.with_headings(1)


def test_exports_have_headings() -> None:
    poses = corner().with_headings(90)
    fleet = q.Fleet(poses, [("a", 180)], [("c", 270)], polygon=LIFT, names=["r"])
    plan = q.solve(fleet).plan
    assert plan is not None
    nodes = plan.to_vda5050()[0]["nodes"]
    assert [node["nodeId"] for node in nodes] == list("aabbcc")
    thetas = [node["nodePosition"]["theta"] for node in nodes]
    assert thetas == pytest.approx([math.pi, 0, 0, math.pi / 2, math.pi / 2, -math.pi / 2])
    transforms = plan.to_ros("multidof", rate=2)[0]["points"]
    rotations = [point["transforms"][0]["rotation"] for point in transforms]
    yaws = [2 * math.atan2(rotation["z"], rotation["w"]) for rotation in rotations]
    # Half a turn is counter-clockwise, as its body is taken to sweep.
    assert math.sin(yaws[1]) == pytest.approx(-math.sqrt(0.5))
    grid = q.Grid(np.ones((1, 2))).with_headings()
    turned = q.Fleet(grid, [(0, 0, "north")], [(1, 0, "east")], radius=0.3)
    plan = q.solve(turned).plan
    assert plan is not None
    thetas = [node["nodePosition"]["theta"] for node in plan.to_vda5050()[0]["nodes"]]
    assert thetas == pytest.approx([-math.pi / 2, 0, 0])


NAV = """
levels:
  L1:
    vertices:
    - [0, 0, {name: dock}]
    - [4, 0, {is_passthrough_point: true}]
    - [8, 0, {name: gate}]
    lanes:
    - [0, 1, {is_bidirectional: true, speed_limit: 0.5}]
    - [1, 2, {}]
"""


def test_nav_graphs(tmp_path: pathlib.Path) -> None:
    file = tmp_path / "hall.yaml"
    file.write_text(NAV)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        roadmap = q.Roadmap.read(file, resolution=(0.001, 0.1))
    assert roadmap.nodes == ["dock", 1, "gate"]
    assert roadmap.named_places == {"dock": ["dock"], "gate": ["gate"]}
    assert roadmap.xy.tolist() == [[0, 0], [4, 0], [8, 0]]
    assert roadmap.edges.tolist() == [[0, 1], [1, 0], [1, 2]]
    assert roadmap.speed_limits[:2].tolist() == [0.5, 0.5] and np.isnan(roadmap.speed_limits[2])
    assert roadmap.no_waiting.tolist() == [1]
    assert q.solve(q.Fleet(roadmap, ["dock"], ["gate"], radius=0.3)).cost == pytest.approx(12)
    with pytest.raises(q.InputError, match="no level with vertices is called 'L2', only 'L1'"):
        q.Roadmap.read(file, level="L2")
    file.write_text(NAV.replace("  L1:", "  L0:\n    vertices:\n    - [0, 0, {}]\n  L1:"))
    with pytest.raises(q.InputError, match="level= says which is meant"):
        q.Roadmap.read(file)
    with pytest.raises(q.FileError):
        q.Roadmap.read(tmp_path / "none.yaml")


def lif(node: Any = None, edge: Any = None) -> str:
    """An L as a layout; ``node``: more of B, ``edge``: more of the edge from A to B."""
    names = {"A": (0, 0), "B": (2, 0), "C": (2, 2)}
    cart = {"vehicleTypeId": "cart"}
    nodes = [
        {"nodeId": name, "nodePosition": {"x": x, "y": y}, "vehicleTypeNodeProperties": [dict(cart)]}
        for name, (x, y) in names.items()
    ]
    nodes[1]["vehicleTypeNodeProperties"] = [dict(cart, **(node or {}))]
    ahead = dict(cart, vehicleOrientation=0)
    edges = [
        {"edgeId": f"{a}{b}", "startNodeId": a, "endNodeId": b, "vehicleTypeEdgeProperties": [dict(ahead)]}
        for a, b in ("AB", "BC", "CB", "BA")
    ]
    edges[0]["vehicleTypeEdgeProperties"] = [dict(ahead, **(edge or {}))]
    stations = [{"stationId": "dock", "interactionNodeIds": ["C", "A"]}]
    layout = {"layoutId": "hall", "nodes": nodes, "edges": edges, "stations": stations}
    return json.dumps({"metaInformation": {"lifVersion": "1.0.0"}, "layouts": [layout]})


def of_lif(folder: pathlib.Path, node: Any = None, edge: Any = None) -> q.PoseRoadmap:
    file = folder / "hall.lif.json"
    file.write_text(lif(node, edge))
    return q.Roadmap.read(file, resolution=(0.001, 0.1)).with_headings(90)


def test_layouts(tmp_path: pathlib.Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        plain = of_lif(tmp_path)
        assert cost(plain, ("A", 0), plain.any_heading("C")) == pytest.approx(5)
        assert plain.places.named_places == {"dock": ["C", "A"]}
        back = of_lif(tmp_path, edge={"vehicleOrientation": 180, "orientationType": "TANGENTIAL"})
        assert cost(back, ("A", 180), back.any_heading("B")) == pytest.approx(2)
        assert ("B", 0) not in back.nodes or cost(back, ("A", 180), ("B", 0)) == pytest.approx(4)
        aside = of_lif(tmp_path, edge={"vehicleOrientation": 90, "orientationType": "GLOBAL"})
        assert cost(aside, ("A", 90), aside.any_heading("C")) == pytest.approx(4)
        stand = of_lif(tmp_path, node={"theta": math.pi})
        assert cost(stand, ("A", 0), stand.any_heading("C")) == pytest.approx(7)
        slow = of_lif(tmp_path, edge={"maxRotationSpeed": math.radians(30)})
        assert cost(slow, ("A", 0), slow.any_heading("C")) == pytest.approx(7)
    with pytest.warns(q.LayoutWarning, match="with_headings honours that"):
        q.Fleet(stand.places, ["A"], ["C"], radius=0.3)
    for directions, expected in (("NONE", None), ("CCW", 5), ("CW", 7), ("BOTH", 5)):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", q.LayoutWarning)
            turns = of_lif(tmp_path, edge={"rotationAtEndNodeAllowed": directions})
        found = cost(turns, ("A", 0), turns.any_heading("C"))
        assert found == (None if expected is None else pytest.approx(expected))
    with pytest.warns(q.LayoutWarning, match="turn only as all edges allow that begin or end there at 'B'"):
        of_lif(tmp_path, edge={"rotationAtEndNodeAllowed": "NONE"})
    with pytest.warns(q.LayoutWarning, match=r"rotation on an edge is not used \(1 time\)"):
        of_lif(tmp_path, edge={"rotationAllowed": True})
    for wrong, match in [
        ({"orientationType": "LOCAL"}, "expected GLOBAL or TANGENTIAL, found 'LOCAL'"),
        ({"vehicleOrientation": 400}, "an orientation is in degrees, from 0 to 360"),
        ({"rotationAtStartNodeAllowed": "LEFT"}, "expected NONE, CCW, CW or BOTH, found 'LEFT'"),
        ({"maxRotationSpeed": 0}, "a rotation speed is positive"),
    ]:
        with pytest.raises(q.InputError, match=match) as caught:
            of_lif(tmp_path, edge=wrong)
        assert caught.value.line == 1
    with pytest.raises(q.InputError, match="theta is in radians, from -pi to pi"):
        of_lif(tmp_path, node={"theta": 90})


def test_from_a_layout_to_orders(tmp_path: pathlib.Path) -> None:
    # It backs from A to B, as the layout says, and goes on ahead.
    poses = of_lif(tmp_path, edge={"vehicleOrientation": 180})
    fleet = q.Fleet(poses, [("A", 180)], [poses.any_heading("C")], polygon=LIFT, names=["r"])
    plan = q.solve(fleet).plan
    assert plan is not None and plan.verify().valid
    nodes = plan.to_vda5050(version="2.0")[0]["nodes"]
    assert [node["nodeId"] for node in nodes] == list("ABBC")
    thetas = [node["nodePosition"]["theta"] for node in nodes]
    assert thetas == pytest.approx([math.pi, math.pi, math.pi / 2, math.pi / 2])
