# SPDX-License-Identifier: MIT
"""Robots of two sizes on a networkx graph, in continuous time."""

import networkx as nx

import quadrille as q

# A ring of eight places with a siding, in metres.
graph = nx.cycle_graph(8)
places = nx.circular_layout(graph, scale=3)
graph.add_edge(0, "siding")
places["siding"] = (4.5, 0)

roadmap = q.Roadmap.from_networkx(graph, pos=places, resolution=0.001)
fleet = q.Fleet(
    roadmap,
    starts=[0, 4, 2],
    goals=[4, 0, "siding"],
    radius=[0.4, 0.4, 0.6],
    speed=[1, 1, 0.5],
    names=["left", "right", "heavy"],
)
result = q.solve(fleet)
print(result.status, result.cost, "seconds in all")
plan = result.plan
if plan is not None:
    report = plan.verify()
    assert report and report.clearances is not None
    print("least clearance", round(float(report.clearances["gap"][0]), 3), "m")
    for path in plan:
        print(path.name, [roadmap.nodes[stop["vertex"]] for stop in path.stops], path.cost)
    print("places 10 times a second:", plan.sample(10).shape)
