# SPDX-License-Identifier: MIT
"""Where agents move: grids and graphs in timesteps, roadmaps in continuous time."""

from __future__ import annotations

import math
import os
import warnings
from typing import TYPE_CHECKING, Any, Hashable, Mapping, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import Immutable, bools, doubles, ints, listed, with_places
from ._errors import InputError, LayoutWarning, renamed
from .rules import Only, only_of, open_to

if TYPE_CHECKING:
    import networkx as nx

    from .poses import PoseRoadmap, Turning

DEFAULT_RESOLUTION = 1e-6

# Of both, or of a length unit and of a tick.
Resolution = Union[float, tuple[float, float]]


class Grid(Immutable):
    """A grid of cells, 4-connected. In each timestep an agent waits or moves to a neighbouring cell.

    A cell is ``(x, y)``: column and row, ``(0, 0)`` in the upper left corner.

    Args:
        free: bool[h, w], true where an agent may stand: the cell (x, y) is ``free[y, x]``.

    Raises:
        ValueError: for another shape or type.
    """

    _graph: _core.StepGraph

    def __init__(self, free: npt.ArrayLike) -> None:
        self._graph = _core.StepGraph.grid(bools(free, "free", (None, None)))

    @property
    def free(self) -> npt.NDArray[np.bool_]:
        """bool[h, w], read-only."""
        return self._graph.free()

    @property
    def shape(self) -> tuple[int, int]:
        """(h, w): rows and columns."""
        height, width = self.free.shape
        return height, width

    @property
    def num_vertices(self) -> int:
        """Number of free cells."""
        return self._graph.num_vertices

    def with_headings(self, turn: int = 1) -> PoseGrid:
        """The grid for robots that turn, as the League of Robot Runners has them.

        Args:
            turn: Timesteps of a quarter turn, at least 1.

        Raises:
            InputError: for a turn that takes no time, or too long.
        """
        return PoseGrid(self, turn)

    def __repr__(self) -> str:
        height, width = self.shape
        return f"<quadrille.Grid {width} x {height}, {self.num_vertices} free cells>"


class Graph(Immutable):
    """An undirected graph with vertices 0 .. n-1. In each timestep an agent waits or moves along an
    edge; two agents may not swap over one.

    Args:
        num_vertices: n.
        edges: int[m, 2], each edge once.

    Raises:
        InputError: for loops, edges that are given twice, vertices that do not exist.
    """

    _graph: _core.StepGraph

    def __init__(self, num_vertices: int, edges: npt.ArrayLike) -> None:
        if num_vertices < 0:
            raise ValueError("num_vertices: a number of vertices is 0 or more")
        self._graph = _core.StepGraph.make(num_vertices, ints(edges, "edges", (None, 2)))

    @property
    def num_vertices(self) -> int:
        """Number of vertices."""
        return self._graph.num_vertices

    @property
    def edges(self) -> npt.NDArray[np.int32]:
        """int32[m, 2], each edge once, the smaller vertex first; read-only."""
        return self._graph.edges()

    def __repr__(self) -> str:
        return f"<quadrille.Graph {self.num_vertices} vertices, {self._graph.num_edges} edges>"


