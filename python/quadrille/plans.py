# SPDX-License-Identifier: MIT
"""Plans: one path per agent, in timesteps or in continuous time."""

from __future__ import annotations

import html
import json
import operator
import os
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Callable, Iterator, Optional, Sequence, Union, cast

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import Immutable, doubles, frozen, listed
from ._errors import InputError
from .graphs import Graph, Grid, Roadmap
from .naming import file_names, place_names
from .poses import PoseRoadmap
from .reports import Report, Violation
from .rules import Obstacle, Underway, obstacle_of

if TYPE_CHECKING:
    import networkx as nx
    import pandas as pd

    from .fleet import Fleet


@dataclass(frozen=True)
class NodeOrder:
    """What becomes of a plan where moves are released as a whole: a follower begins its move after the
    leader has *ended* its own, as by orders of VDA 5050, or ``Executor.gate``."""

    cycle: list[tuple[int, int]]
    """Moves (agent, move) that wait for each other for ever, each for the end of the one before it, the
    first one for the last one. Empty: all arrive."""
    num_knots: int
    """Groups of moves that wait for each other in circles."""
    num_knotted_moves: int
    """Moves in them."""
    num_overlaps: int
    """Precedences whose moves overlap in time in the plan: what it costs to release whole moves."""

    @property
    def acyclic(self) -> bool:
        return not self.cycle


