# SPDX-License-Identifier: MIT
"""Plans: one path per agent, in timesteps or in continuous time."""

from __future__ import annotations

import html
import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Iterator, Optional, Sequence, Union, cast

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import listed
from .graphs import Graph, Grid, Roadmap
from .reports import Report, Violation
from .rules import Obstacle, Underway, obstacle_of

if TYPE_CHECKING:
    import networkx as nx
    import pandas as pd

    from .fleet import Fleet


class Plan:
    """One path per agent. ``StepPlan`` on grids and graphs, ``TimedPlan`` on roadmaps."""

    _plan: Union[_core.StepPlan, _core.TimedPlan]

    def __init__(self, fleet: Fleet[Any], plan: Union[_core.StepPlan, _core.TimedPlan]) -> None:
        self._fleet = fleet
        self._plan = plan

    def __len__(self) -> int:
        """Number of agents."""
        return self._plan.num_agents

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
        return places

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
            ``begin`` and ``end`` (of the plan). An edge says that the second move waits for the first
            one; ``kind`` is "next" within a path, "after" between two agents. The latter have a
            ``slack``: until the first move has ended, the second agent may be that much ahead of the
            first one, counted in times of the plan. ``graph["cycle"]`` of it is a list of (agent,
            move): moves that wait for each other for ever if robots are released move by move, as by
            orders of VDA 5050, each for the end of the one before it, the first one for the last one.
            Empty if all arrive so.

        Raises:
            InputError: if the plan is not valid.
        """
        import networkx

        graph: nx.DiGraph[Any] = networkx.DiGraph()
        moves, list_, cycle = self._precedences()
        graph.graph["cycle"] = [(agent, move) for agent, move in listed(cycle)]
        time = self._fleet._cost
        for agent, move, source, target, begin, end in listed(moves):
            graph.add_node(
                (agent, move), source=source, target=target, begin=time(begin), end=time(end)
            )
            if move > 0:
                graph.add_edge((agent, move - 1), (agent, move), kind="next")
        for leader, first, follower, second, slack in listed(list_):
            graph.add_edge((leader, first), (follower, second), kind="after", slack=time(slack))
        return graph

    def _precedences(
        self,
    ) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64], npt.NDArray[np.int64]]:
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
        self, kind: str = "map", agents: Optional[Sequence[int]] = None, title: str = ""
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

    def _page(self, title: str) -> str:
        raise NotImplementedError

    def _picture(self, kind: str, title: str, agents: list[int]) -> str:
        raise NotImplementedError

    def _checked(self, agent: int) -> int:
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


@dataclass(frozen=True)
class StepPath:
    """Path of one agent in timesteps."""

    name: str
    places: npt.NDArray[np.int32]
    """int32[T, 2], cells (x, y), on grids; int32[T], vertices, on graphs, from the plan's ``now`` on. As
    long as the plan's."""
    cost: int
    """Timesteps until its last arrival, from the plan's ``now``."""


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

    def __getitem__(self, agent: int) -> StepPath:
        agent = self._checked(agent)
        return StepPath(self._fleet._names[agent], self.paths[agent], int(self.costs[agent]))

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
        instance = cast(_core.StepInstance, self._fleet._instance)
        violations, sum_of_costs, makespan = instance.verify(self._plan)
        return Report([Violation(*violation) for violation in violations], sum_of_costs, makespan)

    def _precedences(
        self,
    ) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64], npt.NDArray[np.int64]]:
        return _core.step_precedences(cast(_core.StepInstance, self._fleet._instance), self._plan)

    def _page(self, title: str) -> str:
        return _core.step_page(cast(_core.StepInstance, self._fleet._instance), self._plan, title)

    def _picture(self, kind: str, title: str, agents: list[int]) -> str:
        instance = cast(_core.StepInstance, self._fleet._instance)
        return _core.step_picture(instance, self._plan, kind, title, agents)

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
class TimedPath:
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
        fleet = self._fleet
        return np.array([fleet._cost(cost) for cost in listed(self._plan.costs())], dtype=np.float64)

    @property
    def sum_of_costs(self) -> float:
        # The sum of whole ticks is exact.
        return self._fleet._cost(int(self._plan.costs().sum()))

    def __getitem__(self, agent: int) -> TimedPath:
        agent = self._checked(agent)
        ticks = self._plan.ticks(agent)
        stops = np.empty(len(ticks), dtype=self._stop)
        stops["vertex"] = ticks["vertex"]
        xy = self._roadmap.xy[stops["vertex"]]
        for axis, name in enumerate(self._axes):
            stops[name] = xy[:, axis]
        stops["arrive"], stops["depart"] = self._plan.times(agent, self._roadmap.resolution)
        cost = self._fleet._cost(int(ticks["arrive"][-1] - ticks["arrive"][0]))
        return TimedPath(self._fleet._names[agent], stops, ticks, cost)

    def start_at(self, agent: int, time: float) -> Any:
        """Where the agent is at that time when it does what the plan says, as a start for the fleet that
        plans again on the same roadmap: a vertex, by its name if it has one, or an ``Underway``. As often
        as there is need, also within one move.

        Raises:
            IndexError: for an agent that there is not.
        """
        agent = self._checked(agent)
        nodes = cast(Roadmap, self._fleet.graph)._nodes
        stops, begin = self[agent].stops, self._fleet._moves.get(agent)

        def place(vertex: int) -> Any:
            return vertex if nodes is None else nodes[vertex]

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

    def obstacle(self, agent: int) -> Optional[Obstacle]:
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
        stops = np.stack([path.stops[name] for name in names], axis=1)
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
        instance = cast(_core.TimedInstance, fleet._instance)
        violations, sum_of_costs, makespan, (pairs, gaps) = instance.verify(
            self._plan, num_clearances
        )
        clearances = np.empty(
            len(pairs), dtype=[("agent", "i4"), ("other", "i4"), ("gap", "f8"), ("time", "f8")]
        )
        clearances["agent"], clearances["other"] = pairs[:, 0], pairs[:, 1]
        clearances["gap"], clearances["time"] = (gaps * np.array(self._roadmap.resolution)).T
        return Report(
            [
                Violation(kind, agent, other, fleet._cost(tick), message)
                for kind, agent, other, tick, message in violations
            ],
            fleet._cost(sum_of_costs),
            fleet._cost(makespan),
            clearances,
        )

    def _precedences(
        self,
    ) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64], npt.NDArray[np.int64]]:
        return _core.timed_precedences(cast(_core.TimedInstance, self._fleet._instance), self._plan)

    def _page(self, title: str) -> str:
        return _core.timed_page(cast(_core.TimedInstance, self._fleet._instance), self._plan, title)

    def _picture(self, kind: str, title: str, agents: list[int]) -> str:
        instance = cast(_core.TimedInstance, self._fleet._instance)
        return _core.timed_picture(instance, self._plan, kind, title, agents)

    def _content(self) -> list[bytes]:
        ticks = [self._plan.ticks(agent) for agent in range(len(self))]
        return [stops[name].tobytes() for stops in ticks for name in ("vertex", "arrive", "depart")]

    def __repr__(self) -> str:
        return f"<quadrille.TimedPlan of {len(self)} agents, makespan {self.makespan}>"
