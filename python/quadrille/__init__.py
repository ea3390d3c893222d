# SPDX-License-Identifier: MIT
"""Exact multi-agent path finding: plans for many agents that move at the same time and must not
collide, with the proof that no plan is cheaper.

    import quadrille as q
    fleet = q.read("x.map", "x.scen", agents=50)
    result = q.solve(fleet, time_limit=5)
    result.plan.paths          # int32[n, T, 2]

A place on a grid is ``(x, y)``, column and row. On roadmaps, lengths and times are in your own units.
"""

from ._core import __version__
from ._errors import BodyWarning, FileError, InputError, NoPlanError, RoundingWarning
from .attribution import Attribution, Charge, Place, Raise, Reason, Site
from .dispatching import Dispatcher, Orders
from .fleet import Fleet
from .graphs import Graph, Grid, PoseGrid, Roadmap
from .plans import Plan, StepPath, StepPlan, TimedPath, TimedPlan
from .reading import read
from .reports import Report, Violation
from .rules import Obstacle, Underway
from .solving import Moves, Progress, Result, Statistics, solve

__all__ = [
    "Attribution",
    "BodyWarning",
    "Charge",
    "Dispatcher",
    "FileError",
    "Fleet",
    "Graph",
    "Grid",
    "InputError",
    "Moves",
    "NoPlanError",
    "Obstacle",
    "Orders",
    "Place",
    "Plan",
    "PoseGrid",
    "Progress",
    "Raise",
    "Reason",
    "Report",
    "Result",
    "Roadmap",
    "RoundingWarning",
    "Site",
    "Statistics",
    "StepPath",
    "StepPlan",
    "TimedPath",
    "TimedPlan",
    "Underway",
    "Violation",
    "__version__",
    "read",
    "solve",
]