class Roadmap(Immutable):
    """Vertices in the plane or in space and directed, straight edges, for agents with bodies in
    continuous time.

    Args:
        xy: float[n, 2], places of the vertices in your unit of length; float[n, 3] with heights.
            Where there are any, bodies are spheres.
        edges: int[m, 2], from and to. An edge leads one way.
        durations: float[m], how long the move along an edge takes whoever makes it, in your unit of
            time; NaN, or no array: its length divided by the speed of the agent.
        speed_limits: float[m], nobody goes faster along the edge; NaN, or no array: as fast as the agent
            is. Not on an edge with a duration. For one kind of agents: an edge of its own, ``only`` for
            them, beside one for the others.
        both_ways: Whether each edge may also be used backwards, with the same duration.
        resolution: Size of a length unit and of a tick in your units, or both: (length, time).
            Lengths and times are whole numbers of these, and exact from there on. Places are
            rounded to the nearest.
        nodes: What you call the vertices: ``Fleet`` understands these names as well as numbers.
        only: m entries, who may use an edge: None for all agents, or the name of a group, or several
            names, for the agents of these groups only (None among them: agents without a group). At most
            63 groups, named by strings.
        no_waiting: Vertices at which nobody may wait: who comes there goes on at once. Nobody starts or
            stays there.

    Raises:
        InputError: for loops, vertices that do not exist, numbers that are too large for the
            resolution, edges of length zero without a duration, edges with a duration and a speed limit.
    """

    _graph: _core.TimedGraph

    def __init__(
        self,
        xy: npt.ArrayLike,
        edges: npt.ArrayLike,
        *,
        durations: Optional[npt.ArrayLike] = None,
        both_ways: bool = False,
        resolution: Resolution = DEFAULT_RESOLUTION,
        nodes: Optional[Sequence[Hashable]] = None,
        only: Optional[Sequence[Only]] = None,
        speed_limits: Optional[npt.ArrayLike] = None,
        no_waiting: Sequence[Any] = (),
    ) -> None:
        places = with_places(xy, "xy")
        ends = ints(edges, "edges", (None, 2))
        times: npt.NDArray[np.float64] = np.full(len(ends), np.nan)
        if durations is not None:
            times = doubles(durations, "durations", (len(ends),))
        limits: npt.NDArray[np.float64] = np.full(len(ends), np.nan)
        if speed_limits is not None:
            limits = doubles(speed_limits, "speed_limits", (len(ends),))
        masks, groups = open_to(only, len(ends))
        sizes = listed(doubles(np.broadcast_to(resolution, 2), "resolution", (2,)))
        if not all(0 < size < float("inf") for size in sizes):
            raise ValueError("resolution: a resolution is positive")
        pair = (sizes[0], sizes[1])
        passed = self._passed(no_waiting, nodes)
        graph = _core.TimedGraph(places, ends, times, limits, masks, passed, pair, both_ways)
        self._setup(graph, pair, groups)
        if nodes is not None:
            self._name_nodes(nodes)

    @staticmethod
    def _passed(places: Sequence[Any], nodes: Optional[Sequence[Hashable]]) -> npt.NDArray[np.int64]:
        """Numbers of the vertices at which nobody may wait, of a roadmap with these names."""
        if nodes is None or len(places) == 0:
            return ints(places if len(places) else np.zeros(0, np.int64), "no_waiting", (None,))
        number = {node: at for at, node in enumerate(nodes)}
        for at, place in enumerate(places):
            if place not in number:
                raise InputError(f"no_waiting[{at}]: the roadmap has no vertex called {place!r}")
        return ints([number[place] for place in places], "no_waiting", (None,))

    def _setup(
        self, graph: _core.TimedGraph, resolution: tuple[float, float], groups: list[str]
    ) -> None:
        self._graph = graph
        self._resolution = resolution
        self._groups = groups  # called 1, 2, ... by the compiled part
        self._named_places: dict[str, list[int]] = {}
        # What a file says of headings.
        self._heading_rules: dict[str, list[Any]] = dict(further=[], lanes=[], stands=[], turns=[])
        self._nodes: Optional[list[Hashable]] = None
        self._number: dict[Hashable, int] = {}

    def _name_nodes(self, nodes: Sequence[Hashable]) -> None:
        if len(nodes) != self.num_vertices:
            raise ValueError(f"nodes: {len(nodes)} names for {self.num_vertices} vertices")
        nodes = list(nodes)
        self._nodes = nodes
        self._number = {node: number for number, node in enumerate(nodes)}
        if len(self._number) != len(nodes):
            twice = next(node for at, node in enumerate(nodes) if node in nodes[:at])
            raise ValueError(f"nodes: two vertices are called {twice!r}")

    @classmethod
    def from_networkx(
        cls,
        G: nx.Graph[Any],
        pos: Any = "pos",
        *,
        duration: Optional[str] = None,
        only: Optional[str] = None,
        resolution: Resolution = DEFAULT_RESOLUTION,
    ) -> Roadmap:
        """The roadmap of a networkx graph. Edges of an undirected graph lead both ways.

        Args:
            G: Graph, DiGraph, or their multi-forms. Vertices are numbered in the order of G.
            pos: Name of the node attribute that has the place (x, y), or (x, y, z), or a dict from node
                to place.
            duration: Name of an edge attribute with the duration of a move; edges that lack it take
                their length divided by the speed of the agent.
            only: Name of an edge attribute with the group, or groups, that may use the edge; edges that
                lack it are open to all agents.
            resolution: As for ``Roadmap``.

        Raises:
            ValueError: for a node without a place, and as ``Roadmap``.
        """
        given: Any = G  # What networkx says of its types differs between versions.
        nodes = list(given.nodes)
        places = given.nodes(data=pos) if isinstance(pos, str) else [(node, pos.get(node)) for node in nodes]
        xy: list[Any] = []
        for node, place in places:
            if place is None or np.shape(place) not in ((2,), (3,)):
                raise ValueError(f"pos: node {node!r} has no place (x, y)")
            if xy and len(xy[0]) != len(place):
                raise ValueError(f"pos: node {node!r} does not have {len(xy[0])} coordinates as others")
            xy.append(place)
        number = {node: at for at, node in enumerate(nodes)}
        edges = [(number[u], number[v]) for u, v in given.edges()]
        durations = None
        if duration is not None:
            durations = [np.nan if d is None else d for _, _, d in given.edges(data=duration)]
        return cls(
            xy,
            edges,
            durations=durations,
            both_ways=not G.is_directed(),
            resolution=resolution,
            nodes=nodes,
            only=None if only is None else [groups for _, _, groups in given.edges(data=only)],
        )

    @classmethod
    def read(
        cls,
        file: Union[str, os.PathLike[str]],
        *,
        level: str = "",
        vehicle_type: str = "",
        speed: float = 1,
        resolution: Resolution = DEFAULT_RESOLUTION,
    ) -> Roadmap:
        """The roadmap of a file of others: a nav graph of Open-RMF, a layout in VDMA's LIF, a graph of Nav2,
        GraphML or GML; its contents say which.

        Nobody waits at passthrough points of a nav graph. Vertices are called as the nodes of a LIF or by
        the names in a nav graph; where there is no name, or several vertices have it, by their numbers.
        ``with_headings`` honours what a LIF says of orientations and rotations.

        Args:
            file: Its name.
            level: Of a file with several levels or layouts.
            vehicle_type: Of a LIF with several.
            speed: Of the robots, to say at once that an edge takes too long at its limit.
            resolution: As for ``Roadmap``.

        Raises:
            InputError: with file, line and reason.

        Warns:
            LayoutWarning: of what the file says and plans do not honour.
        """
        sizes = listed(doubles(np.broadcast_to(resolution, 2), "resolution", (2,)))
        if not all(0 < size < float("inf") for size in sizes):
            raise ValueError("resolution: a resolution is positive")
        pair = (sizes[0], sizes[1])
        try:
            graph, ids, are_ids, places, notes, rules = _core.read_map(
                os.fspath(file), pair, speed, level, vehicle_type
            )
        except InputError as error:
            text = str(error).replace("--level", "level=").replace("--vehicle-type", "vehicle_type=")
            raise renamed(error, text) from None
        made = cls.__new__(cls)
        made._setup(graph, pair, [])
        for name, vertex in places:
            made._named_places.setdefault(name, []).append(vertex)
        nodes: list[Hashable] = list(ids) if are_ids else list(range(graph.num_vertices))
        if not are_ids:
            for name, vertices in made._named_places.items():
                if len(vertices) == 1:
                    nodes[vertices[0]] = name
        made._name_nodes(nodes)
        made._heading_rules = rules
        for note in notes:
            warnings.warn(f"{os.fspath(file)}: {note}", LayoutWarning, stacklevel=2)
        return made

    @property
    def named_places(self) -> dict[str, list[Hashable]]:
        """Of a file: further names, such as those of the stations of a LIF, and the vertices that have
        them."""
        nodes = self.nodes
        return {name: [nodes[v] for v in vertices] for name, vertices in self._named_places.items()}

    def with_headings(
        self,
        turning: Turning,
        *,
        kinds: Optional[Mapping[str, Turning]] = None,
        headings: Sequence[tuple[Any, float]] = (),
        lanes: Sequence[tuple[Any, Any, float]] = (),
        stands: Sequence[tuple[Any, float]] = (),
        turns: Sequence[tuple[Any, str]] = (),
    ) -> PoseRoadmap:
        """The roadmap for robots that turn.

        At each place there are the headings of the edges that begin or end there. A robot goes along an
        edge when it faces its way, up to one degree; turns in between take the angle divided by the rate,
        rounded up to whole ticks.

        Args:
            turning: How robots turn of whom ``kinds`` says nothing: degrees per unit of time where they
                stand, or a ``Car``.
            kinds: The same for the robots of a group, by its name.
            headings: (vertex, degrees): one more heading, where a robot begins, say, or has to end.
            lanes: (source, target, degrees): whoever goes along that edge faces so all the way, and not
                ahead. Told several times: in any one of these headings.
            stands: (vertex, degrees): whoever comes to the vertex turns to that heading, and stays in it
                or goes on from it.
            turns: (vertex, "none", "ccw", "cw" or "both"): in which directions robots may turn there.

        What the roadmap's file says of headings holds as well. Places are in the plane of x and y, y
        upwards: 90 degrees are counter-clockwise from 0.

        Raises:
            InputError: for vertices, edges and groups that do not exist, numbers that are out of range, and
                edges that go straight up or down.
        """
        from .poses import PoseRoadmap, heading_rules, kinds_of

        rules = heading_rules(self, headings, lanes, stands, turns)
        return PoseRoadmap(self, kinds_of(turning, kinds or {}, self._groups, self.resolution[1]), rules)

    def _pose_map(self) -> Optional[_core.PoseMap]:
        """Of robots that turn: how their bodies do."""
        return None

    def _yaws(self) -> Optional[npt.NDArray[np.float64]]:
        """Of robots that turn: where they face at each vertex, in radians from -pi to pi."""
        return None

    @property
    def num_vertices(self) -> int:
        """Number of vertices."""
        return self._graph.num_vertices

    @property
    def resolution(self) -> tuple[float, float]:
        """Sizes of a length unit and of a tick in your units of length and time."""
        return self._resolution

    @property
    def xy(self) -> npt.NDArray[np.float64]:
        """float64[n, 2], with heights [n, 3], places in your unit of length, as rounded; read-only."""
        return self._graph.xy(self._resolution)

    @property
    def units(self) -> npt.NDArray[np.int64]:
        """int64[n, 2], with heights [n, 3], places in whole length units; read-only, and not a copy."""
        return self._graph.units

    @property
    def edges(self) -> npt.NDArray[np.int32]:
        """int32[m, 2], from and to; read-only."""
        return self._graph.edges()

    @property
    def durations(self) -> npt.NDArray[np.float64]:
        """float64[m], in your unit of time, NaN where the agent's speed decides; read-only."""
        return self._graph.durations(self._resolution)

    @property
    def speed_limits(self) -> npt.NDArray[np.float64]:
        """float64[m], in your units, NaN where there is none; read-only."""
        return self._graph.speed_limits(self._resolution)

    @property
    def no_waiting(self) -> npt.NDArray[np.int64]:
        """int64[k], the vertices at which nobody may wait, ascending; read-only."""
        return self._graph.no_waiting()

    @property
    def groups(self) -> list[str]:
        """What the groups of agents are called, for which edges are reserved."""
        return list(self._groups)

    @property
    def only(self) -> list[Optional[tuple[Optional[str], ...]]]:
        """Per edge the groups whose agents may use it, None among them for agents without a group; None
        if all may."""
        return [only_of(mask, self._groups) for mask in listed(self._graph.open_to())]

    @property
    def nodes(self) -> list[Hashable]:
        """What the vertices are called: their numbers, or the nodes of the networkx graph."""
        return list(range(self.num_vertices)) if self._nodes is None else list(self._nodes)

    def _vertices(self, places: Any, name: str) -> npt.NDArray[np.int64]:
        """Numbers of vertices that are given by number or by node."""
        if self._nodes is None:
            return ints(places, name, (None,))
        return ints([self._vertex(place, f"{name}[{at}]") for at, place in enumerate(places)], name, (None,))

    def _vertex(self, place: Any, what: str) -> int:
        if self._nodes is None:
            return ints(place, what, ()).item()
        try:
            return self._number[place]
        except (KeyError, TypeError):  # no vertex, or nothing that can be a name
            raise InputError(f"{what}: the roadmap has no vertex called {place!r}") from None

    def _called(self, vertex: int) -> str:
        """For messages."""
        if self._nodes is None:
            return f"vertex {vertex}"
        if vertex >= len(self._nodes):
            return "the middle of its move"
        return repr(self._nodes[vertex])

    def __repr__(self) -> str:
        return f"<quadrille.Roadmap {self.num_vertices} vertices, {self._graph.num_edges} edges>"


