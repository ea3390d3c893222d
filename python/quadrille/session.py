# SPDX-License-Identifier: MIT
"""Agents and roads that change, solved again and again."""

from __future__ import annotations

from typing import Any, Callable, Optional, Sequence, Union, cast

import numpy as np

from . import _core
from ._arrays import ints, per_agent
from ._errors import InputError
from .fleet import Fleet, _bodies, _goal_vertices, _starts
from .graphs import Graph, Grid, Roadmap
from .plans import StepPlan, TimedPlan
from .rules import Obstacle, flags, group_numbers, moments
from .solving import Progress, Result, searched

# What an agent may be given, with the defaults of ``Fleet``.
_DEFAULTS: dict[str, Any] = dict(
    radius=None,
    polygon=None,
    speed=1.0,
    group=None,
    release=None,
    deadline=None,
    leaves=False,
    overlap_at_start=False,
)


_STEP_DEFAULTS: dict[str, Any] = dict(release=None, deadline=None, leaves=False)


class Session:
    """A grid, a graph or a roadmap, and agents that change, and are solved again after each change. What
    the answers rest on lives on: bounds of groups of agents of whom nothing has changed, the last plans,
    which are mended instead of made anew, and on roadmaps distances, lemmas and cores. Costs and proofs
    are those of ``solve`` for ``fleet()``; among plans of the same cost it may be another one.

    Agents are called by names. Whether they are in each other's way, or can reach their goals, is
    found out when the session is solved.

    Args:
        graph: Where the agents move.
        obstacles: On roadmaps: ``Obstacle`` s, of which agents keep clear.
        robust: On grids and graphs, as for a ``Fleet``.
        whole_moves: As for a ``Fleet``.
        now: When agents are at their starts.

    Raises:
        InputError: for numbers that are out of range.
    """

    _defaults = _DEFAULTS

    def __new__(cls, graph: Any, **options: Any) -> Session:
        if isinstance(graph, (Grid, Graph)):
            return super().__new__(_StepSession)
        return super().__new__(cls)

    def __init__(
        self,
        graph: Union[Grid, Graph, Roadmap],
        *,
        obstacles: Sequence[Obstacle] = (),
        robust: int = 0,
        whole_moves: bool = False,
        now: float = 0,
    ) -> None:
        if not isinstance(graph, Roadmap):
            raise InputError("a session needs a grid, a graph or a roadmap")
        if robust != 0:
            raise ValueError("robust is for grids and graphs")
        self._graph = graph
        given = [obstacle._given() for obstacle in obstacles]
        self._core: Any = _core.Session(
            graph._graph, graph.resolution, given, float(now), bool(whole_moves)
        )
        self._begin()

    def _begin(self) -> None:
        self._members: dict[str, int] = {}
        self._agents: dict[str, dict[str, Any]] = {}

    def __len__(self) -> int:
        """Number of agents."""
        return len(self._members)

    def __contains__(self, name: object) -> bool:
        return name in self._members

    def __deepcopy__(self, memo: Any) -> Session:
        raise TypeError("a Session has a state of its own, and cannot be copied; fleet() can")

    __copy__ = __reduce__ = __deepcopy__  # type: ignore[assignment]

    @property
    def names(self) -> list[str]:
        """Of the agents, in the order of plans: as they were added."""
        return list(self._members)

    def add(self, name: str, start: Any, goals: Any, **more: Any) -> None:
        """A new agent.

        Args:
            name: No other one is called so.
            start: A vertex or a cell, on roadmaps also an ``Underway``, which may not wait.
            goals: A vertex or a cell, or a list of several.
            more: ``release``, ``deadline`` and ``leaves``, and on roadmaps ``radius``, ``polygon``,
                ``speed``, ``group`` and ``overlap_at_start``, as for one agent of a ``Fleet``.

        Raises:
            InputError: as ``Fleet``.
        """
        if name in self._members:
            raise InputError(f"there is an agent called {name!r} already")
        agent = {**self._defaults, "start": start, "goals": goals}
        self._agents[name] = self._merged(agent, more)
        try:
            self._members[name] = self._core.add(*self._parts(name))
            self._put_under_way(name)
        except BaseException:
            if name in self._members:
                self._core.remove(self._members.pop(name))
            del self._agents[name]
            raise

    def change(self, name: str, **what: Any) -> None:
        """Another ``start``, ``goals``, or whatever else ``add`` takes; the rest stays as it is.

        Raises:
            InputError: as ``add``, and if no agent is called so; then nothing has changed.
        """
        member, before = self._member(name), self._agents[name]
        self._agents[name] = self._merged(before, what)
        try:
            self._core.change(member, *self._parts(name))
            self._put_under_way(name)
        except BaseException:
            self._agents[name] = before
            self._core.change(member, *self._parts(name))
            self._put_under_way(name)
            raise

    def remove(self, name: str) -> None:
        """The agent is there no more."""
        self._core.remove(self._member(name))
        del self._members[name], self._agents[name]

    def close(self, source: Any, target: Any = None) -> None:
        """Nobody may use the edge from one vertex to another one, until it is opened. On grids and graphs
        that is for both directions, and without a target nobody may be in the place ``source``.

        Raises:
            InputError: if there is none, or it is closed already.
        """
        self._core.close(*self._edge(source, target))

    def open(self, source: Any, target: Any = None) -> None:
        """Closed no more."""
        self._core.open(*self._edge(source, target))

    def assign(self, name: str, goals: Any) -> None:
        """Another goal, or several, from where the agent is.

        Raises:
            InputError: as ``add``, and if no agent is called so.
        """
        self.change(name, goals=goals)

    def advance_to(self, now: float, plan: Any) -> None:
        """Time has gone on until ``now``, and everybody has followed the plan, one for ``fleet()``: that of
        the last answer, or what has become of it where somebody was late. From now on agents begin where
        they are then, at a vertex or under way; those that leave and have arrived are removed. What was
        learned is learned of what is left of their ways.

        Raises:
            InputError: for a time that is over, or a plan that is not valid.
        """
        self._core.advance_to(float(now), plan._plan)
        members = self._core.members()
        for agent, name in enumerate(self.names):
            if self._members[name] in members:
                self._agents[name] = {**self._agents[name], "start": plan.start_at(agent, now)}
            else:
                del self._members[name], self._agents[name]

    @property
    def now(self) -> float:
        """When agents are at their starts."""
        return float(self._core.now())

    def fleet(self) -> Fleet[Any]:
        """The agents as things are now, on the roadmap as it is."""
        fleet: Fleet[TimedPlan] = cast(Any, Fleet.__new__)(Fleet)
        names = self.names
        called = dict(agent=lambda i: repr(names[i]), vertex=self._graph._called)
        fleet._setup(self._graph, self._core.instance(called), names)
        return fleet

    def solve(
        self,
        *,
        progress: Optional[Callable[[Progress], object]] = None,
        on_plan: Optional[Callable[[Any], object]] = None,
        initial: Union[None, StepPlan, TimedPlan] = None,
        keep_interrupt: bool = False,
        **options: Any,
    ) -> Result[Any]:
        """As ``quadrille.solve`` for ``fleet()``, with its arguments."""
        fleet = self.fleet()
        given = dict(options, initial=None if initial is None else initial._plan)

        return searched(fleet, self._search(fleet), given, progress, on_plan, keep_interrupt)

    def _search(self, fleet: Fleet[Any]) -> Callable[[dict[str, Any]], dict[str, Any]]:
        return lambda arguments: cast("dict[str, Any]", self._core.solve(fleet._timed("solve"), arguments))

    def _member(self, name: str) -> int:
        if name not in self._members:
            raise InputError(f"there is no agent called {name!r}")
        return self._members[name]

    def _edge(self, source: Any, target: Any) -> tuple[Any, Any]:
        return self._graph._vertex(source, "source"), self._graph._vertex(target, "target")

    @staticmethod
    def _merged(agent: dict[str, Any], what: dict[str, Any]) -> dict[str, Any]:
        for name in what:
            if name not in agent:
                raise TypeError(f"an agent has no {name!r}: it has {', '.join(sorted(agent))}")
        merged = {**agent, **what}
        # One of them replaces the other one.
        for one, other in (("radius", "polygon"), ("polygon", "radius")):
            if what.get(one) is not None and one in what and other not in what:
                merged[other] = None
        return merged

    def _parts(self, name: str) -> tuple[Any, ...]:
        """As the compiled part takes them."""
        agent, graph = self._agents[name], self._graph
        start, under_way = _starts(graph, [agent["start"]])
        if under_way and under_way[0][-1]:
            raise InputError(f"{name!r} is under way in a session, where it may not wait")
        goals, num_goals = _goal_vertices(graph, [agent["goals"]])
        polygon = None if agent["polygon"] is None else [agent["polygon"]]
        rules = dict(
            poses=graph._pose_map(),
            groups=group_numbers(agent["group"], graph._groups, 1),
            releases=moments(agent["release"], "release", 1, 0.0),
            deadlines=moments(agent["deadline"], "deadline", 1, np.nan),
            leaves=flags(agent["leaves"], "leaves", 1),
            overlaps=flags(agent["overlap_at_start"], "overlap_at_start", 1),
        )
        return (
            start,
            goals,
            num_goals[0],
            _bodies(agent["radius"], polygon, 1, [repr(name)]),
            per_agent(agent["speed"], "speed", 1),
            rules,
            dict(agent=lambda i: repr(name), vertex=graph._called),
        )

    def _put_under_way(self, name: str) -> None:
        _, under_way = _starts(self._graph, [self._agents[name]["start"]])
        for _, source, target, fraction, begun, _ in under_way:
            member = self._members[name]
            self._core.put_under_way(member, source, target, fraction, begun, repr(name))


