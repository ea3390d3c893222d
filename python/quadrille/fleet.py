# SPDX-License-Identifier: MIT
"""Agents with their tasks."""

from __future__ import annotations

import copyreg
import os
import warnings
from contextlib import contextmanager
from typing import Any, Generic, Iterator, Optional, Sequence, TypeVar, Union, cast, overload

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import Immutable, Shape, doubles, ints, listed, per_agent
from ._errors import InputError, LayoutWarning, renamed
from .graphs import Graph, Grid, Roadmap
from .naming import file_names
from .plans import Plan, StepPlan, TimedPlan
from .rules import (
    Obstacle,
    Underway,
    flags,
    group_numbers,
    moments,
    obstacle_of,
    timesteps,
)

P = TypeVar("P", bound=Plan)


class Fleet(Immutable, Generic[P]):
    """Agents on a grid, a graph or a roadmap, each with a start and a goal where it stays at the end, or
    several goals, of which it may choose any one.

    Args:
        graph: ``Grid``, ``Graph`` or ``Roadmap``.
        starts, goals: On a grid int[n, 2], cells (x, y). Otherwise int[n], vertices, or their names
            if the roadmap has names. On roadmaps a start may also be an ``Underway``. An agent may
            have several goals: then ``goals`` has n entries, each a place or a list of places,
            int[k, 2] or int[k]. No two agents end where they would be in each other's way.
        radius: On roadmaps: radius of the agents' discs in your unit of length, a number or
            float[n]; rounded up to a length unit, so that no body is smaller than given. Every
            agent on a roadmap needs a radius or a polygon: there is no default.
        polygon: On roadmaps, instead: float[k, 2], corners of a convex polygon around the agent's
            place, which does not turn; or a list of n entries, None where the radius counts. It is
            rounded outwards to length units, so that it contains the one given.
        speed: On roadmaps: length per time, a number or float[n]. Default 1.
        group: On roadmaps: the name of a group for all agents, or n entries, None without one. An agent
            may use the edges that are open to all, and those that are reserved for its group.
        release: The agent begins no move before this time, a number or n entries: a timestep, on
            roadmaps in your unit of time. At its start it is from ``now`` on all the same, in the way of others, and
            its cost counts from there. Default 0.
        deadline: A plan in which the agent arrives for good later is none; a number or n
            entries, None or NaN: whenever (default). Times on roadmaps are rounded to the nearest tick.
        leaves: Whether the agent vanishes when it arrives, instead of staying at its
            goal; a truth value or bool[n]. Default false.
        overlap_at_start: On roadmaps: whether the agent's body may overlap, at its start, with that of
            another agent for which that is true, too: the two do not collide as long as both stand
            there, nor while one of them does and the other one makes its first move, if they are apart when
            that ends; a truth value or bool[n]. Default false.
        obstacles: On roadmaps: ``Obstacle`` s, of which agents keep clear.
        robust: On grids and graphs: nobody is in a place within so many timesteps after another agent
            was there; 1: nobody follows another one closely. Default 0.
        whole_moves: Plans are for systems that release whole moves, such as VDA 5050: moves that cross
            are never under way at the same time. On grids and graphs that is ``robust=1``. Default false.
        names: n names for the agents, which plans and tables show; default "0", "1", ...
        now: When the agents are at their starts: a timestep, 0 to 1,000,000,000, on roadmaps a time in
            your unit, rounded to the nearest tick. All times, those of plans too, are those of the
            same clock; costs count from ``now``. Default 0.

    Raises:
        InputError: for places that do not exist or are blocked, two agents with the same start or
            the same goal, numbers that are out of range.
        ValueError: for arrays of another shape or type.

    Warns:
        LayoutWarning: if the file of the roadmap says how robots face, and they have no headings.

    Starts or goals of bodies that overlap, goals out of reach and deadlines that are too early are no
    errors: there is no plan, as ``solve`` says.
    """

    # Why there is no plan, of a file: nothing else is known of it.
    _unread: Optional[str] = None
    # Of one of which it is seen that it has no plan: what it was made of.
    _given: Optional[dict[str, Any]] = None

    @overload
    def __init__(
        self: Fleet[StepPlan],
        graph: Union[Grid, Graph],
        starts: npt.ArrayLike,
        goals: Any,
        *,
        release: Any = None,
        deadline: Any = None,
        leaves: Optional[npt.ArrayLike] = None,
        robust: int = 0,
        whole_moves: bool = False,
        names: Optional[Sequence[str]] = None,
        now: int = 0,
    ) -> None: ...

    @overload
    def __init__(
        self: Fleet[TimedPlan],
        graph: Roadmap,
        starts: Any,
        goals: Any,
        *,
        radius: Optional[npt.ArrayLike] = None,
        polygon: Any = None,
        speed: Optional[npt.ArrayLike] = None,
        group: Union[None, str, Sequence[Optional[str]]] = None,
        release: Any = None,
        deadline: Any = None,
        leaves: Optional[npt.ArrayLike] = None,
        overlap_at_start: Optional[npt.ArrayLike] = None,
        obstacles: Sequence[Obstacle] = (),
        whole_moves: bool = False,
        names: Optional[Sequence[str]] = None,
        now: float = 0,
    ) -> None: ...

    def __init__(
        self,
        graph: Union[Grid, Graph, Roadmap],
        starts: Any,
        goals: Any,
        *,
        radius: Optional[npt.ArrayLike] = None,
        polygon: Any = None,
        speed: Optional[npt.ArrayLike] = None,
        group: Union[None, str, Sequence[Optional[str]]] = None,
        release: Any = None,
        deadline: Any = None,
        leaves: Optional[npt.ArrayLike] = None,
        overlap_at_start: Optional[npt.ArrayLike] = None,
        obstacles: Sequence[Obstacle] = (),
        robust: int = 0,
        whole_moves: bool = False,
        names: Optional[Sequence[str]] = None,
        now: float = 0,
    ) -> None:
        parts = {name: value for name, value in locals().items() if name != "self"}
        instance: Union[_core.StepInstance, _core.TimedInstance]
        called = [] if names is None else [repr(str(name)) for name in names]
        if isinstance(graph, Roadmap):
            if robust != 0:
                raise ValueError("robust is for grids and graphs")
            if any(graph._heading_rules.values()):
                warnings.warn(
                    "the layout says how robots face and turn: with_headings honours that",
                    LayoutWarning,
                    stacklevel=2,
                )
            begin, under_way = _starts(graph, starts)
            end, num_goals = _goal_vertices(graph, goals)
            n = len(begin)
            _check_lengths(n, len(num_goals))
            instance = _core.TimedInstance(
                graph._graph,
                graph.resolution,
                begin,
                end,
                num_goals,
                _bodies(radius, polygon, n, called),
                per_agent(1.0 if speed is None else speed, "speed", n),
                dict(
                    poses=graph._pose_map(),
                    groups=group_numbers(group, graph._groups, n),
                    releases=moments(release, "release", n, 0.0),
                    deadlines=moments(deadline, "deadline", n, np.nan),
                    leaves=flags(False if leaves is None else leaves, "leaves", n),
                    overlaps=flags(
                        False if overlap_at_start is None else overlap_at_start, "overlap_at_start", n
                    ),
                    under_way=under_way,
                    obstacles=[obstacle._given() for obstacle in obstacles],
                    now=doubles(now, "now", ()).item(),
                    whole_moves=bool(whole_moves),
                ),
                dict(
                    agent=lambda i: called[i] if i < len(called) else f"agent {i}",
                    vertex=graph._called,
                ),
            )
        else:
            given = dict(radius=radius, polygon=polygon, speed=speed, group=group)
            given.update(obstacles=obstacles or None, overlap_at_start=overlap_at_start)
            for name, value in given.items():
                if value is not None:
                    raise ValueError(f"{name} is for roadmaps")
            shape = (None, 2) if isinstance(graph, Grid) else (None,)
            begin = ints(starts, "starts", shape)
            end, num_goals = _goal_sets(goals, shape)
            _check_lengths(len(begin), len(num_goals))
            n = len(begin)
            instance = _core.StepInstance(
                graph._graph,
                begin,
                end,
                num_goals,
                called,
                ints(now, "now", ()).item(),
                dict(
                    releases=timesteps(release, "release", n, 0),
                    deadlines=timesteps(deadline, "deadline", n, -1),
                    leaves=flags(False if leaves is None else leaves, "leaves", n),
                    robust=ints(robust, "robust", ()).item() or int(bool(whole_moves)),
                ),
            )
        self._setup(graph, instance, names)
        if self.no_plan is not None:
            self._given = parts

    def __reduce__(self) -> Any:
        if self._given is not None:
            return _remade, (self._given,)
        return copyreg.__newobj__, (type(self),), self.__dict__  # type: ignore[attr-defined]

    def _setup(
        self,
        graph: Union[Grid, Graph, Roadmap],
        instance: Union[_core.StepInstance, _core.TimedInstance],
        names: Optional[Sequence[str]],
    ) -> None:
        self._graph = graph
        self._instance = instance
        # Its vertices are those of the graph, and one for each agent that is under way.
        self._places = graph
        if isinstance(graph, Roadmap) and isinstance(instance, _core.TimedInstance):
            if instance.graph.num_vertices > graph.num_vertices:
                self._places = Roadmap.__new__(Roadmap)
                self._places._setup(instance.graph, graph.resolution, graph._groups)
        self._names = [str(i) for i in range(len(self))] if names is None else list(names)
        if len(self._names) != len(self):
            raise ValueError(f"names: {len(self._names)} names for {len(self)} agents")
        if len(set(self._names)) != len(self):
            twice = next(name for at, name in enumerate(self._names) if name in self._names[:at])
            raise ValueError(f"names: two agents are called {twice!r}")

    def __len__(self) -> int:
        """Number of agents."""
        return self._instance.num_agents

    @property
    def graph(self) -> Union[Grid, Graph, Roadmap]:
        """Where the agents move."""
        self._require_parts()
        return self._graph

    @property
    def no_plan(self) -> Optional[str]:
        """On roadmaps: why there is no plan, if that is seen without a search; else None. ``solve`` gives
        it as the explanation."""
        if isinstance(self._instance, _core.TimedInstance):
            return self._instance.no_plan
        return None

    @property
    def names(self) -> list[str]:
        """What the agents are called."""
        self._require_parts()
        return list(self._names)

    @property
    def now(self) -> float:
        """When the agents are at their starts: int, a timestep, or float in your unit of time."""
        return self._instance.now

    @property
    def starts(self) -> npt.NDArray[np.int32]:
        """int32[n, 2], cells (x, y), on grids; int32[n], vertices, otherwise. Read-only.

        Agents that are under way begin at vertices of their own, numbered after those of the roadmap.
        """
        return self._instance.starts()

    @property
    def goals(self) -> npt.NDArray[np.int32]:
        """As ``starts``.

        Raises:
            ValueError: where some agent has several: see ``goal_sets``.
        """
        if self._instance.has_goal_sets():
            raise ValueError("some agents have several goals: goal_sets has them")
        return self._instance.goals()

    @property
    def goal_sets(self) -> list[npt.NDArray[np.int32]]:
        """Per agent, all its goals, as ``starts``."""
        return self._instance.goal_sets()

    @property
    def bodies(self) -> list[Union[float, npt.NDArray[np.float64]]]:
        """On roadmaps, per agent: the radius of a disc, or float64[k, 2], corners of a polygon."""
        return self._timed("bodies").bodies()

    @property
    def duration_error(self) -> float:
        """On roadmaps: the largest relative error of the time that an agent takes for an edge that it may
        use, because it is rounded to whole ticks: abs(rounded - exact) / exact."""
        worst = self._timed("duration_error").duration_error()
        return 0.0 if worst is None else worst[0]

    @property
    def speeds(self) -> npt.NDArray[np.float64]:
        """On roadmaps: float64[n], length per time; read-only."""
        return self._timed("speeds").speeds()

    @property
    def groups(self) -> list[Optional[str]]:
        """On roadmaps, per agent: the name of its group, or None."""
        numbers = listed(self._timed("groups").rules()["groups"])
        names = cast(Roadmap, self._graph)._groups
        return [None if number == 0 else names[number - 1] for number in numbers]

    @property
    def releases(self) -> npt.NDArray[np.float64]:
        """float64[n], before which agents begin no move; read-only."""
        return cast("npt.NDArray[np.float64]", self._instance.rules()["releases"])

    @property
    def deadlines(self) -> npt.NDArray[np.float64]:
        """float64[n], NaN for none; read-only."""
        return cast("npt.NDArray[np.float64]", self._instance.rules()["deadlines"])

    @property
    def leaves(self) -> npt.NDArray[np.bool_]:
        """bool[n], who vanishes at its goal; read-only."""
        return cast("npt.NDArray[np.bool_]", self._instance.rules()["leaves"])

    @property
    def overlap_at_start(self) -> npt.NDArray[np.bool_]:
        """On roadmaps: bool[n], who may overlap with others at its start; read-only."""
        return cast("npt.NDArray[np.bool_]", self._timed("overlap_at_start").rules()["overlaps"])

    @property
    def robust(self) -> int:
        """On grids and graphs: for how many timesteps a place stays closed to others; else 0."""
        return cast(int, self._instance.rules().get("robust", 0))

    @property
    def whole_moves(self) -> bool:
        """Whether plans are for systems that release whole moves."""
        return bool(self._instance.rules().get("whole_moves", self.robust > 0))

    @property
    def _moves(self) -> dict[int, Underway]:
        """Who begins in the middle of a move, by agent."""
        moves = self._timed("moves").rules()["moves"]
        return {
            agent: Underway(source, target, fraction, None, may_wait)
            for agent, source, target, fraction, may_wait in moves
        }

    @property
    def under_way(self) -> npt.NDArray[np.bool_]:
        """On roadmaps: bool[n], who begins in the middle of a move; read-only."""
        return cast("npt.NDArray[np.bool_]", self._timed("under_way").rules()["under_way"])

    @property
    def obstacles(self) -> list[Obstacle]:
        """On roadmaps: as rounded."""
        return [obstacle_of(given) for given in self._timed("obstacles").rules()["obstacles"]]

    def plan(self, paths: Any) -> P:
        """A plan of your own; ``verify`` says whether it is valid.

        Args:
            paths: int[n, T, 2], cells (x, y), on grids; int[n, T], vertices, on graphs. An agent
                stays in its last place. On roadmaps n paths, each a list of stops: a vertex alone,
                through which the agent passes at once; (vertex, depart), where it waits until then; or
                (vertex, arrive, depart). It arrives as soon as it gets there where nothing else is said, and
                begins at ``now``. Vertices by number or name, times in your unit, to the nearest
                tick; a structured array such as ``plan[0].stops`` will do. An agent that is under way begins at
                ``fleet.starts[agent]``.

        Raises:
            InputError: for places that do not exist or are blocked, and on roadmaps where a time is
                missing and no edge leads there.
        """
        if isinstance(self._instance, _core.TimedInstance):
            return self._timed_plan(paths)
        array = np.asarray(paths)
        shape = (None, None, 2) if isinstance(self._graph, Grid) else (None, None)
        if array.ndim == len(shape) and array.shape[1] == 0:
            raise ValueError("paths: a path has at least one place")
        return self._make_plan(self._instance.plan(ints(array, "paths", shape)))

    def _timed_plan(self, paths: Any) -> P:
        if len(paths) != len(self):
            raise InputError(f"paths: {len(paths)} paths for {len(self)} agents")
        instance = self._timed("plan")
        given = [self._stops(path, f"paths[{agent}]") for agent, path in enumerate(paths)]
        with self._named():
            return self._make_plan(instance.plan(given))

    def _stops(self, path: Any, name: str) -> tuple[Any, Any, Any]:
        """Vertices, arrivals and departures, NaN where nothing is said."""
        graph = cast(Roadmap, self._graph)
        if isinstance(path, np.ndarray) and path.dtype.names is not None:
            times = doubles(np.stack([path["arrive"], path["depart"]]), name, (2, None))
            return ints(path["vertex"], name, (None,)), times[0].copy(), times[1].copy()
        vertices: list[int] = []
        given: list[tuple[float, float]] = []
        for at, stop in enumerate(path):
            is_place = not isinstance(stop, (tuple, list)) or (
                isinstance(stop, tuple) and stop in graph._number
            )
            place, *when = (stop,) if is_place else stop
            if len(when) > 2:
                raise InputError(f"{name}[{at}]: a stop is a vertex, with its arrival and departure")
            number = isinstance(place, (int, np.integer)) and place >= graph.num_vertices
            vertices.append(int(place) if number else graph._vertex(place, f"{name}[{at}]"))
            arrive = when[0] if len(when) == 2 else np.nan
            given.append((arrive, when[-1] if when else np.nan))
        if not vertices:
            raise InputError(f"{name}: a path has at least one stop")
        both = doubles(given, name, (None, 2))
        return ints(vertices, name, (None,)), both[:, 0].copy(), both[:, 1].copy()

    def read_plan(self, file: Union[str, os.PathLike[str]], format: Optional[str] = None) -> P:
        """A plan from a file. Whether it is valid, ``verify`` says.

        Args:
            file: Its name.
            format: "json", "cbsh2", "lns2", "visualizer", "lacam" or "yaml", on roadmaps "json" or
                "ccbs"; by default the contents decide.

        Raises:
            InputError: with file, line and reason.
        """
        return self._make_plan(self._instance.read_plan(os.fspath(file), format))

    def save(self, file: Union[str, os.PathLike[str]], format: Optional[str] = None) -> None:
        """Writes the instance for the program. ``read`` gives the same integers and names.

        Args:
            file: Its name.
            format: "json", or on grids "yaml"; by default the name decides (.json, .yaml, .yml), and
                a name without an ending is JSON.

        Raises:
            FileError: if it cannot be written.
            InputError: for another format or ending, and for nodes of a roadmap that are neither
                texts nor whole numbers nor tuples of these.
        """
        self._require_parts()
        self._instance.save(os.fspath(file), format, file_names(self._graph, self._names))

    def _make_plan(self, plan: Union[_core.StepPlan, _core.TimedPlan]) -> P:
        made: Plan
        if isinstance(plan, _core.StepPlan):
            made = StepPlan(cast("Fleet[StepPlan]", self), plan)
        else:
            made = TimedPlan(cast("Fleet[TimedPlan]", self), plan)
        return cast(P, made)

    def _require_parts(self) -> None:
        """A NoPlanError, where they are not known."""
        if self._unread is not None:
            self._instance.num_agents

    def _timed(self, what: str) -> _core.TimedInstance:
        if isinstance(self._instance, _core.TimedInstance):
            return self._instance
        raise ValueError(f"{what}: on roadmaps only")

    def _duration_warning(self) -> str:
        """What there is to say of durations that are rounded too much; empty if nothing is."""
        if not isinstance(self._instance, _core.TimedInstance):
            return ""
        if self._instance.no_plan is not None:
            return ""
        worst = self._instance.duration_error()
        if worst is None or worst[0] < _core.NOTABLE_DURATION_ERROR:
            return ""
        relative, agent, source, target, planned, exact = worst
        return (
            f"durations are rounded by up to {100 * relative:.3g} %: from vertex {source} to {target}, "
            f"agent {self._names[agent]} is planned to take {planned:g} instead of {exact:.4g}; "
            "a smaller resolution of time mends that"
        )

    def _in_names(self, message: str) -> str:
        """A message of the library, with names instead of numbers where there are any."""
        agents: list[Optional[str]] = [
            None if name == str(i) else repr(name) for i, name in enumerate(self._names)
        ]
        nodes = self._graph._nodes if isinstance(self._graph, Roadmap) else None
        vertices: list[Optional[str]] = [repr(node) for node in nodes or []]
        return _core.in_names(message, agents, vertices)

    @contextmanager
    def _named(self) -> Iterator[None]:
        """Errors of the library inside of it have names instead of numbers."""
        try:
            yield
        except InputError as error:
            raise renamed(error, self._in_names(str(error))) from None

    def _cost(self, cost: int) -> float:
        """A cost of the library in the user's unit of time."""
        if isinstance(self._instance, _core.TimedInstance):
            return self._instance.in_input_units(cost)
        return cost

    def __repr__(self) -> str:
        if self._unread is not None:
            return f"<quadrille.Fleet that has no plan: {self._unread}>"
        return f"<quadrille.Fleet of {len(self)} on {self._graph!r}>"


