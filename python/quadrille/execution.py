# SPDX-License-Identifier: MIT
"""Agents that carry out a plan, and are late: who may go on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Union, cast

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import doubles, frozen
from ._errors import InputError
from .plans import Plan, StepPlan, TimedPlan

RULES = ("naive", "gated", "coupled")


class Executor:
    """Says who may go on, whatever has held up whom.

    The caller keeps a *clock* per agent: the time of the plan that the agent has got to, from
    ``plan.now`` on, which never goes back. One that has arrived keeps its clock at the end of its last
    move, or later. As long as no clock passes what it was allowed nobody collides. Three rules, for three
    kinds of systems: ``limits`` for agents that move on their own, ``couple`` for those that take a step
    at the same time, ``gate`` for systems that release whole moves.

    Args:
        plan: A valid plan of either kind, without obstacles.

    Raises:
        InputError: for another plan.
    """

    def __init__(self, plan: Plan) -> None:
        self._plan = plan
        self._order = plan._precedences()
        self._core = _core.Executor(self._order)

    def __len__(self) -> int:
        """Number of agents."""
        return len(self._plan)

    def __deepcopy__(self, memo: Any) -> Executor:
        raise TypeError("an Executor has a state of its own: make another one of the plan")

    __copy__ = __reduce__ = __deepcopy__  # type: ignore[assignment]

    def limits(self, clocks: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """How far each clock may run as things stand; infinite where nothing is in the way. Clocks that are
        old are safe.

        Args:
            clocks: n of them, timesteps or in your unit of time, which are rounded down to whole ticks.

        Raises:
            InputError: for a clock that goes back.
        """
        limits = self._core.limits(self._ticks(clocks, "clocks"))
        known = np.where(limits == _core.UNLIMITED, 0, limits)
        return frozen(np.where(limits == _core.UNLIMITED, np.inf, self._plan._times(known)))

    def couple(self, clocks: npt.ArrayLike, targets: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """The latest clocks, none later than its target, to which the agents may go *in proportion*: after
        a share of the step each has that share of its way behind it. Never ends with all of them waiting.

        Args:
            clocks: As they are, exactly.
            targets: What they would be at the end of the step; of an agent that is held up, its clock.

        Raises:
            InputError: for a clock that goes back, and a target before the clock.
        """
        return self._step(self._core.couple, clocks, targets)

    def gate(self, clocks: npt.ArrayLike, targets: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """The same for whole moves: an agent whose next move follows one that has not ended stops before
        it. All may wait for each other for ever unless ``plan.node_order()`` has no cycle."""
        return self._step(self._core.gate, clocks, targets)

    def reset(self) -> None:
        """The clocks may begin anew."""
        self._core.reset(self._order)

    def _step(self, rule: Any, clocks: Any, targets: Any) -> npt.NDArray[np.float64]:
        reached = rule(self._ticks(clocks, "clocks"), self._ticks(targets, "targets"))
        return frozen(self._plan._times(reached))

    def _ticks(self, times: Any, name: str) -> npt.NDArray[np.int64]:
        given = doubles(times, name, (len(self),)) / self._plan._tick
        if not (np.abs(given) < 1e18).all():
            raise InputError(f"{name}: {times!r} is no time")
        # What differs from a whole tick by a millionth of one is meant to be that.
        return cast("npt.NDArray[np.int64]", np.floor(given + 1e-6).astype(np.int64))


class Releaser:
    """For systems that release whole moves, as VDA 5050 with its base and horizon does: which moves of each
    agent may be released, given how many each has ended. As long as agents make no move before it is
    released nobody collides, and all arrive if ``plan.node_order()`` has no cycle.

    Args:
        plan: As for ``Executor``.
    """

    def __init__(self, plan: Plan) -> None:
        self._plan = plan
        self._core = _core.Releaser(plan._precedences())

    def __len__(self) -> int:
        """Number of agents."""
        return len(self._plan)

    def __deepcopy__(self, memo: Any) -> Releaser:
        raise TypeError("a Releaser has a state of its own: make another one of the plan")

    __copy__ = __reduce__ = __deepcopy__  # type: ignore[assignment]

    def released(self, agent: Union[int, str]) -> int:
        """How many moves of the agent, from the first on, are released."""
        return self._core.released(self._plan._checked(agent))

    def end_moves(self, agent: Union[int, str], count: int) -> None:
        """The first ``count`` moves of the agent have ended.

        Raises:
            InputError: if these are fewer than before, or more than were released.
        """
        self._core.end_moves(self._plan._checked(agent), count)

    def take_news(self) -> list[int]:
        """The agents that got moves released since the last call."""
        return self._core.take_news()


@dataclass(frozen=True)
class Simulation:
    """What became of a plan in some runs under random delays. Times are timesteps or in your unit."""

    rule: str
    arrived: npt.NDArray[np.bool_]
    """bool[runs], whether all agents arrived; else some wait for each other for ever."""
    finish: npt.NDArray[np.float64]
    """float64[runs, n], how long after ``plan.now`` each arrived; NaN in runs that did not end."""
    held: npt.NDArray[np.float64]
    """float64[runs, n], how long each could have gone on and was not allowed to."""
    contacts: npt.NDArray[np.int64]
    """int64[runs], pairs of agents that collided: 0 unless the rule is "naive"."""
    clearance: npt.NDArray[np.float64]
    """float64[runs], the least space between two bodies, negative if they overlapped; NaN without
    lengths, or with fewer than two agents."""

    @property
    def makespans(self) -> npt.NDArray[np.float64]:
        """float64[runs]."""
        return cast("npt.NDArray[np.float64]", self.finish.max(axis=1, initial=0))

    @property
    def sums_of_costs(self) -> npt.NDArray[np.float64]:
        """float64[runs]."""
        return cast("npt.NDArray[np.float64]", self.finish.sum(axis=1))


def simulate(
    plan: Plan,
    rule: str = "coupled",
    *,
    delays: float = 0.1,
    longest: float = 3,
    slow: float = 0.15,
    period: float = 0,
    runs: int = 20,
    seed: int = 0,
) -> Simulation:
    """Lets the agents of a plan go under random delays. The same on every platform; Ctrl-C ends it.

    Args:
        plan: As for ``Executor``.
        rule: "coupled" (``Executor.couple``), "gated" (``Executor.gate``), or "naive": each by its own
            clock, whatever the others do, which collides.
        delays: Share of the moves on which an agent pauses, 0 to 1.
        longest: Longest pause: timesteps, or in your unit of time.
        slow: Agents are slower than planned by up to this share, 0 to 0.95.
        period: On roadmaps, the time between two decisions; 0: the 500th part of the makespan.
        runs, seed: How many; the seed of the first one, which the others follow.

    Raises:
        InputError: for a number that is out of range, and plans that are not valid.
    """
    if rule not in RULES:
        raise InputError(f"rule: {rule!r} is not naive, gated or coupled")
    for name, share, most in (("delays", delays, 1.0), ("slow", slow, 0.95)):
        if not 0 <= share <= most:
            raise InputError(f"{name}: {share:g} is not from 0 to {most:g}")
    if runs < 1 or seed < 0:
        raise InputError("runs: at least 1, and a seed is not negative")
    order = plan._precedences()
    pause = _whole(longest, plan._tick, "longest")
    rows: list[Any] = []
    for k in range(runs):
        if isinstance(plan, StepPlan):
            if period:
                raise InputError("period is for roadmaps; it is a timestep here")
            rows.append(
                _core.step_run(order, plan._instance, plan._plan, delays, pause, slow, seed + k, rule)
            )
        else:
            timed = cast(TimedPlan, plan)
            step = _whole(period or max(plan._tick, timed.makespan / 500), plan._tick, "period")
            rows.append(
                _core.timed_run(
                    order, timed._instance, timed._plan, delays, pause, slow, seed + k, rule, step
                )
            )
    arrived = np.array([row[0] for row in rows], dtype=np.bool_)
    finish = np.array([row[1] for row in rows], dtype=np.float64).reshape(runs, len(plan))
    finish = finish * plan._tick - plan.now
    finish[~arrived] = np.nan
    held = np.array([row[2] for row in rows], dtype=np.float64).reshape(runs, len(plan)) * plan._tick
    contacts = np.array([row[3] for row in rows], dtype=np.int64)
    clearance = np.array([row[4] for row in rows], dtype=np.float64) * (1.0 if isinstance(plan, StepPlan) else cast(TimedPlan, plan)._length_unit)
    for array in (arrived, finish, held, contacts, clearance):
        frozen(cast("npt.NDArray[Any]", array))
    return Simulation(rule, arrived, finish, held, contacts, clearance)


def _whole(time: float, tick: float, name: str) -> int:
    """In ticks, at least one."""
    if not 0 < time / tick < 2**40:
        raise InputError(f"{name}: {time:g} is not positive, or too long")
    return max(1, round(time / tick))