class Plan(Immutable):
    """One path per agent. ``StepPlan`` on grids and graphs, ``TimedPlan`` on roadmaps.

    An agent is given by its number, or by its name: ``plan[3]``, ``plan["amr1"]``.
    """

    _plan: Union[_core.StepPlan, _core.TimedPlan]

    def __init__(self, fleet: Fleet[Any], plan: Union[_core.StepPlan, _core.TimedPlan]) -> None:
        self._fleet = fleet
        self._plan = plan

    def __len__(self) -> int:
        """Number of agents."""
        return self._plan.num_agents

    def __getstate__(self) -> dict[str, Any]:
        return {"_fleet": self._fleet, "_plan": self._plan}

    def __getitem__(self, agent: Union[int, str]) -> Any:
        raise NotImplementedError

    @property
    def names(self) -> list[str]:
        """What the agents are called."""
        return self._fleet.names

    @property
    def now(self) -> float:
        """When all paths begin: int, a timestep, or float in your unit of time."""
        raise NotImplementedError

    @property
    def costs(self) -> npt.NDArray[Any]:
        """Per agent how long after ``now`` it arrives for good: int64[n] in timesteps, float64[n] in your
        unit of time."""
        raise NotImplementedError

    @property
    def makespan(self) -> float:
        """How long after ``now`` the last agent arrives."""
        return cast(float, self.costs.max(initial=0).item())

    @property
    def sum_of_costs(self) -> float:
        return cast(float, self.costs.sum().item())

    @cached_property
    def _free_costs(self) -> list[Optional[float]]:
        """Per agent, what it would cost without the others; None where it can reach no goal."""
        costs = listed(self._fleet._instance.free_costs())
        return [None if cost < 0 else self._fleet._cost(cost) for cost in costs]

    @property
    def delay(self) -> float:
        """By how much the agents' costs are more than without each other, in sum: waits and detours."""
        return float(sum(self[agent].delay for agent in range(len(self))))

    def _times(self, ticks: npt.NDArray[np.int64]) -> npt.NDArray[np.float64]:
        """In your unit of time."""
        return np.array([self._fleet._cost(time) for time in listed(ticks)], dtype=np.float64)

    @property
    def _tick(self) -> float:
        """Its size in your unit of time."""
        return 1.0

    def _timeline(self, agent: int) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Moments float64[k] and places float64[k, dimensions]; between two of them the agent moves evenly."""
        raise NotImplementedError

    def sample(self, hz: float) -> npt.NDArray[np.float64]:
        """Where everybody is, ``hz`` times per timestep or unit of time.

        Returns:
            float64[n, T, 2], (x, y) at ``now`` and 1 / hz, 2 / hz, ... later, up to the makespan; on a
            roadmap with heights float64[n, T, 3]. On a grid a move takes one timestep, evenly.

        Raises:
            ValueError: for a rate that is not positive, and on graphs without coordinates.
        """
        if not 0 < hz < float("inf"):
            raise ValueError(f"hz: a rate is positive, not {hz}")
        # Half a millionth more, so that rounding does not cost the last moment.
        moments = self.now + np.arange(int(np.floor(self.makespan * hz + 5e-7)) + 1) / hz
        places = np.empty((len(self), len(moments), self._dimensions))
        for agent in range(len(self)):
            times, xy = self._timeline(agent)
            for axis in range(self._dimensions):
                places[agent, :, axis] = np.interp(moments, times, xy[:, axis])
        return frozen(places)

    @property
    def _dimensions(self) -> int:
        """Of places."""
        return 2

    def to_pandas(self) -> pd.DataFrame:
        """The plan as a table, for which pandas is needed."""
        import pandas

        return pandas.DataFrame(self._columns())

    def _columns(self) -> dict[str, Any]:
        raise NotImplementedError

    def precedences(self) -> nx.DiGraph[Any]:
        """Which moves come before which, whatever delays the agents; networkx is needed.

        Returns:
            A DiGraph. A node is (agent, move), its attributes are ``source``, ``target`` (vertices),
            ``begin`` and ``end`` (of the plan), and ``goes_on``: it ends where nobody may wait, so that the
            agent does not begin it before it may make the next one, too. An edge says that the second move waits for the first
            one; ``kind`` is "next" within a path, "after" between two agents. The latter have a
            ``slack``: until the first move has ended, the second agent may be that much ahead of the
            first one, counted in times of the plan. ``graph["cycle"]`` of it is a list of (agent,
            move): moves that wait for each other for ever if robots are released move by move, as by
            orders of VDA 5050, each for the end of the one before it, the first one for the last one.
            Empty if all arrive so.

        Raises:
            InputError: if the plan is not valid.
        """
        return order_graph(self._precedences(), self._fleet._cost)

    def node_order(self) -> NodeOrder:
        """Whether all arrive if robots are released move by move.

        Raises:
            InputError: as ``precedences``.
        """
        cycle, *counts = self._precedences().node_order()
        return NodeOrder(_cycle(cycle), *counts)

    def _precedences(self) -> _core.Precedences:
        raise NotImplementedError

    def verify(self) -> Report:
        """Replays the plan, by code that shares nothing with the searches."""
        raise NotImplementedError

    def save(self, file: Union[str, os.PathLike[str]], format: Optional[str] = None) -> None:
        """Writes the plan.

        Args:
            file: Its name.
            format: "json", "cbsh2", "lns2", "visualizer", "lacam" or "yaml", on roadmaps "json" or
                "ccbs"; by default the name decides (.json, .yaml, .yml, on roadmaps .json, .xml),
                and a name without an ending is JSON.

        Raises:
            FileError: if it cannot be written.
            InputError: for a format that is not for this graph, and for other endings.
        """
        self._plan.save(self._fleet._instance, os.fspath(file), format)  # type: ignore[arg-type]

    def to_html(self, title: str = "") -> str:
        """The page of ``quadrille view``, which plays the plan: one text, without other files.

        Args:
            title: By default "Plan of n agents".
        """
        return self._page(title)

    def to_svg(
        self, kind: str = "map", agents: Optional[Sequence[Union[int, str]]] = None, title: str = ""
    ) -> str:
        """A picture of the plan.

        Args:
            kind: "map", with paths, starts and goals; "space-time", along the path of the first of
                the agents; "waits", a row per agent.
            agents: Who is drawn; by default all.
            title: Stands above the picture.

        Raises:
            InputError: for another kind.
            IndexError: for an agent that there is not.
        """
        chosen = range(len(self)) if agents is None else agents
        return self._picture(kind, title, [self._checked(agent) for agent in chosen])

    def _repr_html_(self) -> str:
        """The page, for notebooks. In a frame, because it has scripts and styles of its own."""
        page, title = html.escape(self.to_html()), html.escape(repr(self))
        return (
            f'<iframe srcdoc="{page}" sandbox="allow-scripts" title="{title}" '
            'style="width: 100%; height: 36em; border: 1px solid #8888"></iframe>'
        )

    def _shown(self) -> list[str]:
        """Names for pages; agents that are called by their numbers have none."""
        names = self._fleet._names
        return [name if name != str(i) else "" for i, name in enumerate(names)]

    def _page(self, title: str) -> str:
        raise NotImplementedError

    def _picture(self, kind: str, title: str, agents: list[int]) -> str:
        raise NotImplementedError

    def _checked(self, agent: Union[int, str]) -> int:
        """The number of an agent that is given by number, from the end if it is negative, or by name."""
        if isinstance(agent, str):
            if agent not in self._fleet._names:
                raise InputError(f"there is no agent called {agent!r}")
            return self._fleet._names.index(agent)
        agent = operator.index(agent)
        if not -len(self) <= agent < len(self):
            raise IndexError(f"there is no agent {agent} among {len(self)}")
        return agent % len(self)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Plan):
            return NotImplemented
        return type(self) is type(other) and self._content() == other._content()

    __hash__ = None  # type: ignore[assignment]

    def _content(self) -> list[bytes]:
        raise NotImplementedError


def order_graph(order: _core.Precedences, time: Callable[[int], float]) -> nx.DiGraph[Any]:
    """As ``Plan.precedences`` says. ``time``: from that of the library to the user's unit."""
    import networkx

    graph: nx.DiGraph[Any] = networkx.DiGraph()
    graph.graph["cycle"] = _cycle(order.node_order()[0])
    for agent, move, source, target, begin, end, goes_on in listed(order.moves()):
        graph.add_node(
            (agent, move),
            source=source,
            target=target,
            begin=time(begin),
            end=time(end),
            goes_on=bool(goes_on),
        )
        if move > 0:
            graph.add_edge((agent, move - 1), (agent, move), kind="next")
    for leader, first, follower, second, slack in listed(order.list()):
        graph.add_edge((leader, first), (follower, second), kind="after", slack=time(slack))
    return graph


