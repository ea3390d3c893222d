# SPDX-License-Identifier: MIT
"""Live fleets: tasks keep coming, robots are late, and nobody collides."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import frozen, ints
from ._errors import InputError
from .fleet import Fleet
from .graphs import Roadmap
from .plans import TimedPlan

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


class Dispatcher:
    """Says who of a fleet on a roadmap may go where until when.

    Each agent follows its course by a *clock* of its own, the time of the course that it has got to, and
    goes no further than ``limit`` says: then nobody collides, however late anybody is. ``tick`` makes new
    courses for those that have new tasks, and says how far everybody may go until the next call.

    Args:
        fleet: On a roadmap, without obstacles, all agents at vertices. Those that have a goal elsewhere
            than where they start have it as their first task.
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
            raise InputError("a dispatcher needs a roadmap")
        self._fleet = fleet
        self._graph = fleet.graph
        self._tick = fleet.graph.resolution[1]
        self._core = _core.Dispatcher(
            fleet._timed("Dispatcher"), float(effort), float(reach), float(patience), bool(improves)
        )
        starts = fleet._timed("Dispatcher").starts()
        for agent, goals in enumerate(fleet._timed("Dispatcher").goal_sets()):
            if list(goals) != [starts[agent]]:
                self._core.assign(agent, [int(goal) for goal in goals], 0.0, None)

    def __len__(self) -> int:
        """Number of agents."""
        return len(self._core)

    def __deepcopy__(self, memo: Any) -> Dispatcher:
        raise TypeError("a Dispatcher has a state of its own, and cannot be copied")

    __copy__ = __reduce__ = __deepcopy__  # type: ignore[assignment]

    def _agent(self, agent: Union[int, str]) -> int:
        if isinstance(agent, str):
            if agent not in self._fleet._names:
                raise InputError(f"there is no agent called {agent!r}")
            return self._fleet._names.index(agent)
        number: int = ints(agent, "agent", ()).item()
        if not 0 <= number < len(self):
            raise IndexError(f"there is no agent {number} among {len(self)}")
        return number

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

    def cancel(self, agent: Union[int, str]) -> None:
        """Of what the agent has been told, nothing is left to do."""
        self._core.cancel(self._agent(agent))

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

    def num_tasks(self, agent: Union[int, str]) -> int:
        """Those that are not done yet."""
        return self._core.num_tasks(self._agent(agent))

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
