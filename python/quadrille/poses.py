# SPDX-License-Identifier: MIT
"""Roadmaps for robots that turn."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Hashable, Mapping, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import frozen
from ._errors import InputError, renamed
from .graphs import Roadmap
from .rules import ALL


@dataclass(frozen=True)
class Car:
    """Robots that do not turn where they stand: they go on along each lane whose direction differs by at
    most ``max_steer`` from their heading, and need no time for that."""

    max_steer: float
    """Degrees, 0 to 180."""


# How robots turn: degrees per unit of time where they stand, or as cars.
Turning = Union[float, Car]

DIRECTIONS = {"none": (False, False), "ccw": (True, False), "cw": (False, True), "both": (True, True)}


class PoseRoadmap(Roadmap):
    """A roadmap for robots that turn, made by ``Roadmap.with_headings``.

    A vertex is called ``(place, heading)``: what the place is called in the roadmap that this one was made
    of, and where the robot faces, in degrees, 0 along x, 90 along y, rounded to 0.000001. The poses of a
    place are all where it is. ``edges``, ``durations`` and so on are those between poses; turns are edges
    of length zero with a duration.

    A ``polygon`` of ``Fleet`` is that of a robot that faces along x, and turns with it. While the robot
    turns it takes up all that it sweeps, by the shorter way round; half a turn goes counter-clockwise.
    """

    def __init__(self, places: Roadmap, kinds: list[Any], rules: dict[str, Any]) -> None:
        try:
            self._poses = _core.PoseMap(places._graph, kinds, rules)
        except InputError as error:
            called: list[Optional[str]] = [repr(node) for node in places.nodes]
            raise renamed(error, _core.in_names(str(error), [], called)) from None
        self._setup(self._poses.graph, places.resolution, places._groups)
        self._of = places
        nodes, leaving = places.nodes, self._poses.leaving()
        self._place_of = frozen(self._poses.places())
        called_by: list[Hashable] = []
        for place, heading, leaves in zip(self._place_of, self.headings, leaving):
            name = (nodes[place], float(heading))
            called_by.append((*name, "leaving") if leaves else name)
        self._name_nodes(called_by)

    @property
    def places(self) -> Roadmap:
        """The roadmap that it was made of."""
        return self._of

    @property
    def headings(self) -> npt.NDArray[np.float64]:
        """float64[n], where robots face at each vertex, in degrees from 0 to 360; read-only."""
        return frozen(np.round(np.degrees(self._poses.headings()), 6))

    def place(self, vertex: Any) -> Hashable:
        """What the place of a vertex is called, which is given by its number or its name."""
        number = int(vertex) if isinstance(vertex, (int, np.integer)) else self._vertex(vertex, "place")
        if not 0 <= number < self.num_vertices:
            raise InputError(f"place: there is no vertex {number} among {self.num_vertices}")
        place: int = self._place_of[number].item()
        return self._of.nodes[place]

    def facing(self, place: Any, heading: float) -> Hashable:
        """The name of the pose of a place that faces most nearly there, in degrees: of those in which robots
        arrive or stay.

        Raises:
            InputError: for a place that does not exist, or a heading that is not finite.
        """
        if not math.isfinite(heading):
            raise InputError(f"facing: {heading} is no heading")
        number = self._of._vertex(place, "facing")
        self._require_place(number, "facing")
        return self.nodes[self._poses.facing(number, math.radians(heading))]

    def any_heading(self, place: Any) -> list[Hashable]:
        """The poses of a place in which robots stay, as a goal for ``Fleet``: a robot ends at any of them.

        Raises:
            InputError: for a place that does not exist.
        """
        number = self._of._vertex(place, "any_heading")
        self._require_place(number, "any_heading")
        nodes = self.nodes
        return [nodes[pose] for pose in self._poses.stays(number)]

    def _require_place(self, number: int, what: str) -> None:
        if not 0 <= number < self._of.num_vertices:
            raise InputError(f"{what}: there is no place {number} among {self._of.num_vertices}")

    def with_headings(self, turning: Turning, **rules: Any) -> PoseRoadmap:
        """Its robots turn already.

        Raises:
            InputError: always.
        """
        raise InputError("with_headings: the vertices are poses already")

    def _pose_map(self) -> _core.PoseMap:
        return self._poses

    def _yaws(self) -> npt.NDArray[np.float64]:
        radians = self._poses.headings()
        return np.where(radians > np.pi, radians - 2 * np.pi, radians)

    def __repr__(self) -> str:
        return f"<quadrille.PoseRoadmap {self.num_vertices} poses of {self._of.num_vertices} places>"


def kinds_of(
    turning: Turning, kinds: Mapping[str, Turning], groups: list[str], tick: float
) -> list[tuple[int, Optional[float], Optional[float]]]:
    """As the compiled part takes them: each group once."""
    others, made = ALL, []
    for group, own in kinds.items():
        if group not in groups:
            raise InputError(f"kinds: the roadmap has no group {group!r}")
        bit = 1 << (groups.index(group) + 1)
        others &= ~bit
        made.append((bit, *_kind(own, f"kinds[{group!r}]", tick)))
    return [(others, *_kind(turning, "turning", tick)), *made]


def _kind(turning: Turning, what: str, tick: float) -> tuple[Optional[float], Optional[float]]:
    if isinstance(turning, Car):
        if not 0 <= turning.max_steer <= 180:
            raise InputError(f"{what}: a car steers by 0 to 180 degrees, not by {turning.max_steer}")
        return None, math.radians(turning.max_steer)
    if not 0 < turning < math.inf:
        raise InputError(f"{what}: robots turn by more than 0 degrees per unit of time, not by {turning}")
    return math.radians(turning) * tick, None


def heading_rules(
    places: Roadmap,
    headings: Sequence[tuple[Any, float]],
    lanes: Sequence[tuple[Any, Any, float]],
    stands: Sequence[tuple[Any, float]],
    turns: Sequence[tuple[Any, str]],
) -> dict[str, Any]:
    """What the roadmap's file says of headings, and what is given; angles in degrees."""
    rules = {name: list(told) for name, told in places._heading_rules.items()}
    for name, given, to in (("headings", headings, "further"), ("stands", stands, "stands")):
        for at, (place, heading) in enumerate(given):
            rules[to].append((places._vertex(place, f"{name}[{at}]"), _angle(heading, f"{name}[{at}]")))
    for at, (source, target, heading) in enumerate(lanes):
        ends = [places._vertex(end, f"lanes[{at}]") for end in (source, target)]
        rules["lanes"].append((*ends, _angle(heading, f"lanes[{at}]")))
    for at, (place, allowed) in enumerate(turns):
        if allowed not in DIRECTIONS:
            raise InputError(f"turns[{at}]: {allowed!r} is not none, ccw, cw or both")
        rules["turns"].append((places._vertex(place, f"turns[{at}]"), *DIRECTIONS[allowed], math.inf))
    return rules


def _angle(degrees: float, what: str) -> float:
    if not math.isfinite(degrees):
        raise InputError(f"{what}: {degrees} is no heading")
    return math.radians(degrees)
