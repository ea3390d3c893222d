# SPDX-License-Identifier: MIT
"""Live fleets: tasks keep coming, robots are late, and nobody collides."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Iterable, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import frozen, ints
from ._errors import InputError
from .fleet import Fleet
from .graphs import Roadmap
from .plans import StepPlan, TimedPlan, order_graph

if TYPE_CHECKING:
    import networkx as nx

_STOP = np.dtype(
    [("source", "i4"), ("target", "i4"), ("fraction", "f8"), ("arrive", "f8"), ("depart", "f8")]
)


@dataclass(frozen=True)
class Orders:
    """What became of a call of ``Dispatcher.tick``."""

    served: list[int]
    """Agents whose task is done."""
    waiting: int
    """How many have a task, and no path to it yet."""
    has_new_plan: bool
    cost: float
    """Until all that have a path to their goal arrive there, in sum."""
    lower_bound: float
    """What that takes at least."""

    @property
    def gap_percent(self) -> float:
        """How much dearer than at least that is; 0 if nothing is to be done."""
        return 100 * (self.cost - self.lower_bound) / self.lower_bound if self.lower_bound else 0.0


class _Dispatching:
    """What dispatchers have in common: agents that are called by numbers or names, and have tasks."""

    _fleet: Fleet[Any]
    _core: Any

    def __len__(self) -> int:
        """Number of agents."""
        return len(self._core)

    def __deepcopy__(self, memo: Any = None) -> Any:
        raise TypeError(f"a {type(self).__name__} has a state of its own, and cannot be copied")

    __copy__ = __reduce__ = __deepcopy__

    def _agent(self, agent: Union[int, str]) -> int:
        if isinstance(agent, str):
            if agent not in self._fleet._names:
                raise InputError(f"there is no agent called {agent!r}")
            return self._fleet._names.index(agent)
        number: int = ints(agent, "agent", ()).item()
        if not 0 <= number < len(self):
            raise IndexError(f"there is no agent {number} among {len(self)}")
        return number

    def cancel(self, agent: Union[int, str]) -> None:
        """Of what the agent has been told, nothing is left to do."""
        self._core.cancel(self._agent(agent))

    def order(self) -> nx.DiGraph[Any]:
        """In which order agents pass the places that they share, as courses and paths are now: the graph
        of ``Plan.precedences``, without what nobody has to wait for any more. Agents that obey it may
        go further than they have been told, and do not collide. networkx is needed."""
        return order_graph(self._core.order(), self._fleet._cost)

    def num_tasks(self, agent: Union[int, str]) -> int:
        """Those that are not done yet."""
        return int(self._core.num_tasks(self._agent(agent)))


class Dispatcher(_Dispatching):
    """Says who of a fleet on a roadmap may go where until when.

    Each agent follows its course by a *clock* of its own, the time of the course that it has got to, and
    goes no further than ``limit`` says: then nobody collides, however late anybody is. ``tick`` makes new
    courses for those that have new tasks, and says how far everybody may go until the next call.

    Args:
        fleet: On a roadmap, all agents at vertices, from time 0 on. Those that have a goal elsewhere than
            where they start have it as their first task, by their deadline. What a fleet may ask for and a
            dispatcher does not heed is refused: obstacles, whole moves, releases, agents that leave,
            overlap at their starts or have bodies that change, vertices where nobody may wait.
        effort: For looking for paths, per call: nominal seconds, counted in steps, so that the same
            calls give the same answers. With 0 nobody gets a new path.
        reach: How far an agent may go beyond where it was last seen, as time on its course; 0: any.
        patience: An agent that is later is planned for from where it is; 0: the time of eight calls.
        improves: Whether what is left of the effort makes paths cheaper.

    Raises:
        InputError: for a fleet that does not fit; NoPlanError where starts overlap.
    """

    def __init__(
        self,
        fleet: Fleet[TimedPlan],
        *,
        effort: float = 0.02,
        reach: float = 0.0,
        patience: float = 0.0,
        improves: bool = True,
    ) -> None:
        if not isinstance(fleet.graph, Roadmap):
            raise InputError("a Dispatcher needs a roadmap; on grids and graphs there is GridDispatcher")
        self._fleet = fleet
        self._graph = fleet.graph
        self._tick = fleet.graph.resolution[1]
        with fleet._named():
            self._core: _core.Dispatcher = _core.Dispatcher(
                fleet._timed("Dispatcher"), float(effort), float(reach), float(patience), bool(improves)
            )

    def assign(
        self,
        agent: Union[int, str],
        goals: Any,
        *,
        service: float = 0.0,
        deadline: Optional[float] = None,
    ) -> None:
        """Sends an agent, given by its number or name, to a vertex, or to any one of a list of vertices,
        after all that it has been told before.

        Args:
            goals: a vertex, by number or name, or a list of these.
            service: how long it stays there before it is free again.
            deadline: by when it should be there; the earliest goes first, and who is late does come.

        Raises:
            InputError: for vertices that there are not, or none of which it can reach.
        """
        several = isinstance(goals, (list, tuple, np.ndarray)) and not (
            self._graph._nodes is not None and isinstance(goals, tuple) and goals in self._graph._nodes
        )
        places = list(goals) if several else [goals]
        vertices = [self._graph._vertex(place, "goals") for place in places]
        for vertex in vertices:
            if not 0 <= vertex < self._graph.num_vertices:
                raise InputError(f"goals: there is no vertex {vertex} among {self._graph.num_vertices}")
        with self._fleet._named():
            self._core.assign(self._agent(agent), vertices, float(service), deadline)

    def close(self, source: Any, target: Any) -> None:
        """Nobody enters the lane from one vertex to another one any more, but for agents that have been
        allowed to, until it is opened. Who was to go there finds another way, or waits.

        Raises:
            InputError: if there is none, or it is closed already.
        """
        with self._fleet._named():
            self._core.close(self._graph._vertex(source, "source"), self._graph._vertex(target, "target"))

    def open(self, source: Any, target: Any) -> None:
        """Closed no more."""
        with self._fleet._named():
            self._core.open(self._graph._vertex(source, "source"), self._graph._vertex(target, "target"))

    def report(self, agent: Union[int, str], clock: float) -> None:
        """How far the agent has got: the time on its course, which is rounded down.

        Raises:
            InputError: if it goes back, or beyond ``limit``.
        """
        number, before, limit = self._agent(agent), self.clock(agent), self.limit(agent)
        if clock < before - self._tick:
            raise InputError(f"clock: {clock:g} is before {before:g}, and clocks never go back")
        if clock > limit + self._tick:
            raise InputError(f"clock: {clock:g} is beyond {limit:g}, as far as the agent was allowed to go")
        with self._fleet._named():
            self._core.report(number, float(clock))

    def tick(self, duration: float, *, time_limit: Optional[float] = None) -> Orders:
        """So much more time: new courses, and how far everybody may go until then. Ctrl-C ends the
        program's loop, not the call. ``time_limit``: seconds of wall clock for looking for paths."""
        return Orders(**self._core.tick(float(duration), time_limit))

    @property
    def now(self) -> float:
        """Until when everybody has been told what to do."""
        return self._core.now()

    def clock(self, agent: Union[int, str]) -> float:
        """As reported, or counted anew by ``tick``."""
        return self._core.clock(self._agent(agent))

    def limit(self, agent: Union[int, str]) -> float:
        """How far the agent may go on its course, on the same clock."""
        return self._core.limit(self._agent(agent))

    def course(self, agent: Union[int, str]) -> npt.NDArray[np.void]:
        """Stops from where the agent is, or before, to the end: ``source``, ``target``, ``fraction``,
        ``arrive``, ``depart``. At a vertex the first two are the same; else it stands on the edge between
        them, with that fraction behind it. Read-only."""
        rows = self._core.course(self._agent(agent))
        stops = np.empty(len(rows), dtype=_STOP)
        for column, name in enumerate(_STOP.names or ()):
            stops[name] = rows[:, column]
        return frozen(stops)

    def at(self, agent: Union[int, str], clock: float) -> npt.NDArray[np.float64]:
        """Where the agent is when it has got so far: float64[2], or [3] where there are heights."""
        stops = self.course(agent)
        xy = self._graph.xy
        places = xy[stops["source"]] + stops["fraction"][:, None] * (
            xy[stops["target"]] - xy[stops["source"]]
        )
        at = int(np.searchsorted(stops["arrive"], clock, side="right")) - 1
        if at < 0 or at + 1 == len(stops) or clock <= stops["depart"][at]:
            return frozen(np.array(places[max(at, 0)]))
        share = (clock - stops["depart"][at]) / (stops["arrive"][at + 1] - stops["depart"][at])
        return frozen(np.array(places[at] + share * (places[at + 1] - places[at])))


