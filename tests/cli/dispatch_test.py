#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""quadrille dispatch: on grids, with the tasks of the League of Robot Runners, as a page, and for other programs.

usage: dispatch_test.py <quadrille>
"""

import json
import math
import random
import re
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM = sys.argv[1]
ROOM = "type octile\nheight 4\nwidth 6\nmap\n......\n.@@.@.\n.@@.@.\n......\n"


def run(*arguments, given=None):
    return subprocess.run([PROGRAM, *map(str, arguments)], input=given, capture_output=True, text=True, check=False)


def report_of(*arguments):
    done = run("dispatch", *arguments, "--json", "-", "--quiet")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def scenario(cells):
    rows = [f"0\troom.map\t6\t4\t{a}\t{b}\t{c}\t{d}\t1" for a, b, c, d in cells]
    return "version 1\n" + "\n".join(rows) + "\n"


def room(folder):
    (folder / "room.map").write_text(ROOM)
    (folder / "room.scen").write_text(scenario([(0, 0, 5, 0), (5, 0, 0, 0), (0, 3, 5, 3), (5, 3, 0, 3)]))
    return "--map", folder / "room.map", "--scen", folder / "room.scen", "--agents", 4


def test_grids(folder):
    report = report_of(*room(folder), "--steps", 300, "--delays", 0.1, "--effort", 3)
    assert report["robots"] == 4 and report["contacts"] == 0 and report["tasks_done"] > 30
    gaps = report["each_call"]["gap_percent"]
    assert len(gaps) == len(report["each_call"]["seconds"]) == 300 and min(gaps) >= 0
    assert len(report["service_times"]) == report["tasks_done"]
    own = report_of(*room(folder), "--own-tasks")
    # Five moves each at least, and two pairs that meet.
    assert own["tasks_done"] == 4 and own["time"] >= 5
    graph = {"quadrille": "instance", "version": 1, "graph": {"vertices": 2, "edges": [[0, 1]]},
             "agents": [{"start": 0, "goal": 1}]}
    (folder / "graph.json").write_text(json.dumps(graph))
    on_graph = "--instance", folder / "graph.json"
    assert report_of(*on_graph, "--own-tasks")["tasks_done"] == 1
    for more in (["--dispatcher", "roadmap"], ["--view", "-"]):
        done = run("dispatch", *on_graph, *more, "--quiet")
        assert done.returncode == 65 and "a graph has no places" in done.stderr, done.stderr


def test_which_dispatcher(folder):
    on_roadmap = report_of(*room(folder), "--dispatcher", "roadmap", "--steps", 150, "--delays", 0.1, "--step", 0.5)
    assert on_roadmap["dispatcher"] == "roadmap" and on_roadmap["contacts"] == 0 and on_roadmap["time"] == 75
    on_grid = report_of(*room(folder), "--steps", 75, "--delays", 0.1, "--window", 8, "--service", 2)
    assert on_grid["dispatcher"] == "grid" and on_grid["contacts"] == 0 and on_grid["tasks_done"] > 5
    assert on_grid["new_origins"] == 0
    league_tasks = league(folder, ["23,0,5", "3", "18,23", "5,18,0", "9", "15,21"], numTasksReveal=1.5)
    without_turns = report_of(*league_tasks, "--dispatcher", "grid")
    assert without_turns["tasks_done"] == len(without_turns["service_times"]) == 6
    assert without_turns["time"] < report_of(*league_tasks, "--effort", 3)["time"]
    for wrong, why in (
        (["--step", 0.5], "--step: on a grid a call is one timestep"),
        (["--reach", 3], "it belongs to --dispatcher roadmap"),
        (["--service", 1.5], "--service: on a grid times are whole timesteps"),
        (["--window", 9, "--dispatcher", "roadmap"], "--window belongs to --dispatcher grid"),
        (["--dispatcher", "train"], "'train' is not grid or roadmap"),
    ):
        done = run("dispatch", *room(folder), *wrong)
        assert done.returncode == 64 and why in done.stderr, (wrong, done.stderr)
    done = run("dispatch", *town(folder), "--dispatcher", "grid")
    assert done.returncode == 64 and "needs a grid or graph" in done.stderr, done.stderr


def test_what_is_not_heeded_is_refused(folder):
    file = Path(town(folder)[1])
    plain = json.loads(file.read_text())
    later = dict(plain["agents"][0], release=3)
    for more, why in (
        (dict(whole_moves=True), "plans for whole moves are not supported here"),
        (dict(now=5), "a live fleet begins at time 0"),
        (dict(agents=[later, *plain["agents"][1:]]), "is released later, which is not supported here"),
    ):
        file.write_text(json.dumps({**plain, **more}))
        for serves in ([], ["--serve"]):
            done = run("dispatch", "--instance", file, *serves, given="")
            assert done.returncode == 65 and why in done.stderr, (more, done.stderr)
    graph = {"quadrille": "instance", "version": 1, "graph": {"vertices": 2, "edges": [[0, 1]]}, "now": 5,
             "agents": [{"start": 0, "goal": 1}]}
    file.write_text(json.dumps(graph))
    done = run("dispatch", "--instance", file)
    assert done.returncode == 65 and "begin at timestep 0, and not at 5" in done.stderr, done.stderr


def test_serving_a_grid(folder):
    server, draw = Server(*room(folder), "--effort", 3), random.Random(3)
    cells = [[x, y] for y, row in enumerate(ROOM.split("\n")[4:]) for x, letter in enumerate(row) if letter == "."]
    closed, served, before = set(), 0, [[0, 0], [5, 0], [0, 3], [5, 3]]
    for time in range(200):
        if time % 20 == 10:
            assert server.ask("close", **{"from": [2, 0], "to": [3, 0]}) == {"from": [2, 0], "to": [3, 0]}
            closed = {(2, 0), (3, 0)}
        if time % 20 == 19:
            server.ask("open", **{"from": [3, 0], "to": [2, 0]})
            closed = set()
        held = [robot for robot in range(4) if draw.random() < 0.1]
        news = server.ask("tick", duration=1, held=held)
        assert news["now"] == time + 1 and news["cost"] >= news["lower_bound"]
        served += len(news["served"])
        places = [robot["course"][0]["vertex"] for robot in news["robots"]]
        assert all(place in cells for place in places)
        assert len({tuple(place) for place in places}) == 4
        for who, (a, b) in enumerate(zip(before, places)):
            assert math.dist(a, b) <= (0 if who in held else 1) and {tuple(a), tuple(b)} != closed
            assert a == b or not any(before[other] == b and places[other] == a for other in range(4))
        before = places
        for robot in news["robots"]:
            if robot["tasks"] == 0:
                server.ask("assign", robot=robot["robot"], goals=draw.choice(cells))
    assert served > 40
    for line, why in (
        ('{"tick": {"duration": 2}}', "a call is one timestep"),
        ('{"tick": {"duration": 1, "held": 3}}', '"held" is a list'),
        ('{"tick": {"duration": 1, "held": [9]}}', "there is no robot 9"),
        ('{"close": {"from": [0, 0], "to": [3, 3]}}', "there is no edge"),
        ('{"report": {"robot": 0, "clock": 999}}', "was allowed to go no further than to"),
        ('{"assign": {"robot": 0, "goals": [[1, 1]]}}', "there is no vertex [1,1]"),
    ):
        answer = server.say(line)
        assert "error" in answer and why in answer["error"]["message"], (line, answer)
    server.end()


def league(folder, tasks, **more):
    (folder / "l.map").write_text(ROOM)
    (folder / "l.agents").write_text("3\n0\n5\n18\n")
    (folder / "l.tasks").write_text(f"# version\n{len(tasks)}\n" + "".join(f"{task}\n" for task in tasks))
    problem = {"mapFile": "l.map", "agentFile": "l.agents", "taskFile": "l.tasks", "teamSize": 3, **more}
    (folder / "l.json").write_text(json.dumps(problem))
    return "--instance", folder / "l.json"


def test_tasks_of_the_league(folder):
    tasks = ["23,0,5", "3", "18,23", "5,18,0", "9", "15,21"]
    report = report_of(*league(folder, tasks, numTasksReveal=1.5), "--effort", 3)
    assert report["tasks_done"] == len(report["service_times"]) == 6 and report["contacts"] == 0
    assert report["calls"] < 1000
    # Somebody goes to 23, then back to 0 and to 5: that takes at least 5 + 3 moves there, and as many back.
    assert max(report["service_times"]) >= 8 + 5
    # What is known are the first ones: with one task per robot the others come later, or not at all.
    few = report_of(*league(folder, tasks, numTasksReveal=1), "--effort", 3, "--steps", 3)
    assert few["tasks_done"] <= 3
    for wrong in ("23,", "x", "23,7", "23,,0", "99"):
        done = run("dispatch", *league(folder, ["3", "9", wrong]))
        assert (done.returncode == 0) == (wrong == "23,"), (wrong, done.stderr)
        if done.returncode != 0:
            assert re.search(r"l\.tasks:5: ", done.stderr), done.stderr


def scene_of(page):
    return json.loads(re.search(r'<script[^>]*type="application/json"[^>]*>(.*?)</script>', page, re.S).group(1))


def test_pages(folder):
    done = run("dispatch", *room(folder), "--steps", 40, "--delays", 0.2, "--view", "-", "--quiet")
    assert done.returncode == 0, done.stderr
    scene = scene_of(done.stdout)
    assert len(scene["agents"]) == 4 and scene["violations"] == []
    times = set()
    for agent in scene["agents"]:
        stops = [agent["stops"][k:k + 4] for k in range(0, len(agent["stops"]), 4)]
        assert stops[0][2] == 0 and stops[-1][3] <= 4000
        times.add(stops[-1][3])
        for (x, y, _, leave), (to_x, to_y, come, _) in zip(stops, stops[1:]):
            # At speed 1, a length unit in a tick, and along rows and columns.
            assert come > leave and abs(math.hypot(to_x - x, to_y - y) - (come - leave)) < 1.1
            assert abs(to_x - x) < 1 or abs(to_y - y) < 1
    assert times == {4000}
    run("solve", *room(folder), "--plan", folder / "p.json", "--quiet")
    done = run("simulate", *room(folder), folder / "p.json", "--view", "-", "--quiet", "--delays", 0.5)
    assert done.returncode == 0, done.stderr
    scene = scene_of(done.stdout)
    cells = {(x, y) for y, row in enumerate(ROOM.split("\n")[4:]) for x, letter in enumerate(row) if letter == "."}
    seen = [{} for _ in range(4)]
    for who, agent in enumerate(scene["agents"]):
        stops = [agent["stops"][k:k + 4] for k in range(0, len(agent["stops"]), 4)]
        for x, y, come, leave in stops:
            for time in range(come, leave + 1, 100):
                seen[who][time] = (round(x / 100), round(y / 100))
        assert set(seen[who].values()) <= cells
    # The coupled rule: nobody is in the same cell at the same time.
    for time in set.intersection(*(set(one) for one in seen)):
        assert len({one[time] for one in seen}) == 4


def town(folder):
    instance = {
        "quadrille": "instance", "version": 1, "resolution": 0.001,
        "roadmap": {
            "names": ["west", "cross", "east", "bay"],
            "vertices": [[0, 0], [1, 0], [2, 0], [1, 0.8]],
            "edges": [[0, 1], [1, 0], [1, 2], [2, 1], [1, 3], [3, 1]],
        },
        "agents": [
            {"name": "slow", "start": 0, "goal": 0, "radius": 0.3},
            {"name": "fast", "start": 2, "goal": 2, "radius": 0.25, "speed": 2},
        ],
    }
    (folder / "town.json").write_text(json.dumps(instance))
    return "--instance", folder / "town.json"


class Server:
    def __init__(self, *arguments):
        self.process = subprocess.Popen(
            [PROGRAM, "dispatch", "--serve", *map(str, arguments)], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            text=True)

    def say(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()
        answer = self.process.stdout.readline()
        assert answer.endswith("\n")
        return json.loads(answer)

    def ask(self, what, **given):
        return self.say(json.dumps({what: given}))[what]

    def end(self):
        self.process.stdin.close()
        assert self.process.wait() == 0


def place(course, clock, xy):
    """Where a robot is on its course."""
    def at(stop):
        a, b = xy[stop["vertex"]], xy[stop.get("to", stop["vertex"])]
        share = stop.get("fraction", 0)
        return [p + share * (q - p) for p, q in zip(a, b)]

    for stop, after in zip(course, course[1:]):
        if clock < after["arrive"]:
            if clock <= stop["depart"]:
                return at(stop)
            share = (clock - stop["depart"]) / (after["arrive"] - stop["depart"])
            return [p + share * (q - p) for p, q in zip(at(stop), at(after))]
    return at(course[-1])


def test_serving(folder):
    server, draw = Server(*town(folder), "--effort", 3), random.Random(2)
    xy = {"west": (0, 0), "cross": (1, 0), "east": (2, 0), "bay": (1, 0.8)}
    assert server.ask("assign", robot="slow", goals="east", service=0.5) == {"robot": "slow", "tasks": 1}
    assert server.ask("assign", robot=1, goals=["west", 3]) == {"robot": "fast", "tasks": 1}
    assert server.ask("cancel", robot="fast")["tasks"] == 0
    served = 0
    for _ in range(300):
        news = server.ask("tick", duration=0.25)
        served += len(news["served"])
        assert news["gap_percent"] >= 0 and set(news["served"]) <= {"slow", "fast"}
        places = []
        for robot in news["robots"]:
            late = draw.random() < 0.3
            clock = robot["clock"] if late else min(robot["clock"] + 0.25, robot["limit"])
            # The library rounds clocks down to thousandths.
            clock = max(robot["clock"], math.floor(clock * 1000 + 1e-6) / 1000)
            assert server.ask("report", robot=robot["robot"], clock=clock) == {"robot": robot["robot"], "clock": clock}
            places.append(place(robot["course"], clock, xy))
            if robot["tasks"] == 0:
                server.ask("assign", robot=robot["robot"], goals=draw.choice(list(xy)))
        assert math.dist(*places) > 0.55 - 1e-6
    assert served > 20
    for way in (("cross", "bay"), ("bay", "cross")):
        server.ask("close", **dict(zip(("from", "to"), way)))
    for _ in range(12):
        for robot in server.ask("tick", duration=0.25)["robots"]:
            server.ask("report", robot=robot["robot"], clock=robot["limit"])
    for robot in server.ask("tick", duration=0.25)["robots"]:
        ways = [(a["vertex"], b["vertex"]) for a, b in zip(robot["course"], robot["course"][1:])]
        assert ("cross", "bay") not in ways and ("bay", "cross") not in ways
        server.ask("report", robot=robot["robot"], clock=robot["limit"])
    for line, why in (
        ('{"close": {"from": "bay", "to": "cross"}}', "is closed already"),
        ('{"tick": {"duration": 1, "held": [0]}}', "\"held\" is for grids"),
        ("", "this is no JSON"),
        ("[1]", "a request is an object with one key"),
        ('{"assign": {"robot": "slow", "goals": 1}, "tick": {}}', "with one key"),
        ('{"drive": {}}', "there is no request 'drive'"),
        ('{"assign": {"robot": "slow"}}', "'assign' needs \"goals\""),
        ('{"assign": {"robot": "slow", "goals": 1, "speed": 2}}', "'assign' has no \"speed\""),
        ('{"assign": {"robot": "quick", "goals": 1}}', "there is no robot \"quick\""),
        ('{"assign": {"robot": 2, "goals": 1}}', "there is no robot 2"),
        ('{"assign": {"robot": "slow", "goals": "north"}}', "there is no vertex \"north\""),
        ('{"assign": {"robot": "slow", "goals": []}}', "\"goals\" has none"),
        ('{"assign": {"robot": "slow", "goals": 1, "service": -1}}', "\"service\" is negative or too long"),
        ('{"assign": {"robot": "slow", "goals": 1, "deadline": "soon"}}', "\"deadline\" is a number"),
        ('{"report": {"robot": "slow", "clock": 1e9}}', "was allowed to go no further than to"),
        ('{"report": {"robot": "slow", "clock": -1}}', "\"clock\" is negative or too long"),
        ('{"tick": {"duration": 0}}', "time has to go on"),
        ('{"goal": {"robot": "slow", "one_of": []}}', "\"one_of\" is a list of at least one"),
        ('{"goal": {"robot": "slow", "one_of": [{"regions": []}]}}', "regions alone are no vertices"),
        ('{"goal": {"robot": "slow", "one_of": [{"nodes": [{"key": {"key": [1]}}]}], "cost_bias": [1, 2]}}',
         "as long as \"one_of\""),
    ):
        answer = server.say(line)
        assert why in answer["error"]["message"], (line, answer)
        assert answer["error"]["line"] > 300
    assert server.ask("tick", duration=0.25)["now"] > 0
    server.end()
    done = run("dispatch", *town(folder), "--serve", "--steps", 3)
    assert done.returncode == 64 and "--steps belongs to a simulation" in done.stderr


def main():
    for test in (test_grids, test_which_dispatcher, test_tasks_of_the_league, test_pages, test_serving,
                 test_what_is_not_heeded_is_refused, test_serving_a_grid):
        with tempfile.TemporaryDirectory() as folder:
            test(Path(folder))
    print("all is well")


if __name__ == "__main__":
    main()
