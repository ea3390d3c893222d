# SPDX-License-Identifier: MIT
"""What a replay says about a plan."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional

import numpy.typing as npt


@dataclass(frozen=True)
class Violation:
    """One broken rule of a plan."""

    kind: str
    """"vertex-conflict", "swap-conflict", "collision", "wrong-goal", ..."""
    agent: int
    other: Optional[int]
    """The other agent of a collision; larger than ``agent``."""
    time: float
    """Timestep, or time in your unit, when the step begins in which it happens."""
    message: str
    """One sentence that names agents, place and time."""


@dataclass(frozen=True)
class Report:
    """What a replay of a plan says. True if the plan is valid."""

    violations: list[Violation]
    sum_of_costs: float
    """In timesteps, or in your unit of time; meaningful for valid plans."""
    makespan: float
    clearances: Optional[npt.NDArray[Any]] = None
    """On roadmaps, of the pairs of agents that come nearest, nearest first: (agent, other, gap, time),
    the least distance between the bodies over all time, in your unit of length, and a moment at
    which it is that small."""

    @property
    def valid(self) -> bool:
        return not self.violations

    def __bool__(self) -> bool:
        return self.valid
