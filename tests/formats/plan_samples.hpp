// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <sstream>
#include <string>

#include "quadrille/discrete/movingai.hpp"

// One plan of two agents, as several programs write it.

namespace quadrille::formats {

/// From (1, 0) down to (1, 2), and from (0, 1) to the right, to (3, 1).
inline discrete::Instance crossing() {
  std::istringstream map("type octile\nheight 3\nwidth 4\nmap\n@.@@\n....\n@..@\n");
  std::istringstream scen(
      "version 1\n0\tm.map\t4\t3\t1\t0\t1\t2\t0\n0\tm.map\t4\t3\t0\t1\t3\t1\t0\n");
  const auto read = discrete::read_map(map, "m.map").value();
  return discrete::make_instance(std::make_shared<const discrete::Graph>(read.graph()),
                                 discrete::read_scenario(scen, "m.scen").value(), 2)
      .value();
}

/// Of MAPF-LNS2: no blank behind the colon.
inline const std::string kLns2 =
    "Agent 0:(0,1)->(1,1)->(2,1)->\n"
    "Agent 1:(1,0)->(1,0)->(1,1)->(1,2)->(1,3)->\n";

inline const std::string kLacam = R"(agents=2
map_file=m.map
solved=1
soc=6
makespan=4
starts=(1,0),(0,1),
goals=(1,2),(3,1),
soc_lb=5
a message of its own
solution=
0:(1,0),(0,1),
1:(1,1),(0,1),
2:(1,2),(1,1),
3:(1,2),(2,1),
4:(1,2),(3,1),
)";

inline const std::string kPlanViz = R"({"actionModel": "MAPF", "AllValid": "Yes", "teamSize": 2,
"start": [[0, 1, "N/A"], [1, 0, "N/A"]], "sumOfCost": 6, "errors": [],
"actualPaths": ["D,D,W,W", "W,R,R,R"], "plannerTimes": [0.1]}
)";

inline const std::string kTracker =
    "map_name,scen_type,type_id,agents,lower_cost,solution_cost,solution_plan,flip_up_down\r\n"
    "m,even,1,1,2,2,\"2d\",FALSE\r\n"
    "m,even,1,2,5,6,\"2d2w\n"
    "w3rw\",FALSE\r\n";

inline const std::string kAtb033 =
    "cost: 8\n"
    "schedule:\n"
    "  agent0: [{t: 0, x: 1, y: 0}, {t: 1, x: 1, y: 1}, {t: 2, x: 1, y: 2}]\n"
    "  agent1: [{t: 0, x: 0, y: 1}, {t: 1, x: 0, y: 1}, {t: 2, x: 1, y: 1}, {t: 3, x: 2, y: 1}, "
    "{t: 4, x: 3, y: 1}]\n";

inline const std::string kLibmrpRoadmap = R"(roadmap:
  undirected: True
  allow_wait_actions: true
  edges:
    - [B, A]
    - [A, C]
    - [A, 7]
    - [C, A]
agents:
  - name: agent0
    start: B
    goal: C
  - start: C
    goal: 7
)";

inline const std::string kSidingJson =
    R"({"quadrille": "instance", "version": 1, "resolution": 0.001, "roadmap": {
"vertices": [[0, 0], [1.5, 0], [3, 0], [1.5, 1.25], [1.5, 0.0001]],
"edges": [[0, 1], [1, 0], [1, 2], [2, 1], [1, 3], [3, 1]]},
"agents": [{"start": 0, "goal": 3, "radius": 0.2}]})";

inline const std::string kLogWithIds = R"(<root><log>
<agent number="0">
<path>
<section start_id="0" goal_id="0" duration="0.5"/>
<section start_id="0" goal_id="1" duration="1.5"/>
<section start_id="1" goal_id="3" duration="1.25"/>
</path></agent></log></root>
)";

inline const std::string kLogWithPlaces = R"(<root><log>
<agent number="0">
<path>
<section start_i="0" start_j="0" goal_i="0" goal_j="0" duration="0.5"/>
<section start_i="0" start_j="0" goal_i="1.5" goal_j="0" duration="1.5"/>
<section start_i="1.5" start_j="0" goal_i="1.5" goal_j="1.25" duration="1.25"/>
</path></agent></log></root>
)";

}  // namespace quadrille::formats
