#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Plans for Open-RMF's next generation: the fields of all messages, and robots that do what these say and nothing
else, however late, and never collide.

usage: rmf_test.py <quadrille>
"""

import copy
import json
import math
import random
import subprocess
import sys
import tempfile
from pathlib import Path

from rmf_fields import check


def run(program, *arguments, given=None):
    return subprocess.run([program, *map(str, arguments)], input=given, capture_output=True, text=True, check=False)


def place(waypoints, k, share):
    """On the way from waypoint k to the next one."""
    here = waypoints[k]["position"]
    there = waypoints[min(k + 1, len(waypoints) - 1)]["position"]
    return [a + share * (b - a) for a, b in zip(here, there)]


class Robot:
    """Knows its plan, and of others what their progress is."""

    def __init__(self, message):
        self.name, self.plan = message["name"], message["plan"]
        self.at, self.share, self.is_away = 0, 0.0, False

    @property
    def waypoints(self):
        return self.plan["waypoints"]

    @property
    def has_arrived(self):
        return self.at + 1 == len(self.waypoints)

    @property
    def progress(self):
        if not self.is_away:
            return self.waypoints[self.at]["progress"]
        way = self.waypoints[self.at]["departure_trajectory"][0]
        first, last = way["initial_progress_level"], way["final_progress_level"]
        return first + self.share * (last - first)

    @property
    def place(self):
        return place(self.waypoints, self.at, self.share)

    def may_leave(self, robots):
        for blocker in self.waypoints[self.at]["departure_blockers"]:
            other = robots[blocker["name"]]
            assert other.plan["plan_id"] == blocker["plan_id"]
            if other.progress < blocker["required_progress"]:
                return False
        return True

    def step(self, time, robots):
        """Goes on for so long."""
        if self.has_arrived or not (self.is_away or self.may_leave(robots)):
            return
        self.is_away = True
        knots = self.waypoints[self.at]["departure_trajectory"][0]["curve"]["knots"]
        self.share += time / knots[-1]
        if self.share >= 1:
            self.at, self.share, self.is_away = self.at + 1, 0.0, False


def follow(messages, radii, seed):
    """The least space between two bodies, and whether all arrive."""
    robots = {message["name"]: Robot(message) for message in messages}
    draw, least = random.Random(seed), math.inf
    chance = {name: draw.choice([0.3, 0.7, 1.0]) for name in robots}
    for _ in range(20_000):
        everybody = list(robots.values())
        if all(robot.has_arrived for robot in everybody):
            return least, True
        # One at a time, in any order, so that steps are short against what bodies need.
        draw.shuffle(everybody)
        for robot in everybody:
            if draw.random() < chance[robot.name]:
                robot.step(0.02, robots)
        for i, one in enumerate(messages):
            for other in messages[:i]:
                apart = math.dist(robots[one["name"]].place, robots[other["name"]].place)
                least = min(least, apart - radii[one["name"]] - radii[other["name"]])
    return least, False


def crossing(seed):
    """Robots of two sizes and speeds on nine crossings, as an instance."""
    draw = random.Random(seed)
    vertices = [[3 * (i % 3) + draw.uniform(-0.3, 0.3), 3 * (i // 3) + draw.uniform(-0.3, 0.3)] for i in range(9)]
    pairs = [(i, i + 1) for i in range(9) if i % 3 < 2] + [(i, i + 3) for i in range(6)]
    starts, goals = draw.sample(range(9), 5), draw.sample(range(9), 5)
    agents = [
        {"name": f"amr{k}", "start": starts[k], "goal": goals[k], "radius": draw.choice([0.3, 0.5]),
         "speed": draw.choice([1, 1.5])}
        for k in range(5)
    ]
    edges = [edge for a, b in pairs for edge in ([a, b], [b, a])]
    return {
        "quadrille": "instance", "version": 1, "resolution": 0.001,
        "roadmap": {"vertices": vertices, "edges": edges}, "agents": agents,
    }


def test_robots_never_collide(program, folder):
    followed, tight = 0, 0
    for seed in range(25):
        file, plan = folder / "i.json", folder / "p.json"
        file.write_text(json.dumps(crossing(seed)))
        if run(program, "solve", "--instance", file, "--plan", plan, "--quiet", "--gap", 5).returncode != 0:
            continue
        done = run(program, "export", "--instance", file, "--to", "open-rmf-plan", plan)
        if done.returncode == 1 or "wait for each other for ever" in done.stderr:
            continue
        assert done.returncode == 0, done.stderr
        messages = json.loads(done.stdout)
        radii = {agent["name"]: agent["radius"] for agent in json.loads(file.read_text())["agents"]}
        assert [message["name"] for message in messages] == list(radii)
        for message in messages:
            check(message["plan"], "Plan", message["name"])
            levels = [waypoint["progress"] for waypoint in message["plan"]["waypoints"]]
            assert levels == sorted(set(levels)), "progress increases"
        followed += 1
        for run_ in range(4):
            least, all_arrive = follow(messages, radii, run_)
            assert all_arrive and least > -0.002, (seed, run_, least)
        # The referee sees robots that do not wait for what they are told to.
        hasty = copy.deepcopy(messages)
        for message in hasty:
            for waypoint in message["plan"]["waypoints"]:
                waypoint["departure_blockers"] = []
        tight += any(follow(hasty, radii, run_)[0] < -0.05 for run_ in range(4))
    assert followed >= 10 and tight >= 5, (followed, tight)


def test_server(program, folder):
    file = folder / "i.json"
    instance = crossing(1)
    for agent in instance["agents"]:
        agent["goal"] = agent["start"]
    file.write_text(json.dumps(instance))
    free = [v for v in range(9) if v not in [agent["start"] for agent in instance["agents"]]]
    node = {"graph_name": "graph", "key": [free[0]], "name": [], "map": [], "element_type": 1}
    far = {**node, "key": [free[1]]}
    goal = {
        "one_of": [{"regions": [], "nodes": [{"key": key, "orientations": []}]} for key in (node, far)],
        "cost_bias": [1000.0, 0.0], "session": {"uuid": list(range(16))},
    }
    check(goal, "DestinationGoal")
    lines = [{"goal": {"robot": "amr0", **goal}}, {"tick": {"duration": 0.5}}, {"plans": {}}]
    done = run(program, "dispatch", "--instance", file, "--serve",
               given="".join(json.dumps(line) + "\n" for line in lines))
    assert done.returncode == 0, done.stderr
    answers = [json.loads(line) for line in done.stdout.splitlines()]
    assert [list(answer) for answer in answers] == [["goal"], ["tick"], ["plans"]], answers
    for message in answers[2]["plans"]:
        check(message["plan"], "Plan")
        check(message["release"], "PlanRelease")
        check(message["progress"], "Progress")
        assert message["plan"]["plan_id"] == message["release"]["plan_id"]
    first = answers[2]["plans"][0]
    # The other choice would cost 1000 more.
    assert first["plan"]["waypoints"][-1]["arrival_constraints"]["nodes"][0]["key"]["key"] == [free[1]]
    assert first["plan"]["plan_id"]["destination_session"]["uuid"] == list(range(16))


class LiveRobot:
    """Obeys departure blockers, also when it is under way already, and nothing else."""

    def __init__(self, message, clock):
        self.name, self.plan, self.clock = message["name"], message["plan"], clock
        self.waypoints = self.plan["waypoints"]

    @property
    def left(self):
        """The waypoint from which it goes on, or stands at."""
        at = 0
        while at + 1 < len(self.waypoints) and self.arrival(at + 1) <= self.clock:
            at += 1
        return at

    def arrival(self, k):
        return self.waypoints[k - 1]["departure_trajectory"][0]["final_progress_level"]

    @property
    def place(self):
        at = self.left
        way = self.waypoints[at]["departure_trajectory"]
        if not way or self.clock <= way[0]["initial_progress_level"]:
            return self.waypoints[at]["position"]
        first, last = way[0]["initial_progress_level"], way[0]["final_progress_level"]
        return place(self.waypoints, at, (self.clock - first) / (last - first))

    def has_arrived(self):
        return self.left + 1 == len(self.waypoints)

    def step(self, time, robots):
        here = self.waypoints[self.left]
        if self.has_arrived():
            return
        begin = here["departure_trajectory"][0]["initial_progress_level"]
        then = self.clock + time
        # Up to where it leaves it may go at any time.
        if then > begin:
            for blocker in here["departure_blockers"]:
                other = robots[blocker["name"]]
                assert other.plan["plan_id"] == blocker["plan_id"]
                # Who has arrived has made all its progress.
                if other.clock < blocker["required_progress"] and not other.has_arrived():
                    then = max(self.clock, min(then, begin))
        self.clock = then


def follow_live(messages, clocks, radii, seed):
    robots = {message["name"]: LiveRobot(message, clocks[message["name"]]) for message in messages}
    draw, least = random.Random(seed), math.inf
    chance = {name: draw.choice([0.2, 0.6, 1.0]) for name in robots}
    for _ in range(1500):
        everybody = list(robots.values())
        if all(robot.has_arrived() for robot in everybody):
            break
        draw.shuffle(everybody)
        for robot in everybody:
            if draw.random() < chance[robot.name]:
                robot.step(0.02, robots)
        for i, one in enumerate(everybody):
            for other in everybody[:i]:
                least = min(least, math.dist(one.place, other.place) - radii[one.name] - radii[other.name])
    return least, all(robot.has_arrived() for robot in robots.values())


def session(program, arguments, names, goals, seed, step, late, look):
    """Robots of a server that are late at random. `look` sees messages and clocks after each call."""
    draw = random.Random(seed)
    server = subprocess.Popen([program, "dispatch", *map(str, arguments), "--serve", "--effort", "3"],
                              stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def ask(what, **given):
        server.stdin.write(json.dumps({what: given}) + "\n")
        server.stdin.flush()
        answer = json.loads(server.stdout.readline())
        assert what in answer, answer
        return answer[what]

    for call in range(40):
        held = [name for name in names if draw.random() < 0.2] if not late else []
        news = ask("tick", duration=step, **({"held": held} if held else {}))
        clocks = {robot["robot"]: robot["clock"] for robot in news["robots"]}
        if call % 4 == 1:
            look(ask("plans"), clocks)
        for robot in news["robots"]:
            if robot["tasks"] == 0:
                ask("assign", robot=robot["robot"], goals=draw.choice(goals))
            if late and draw.random() < 0.7:
                ask("report", robot=robot["robot"], clock=robot["limit"])
    server.stdin.close()
    assert server.wait() == 0


def test_blockers_of_a_server(program, folder):
    seen = {"runs": 0, "blockers": 0, "arrived": 0, "tight": 0}
    for seed in range(6):
        file = folder / "live.json"
        instance = crossing(seed)
        for agent in instance["agents"]:
            agent["goal"] = agent["start"]
        file.write_text(json.dumps(instance))
        radii = {agent["name"]: agent["radius"] for agent in instance["agents"]}

        def look(messages, clocks):
            for message in messages:
                check(message["plan"], "Plan", message["name"])
            seen["blockers"] += sum(len(w["departure_blockers"]) for m in messages for w in m["plan"]["waypoints"])
            least, arrived = follow_live(messages, clocks, radii, seen["runs"])
            assert least > -0.002, (seed, seen, least)
            seen["runs"] += 1
            seen["arrived"] += arrived
            for message in messages:
                for waypoint in message["plan"]["waypoints"]:
                    waypoint["departure_blockers"] = []
            seen["tight"] += follow_live(messages, clocks, radii, seen["runs"])[0] < -0.05

        session(program, ["--instance", file], list(radii), list(range(9)), seed, 0.5, True, look)
    assert seen["blockers"] > 100 and seen["arrived"] > 20 and seen["tight"] > 5, seen


def test_blockers_on_a_grid(program, folder):
    names = [f"r{k}" for k in range(6)]
    instance = {
        "quadrille": "instance", "version": 1, "grid": {"width": 4, "height": 3, "rows": ["....", ".@..", "...."]},
        "agents": [{"name": name, "start": cell, "goal": cell}
                   for name, cell in zip(names, [[0, 0], [1, 0], [3, 0], [3, 1], [0, 2], [2, 2]])],
    }
    file = folder / "grid.json"
    file.write_text(json.dumps(instance))
    seen = {"runs": 0, "blockers": 0, "tight": 0}

    def look(messages, clocks):
        radii = {name: 0.35 for name in names}
        for message in messages:
            check(message["plan"], "Plan", message["name"])
        seen["blockers"] += sum(len(w["departure_blockers"]) for m in messages for w in m["plan"]["waypoints"])
        assert follow_live(messages, clocks, radii, seen["runs"])[0] > -0.002
        seen["runs"] += 1
        for message in messages:
            for waypoint in message["plan"]["waypoints"]:
                waypoint["departure_blockers"] = []
        seen["tight"] += follow_live(messages, clocks, radii, seen["runs"])[0] < -0.05

    for seed in range(4):
        session(program, ["--instance", file], names, [[0, 0], [3, 2], [2, 0], [0, 1], [2, 1]], seed, 1, False, look)
    assert seen["blockers"] > 50 and seen["tight"] > 3, seen


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        test_robots_never_collide(program, Path(folder))
        test_server(program, Path(folder))
        test_blockers_of_a_server(program, Path(folder))
        test_blockers_on_a_grid(program, Path(folder))
    print("all is well")


if __name__ == "__main__":
    main()