def _cycle(moves: npt.NDArray[np.int64]) -> list[tuple[int, int]]:
    return [(agent, move) for agent, move in listed(moves)]


@dataclass(frozen=True)
class Wait:
    """A stay that takes time, before the agent has arrived for good."""

    place: Any
    """Where: a cell (x, y), or a vertex, by its name if it has one."""
    begin: float
    end: float


@dataclass(frozen=True)
class StepPath(Immutable):
    """Path of one agent in timesteps."""

    name: str
    places: npt.NDArray[np.int32]
    """int32[T, 2], cells (x, y), on grids; int32[T], vertices, on graphs, from the plan's ``now`` on. As
    long as the plan's."""
    cost: int
    """Timesteps until its last arrival, from the plan's ``now``."""
    now: int = 0
    """The plan's."""
    free_cost: Optional[int] = None
    """What its cost would be without the other agents; None if it can reach no goal."""

    @property
    def delay(self) -> int:
        """How much more its cost is: waits and detours. 0 if it can reach no goal."""
        return 0 if self.free_cost is None else self.cost - self.free_cost

    def at(self, time: float) -> Any:
        """Where the agent is: at its start before the plan begins, in its last place after the end. On
        grids float64[2], (x, y), also between two cells; on graphs the vertex that it is at, or leaves."""
        since = min(max(time - self.now, 0), len(self.places) - 1)
        before = int(since)
        if self.places.ndim == 1:
            return int(self.places[before])
        after = self.places[min(before + 1, len(self.places) - 1)]
        return frozen(self.places[before] + (since - before) * (after - self.places[before]))

    def waits(self) -> list[Wait]:
        """Where it stands still before it has arrived for good."""
        waits: list[Wait] = []
        places = listed(self.places[: self.cost + 1])
        for t in range(self.cost):
            if places[t] != places[t + 1]:
                continue
            place = tuple(places[t]) if self.places.ndim == 2 else places[t]
            if waits and waits[-1].end == self.now + t:
                waits[-1] = Wait(place, waits[-1].begin, self.now + t + 1)
            else:
                waits.append(Wait(place, self.now + t, self.now + t + 1))
        return waits


