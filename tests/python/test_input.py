# SPDX-License-Identifier: MIT
"""Bad input is a ValueError, with the same text as the program's message."""

import pathlib

import numpy as np
import pytest
from conftest import SOURCE, run_program

import quadrille as q

MALFORMED = SOURCE / "tests/data/malformed"


def program_message(*arguments):
    done = run_program("info", *arguments)
    assert done.returncode == 65, (arguments, done.returncode, done.stderr)
    prefix = "quadrille: "
    assert done.stderr.startswith(prefix)
    return done.stderr[len(prefix):].rstrip("\n")


def test_malformed_files_get_the_message_of_the_program():
    seen = 0
    for line in (MALFORMED / "expected.tsv").read_text().splitlines():
        name, number = line.split("\t")[:2]
        path = MALFORMED / name
        extension = pathlib.Path(name).suffix
        if extension in (".json", ".yaml"):
            files, options = [path], ["--instance", path]
        elif extension == ".map":
            files, options = [path], ["--map", path]
        else:
            continue
        done = run_program("info", *options)
        if done.returncode != 65:  # some are wrong with the options of their tests only
            continue
        with pytest.raises(q.InputError) as raised:
            q.read(*files)
        assert f"quadrille: {raised.value}\n" == done.stderr, name
        assert raised.value.file == str(path) and raised.value.reason in str(raised.value)
        assert raised.value.line == (int(number) or None)
        seen += 1
    assert seen > 50


def test_tasks_that_do_not_fit(tmp_path):
    valid = SOURCE / "tests/data/valid"
    roadmaps = SOURCE / "tests/data/roadmaps"
    for files, arguments, options in [
        ((valid / "small.map", valid / "small.scen"), dict(agents=9),
         ("--map", valid / "small.map", "--scen", valid / "small.scen", "--agents", 9)),
        ((roadmaps / "roadmap.xml", roadmaps / "tasks.xml"), dict(agents=99),
         ("--roadmap", roadmaps / "roadmap.xml", "--task", roadmaps / "tasks.xml", "--agents", 99)),
        ((roadmaps / "roadmap.xml", tmp_path / "none.xml"), dict(radius=0.2),
         ("--roadmap", roadmaps / "roadmap.xml", "--task", tmp_path / "none.xml", "--radius", 0.2)),
        ((valid / "small.map", tmp_path), {}, ("--map", valid / "small.map", "--scen", tmp_path)),
        ((tmp_path / "none.json",), {}, ("--instance", tmp_path / "none.json")),
    ]:
        with pytest.raises(ValueError) as raised:
            q.read(*files, **arguments)
        assert str(raised.value) == program_message(*options)
    with pytest.raises(OSError):
        q.read(tmp_path / "none.json")


def test_options_that_do_not_fit():
    siding = SOURCE / "examples/maps/siding.json"
    for arguments in (dict(radius=1), dict(passable="S")):
        with pytest.raises(ValueError, match="belong"):
            q.read(siding, **arguments)
    assert len(q.read(siding, agents=1)) == 1
    with pytest.raises(ValueError, match="one file"):
        q.read()
    with pytest.raises(q.InputError, match="needs the grid|--task is missing"):
        q.read(SOURCE / "examples/maps/meeting.map", continuous=True, agents=3)


def test_all_formats_are_read():
    maps, roadmaps = SOURCE / "examples/maps", SOURCE / "tests/data/roadmaps"
    valid = SOURCE / "tests/data/valid"
    fleet = q.read(maps / "meeting.map", maps / "meeting.scen", agents=4)
    assert len(fleet) == 4 and isinstance(fleet.graph, q.Grid)
    assert len(q.read(str(maps / "meeting.map"), maps / "meeting.scen")) == 6
    assert len(q.read(maps / "meeting.map")) == 0
    assert isinstance(q.read(valid / "graph.json").graph, q.Graph)
    assert isinstance(q.read(valid / "grid.yaml").graph, q.Grid)
    assert isinstance(q.read(roadmaps / "roadmap.xml", radius=0.1).graph, q.Roadmap)
    assert isinstance(q.read(roadmaps / "cells.xml", roadmaps / "tasks.xml", agents=1, radius=0.3).graph, q.Roadmap)
    with pytest.warns(q.BodyWarning, match=r"discs of radius sqrt\(2\)/4"):
        timed = q.read(maps / "meeting.map", maps / "meeting.scen", continuous=True, agents=2)
    assert isinstance(timed.graph, q.Roadmap) and q.solve(timed).status == "optimal"


GRID = q.Grid(np.ones((2, 3)))
ROADMAP = q.Roadmap([(0, 0), (2, 0), (4, 0)], [(0, 1), (1, 2)], both_ways=True)