def _remade(given: dict[str, Any]) -> Fleet[Any]:
    made: Fleet[Any] = cast(Any, Fleet)(**given)
    return made


def _starts(
    graph: Roadmap, starts: Any
) -> tuple[npt.NDArray[np.int64], list[tuple[int, int, int, float, Optional[float], bool]]]:
    """Vertices, and who is under way instead: the agent, and an ``Underway``."""
    under_way: list[tuple[int, int, int, float, Optional[float], bool]] = []
    if isinstance(starts, np.ndarray) and starts.dtype.kind != "O":
        return graph._vertices(starts, "starts"), under_way
    places = list(starts)
    for agent, place in enumerate(places):
        if not isinstance(place, Underway):
            continue
        source = graph._vertex(place.source, f"starts[{agent}]")
        target = graph._vertex(place.target, f"starts[{agent}]")
        begun = None if place.begun is None else float(place.begun)
        under_way.append((agent, source, target, float(place.fraction), begun, bool(place.may_wait)))
        places[agent] = place.source
    return graph._vertices(places, "starts"), under_way


def _goal_sets(goals: Any, shape: Shape) -> tuple[npt.NDArray[np.int64], list[int]]:
    """All goals in a row, and how many each agent has. ``shape``: of an array of places."""
    dimensions = len(shape)
    entries: Any = goals if isinstance(goals, (np.ndarray, list, tuple)) else ()
    if not any(np.ndim(entry) == dimensions for entry in entries):
        plain = ints(goals, "goals", shape)
        return plain, [1] * len(plain)
    sets = [
        ints(entry if np.ndim(entry) == dimensions else [entry], f"goals[{agent}]", shape)
        for agent, entry in enumerate(entries)
    ]
    return np.ascontiguousarray(np.concatenate(sets)), [len(one) for one in sets]