class StepPlan(Plan):
    """Paths in timesteps, on a grid or a graph."""

    _plan: _core.StepPlan
    _paths: Optional[npt.NDArray[np.int32]] = None

    @property
    def paths(self) -> npt.NDArray[np.int32]:
        """int32[n, T, 2], cells (x, y), on grids; int32[n, T], vertices, on graphs, at the timesteps
        ``now``, ``now`` + 1, ... T - 1 is the makespan: agents stay in their last place. Read-only;
        made once."""
        if self._paths is None:
            self._paths = self._plan.paths(self._graph)
        return self._paths

    @property
    def _graph(self) -> _core.StepGraph:
        return cast("Union[Grid, Graph]", self._fleet.graph)._graph

    @property
    def now(self) -> int:
        return self._plan.now

    @property
    def costs(self) -> npt.NDArray[np.int64]:
        return self._plan.costs()

    @property
    def _instance(self) -> _core.StepInstance:
        return cast(_core.StepInstance, self._fleet._instance)

    def __getitem__(self, agent: Union[int, str]) -> StepPath:
        number = self._checked(agent)
        free = self._free_costs[number]
        return StepPath(
            self._fleet._names[number],
            self.paths[number],
            int(self.costs[number]),
            self.now,
            None if free is None else int(free),
        )

    def __iter__(self) -> Iterator[StepPath]:
        return (self[agent] for agent in range(len(self)))

    def _timeline(self, agent: int) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        if not self._graph.is_grid:
            raise ValueError("the vertices of a graph have no coordinates")
        xy = self.paths[agent].astype(np.float64)
        return self.now + np.arange(len(xy), dtype=np.float64), xy

    def _columns(self) -> dict[str, Any]:
        """One row per agent and timestep up to its arrival: agent, t, and x and y or vertex."""
        lengths = self.costs + 1
        agent = np.repeat(np.arange(len(self)), lengths)
        since = np.concatenate([np.arange(length) for length in lengths] or [np.arange(0)])
        names = np.array(self._fleet._names, dtype=object)
        columns: dict[str, Any] = {"agent": names[agent], "t": self.now + since}
        places = self.paths[agent, since]
        if places.ndim == 2:
            columns.update(x=places[:, 0], y=places[:, 1])
        else:
            columns.update(vertex=places)
        return columns

    def verify(self) -> Report:
        violations, sum_of_costs, makespan = self._instance.verify(self._plan)
        called = self._fleet._in_names
        found = [
            Violation(kind, agent, other, time, called(message))
            for kind, agent, other, time, message in violations
        ]
        return Report(found, sum_of_costs, makespan)

    def _precedences(self) -> _core.Precedences:
        with self._fleet._named():
            return _core.step_precedences(self._instance, self._plan)

    def _page(self, title: str) -> str:
        return _core.step_page(self._instance, self._plan, title, self._shown())

    def _picture(self, kind: str, title: str, agents: list[int]) -> str:
        return _core.step_picture(self._instance, self._plan, kind, title, agents)

    def _content(self) -> list[bytes]:
        return [np.array([self.now, *self.paths.shape]).tobytes(), self.paths.tobytes()]

    def __repr__(self) -> str:
        return f"<quadrille.StepPlan of {len(self)} agents, makespan {self.makespan}>"


STOP = np.dtype(
    [("vertex", "i4"), ("x", "f8"), ("y", "f8"), ("arrive", "f8"), ("depart", "f8")]
)
STOP_IN_SPACE = np.dtype(
    [("vertex", "i4"), ("x", "f8"), ("y", "f8"), ("z", "f8"), ("arrive", "f8"), ("depart", "f8")]
)


@dataclass(frozen=True)
class TimedPath(Immutable):
    """Path of one agent in continuous time."""

    name: str
    stops: npt.NDArray[np.void]
    """Structured [k]: (vertex, x, y, arrive, depart), on a roadmap with heights also z after y; places
    and times in your units. The agent is at the vertex from its arrival to its departure, then moves
    evenly to the next one; the last stop is for ever."""
    ticks: npt.NDArray[np.void]
    """Structured [k]: (vertex, arrive, depart) in whole ticks, which is what the proof is about.
    Read-only, and not a copy: it keeps the plan alive."""
    cost: float
    """How long after its first arrival, the plan's ``now``, it arrives at its last stop."""
    free_cost: Optional[float] = None
    """What that would be without the other agents and obstacles; None if it can reach no goal."""
    places: tuple[Any, ...] = ()
    """What the vertices of the stops are called: their names, or numbers."""

    @property
    def delay(self) -> float:
        """How much more its cost is: waits and detours. 0 if it can reach no goal."""
        return 0.0 if self.free_cost is None else self.cost - self.free_cost

    def at(self, time: float) -> npt.NDArray[np.float64]:
        """Where the agent is, float64[2], with heights [3]: at its start before the plan begins, at its
        last stop after the end."""
        return self._look(time)[0]

    def velocity(self, time: float) -> npt.NDArray[np.float64]:
        """How fast it goes, float64[2], with heights [3]; at the moment in which that changes, what comes
        after it."""
        return self._look(time)[1]

    def waits(self) -> list[Wait]:
        """The stops that take time, before it has arrived for good."""
        return [
            Wait(self.places[k], float(stop["arrive"]), float(stop["depart"]))
            for k, stop in enumerate(self.stops[:-1])
            if stop["depart"] > stop["arrive"]
        ]

    def _look(self, time: float) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        stops = self.stops
        axes = [name for name in ("x", "y", "z") if name in (stops.dtype.names or ())]
        here = max(int(np.searchsorted(stops["arrive"], time, side="right")) - 1, 0)
        place = np.array([stops[axis][here] for axis in axes])
        if here + 1 == len(stops) or time < stops["depart"][here]:
            return frozen(place), frozen(np.zeros(len(axes)))
        way = np.array([stops[axis][here + 1] for axis in axes]) - place
        duration = stops["arrive"][here + 1] - stops["depart"][here]
        share = (time - stops["depart"][here]) / duration
        return frozen(place + share * way), frozen(way / duration)