@pytest.mark.parametrize("make, text", [
    (lambda: q.Grid([1, 0]), r"free: expected an array of shape \(n, n\), not \(2,\)"),
    (lambda: q.Grid([[0.5]]), "free: expected booleans"),
    (lambda: q.Fleet(GRID, [(0, 0)], [(3, 0)]), r"agent 0: goal: the cell \(3, 0\) is blocked, or outside"),
    (lambda: q.Fleet(GRID, [(0, 0)], [(-1, 0)]), r"agent 0: goal: the cell \(-1, 0\)"),
    (lambda: q.Fleet(GRID, [(0, 2**40)], [(0, 0)]), r"start: the cell \(0, 1099511627776\)"),
    (lambda: q.Fleet(GRID, [(0, 0), (0, 0)], [(1, 0), (2, 0)]), "agents 0 and 1"),
    (lambda: q.Fleet(GRID, [(0.5, 0)], [(1, 0)]), "starts: expected integers"),
    (lambda: q.Fleet(GRID, [(0, 0)], []), "there are 1 starts and 0 goals"),
    (lambda: q.Fleet(GRID, [0], [1]), r"starts: expected an array of shape \(n, 2\)"),
    (lambda: q.Fleet(GRID, [(0, 0)], [(1, 0)], radius=1), "radius is for roadmaps"),
    (lambda: q.Fleet(GRID, [(0, 0)], [(1, 0)], names=["a", "b"]), "2 names for 1 agents"),
    (lambda: q.Fleet(ROADMAP, [3], [0], radius=0.3), "agent 0: start: there is no vertex 3 among 3"),
    (lambda: q.Fleet(ROADMAP, [0], [1], radius=0), "^agent 0 has a radius of 0, which is not positive, or too large$"),
    (lambda: q.Fleet(ROADMAP, [0], [1], radius=0.3, speed=float("nan")), "^agent 0 has a speed of nan, which is not supported$"),
    (lambda: q.Fleet(ROADMAP, [0], [1], polygon=[(0, 0), (1, 0), (2, 0)]), "agent 0 has a polygon .*line"),
    (lambda: q.Fleet(ROADMAP, [0], [1], radius=1, polygon=[(0, 0), (1, 0), (1, 1)]), "either a radius or a polygon"),
    (lambda: q.Fleet(ROADMAP, [0], [1]), "agent 0 has no body: on a roadmap give a radius or a polygon"),
    (lambda: q.Fleet(ROADMAP, [0, 1], [1, 2], polygon=[[(0, 0), (1, 0), (0, 1)], None]), "agent 1 has no body"),
    (lambda: q.Roadmap([(0, 0), (1, 0)], [(0, 2)]), r"edges\[0\]: there is no vertex 2 among 2"),
    (lambda: q.Roadmap([(0, 0), (1, 0)], [(0, 0)]), r"edges\[0\] leads from vertex 0 to itself"),
    (lambda: q.Roadmap([(0, 0), (0, float("inf"))], []), r"xy\[1\]"),
    (lambda: q.Roadmap([(0, 0), (1, 0)], [(0, 1)], durations=[0]), r"durations\[0\]"),
    (lambda: q.Roadmap([(0, 0)], [], resolution=0), "resolution"),
    (lambda: q.Roadmap([(0, 0)], [], nodes=["a", "b"]), "2 names for 1 vertices"),
    (lambda: q.Graph(2, [(0, 2)]), "there is no vertex 2 among 2"),
    (lambda: q.Graph(2, [(0, 1), (1, 0)]), "edge"),
    (lambda: q.Graph(-1, []), "num_vertices"),
    (lambda: q.Fleet(GRID, [(0, 0)], [(1, 0)]).plan([[]]), "paths"),
    (lambda: q.Fleet(GRID, [(0, 0)], [(1, 0)]).plan([[(9, 9)]]), r"agent 0, timestep 0: the cell \(9, 9\)"),
])
def test_arguments_that_are_wrong(make, text):
    with pytest.raises(ValueError, match=text):
        make()


@pytest.mark.parametrize("arguments, text", [
    (dict(gap=-1), "gap"),
    (dict(threads=0), "threads"),
    (dict(threads=-1), "threads: -1 is out of range"),
    (dict(seed=-1), "seed: -1 is out of range"),
    (dict(seed=2**40), "seed"),
    (dict(time_limit=-1), "time_limit: a limit is 0 or more"),
    (dict(system="cbs"), "system: 'cbs' is not dpll, dpll-mdd, smt-cbs or mdd-sat"),
    (dict(objective="fuel"), "objective: 'fuel' is not sum-of-costs or makespan"),
    (dict(check="2/1"), "2/1"),
    (dict(progress_interval=-1), "interval"),
    (dict(known_bound=-1), "the known lower bound is negative"),
    (dict(known_bound=1000), "the known lower bound is wrong: it is 1000, and a plan costs 1"),
])
def test_options_that_are_wrong(arguments, text):
    with pytest.raises(ValueError, match=text):
        q.solve(q.Fleet(GRID, [(0, 0)], [(1, 0)]), **arguments)


def test_options_that_are_not_for_roadmaps():
    fleet = q.Fleet(ROADMAP, [0], [1], radius=0.3)
    for arguments in (dict(check="watch"), dict(first_plan=False), dict(cost_search="iterative")):
        with pytest.raises(ValueError, match="does not apply to roadmaps"):
            q.solve(fleet, **arguments)
    with pytest.raises(ValueError, match="'mdd-sat' is not dpll or smt-cbs"):
        q.solve(fleet, system="mdd-sat")
    with pytest.raises(TypeError):
        q.solve(fleet, threads="two")


def test_files_that_cannot_be_written(tmp_path):
    fleet = q.Fleet(GRID, [(0, 0)], [(1, 0)])
    with pytest.raises(OSError, match="cannot write: No such file"):
        fleet.save(tmp_path / "none" / "i.json")
    plan = q.solve(fleet).plan
    with pytest.raises(ValueError, match="format: 'png'"):
        plan.save(tmp_path / "p", "png")
    with pytest.raises(q.FileError):
        plan.save("/dev/full")
    graph_plan = q.solve(q.Fleet(q.Graph(2, [(0, 1)]), [0], [1])).plan
    with pytest.raises(q.InputError):
        graph_plan.save(tmp_path / "p", "cbsh2")
    with pytest.raises(q.InputError, match="p.json:1"):
        (tmp_path / "p.json").write_text("{]")
        fleet.read_plan(tmp_path / "p.json")
