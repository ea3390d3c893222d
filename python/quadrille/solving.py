# SPDX-License-Identifier: MIT
"""The search for a plan of least cost."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Any, Callable, Generic, NamedTuple, Optional, Union

from . import _core
from ._errors import RoundingWarning
from .attribution import Attribution, _attribution
from .fleet import Fleet, P
from .graphs import PoseGrid


class Statistics(NamedTuple):
    """What one search did."""

    cpu_s: float
    wall_s: float
    peak_rss_mib: float
    """Largest resident memory of the process."""
    sat_calls: int
    conflicts: int
    """Clauses learned by the SAT solver."""
    decisions: int
    variables: int
    clauses: int
    collision_clauses: int
    """Of the clauses, those that rule out a conflict of two agents."""
    checks: int
    models_checked: int
    rejected_models: int
    cores: int
    """Unsatisfiable cores that raised the lower bound."""
    first_plan: str
    """Where the first plan came from; docs/cli.md. Empty: there is none."""


def _gap(cost: Optional[float], lower_bound: Optional[float]) -> Optional[float]:
    if cost is None or lower_bound is None:
        return None
    if cost == lower_bound:
        return 0.0
    return 100 * (cost - lower_bound) / lower_bound if lower_bound > 0 else float("inf")


@dataclass(frozen=True)
class Progress:
    """A look at a running search. Costs are in timesteps, or in your unit of time."""

    lower_bound: float
    """Proved: no plan is cheaper."""
    cost: Optional[float]
    """Of the best plan so far."""
    elapsed: float
    """Seconds."""
    conflicts: int
    phase: str = "search"
    """"feasibility", "set-up", "joint-search", "routes", "first-plan" or "search"."""

    @property
    def gap(self) -> Optional[float]:
        """By how many per cent of the bound the best plan may be too dear; None without a plan."""
        return _gap(self.cost, self.lower_bound)

    def __str__(self) -> str:
        cost, gap = ("none", "") if self.cost is None else (f"{self.cost:g}", f", gap {self.gap:.2f} %")
        return f"{self.elapsed:.1f} s: {self.phase}, bound {self.lower_bound:g}, best plan {cost}{gap}"


@dataclass(frozen=True)
class Moves:
    """How many moves a plan has: timesteps in which an agent changes its place."""

    number: int
    lower_bound: int
    """No plan of least cost has fewer."""
    proved: bool
    """The plan is one of least cost, and ``number`` is ``lower_bound``."""


@dataclass(frozen=True)
class Result(Generic[P]):
    """What a search has found and proved."""

    status: str
    """"optimal": a plan, and the proof that none is cheaper. "feasible": a plan. "infeasible": the
    proof that there is none. "unknown": a limit, or Ctrl-C, came first."""
    plan: Optional[P]
    """Verified; None unless the status is optimal or feasible."""
    cost: Optional[float]
    """Of the plan: int timesteps, or float in your unit of time."""
    lower_bound: Optional[float]
    """Proved: no plan is cheaper. None if there is no plan at all."""
    stop: str
    """What ended the search: "none" (it ended by itself), "wall-time", "cpu-time", "memory",
    "conflicts", "interrupt" (Ctrl-C) or "gap"."""
    explanation: str
    """For infeasible: why. For unknown: what ended the search."""
    statistics: Statistics
    internal_error: Optional[str]
    """A check of the solver's own work that failed; the status is unknown then. Please report it."""
    rests_on_known_bound: bool = False
    """``lower_bound`` is your ``known_bound``, and less than that was proved."""
    attribution: Optional[Attribution] = None
    """With ``explain``: why no plan is cheaper. None for infeasible, and if a limit came before the
    costs of the agents alone were known."""
    moves: Optional[Moves] = None
    """With ``tie="fewest-moves"`` and a plan."""

    @property
    def gap(self) -> Optional[float]:
        """By how many per cent of the bound the plan may be too dear; None without a plan."""
        return _gap(self.cost, self.lower_bound)

    def __repr__(self) -> str:
        return f"<quadrille.Result {self.status}, cost {self.cost}, lower bound {self.lower_bound}>"


class Interrupted(KeyboardInterrupt):
    """Ctrl-C has ended a search."""

    result: Result[Any]
    """What there is by then; ``stop`` is "interrupt"."""