class TimedPlan(Plan):
    """Paths in continuous time, on a roadmap."""

    _plan: _core.TimedPlan

    @property
    def _roadmap(self) -> Roadmap:
        return cast(Roadmap, self._fleet._places)

    @property
    def _dimensions(self) -> int:
        return self._roadmap.units.shape[1]

    @property
    def _axes(self) -> str:
        return "xyz"[: self._dimensions]

    @property
    def _stop(self) -> np.dtype[np.void]:
        return STOP if self._dimensions == 2 else STOP_IN_SPACE

    @property
    def now(self) -> float:
        return self._fleet.now

    @property
    def costs(self) -> npt.NDArray[np.float64]:
        return frozen(self._times(self._plan.costs()))

    @property
    def _instance(self) -> _core.TimedInstance:
        return cast(_core.TimedInstance, self._fleet._instance)

    @property
    def _tick(self) -> float:
        return self._roadmap.resolution[1]

    @property
    def sum_of_costs(self) -> float:
        # The sum of whole ticks is exact.
        return self._fleet._cost(int(self._plan.costs().sum()))

    def __getitem__(self, agent: Union[int, str]) -> TimedPath:
        number = self._checked(agent)
        ticks = self._plan.ticks(number)
        stops = np.empty(len(ticks), dtype=self._stop)
        stops["vertex"] = ticks["vertex"]
        xy = self._roadmap.xy[stops["vertex"]]
        for axis, name in enumerate(self._axes):
            stops[name] = xy[:, axis]
        stops["arrive"], stops["depart"] = self._plan.times(number, self._roadmap.resolution)
        cost = self._fleet._cost(int(ticks["arrive"][-1] - ticks["arrive"][0]))
        free, places = self._free_costs[number], tuple(map(self._place, listed(ticks["vertex"])))
        return TimedPath(self._fleet._names[number], frozen(stops), ticks, cost, free, places)

    def _place(self, vertex: int) -> Any:
        """What a vertex is called; None for one in the middle of a move."""
        graph = cast(Roadmap, self._fleet.graph)
        if vertex >= graph.num_vertices:
            return None
        return vertex if graph._nodes is None else graph._nodes[vertex]

    def start_at(self, agent: Union[int, str], time: float) -> Any:
        """Where the agent is at that time when it does what the plan says, as a start for the fleet that
        plans again on the same roadmap: a vertex, by its name if it has one, or an ``Underway``. As often
        as there is need, also within one move.

        Raises:
            IndexError: for an agent that there is not.
        """
        agent = self._checked(agent)
        place, stops, begin = self._place, self[agent].stops, self._fleet._moves.get(agent)

        def on_the_way(
            source: int, target: int, fraction: float, may_wait: bool = False
        ) -> Underway:
            return Underway(place(source), place(target), fraction, None, may_wait)

        last = len(stops) - 1
        at = next((k for k in range(last) if stops["depart"][k] >= time), last)
        vertex = int(stops["vertex"][at])
        if at == 0 and begin is not None:
            return on_the_way(begin.source, begin.target, begin.fraction, begin.may_wait)
        if at == 0 or stops["arrive"][at] <= time:
            return place(vertex)
        depart, arrive = float(stops["depart"][at - 1]), float(stops["arrive"][at])
        share = (time - depart) / (arrive - depart)
        if at == 1 and begin is not None:
            rest = 1 - begin.fraction
            return on_the_way(begin.source, begin.target, begin.fraction + rest * share)
        return on_the_way(int(stops["vertex"][at - 1]), vertex, share)

    def obstacle(self, agent: Union[int, str]) -> Optional[Obstacle]:
        """What another fleet has to keep clear of, when the agent does what the plan says; None for one
        that leaves where it begins, and so is never anywhere.

        Raises:
            IndexError: for an agent that there is not.
        """
        path = self[agent]
        leaves = bool(self._fleet.leaves[self._checked(agent)])
        if leaves and path.cost == 0:
            return None
        names = [*self._axes, "arrive", "depart"]
        stops = frozen(np.stack([path.stops[name] for name in names], axis=1))
        body = self._fleet.bodies[self._checked(agent)]
        return obstacle_of((body, stops, leaves))

    def __iter__(self) -> Iterator[TimedPath]:
        return (self[agent] for agent in range(len(self)))

    def _timeline(self, agent: int) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        stops = self[agent].stops
        times = np.stack([stops["arrive"], stops["depart"]], axis=1).ravel()
        places = np.stack([stops[name] for name in self._axes], axis=1)
        return times, np.repeat(places, 2, axis=0)

    def _columns(self) -> dict[str, Any]:
        """One row per stop: agent, vertex, x, y, with heights z, arrive, depart."""
        paths = list(self)
        stops = np.concatenate([path.stops for path in paths] or [np.empty(0, dtype=self._stop)])
        columns: dict[str, Any] = {
            "agent": [path.name for path in paths for _ in range(len(path.stops))]
        }
        columns.update((name, stops[name]) for name in self._stop.names or ())
        return columns

    def verify(self, num_clearances: Optional[int] = 1) -> Report:
        """Replays the plan over all time.

        Args:
            num_clearances: how many pairs of agents that come nearest are told; None for all pairs.
        """
        fleet = self._fleet
        violations, sum_of_costs, makespan, (pairs, gaps) = self._instance.verify(
            self._plan, num_clearances
        )
        clearances = np.empty(
            len(pairs), dtype=[("agent", "i4"), ("other", "i4"), ("gap", "f8"), ("time", "f8")]
        )
        clearances["agent"], clearances["other"] = pairs[:, 0], pairs[:, 1]
        clearances["gap"], clearances["time"] = (gaps * np.array(self._roadmap.resolution)).T
        return Report(
            [
                Violation(kind, agent, other, fleet._cost(tick), fleet._in_names(message))
                for kind, agent, other, tick, message in violations
            ],
            fleet._cost(sum_of_costs),
            fleet._cost(makespan),
            frozen(clearances),
        )

    def _yaws(self) -> Optional[npt.NDArray[np.float64]]:
        """Of robots that turn: where they face at each vertex of the instance, in radians. An agent that
        begins in the middle of a move faces as at its end."""
        graph = cast(Roadmap, self._fleet.graph)
        yaws = graph._yaws()
        if yaws is None:
            return None
        ends = [move.target for move in self._fleet._moves.values()]
        return doubles(np.concatenate([yaws, yaws[np.array(ends, dtype=np.int64)]]), "yaws", (None,))

    def _robots(self) -> _core.Names:
        """For messages to others."""
        graph = self._fleet.graph
        if isinstance(graph, PoseRoadmap):
            return [*self._fleet.names], place_names(graph), []
        return [*self._fleet.names], file_names(graph, self._fleet._names)[1], []

    def _valid(self) -> None:
        report = self.verify()
        if not report:
            raise InputError(report.violations[0].message)

    def to_csv(self, rate: float = 10) -> str:
        """Samples as a table, ``quadrille export --to csv``: agent,time,x,y,vx,vy, with heights z and vz.

        Args:
            rate: Samples per unit of time, besides both ends of each move and wait.

        Raises:
            InputError: for a plan that is not valid, and more than 10 million samples.
        """
        return self._samples("csv", rate, 2)

    def to_ros(self, message: str = "multidof", *, rate: float = 10, version: int = 2) -> list[Any]:
        """Messages of ROS, one per agent, ``quadrille export --to multidof`` and ``path``.

        Args:
            message: "multidof" (trajectory_msgs/MultiDOFJointTrajectory), which has the agent's name, or
                "path" (nav_msgs/Path).
            rate: As for ``to_csv``.
            version: Of ROS, 1 or 2: what the fields of times are called.

        Raises:
            InputError: as for ``to_csv``, and for times that messages cannot hold.
        """
        if message not in ("multidof", "path"):
            raise InputError(f"message: {message!r} is not multidof or path")
        return cast("list[Any]", json.loads(self._samples(message, rate, version)))

    def _samples(self, format: str, rate: float, version: int) -> str:
        if not 0 < rate < float("inf"):
            raise ValueError(f"rate: a rate is positive, not {rate}")
        self._valid()
        return _core.samples(
            self._instance, self._plan, self._yaws(), self._robots(), format, rate, version
        )

    def to_rmf(
        self,
        *,
        map: str = "map",
        graph: str = "graph",
        session: str = "",
        allow_cycles: bool = False,
    ) -> list[dict[str, Any]]:
        """What a plan server of Open-RMF's next generation says, ``quadrille export --to open-rmf-plan``:
        one {"name": participant, "plan": rmf_prototype_msgs/Plan} per agent.

        Args:
            map, graph: What they are called.
            session: Sessions of destinations are made of it and the agents' names.
            allow_cycles: Also if robots wait for each other for ever so.

        Raises:
            InputError: for plans that are not valid, or by which robots wait for ever, and roadmaps with
                heights.
        """
        order = self._precedences()
        text = _core.rmf_plans(
            self._instance, self._plan, order, self._robots(), [map, graph, session], allow_cycles
        )
        return cast("list[dict[str, Any]]", json.loads(text))

    def to_vda5050(
        self,
        *,
        version: str = "3.0",
        manufacturer: str = "quadrille",
        map: str = "map",
        order_id: str = "",
        time_stamp: str = "1970-01-01T00:00:00.000Z",
        first: Optional[Sequence[int]] = None,
        released: Optional[Sequence[int]] = None,
        update: int = 0,
        allow_cycles: bool = False,
    ) -> list[dict[str, Any]]:
        """Orders of VDA 5050, one per agent, ``quadrille export --to vda5050``. Serial numbers and nodes
        are called as the agents and vertices are.

        Args:
            version: "3.0", "2.1" or "2.0".
            manufacturer, map: What they are called.
            order_id: Beginning of the ids of orders, which the robot's name follows; else they are the
                names of the robots.
            time_stamp: Of all messages, YYYY-MM-DDTHH:mm:ss.fffZ.
            first, released: Per agent, the node of its path with which the order begins, and the last one
                of its base, as ``Releaser.released`` counts. Default: as at the start. An update begins
                with the last node that was released before.
            update: Number of the update.
            allow_cycles: Also if robots wait for each other for ever with these orders.

        Raises:
            InputError: for plans that are not valid, or whose order of moves has a cycle; for names
                that VDA 5050 does not know, roadmaps with heights, and numbers that do not fit.
        """
        order = self._precedences()
        at_start = _core.Releaser(order)
        ends = [at_start.released(agent) for agent in range(len(self))] if released is None else released
        begins = [0] * len(self) if first is None else first
        for name, numbers in (("first", begins), ("released", ends)):
            if len(numbers) != len(self):
                raise ValueError(f"{name}: {len(numbers)} numbers for {len(self)} agents")
            for agent, number in enumerate(numbers):
                if not 0 <= number < len(self._plan.ticks(agent)):
                    raise InputError(f"{name}[{agent}]: the path has no node {number}")
        heads = [version, manufacturer, map, order_id, time_stamp]
        texts = _core.orders(
            self._instance,
            self._plan,
            self._yaws(),
            order,
            self._robots(),
            heads,
            list(begins),
            list(ends),
            update,
            allow_cycles,
        )
        return [json.loads(text) for text in texts]

    @property
    def _length_unit(self) -> float:
        """Its size in your unit of length."""
        return self._roadmap.resolution[0]

    def _precedences(self) -> _core.Precedences:
        with self._fleet._named():
            return _core.timed_precedences(self._instance, self._plan)

    def _page(self, title: str) -> str:
        return _core.timed_page(self._instance, self._plan, title, self._shown())

    def _picture(self, kind: str, title: str, agents: list[int]) -> str:
        return _core.timed_picture(self._instance, self._plan, kind, title, agents)

    def _content(self) -> list[bytes]:
        ticks = [self._plan.ticks(agent) for agent in range(len(self))]
        return [stops[name].tobytes() for stops in ticks for name in ("vertex", "arrive", "depart")]

    def __repr__(self) -> str:
        return f"<quadrille.TimedPlan of {len(self)} agents, makespan {self.makespan}>"
