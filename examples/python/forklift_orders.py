# SPDX-License-Identifier: MIT
"""From a nav graph of Open-RMF to orders of VDA 5050 with headings: forklifts, longer than they are
wide, that turn on the spot."""

import json
import pathlib
import sys

import quadrille as q

# The places and lanes in metres and seconds, with their names, limits and passthrough points.
MAPS = pathlib.Path(__file__).parent.parent / "maps"
places = q.Roadmap.read(MAPS / "hall.nav.yaml", resolution=(0.001, 0.1))
poses = places.with_headings(turning=45)  # degrees per second

# From where, facing where, to where.
tasks = {"lift_1": ("dock", 0, "rack_3"), "lift_2": ("rack_2", 270, "dock"), "lift_3": ("gate", 180, "rack_1")}
fleet = q.Fleet(
    poses,
    starts=[poses.facing(place, heading) for place, heading, _ in tasks.values()],
    goals=[poses.any_heading(goal) for _, _, goal in tasks.values()],
    polygon=[(-0.6, -0.4), (0.6, -0.4), (0.6, 0.4), (-0.6, 0.4)],
    speed=1,
    names=list(tasks),
)
result = q.solve(fleet)
print(result.status, result.cost, file=sys.stderr)
assert result.plan is not None

# A robot is released as far as it has to wait for nobody.
for order in result.plan.to_vda5050(manufacturer="maker", map="L1"):
    print(order["serialNumber"])
    for node in order["nodes"]:
        where = node["nodePosition"]
        print(f"  {'go to' if node['released'] else 'then '} {node['nodeId']} and face {where['theta']:.3f}")
print(json.dumps(order["nodes"][1]))

# And as it goes on: a robot has made its first move.
releaser = q.Releaser(result.plan)
releaser.end_moves("lift_3", 1)
for robot in releaser.take_news():
    print(fleet.names[robot], "may make", releaser.released(robot), "moves")