def _goal_vertices(graph: Roadmap, goals: Any) -> tuple[npt.NDArray[np.int64], list[int]]:
    """The same on a roadmap, whose vertices may have names. A name may be a tuple, but not a list."""

    def is_set(entry: Any) -> bool:
        if isinstance(entry, tuple):
            return entry not in graph._number
        return isinstance(entry, list) or (isinstance(entry, np.ndarray) and entry.ndim == 1)

    if not isinstance(goals, (list, tuple, np.ndarray)) or not any(is_set(entry) for entry in goals):
        plain = graph._vertices(goals, "goals")
        return plain, [1] * len(plain)
    sets = [
        graph._vertices(entry if is_set(entry) else [entry], f"goals[{agent}]")
        for agent, entry in enumerate(goals)
    ]
    return np.ascontiguousarray(np.concatenate(sets)), [len(one) for one in sets]


def _check_lengths(starts: int, goals: int) -> None:
    if starts != goals:
        raise ValueError(f"there are {starts} starts and {goals} goals")


def _bodies(radius: Any, polygon: Any, n: int, called: Sequence[str]) -> list[Any]:
    """Per agent a float or float64[k, 2]."""
    radii: list[Optional[float]] = [None] * n
    if radius is not None:
        radii = [float(r) for r in per_agent(radius, "radius", n)]
    bodies: list[Any] = list(radii)
    if polygon is not None:
        if len(polygon) and (any(c is None for c in polygon) or np.ndim(polygon[0]) == 2):
            if len(polygon) != n:
                raise ValueError(f"polygon: {len(polygon)} entries for {n} agents")
            bodies = [
                radii[i] if corners is None else doubles(corners, "polygon", (None, 2))
                for i, corners in enumerate(polygon)
            ]
        elif radius is not None:
            raise ValueError("an agent has either a radius or a polygon")
        else:
            bodies = [doubles(polygon, "polygon", (None, 2))] * n
    for agent, body in enumerate(bodies):
        if body is None:
            who = called[agent] if agent < len(called) else f"agent {agent}"
            raise InputError(f"{who} has no body: on a roadmap give a radius or a polygon")
    return bodies
