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
from ._errors import BodyWarning, FileError, InputError, LayoutWarning, NoPlanError, RoundingWarning
from .attribution import Attribution, Charge, Place, Raise, Reason, Site
from .dispatching import Dispatcher, GridDispatcher, Orders
from .execution import Executor, Releaser, Simulation, simulate
from .fleet import Fleet
from .graphs import Graph, Grid, PoseGrid, Roadmap
from .plans import NodeOrder, Plan, StepPath, StepPlan, TimedPath, TimedPlan, Wait
from .poses import Car, PoseRoadmap
from .reading import read
from .reports import Report, Violation
from .rules import Obstacle, Underway
from .session import Session
from .solving import Interrupted, Moves, Progress, Result, Statistics, solve

__all__ = [
    "Attribution",
    "BodyWarning",
    "Car",
    "Charge",
    "Dispatcher",
    "Executor",
    "FileError",
    "Fleet",
    "Graph",
    "Grid",
    "GridDispatcher",
    "InputError",
    "Interrupted",
    "LayoutWarning",
    "Moves",
    "NoPlanError",
    "NodeOrder",
    "Obstacle",
    "Orders",
    "Place",
    "Plan",
    "PoseGrid",
    "PoseRoadmap",
    "Progress",
    "Raise",
    "Reason",
    "Releaser",
    "Report",
    "Result",
    "Roadmap",
    "RoundingWarning",
    "Session",
    "Simulation",
    "Site",
    "Statistics",
    "StepPath",
    "StepPlan",
    "TimedPath",
    "TimedPlan",
    "Underway",
    "Violation",
    "Wait",
    "__version__",
    "read",
    "simulate",
    "solve",
]