def solve(
    fleet: Fleet[P],
    *,
    time_limit: Optional[float] = None,
    gap: Optional[float] = None,
    threads: int = 1,
    seed: int = 0,
    system: str = "dpll",
    objective: str = "sum-of-costs",
    progress: Optional[Callable[[Progress], object]] = None,
    progress_interval: float = 0.25,
    on_plan: Optional[Callable[[P], object]] = None,
    initial: Optional[P] = None,
    known_bound: Optional[float] = None,
    plan_interval: float = 1.0,
    cpu_limit: Optional[float] = None,
    memory_limit: Optional[float] = None,
    conflict_limit: Optional[int] = None,
    race: bool = False,
    first_plan: Optional[bool] = None,
    cost_search: Optional[str] = None,
    tie: Optional[str] = None,
    check: Optional[str] = None,
    mdd_growth: Optional[str] = None,
    forbid_first: Optional[bool] = None,
    chronological: Optional[bool] = None,
    explain: bool = False,
    audit: bool = False,
    keep_interrupt: bool = False,
) -> Result[P]:
    """Finds a plan of least cost, or proves that there is none.

    The same fleet, options and seed give the same answer as long as no limit of time or memory is
    met. The GIL is released, so that other Python threads go on and several searches may run at once.
    Ctrl-C ends the search and raises ``Interrupted``, a KeyboardInterrupt that has what there is by then as its ``result``.

    Args:
        fleet: The agents.
        time_limit: Seconds of wall-clock time; 0 stops at once.
        gap: Stop when the plan costs at most this many per cent more than is proved necessary.
        threads: Searches side by side, 1 to 64.
        seed: Of all random choices, 0 to 2000000000.
        system: "dpll", "dpll-mdd", "smt-cbs" or "mdd-sat"; on roadmaps "dpll" or "smt-cbs".
        objective: "sum-of-costs" of the agents' arrivals, or "makespan", the last one.
        progress: Called with a ``Progress`` in this thread, when a phase begins and else about once
            in ``progress_interval`` seconds. An exception ends the search and comes out of ``solve``.
        on_plan: Called with the best plan so far whenever a better one is known, at most once in
            ``plan_interval`` seconds. Exceptions as with ``progress``.
        initial: A valid plan for the same agents to begin with: the answer costs no more.
        known_bound: No plan costs less, as you know from elsewhere, such as an earlier solve: the search
            begins from it. A whole number of timesteps, or your unit of time. What rests on it alone
            says so (``rests_on_known_bound``); a plan that costs less is an ``InputError``.
        cpu_limit: Seconds of CPU time, of all threads together.
        memory_limit: MiB that the search may add to the process.
        conflict_limit: Conflicts of the SAT solver.
        race: With threads: take the proof that comes first in time. The plan, not its cost, may
            differ from run to run then.
        first_plan: Not on roadmaps: look for a plan of any cost before and beside the proof (default).
        cost_search: Not on roadmaps: "core-guided" or "iterative".
        tie: Not on roadmaps: which plan of least cost: "any" (default) or "fewest-moves", one with as few
            moves as any, found by a second search. ``moves`` says how many, and whether that is proved.
        check: Of dpll-mdd: "watch" (default), "propagate", or shares such as "1/2,3/4".
        mdd_growth: Of the systems with decision diagrams: "on-demand" (default) or "full".
        forbid_first, chronological: Of dpll in timesteps; see the manual of the program.
        explain: Say in ``attribution`` what the bound is made of. Of "dpll", on roadmaps of "smt-cbs"
            too, with one thread.
        audit: Derive every lemma again by other means; slow.
        keep_interrupt: Ctrl-C ends the search and nothing else: its result is returned (``stop`` is
            "interrupt").

    Returns:
        A ``Result``. Limits, and the lack of a plan, are no errors.

    Warns:
        RoundingWarning: if an agent is planned to take 5 per cent more or less time for an edge than
            it does, because times are rounded to whole ticks (``fleet.duration_error``).

    Raises:
        InputError: for an option that is out of range or does not apply.
        Interrupted: for Ctrl-C, unless ``keep_interrupt`` is true; nothing else is raised but what
            callbacks and signal handlers raise, and MemoryError.
    """
    given: dict[str, Any] = dict(
        time_limit=time_limit,
        gap=gap,
        threads=threads,
        seed=seed,
        system=system,
        objective=objective,
        progress_interval=progress_interval,
        plan_interval=plan_interval,
        cpu_limit=cpu_limit,
        memory_limit=memory_limit,
        conflict_limit=conflict_limit,
        race=race,
        first_plan=first_plan,
        cost_search=cost_search,
        tie=tie,
        check=check,
        mdd_growth=mdd_growth,
        forbid_first=forbid_first,
        chronological=chronological,
        explain=explain,
        audit=audit,
        known_bound=known_bound,
        initial=None if initial is None else initial._plan,
    )
    if rounded := fleet._duration_warning():
        warnings.warn(rounded, RoundingWarning, stacklevel=2)
    if not fleet._unread and isinstance(fleet.graph, PoseGrid):
        given["poses"] = fleet.graph._cells()
    return searched(fleet, fleet._instance.solve, given, progress, on_plan, keep_interrupt)


def searched(
    fleet: Fleet[P],
    search: Callable[[dict[str, Any]], dict[str, Any]],
    given: dict[str, Any],
    progress: Optional[Callable[[Progress], object]] = None,
    on_plan: Optional[Callable[[P], object]] = None,
    keep_interrupt: bool = False,
) -> Result[P]:
    """What ``search``, of the compiled part, makes of the fleet."""
    arguments = {name: value for name, value in given.items() if value is not None}
    cost = fleet._cost
    if progress is not None:
        tell = progress

        def on_progress(
            phase: str, bound: int, best: Optional[int], elapsed: float, conflicts: int
        ) -> None:
            known = None if best is None else cost(best)
            tell(Progress(cost(bound), known, elapsed, conflicts, phase))

        arguments["progress"] = on_progress
    if on_plan is not None:
        show = on_plan

        def on_better_plan(plan: Union[_core.StepPlan, _core.TimedPlan]) -> None:
            show(fleet._make_plan(plan))

        arguments["on_plan"] = on_better_plan
    outcome = search(arguments)
    best, bound, plan = outcome["cost"], outcome["lower_bound"], outcome["plan"]
    result = Result(
        status=outcome["status"],
        plan=None if plan is None else fleet._make_plan(plan),
        cost=None if best is None else cost(best),
        lower_bound=None if bound is None else cost(bound),
        stop=outcome["stop"],
        explanation=outcome["explanation"] if fleet._unread else fleet._in_names(outcome["explanation"]),
        statistics=Statistics(**outcome["statistics"]),
        internal_error=outcome["internal_error"],
        rests_on_known_bound=outcome["rests_on_known_bound"],
        attribution=_attribution(outcome["attribution"], cost),
        moves=None if outcome["moves"] is None else Moves(*outcome["moves"]),
    )
    if outcome.get("interrupted", False) and not keep_interrupt:
        interrupted = Interrupted("Ctrl-C has ended the search; its result is this one's")
        interrupted.result = result
        raise interrupted
    return result
