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


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        test_robots_never_collide(program, Path(folder))
        test_server(program, Path(folder))
    print("all is well")


if __name__ == "__main__":
    main()