class GridDispatcher(_Dispatching):
    """Says where agents on a grid or graph go in the next timestep, which all take at the same time.
    Nobody ever collides, however many are held up, and there is a next step whatever the effort; for
    thousands of agents.

    Args:
        fleet: On a grid or graph, without rules. Agents that have a goal elsewhere than where they start
            have it as their first task.
        effort: For better paths, per call: nominal seconds, counted in steps, so that the same calls
            give the same answers.
        window: Timesteps that are planned ahead.
        seed: Of all random choices.
        improves: Whether what is left of the effort makes paths cheaper.

    Raises:
        InputError: for a fleet that does not fit.
    """

    def __init__(
        self,
        fleet: Fleet[StepPlan],
        *,
        effort: float = 0.02,
        window: int = 20,
        seed: int = 0,
        improves: bool = True,
    ) -> None:
        if not isinstance(fleet._instance, _core.StepInstance):
            raise InputError("a GridDispatcher needs a grid or a graph; on roadmaps there is Dispatcher")
        self._fleet = fleet
        self._width = fleet.starts.shape[1:]
        self._core: _core.GridDispatcher = _core.GridDispatcher(
            fleet._instance,
            float(effort),
            ints(window, "window", ()).item(),
            ints(seed, "seed", ()).item(),
            bool(improves),
        )

    def assign(
        self, agent: Union[int, str], goals: Any, *, service: int = 0, deadline: Optional[int] = None
    ) -> None:
        """Sends an agent, given by its number or name, to a place, or to any one of several, after all
        that it has been told before.

        Args:
            goals: a cell ``(x, y)``, or int[k, 2]; on graphs a vertex, or int[k].
            service: for how many timesteps it stays there before it is free again.
            deadline: by when it should be there; the earliest goes first, and who is late does come.

        Raises:
            InputError: for places that there are not, or none of which it can reach.
        """
        places = np.asarray(goals)
        if places.ndim == len(self._width):
            places = places[None]
        by = None if deadline is None else ints(deadline, "deadline", ()).item()
        given = ints(places, "goals", (None, *self._width))
        with self._fleet._named():
            self._core.assign(self._agent(agent), given, ints(service, "service", ()).item(), by)

    def close(self, one: Any, other: Any) -> None:
        """Nobody takes the edge between two places any more, in either direction, until it is opened.
        Whose goals are behind closed edges wait.

        Raises:
            InputError: if there is none, or it is closed already.
        """
        self._core.close(ints([one, other], "edge", (2, *self._width)))

    def open(self, one: Any, other: Any) -> None:
        """Closed no more."""
        self._core.open(ints([one, other], "edge", (2, *self._width)))

    def tick(self, held: Iterable[Union[int, str]] = (), *, time_limit: Optional[float] = None) -> Orders:
        """A timestep. Agents in ``held`` stay where they are, and so do those that have to wait for them.
        Costs are timesteps of those that arrive within the window, and those that do not are waiting.
        ``time_limit``: seconds of wall clock for better paths."""
        return Orders(**self._core.tick([self._agent(agent) for agent in held], time_limit))

    @property
    def now(self) -> int:
        """Timesteps that are over."""
        return self._core.now()

    @property
    def places(self) -> npt.NDArray[np.int32]:
        """Where all are: int32[n, 2], cells, or int32[n], vertices. Read-only."""
        return self._core.places()

    def path(self, agent: Union[int, str]) -> npt.NDArray[np.int32]:
        """Where the agent is now, and after each timestep to come, as planned. Read-only."""
        return self._core.path(self._agent(agent))
