# SPDX-License-Identifier: MIT
"""Why no plan is cheaper: what a proven lower bound is made of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, NamedTuple, Optional, Tuple, Union

Vertex = Union[int, Tuple[int, int]]
"""(x, y) on grids, else the number of a vertex."""


class Charge(NamedTuple):
    """What an agent costs."""

    free_cost: float
    """Of its cheapest path when it is alone."""
    cost: Optional[float]
    """In the plan; None without one."""


class Raise(NamedTuple):
    """A step of the bound. Any agents that contain ``agents`` and ``bystanders`` of some raises cost at
    least what each costs alone and these amounts, even if there are no others."""

    kind: str
    """"core", "cover", "search" or "total"."""
    amount: float
    agents: tuple[int, ...]
    """Who costs more."""
    bystanders: tuple[int, ...]
    """Who may be needed for the proof besides."""


class Place(NamedTuple):
    """Where two agents are in each other's way."""

    kind: str
    """"vertex", "edge", "corridor" (its ends), "rectangle" (opposite corners), "goal" (of the second
    agent, which rests there) or "crossing" (the edge of the first agent)."""
    start: Vertex
    end: Vertex


class Site(NamedTuple):
    """Where and when the search saw two agents in each other's way. No proof by itself."""

    agents: tuple[int, int]
    place: Place
    other: Optional[Place]
    """Of a crossing: the edge of the second agent."""
    begin: float
    end: Optional[float]
    """The first moment after it; None: for ever."""
    lemmas: int
    """The more, and the longer, the more of a bottleneck it is."""


class Reason(NamedTuple):
    """These agents alone, even if there are no others, cost ``amount`` more than their free costs (makespan:
    than the largest free cost of all agents). The amounts of all reasons sum up to what the bound is above the free bound."""

    amount: float
    agents: tuple[int, ...]
    sites: tuple[Site, ...]
    """Where these are in each other's way, most lemmas first."""


@dataclass(frozen=True)
class Attribution:
    """What a lower bound is made of: ``free_bound`` and the amounts of all raises. Costs and times are
    timesteps, or in your unit of time."""

    free_bound: float
    """The sum (makespan: the largest) of the free costs."""
    lower_bound: float
    agents: tuple[Charge, ...]
    raises: tuple[Raise, ...]
    """In the order in which they were proved."""
    sites: tuple[Site, ...]
    reasons: tuple[Reason, ...]
    """The same in few reasons, the largest first."""

    def __str__(self) -> str:
        lines = [f"bound {self.lower_bound:g} = {self.free_bound:g} that the agents cost alone"]
        for reason in self.reasons:
            names = ", ".join(str(agent) for agent in reason.agents)
            lines.append(f"+ {reason.amount:g}: agents {names}")
        return "\n".join(lines)


def _attribution(parts: Any, cost: Callable[[int], float]) -> Optional[Attribution]:
    """Of what the compiled part returns; ``cost`` converts timesteps or ticks."""
    if parts is None:
        return None
    free_bound, lower_bound, agents, raises, sites, reasons = parts

    def site(part: Any) -> Site:
        pair, place, other, begin, end, lemmas = part
        second = None if other is None else Place(*other)
        return Site(pair, Place(*place), second, cost(begin), None if end is None else cost(end), lemmas)

    all_sites = tuple(site(part) for part in sites)
    return Attribution(
        cost(free_bound),
        cost(lower_bound),
        tuple(Charge(cost(free), None if own is None else cost(own)) for free, own in agents),
        tuple(Raise(kind, cost(amount), who, near) for kind, amount, who, near in raises),
        all_sites,
        tuple(Reason(cost(amount), who, tuple(all_sites[k] for k in where)) for amount, who, where in reasons),
    )
