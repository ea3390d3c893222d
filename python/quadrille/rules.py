# SPDX-License-Identifier: MIT
"""What fleets on roadmaps need besides tasks: groups, releases, deadlines, moves in progress, obstacles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Iterable, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from ._arrays import bools, doubles, ints, listed, per_agent, with_places
from ._errors import InputError

# Whom an edge is open to: everybody, a group, or some; None among these is who has no group.
Only = Union[None, str, Iterable[Optional[str]]]

ALL = (1 << 64) - 1
MOST_GROUPS = 63


@dataclass(frozen=True, eq=False)
class Obstacle:
    """A body that moves as is known, and for which nobody plans: a robot of another fleet, say. Agents
    keep clear of it as of each other."""

    path: npt.ArrayLike
    """float[k, 4]: x, y, arrival and departure of each stop, or float[k, 5] with z after y, in your units of length and time, rounded to
    the nearest length unit and tick. It goes straight and evenly from each stop to the next, which it
    reaches later; before the first one it is nowhere."""
    radius: Optional[float] = None
    """Of a disc; rounded up to a length unit."""
    polygon: Optional[npt.ArrayLike] = None
    """Instead: float[k, 2], corners of a convex polygon around its place. One of the two is needed."""
    leaves: bool = False
    """It vanishes at its last departure; otherwise it stays at its last stop for ever."""

    def _given(self) -> tuple[Any, ...]:
        """As the compiled part takes it."""
        if (self.radius is None) == (self.polygon is None):
            given = "no body: it" if self.radius is None else "two bodies: it"
            raise InputError(f"an obstacle has {given} has either a radius or a polygon")
        body: Any
        if self.radius is None:
            body = doubles(self.polygon, "polygon", (None, 2))
        else:
            body = float(self.radius)
        return body, with_places(self.path, "path", 2), bool(self.leaves)


@dataclass(frozen=True)
class Underway:
    """Instead of a start: when the fleet begins the agent is in the middle of the move from ``source`` to
    ``target`` and finishes it, without a stop, also if there is no such edge any more. Its place is that
    point of the edge, exactly."""

    source: Any
    """Vertex, or its name."""
    target: Any
    fraction: float = 0.0
    """How much of the move lies behind it, 0 to 1. Rounded down to whole ticks, of which at least one is
    left; where it is follows from that."""
    begun: Optional[float] = None
    """Instead of a fraction: when it began the move, on the clock of the fleet's ``now``; negative where
    that is 0. Rounded up to a whole tick."""
    may_wait: bool = False
    """It stands there, and may wait before it goes on."""


def obstacle_of(given: tuple[Any, ...]) -> Obstacle:
    """From the compiled part."""
    body, path, leaves = given
    if isinstance(body, float):
        return Obstacle(path, radius=body, leaves=leaves)
    return Obstacle(path, polygon=body, leaves=leaves)


def open_to(only: Optional[Sequence[Only]], n: int) -> tuple[npt.NDArray[np.uint64], list[str]]:
    """Per edge the groups that may use it, as bits, and what the groups 1, 2, ... are called."""
    names: list[str] = []
    masks = np.full(n, ALL, dtype=np.uint64)
    if only is None:
        return masks, names
    if len(only) != n:
        raise ValueError(f"only: {len(only)} entries for {n} edges")
    for edge, entry in enumerate(only):
        if entry is None:
            continue
        mask = 0
        for name in [entry] if isinstance(entry, str) else entry:
            if name is None:
                mask |= 1
                continue
            if not isinstance(name, str):
                raise ValueError(f"only[{edge}]: a group is called by a string, not {name!r}")
            if name not in names:
                names.append(name)
            mask |= 1 << (names.index(name) + 1)
        if len(names) > MOST_GROUPS:
            raise ValueError(f"only: there are more than {MOST_GROUPS} groups")
        if mask == 0:
            raise ValueError(f"only[{edge}]: the edge is open to nobody")
        masks[edge] = mask
    return masks, names


def only_of(mask: int, names: list[str]) -> Optional[tuple[Optional[str], ...]]:
    """The groups of one edge, from the bits."""
    if mask == ALL:
        return None
    everybody: list[Optional[str]] = [None, *names]
    return tuple(name for at, name in enumerate(everybody) if mask >> at & 1)


def numbered_groups(masks: npt.NDArray[np.uint64], groups: npt.NDArray[np.int64]) -> list[str]:
    """Names for the groups of a file, which are numbers: as many as edges and agents speak of."""
    most = int(groups.max(initial=0))
    for mask in listed(np.unique(masks)):
        if mask != ALL:
            most = max(most, mask.bit_length() - 1)
    return [str(number) for number in range(1, most + 1)]


def group_numbers(group: Any, names: list[str], n: int) -> npt.NDArray[np.int64]:
    """The number of each agent's group; 0 without one."""
    wanted = [group] * n if group is None or isinstance(group, str) else list(group)
    if len(wanted) != n:
        raise ValueError(f"group: {len(wanted)} entries for {n} agents")
    for name in wanted:
        if name is not None and name not in names:
            raise ValueError(f"group: the roadmap has no group {name!r}")
    return ints([0 if name is None else names.index(name) + 1 for name in wanted], "group", (n,))


def moments(times: Any, name: str, n: int, default: float) -> npt.NDArray[np.float64]:
    """A time for each agent; one that is not given, or None, is the default."""
    if isinstance(times, (list, tuple)):
        times = [np.nan if time is None else time for time in times]
    given = per_agent(default if times is None else times, name, n).copy()
    given[np.isnan(given)] = default
    return given


def timesteps(times: Any, name: str, n: int, default: int) -> npt.NDArray[np.int64]:
    """A timestep for each agent; one that is not given, or None, is the default."""
    given = moments(times, name, n, float(default))
    if not np.array_equal(given, np.floor(given)):
        raise ValueError(f"{name}: timesteps are whole numbers")
    return given.astype(np.int64)


def flags(values: Any, name: str, n: int) -> npt.NDArray[np.bool_]:
    """One truth value for all agents, or one for each."""
    if np.ndim(values) == 0:
        values = [values] * n
    return bools(values if n > 0 else np.empty(0, dtype=np.bool_), name, (n,))