class PoseGrid(Roadmap):
    """A grid for robots that turn: a roadmap of poses, made by ``Grid.with_headings``.

    In one timestep, the unit of time, a robot waits or goes to the cell ahead; turning to the left or
    right where it is takes ``turn`` of them. A vertex is called ``(x, y, heading)``, where the heading is
    "east", "south", "west" or "north" and (x, y) a free cell; all four of a cell are in one place. With
    radius 0.35 (``RADIUS``) robots collide exactly if two are in one cell, or change places.

        grid = q.Grid(free).with_headings()
        fleet = q.Fleet(grid, [(0, 0, "east")], [grid.any_heading(4, 2)], radius=grid.RADIUS)
    """

    RADIUS = 0.35

    def __init__(self, grid: Grid, turn: int = 1) -> None:
        free = grid.free
        graph = _core.TimedGraph.poses(free, int(ints(turn, "turn", ())))
        self._setup(graph, _core.pose_resolution, [])
        cells = [(int(x), int(y)) for y, x in zip(*np.nonzero(free))]
        self._name_nodes([(x, y, heading) for x, y in cells for heading in _core.heading_names()])
        self._turn, self._free = int(turn), free

    @property
    def turn(self) -> int:
        """Timesteps of a quarter turn."""
        return self._turn

    def any_heading(self, x: int, y: int) -> list[Hashable]:
        """The poses of a cell, as a goal for ``Fleet``: a robot ends at any one of them.

        Raises:
            InputError: for a cell that is not free.
        """
        poses: list[Hashable] = [(x, y, heading) for heading in _core.heading_names()]
        for pose in poses:
            self._vertex(pose, "any_heading")
        return poses

    def _cells(self) -> tuple[npt.NDArray[np.bool_], int]:
        """Which of them are free, and how long a quarter turn takes."""
        return self._free, self._turn

    def with_headings(self, turning: Turning, **rules: Any) -> PoseRoadmap:
        """Its robots turn already.

        Raises:
            InputError: always.
        """
        raise InputError("with_headings: the vertices are poses already")

    def _yaws(self) -> npt.NDArray[np.float64]:
        # The rows of a grid go down, and so does y.
        angles = {"east": 0.0, "south": math.pi / 2, "west": math.pi, "north": -math.pi / 2}
        one = [angles[heading] for heading in _core.heading_names()]
        return np.tile(np.array(one), self.num_vertices // len(one))

    def __repr__(self) -> str:
        return f"<quadrille.PoseGrid {self.num_vertices} poses, a quarter turn takes {self.turn}>"
