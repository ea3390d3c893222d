# SPDX-License-Identifier: MIT
"""Instances from files."""

from __future__ import annotations

import os
import warnings
from typing import Any, Optional, Union

from . import _core
from ._errors import BodyWarning
from .fleet import Fleet
from .graphs import Graph, Grid, Roadmap
from .naming import agent_names, group_names, node_names
from .rules import numbered_groups


def read(
    *files: Union[str, os.PathLike[str]],
    agents: Optional[int] = None,
    passable: Optional[str] = None,
    blocked: Optional[str] = None,
    continuous: bool = False,
    radius: Optional[float] = None,
    speed: Optional[float] = None,
    neighbourhood: Optional[int] = None,
    resolution: Optional[float] = None,
) -> Fleet[Any]:
    """The agents of one file, or of two: a map and its tasks. All formats that the program reads.

    - ``read("x.map", "x.scen", agents=50)``: MovingAI's map and the first 50 rows of a scenario.
    - ``read("x.json")``, ``read("x.yaml")``: quadrille's JSON, on a grid, a graph or a roadmap;
      libMultiRobotPlanning's YAML.
    - ``read("map.xml", "task.xml", radius=0.35)``: a roadmap as GraphML, or a grid as XML.
    - ``read("x.map", "x.scen", continuous=True)``: a grid in continuous time.
    - ``read("x.map")``: a map alone gives a fleet without agents.

    Args:
        agents: Take the first so many rows; all by default.
        passable, blocked: Letters of a map beyond the usual ones.
        continuous: Whether a map is for continuous time. So it is if one of the following is given,
            and if it is no ``.map`` file.
        radius, speed: Of all agents, of files that say nothing of bodies; the radius is rounded down to
            a length unit. Default sqrt(2)/4, which on a grid of unit cells lets a diagonal move just
            touch a disc in the cell beside it, with a warning; and 1.
        neighbourhood: On grids: moves to 2^k neighbours, 2 to 5; default 3.
        resolution: Size of a tick and of a length unit; default 0.000001.

    A file of which it is seen that it has no plan (the program's ``solve`` calls it infeasible: starts
    or goals of bodies overlap, a goal is out of reach, a deadline too early) gives a fleet that can only
    be solved, and is infeasible; what else one asks of it raises ``NoPlanError``.

    Raises:
        InputError: with file, line and reason, as the program prints them.

    Warns:
        BodyWarning: if agents are discs of the default radius, because nothing says what they are.
    """
    if len(files) not in (1, 2):
        raise ValueError(f"read takes one file, or a map and its tasks, not {len(files)} files")
    names = [os.fspath(file) for file in files]
    given: dict[str, Any] = dict(
        agents=agents,
        passable=passable,
        blocked=blocked,
        radius=radius,
        speed=speed,
        neighbourhood=neighbourhood,
        resolution=resolution,
    )
    given = {name: value for name, value in given.items() if value is not None}
    is_map = names[0].endswith(".map")
    is_timed = continuous or bool({"radius", "speed", "neighbourhood", "resolution"} & given.keys())
    if len(names) == 1 and not is_map and not names[0].endswith(".xml"):
        given["instance"] = names[0]
    else:
        first, second = ("map", "scen") if is_map and not is_timed else ("roadmap", "task")
        given[first] = names[0]
        if len(names) == 2:
            given[second] = names[1]
    fleet = _fleet_of(*_core.read(given))
    if "roadmap" in given and radius is None and (fleet._unread is not None or len(fleet) > 0):
        warnings.warn(
            "nothing says how large the agents are: they are discs of radius sqrt(2)/4; give a radius",
            BodyWarning,
            stacklevel=2,
        )
    return fleet


def _fleet_of(
    instance: Union[_core.StepInstance, _core.TimedInstance], names: _core.Names
) -> Fleet[Any]:
    graph: Union[Grid, Graph, Roadmap]
    fleet: Fleet[Any] = Fleet.__new__(Fleet)
    if isinstance(instance, _core.TimedInstance) and instance.no_plan is not None:
        fleet._instance, fleet._unread = instance, instance.no_plan
        return fleet
    if isinstance(instance, _core.TimedInstance):
        graph = Roadmap.__new__(Roadmap)
        groups = numbered_groups(instance.graph.open_to(), instance.rules()["groups"])
        graph._setup(instance.graph, instance.resolution, group_names(names, groups))
        nodes = node_names(names, graph.num_vertices)
        if nodes is not None:
            graph._name_nodes(nodes)
    else:
        graph = Grid.__new__(Grid) if instance.graph.is_grid else Graph.__new__(Graph)
        graph._graph = instance.graph
    fleet._setup(graph, instance, agent_names(names, instance.num_agents))
    return fleet
