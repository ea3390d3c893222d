#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Trajectories of `quadrille export` as messages of ROS: each field is one of the message, with values of
its type; those of ROS 1 are the same when they are serialised and read back, those of ROS 2 are the same
but for the names of times; and they say what the CSV and the plan say, with headings along the moves.

usage: ros_test.py <quadrille>
"""
import csv
import io
import json
import math
import subprocess
import sys
import tempfile

import genpy
import genpy.message
from geometry_msgs.msg import Vector3
from nav_msgs.msg import Path
from trajectory_msgs.msg import MultiDOFJointTrajectory

program = sys.argv[1]


def run(*arguments, codes=(0,)):
    done = subprocess.run([program, *arguments], capture_output=True, text=True, check=False)
    assert done.returncode in codes, (arguments, done.returncode, done.stderr)
    return done.stdout


def round_trip(kind, fields):
    """The message that comes back. `seq` of headers is the only field that nobody sets."""
    message = kind()
    genpy.message.fill_message_args(message, [fields])
    data = io.BytesIO()
    message.serialize(data)  # Checks all types.
    back = kind().deserialize(data.getvalue())
    assert back == message
    return back


def has_all_fields(message, fields, where="message"):
    """The JSON has all fields of the message, so that none of them is there by default."""
    for name, value in fields.items():
        of_message = getattr(message, name)
        if isinstance(value, dict):
            has_all_fields(of_message, value, f"{where}.{name}")
        elif isinstance(value, list):
            assert len(of_message) == len(value), (where, name)
            for k, item in enumerate(value):
                if isinstance(item, dict):
                    has_all_fields(of_message[k], item, f"{where}.{name}[{k}]")
        else:
            assert of_message == value, (where, name, of_message, value)
    if not isinstance(message, (genpy.Time, genpy.Duration)):
        assert set(message.__slots__) - {"seq"} == set(fields), (where, message.__slots__, fields)


# The messages of ROS 2, by its interface files; lists hold any number of one kind.
INT32, UINT32, FLOAT64, STRING = range(-2**31, 2**31), range(2**32), float, str
VECTOR = {"x": FLOAT64, "y": FLOAT64, "z": FLOAT64}
QUATERNION = {**VECTOR, "w": FLOAT64}
TIME, DURATION = {"sec": INT32, "nanosec": UINT32}, {"sec": INT32, "nanosec": UINT32}
HEADER = {"stamp": TIME, "frame_id": STRING}
TWIST = {"linear": VECTOR, "angular": VECTOR}
ROS2_PATH = {"header": HEADER,
             "poses": [{"header": HEADER, "pose": {"position": VECTOR, "orientation": QUATERNION}}]}
ROS2_TRAJECTORY = {
    "header": HEADER, "joint_names": [STRING],
    "points": [{"transforms": [{"translation": VECTOR, "rotation": QUATERNION}], "velocities": [TWIST],
                "accelerations": [TWIST], "time_from_start": DURATION}]}


def is_message(value, kind):
    """All fields of a message of ROS 2, with values of their types, and no other one."""
    if isinstance(kind, dict):
        return isinstance(value, dict) and value.keys() == kind.keys() and all(
            is_message(value[name], of_field) for name, of_field in kind.items())
    if isinstance(kind, list):
        return isinstance(value, list) and all(is_message(item, kind[0]) for item in value)
    if isinstance(kind, range):
        return type(value) is int and value in kind
    if kind is FLOAT64:
        return type(value) in (int, float)
    return isinstance(value, kind)


def in_ros_1(value):
    """With the old names of times."""
    if isinstance(value, list):
        return [in_ros_1(item) for item in value]
    if isinstance(value, dict):
        names = {"sec": "secs", "nanosec": "nsecs"}
        return {names.get(name, name): in_ros_1(item) for name, item in value.items()}
    return value


def refuses(kind, fields):
    """What is no such message is not taken for one."""
    try:
        round_trip(kind, fields)
    except (genpy.MessageException, genpy.SerializationError):
        return
    sys.exit(f"a broken {kind.__name__} was serialised")


def close(a, b):
    return abs(a - b) <= 1e-9 * max(1, abs(a))


def headings(rows, turns):
    """Along the move that begins there; of a wait, along the last one; at first, along the first one."""
    along = [math.atan2(row["vy"], row["vx"]) if turns and (row["vx"], row["vy"]) != (0, 0) else None for row in rows]
    heading = next((angle for angle in along if angle is not None), 0)
    for angle in along:
        heading = heading if angle is None else angle
        yield heading


def faces(orientation, heading):
    """A rotation about the axis of z; two headings that differ by a full turn are the same."""
    assert orientation.x == orientation.y == 0 and close(orientation.z**2 + orientation.w**2, 1), orientation
    return abs(math.sin(math.atan2(orientation.z, orientation.w) - heading / 2)) < 1e-6


with tempfile.TemporaryDirectory() as folder:
    instance, plan = f"{folder}/instance.json", f"{folder}/plan.json"
    samples = heights = polygons = turned = 0
    for seed, *space in ((0,), (1,), (2,), (0, "--altitude", "4"), (1, "--altitude", "4")):
        run("generate", "--kind", "roadmap", "--vertices", "30", "--agents", "6", "--mixed", "--seed", str(seed),
            *space, "--instance-output", instance)
        run("solve", "--instance", instance, "--gap", "1000", "--quiet", "--plan", plan, codes=(0, 10))
        export = ["export", "--instance", instance, "--rate", "5", plan, "--to"]
        rows = [{key: float(value) for key, value in row.items()}
                for row in csv.DictReader(io.StringIO(run(*export, "csv")))]
        trajectories = json.loads(run(*export, "multidof", "--ros", "1"))
        paths = json.loads(run(*export, "path", "--ros", "1"))
        for old, to, kind in ((trajectories, "multidof", ROS2_TRAJECTORY), (paths, "path", ROS2_PATH)):
            messages = json.loads(run(*export, to))
            assert is_message(messages, [kind]) and not is_message(old, [kind])
            assert in_ros_1(messages) == old and json.loads(run(*export, to, "--ros", "2")) == messages
        agents = json.loads(open(instance, encoding="utf-8").read())["agents"]
        stops = json.loads(open(plan, encoding="utf-8").read())["plan"]
        assert len(trajectories) == len(paths) == len(stops) == 6
        for agent, (of_trajectory, of_path) in enumerate(zip(trajectories, paths)):
            trajectory, path = round_trip(MultiDOFJointTrajectory, of_trajectory), round_trip(Path, of_path)
            has_all_fields(trajectory, of_trajectory)
            has_all_fields(path, of_path)
            assert trajectory.joint_names == [f"agent{agent}"]
            of_agent = [row for row in rows if row["agent"] == agent]
            assert len(of_agent) == len(trajectory.points) == len(path.poses)
            turns = "radius" in agents[agent]
            polygons += not turns
            for row, point, pose, heading in zip(of_agent, trajectory.points, path.poses, headings(of_agent, turns)):
                assert faces(pose.pose.orientation, heading), (row, pose, heading)
                assert point.transforms[0].rotation == pose.pose.orientation
                assert point.velocities[0].angular == Vector3()
                turned += abs(heading) > 0.1
                place, speed = point.transforms[0].translation, point.velocities[0].linear
                position = pose.pose.position
                assert (place.x, place.y, place.z) == (position.x, position.y, position.z)
                assert close(place.x, row["x"]) and close(place.y, row["y"])
                assert close(speed.x, row["vx"]) and close(speed.y, row["vy"])
                assert ("z" in row) == bool(space)
                assert close(place.z, row.get("z", 0)) and close(speed.z, row.get("vz", 0))
                heights += place.z > 0 and speed.z != 0
                assert abs(point.time_from_start.to_sec() - row["time"]) < 1e-9
                assert abs(pose.header.stamp.to_sec() - row["time"]) < 1e-9
                assert pose.header.frame_id == "map"
                samples += 1
            for row, after in zip(of_agent, of_agent[1:]):  # Velocities are those of what comes next.
                for axis in "xyz" if space else "xy":
                    step = row["v" + axis] * (after["time"] - row["time"])
                    assert abs(row[axis] + step - after[axis]) < 1e-6, (row, after)
            last = path.poses[-1].pose.position
            assert [last.x, last.y, last.z][:len(stops[agent][-1]["at"])] == stops[agent][-1]["at"]
            assert abs(path.poses[-1].header.stamp.to_sec() - stops[agent][-1]["arrive"]) < 1e-9
            refuses(Path, {**of_path, "frame": "map"})
            refuses(MultiDOFJointTrajectory, {**of_trajectory, "joint_names": [1]})
    assert samples > 200, samples
    assert heights > 50, heights
    assert polygons > 3 and turned > 100, (polygons, turned)