class _StepSession(Session):
    """A ``Session`` on a grid or a graph."""

    _defaults = _STEP_DEFAULTS

    def __init__(
        self,
        graph: Any,
        *,
        obstacles: Sequence[Obstacle] = (),
        robust: int = 0,
        whole_moves: bool = False,
        now: float = 0,
    ) -> None:
        if obstacles:
            raise ValueError("obstacles is for roadmaps")
        self._graph = graph
        begin, distance = ints(now, "now", ()).item(), ints(robust, "robust", ()).item()
        # What is wrong with these is what is wrong with a fleet of nobody.
        empty = np.zeros((0, 2) if isinstance(graph, Grid) else 0, np.int64)
        Fleet(graph, empty, empty, robust=distance, now=begin)
        self._core = _core.StepSession(graph._graph, begin, distance or int(bool(whole_moves)))
        self._begin()

    def advance_to(self, now: float, plan: Any) -> None:
        self._core.advance_to(ints(now, "now", ()).item(), plan._plan)
        members = self._core.members
        for name in [name for name, member in self._members.items() if member not in members]:
            del self._members[name], self._agents[name]
        starts = self._core.instance().starts()
        for name, start in zip(self.names, starts.tolist()):
            self._agents[name]["start"] = start

    @property
    def now(self) -> float:
        return int(self._core.now)

    def fleet(self) -> Fleet[Any]:
        fleet: Fleet[StepPlan] = cast(Any, Fleet.__new__)(Fleet)
        fleet._setup(self._graph, self._core.instance(), self.names)
        return fleet

    def _search(self, fleet: Fleet[Any]) -> Callable[[dict[str, Any]], dict[str, Any]]:
        return lambda arguments: cast("dict[str, Any]", self._core.solve(arguments))

    def _edge(self, source: Any, target: Any) -> tuple[Any, Any]:
        shape = (2,) if isinstance(self._graph, Grid) else ()
        end = None if target is None else ints(target, "target", shape)
        return ints(source, "source", shape), end

    def _parts(self, name: str) -> tuple[Any, ...]:
        agent = self._agents[name]
        rules = {key: agent[key] for key in _STEP_DEFAULTS if agent[key] is not None}
        one = Fleet(
            self._graph, [agent["start"]], [agent["goals"]], names=[name], now=self._core.now, **rules
        )
        return (one._instance,)

    def _put_under_way(self, name: str) -> None:
        pass
