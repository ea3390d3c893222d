# SPDX-License-Identifier: MIT
"""The fields of the messages of a plan server of Open-RMF's next generation (rmf_prototype_msgs), and whether
a JSON value is such a message: all fields, no others, each of its type."""

import math
import struct


def array(kind, most=None, size=None):
    return ("array", kind, most, size)


MESSAGES = {
    "Time": {"sec": "int32", "nanosec": "uint32"},
    "UUID": {"uuid": array("uint8", size=16)},
    "PlanId": {"destination_session": "UUID", "plan_version": "uint64"},
    "GraphElementKey": {
        "graph_name": "string", "key": array("int64", most=2), "name": array("string", most=1),
        "map": array("string", most=1), "element_type": "uint8",
    },
    "TargetOrientation": {
        "orientation_radians": "float32", "spread_radians": "float32", "tolerance_radians": "float32",
    },
    "Region": {"points": array("float32"), "hint": "uint8"},
    "TargetRegion": {"tolerance": "float32", "region": "Region", "orientations": array("TargetOrientation")},
    "TargetNode": {"key": "GraphElementKey", "orientations": array("TargetOrientation")},
    "DestinationConstraints": {"regions": array("TargetRegion"), "nodes": array("TargetNode")},
    "DestinationGoal": {
        "one_of": array("DestinationConstraints"), "cost_bias": array("float32"), "session": "UUID",
    },
    "TrafficDependency": {"name": "string", "plan_id": "PlanId", "required_progress": "float32"},
    "ControlPoint": {"position": array("float32", size=2), "weight": "float32"},
    "Curve": {"degree": "uint32", "control_points": array("ControlPoint"), "knots": array("float32")},
    "Trajectory": {
        "curve": "Curve", "initial_progress_level": "float32", "final_progress_level": "float32",
        "maps": array("string"), "keys": array("GraphElementKey"),
    },
    "Waypoint": {
        "position": array("float32", size=2), "arrival_constraints": "DestinationConstraints",
        "progress": "float32", "maps": array("string"), "departure_blockers": array("TrafficDependency"),
        "departure_trajectory": array("Trajectory"), "departure_action": "string", "arrival_action": "string",
    },
    "Plan": {"waypoints": array("Waypoint"), "start_time": "Time", "plan_id": "PlanId", "workflow": "string"},
    "PlanRelease": {"waypoint_id": "uint64", "plan_id": "PlanId"},
    "Progress": {
        "progress": "float32", "reached_waypoint": "uint64", "target_waypoint": "uint64",
        "reached_keys": array("GraphElementKey"), "plan_id": "PlanId",
    },
}
RANGES = {
    "uint8": (0, 2**8), "uint32": (0, 2**32), "uint64": (0, 2**64), "int32": (-(2**31), 2**31),
    "int64": (-(2**63), 2**63),
}


def check(value, kind, where="message"):
    """An AssertionError that says where and what, if the value is not of that kind."""
    if isinstance(kind, tuple):
        _, entry, most, size = kind
        assert isinstance(value, list), f"{where}: no array"
        assert most is None or len(value) <= most, f"{where}: more than {most} entries"
        assert size is None or len(value) == size, f"{where}: not {size} entries"
        for k, one in enumerate(value):
            check(one, entry, f"{where}[{k}]")
    elif kind in MESSAGES:
        assert isinstance(value, dict), f"{where}: no object"
        assert set(value) == set(MESSAGES[kind]), f"{where}: {sorted(value)} are not the fields of {kind}"
        for name, of in MESSAGES[kind].items():
            check(value[name], of, f"{where}.{name}")
    elif kind == "string":
        assert isinstance(value, str), f"{where}: no text"
    elif kind == "float32":
        assert type(value) in (int, float) and math.isfinite(value), f"{where}: no number"
        assert struct.unpack("f", struct.pack("f", value))[0] == value, f"{where}: {value} is no float32"
    else:
        least, end = RANGES[kind]
        assert type(value) is int and least <= value < end, f"{where}: {value} is no {kind}"
