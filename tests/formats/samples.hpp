// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "quadrille/geometry/point.hpp"

// Small files as other programs write them, for tests of right values and for mutants.

namespace quadrille::formats {

inline const std::string kLif =
    R"({"metaInformation": {"projectIdentification": "p", "creator": "c", "lifVersion": "1.0.0"},
"layouts": [{"layoutId": "hall", "layoutVersion": "1", "nodes": [
{"nodeId": "A", "nodePosition": {"x": 0, "y": 0}, "vehicleTypeNodeProperties": [{"vehicleTypeId": "cart"}]},
{"nodeId": "B", "nodePosition": {"x": 2, "y": 0}, "vehicleTypeNodeProperties": [{"vehicleTypeId": "cart"}]},
{"nodeId": "C", "mapId": "m", "nodePosition": {"x": 2, "y": -1.5}, "vehicleTypeNodeProperties": [{"vehicleTypeId": "cart"}]}], "edges": [
{"edgeId": "e", "startNodeId": "A", "endNodeId": "B", "vehicleTypeEdgeProperties": [{"vehicleTypeId": "cart", "maxSpeed": 0.5}]},
{"edgeId": "f", "startNodeId": "B", "endNodeId": "A", "vehicleTypeEdgeProperties": [{"vehicleTypeId": "cart", "maxSpeed": 3, "rotationAllowed": true}]},
{"edgeId": "g", "startNodeId": "B", "endNodeId": "C", "vehicleTypeEdgeProperties": [{"vehicleTypeId": "cart", "trajectory": {"degree": 1}}]},
{"edgeId": "h", "startNodeId": "C", "endNodeId": "B", "vehicleTypeEdgeProperties": [{"vehicleTypeId": "cart"}]}],
"stations": [{"stationId": "dock", "interactionNodeIds": ["C"]}]}]}
)";

inline const std::string kRouteGraph =
    R"({"type": "FeatureCollection", "name": "graph", "features": [
{"type": "Feature", "properties": {"id": 1, "frame": "map", "operations": {}}, "geometry": {"type": "Point", "coordinates": [0, 0]}},
{"type": "Feature", "properties": {"id": 2}, "geometry": {"type": "Point", "coordinates": [1.0, 0.0]}},
{"type": "Feature", "properties": {"id": 3, "frame": "map"}, "geometry": {"type": "Point", "coordinates": [1.0, 2.5]}},
{"type": "Feature", "properties": {"id": 4, "startid": 1, "endid": 2, "metadata": {"speed_limit": 0.5, "a": 1}}, "geometry": {"type": "MultiLineString", "coordinates": []}},
{"type": "Feature", "properties": {"id": 5, "startid": 2, "endid": 1, "overridable": true, "cost": 3}, "geometry": {"type": "LineString", "coordinates": []}},
{"type": "Feature", "properties": {"id": 6, "startid": 2, "endid": 3}, "geometry": {"type": "MultiLineString", "coordinates": []}}]}
)";

inline const std::string kNetworkx = R"xml(<?xml version='1.0' encoding='utf-8'?>
<graphml xmlns="http://graphml.graphdrawing.org/xmlns">
  <key id="d1" for="node" attr.name="y" attr.type="double"/>
  <key id="d0" for="node" attr.name="x" attr.type="double"/>
  <graph edgedefault="undirected">
    <node id="west"><data key="d0">0.0</data><data key="d1">0</data></node>
    <node id="(0, 1)"><data key="d0">1.0</data><data key="d1">0.0</data></node>
    <node id="7"><data key="d1">0.5</data><data key="d0">1</data></node>
    <edge source="(0, 1)" target="west"/>
    <edge source="(0, 1)" target="7"/>
  </graph>
</graphml>
)xml";

inline const std::string kOmplInSpace = R"(<graphml>
  <key id="key0" for="node" attr.name="coords" attr.type="string" />
  <graph id="G" edgedefault="directed">
    <node id="n0"><data key="key0">0,0,1</data></node>
    <node id="n1"><data key="key0">3,0,-1.5</data></node>
    <edge id="e0" source="n0" target="n1"/>
  </graph>
</graphml>
)";

inline const std::string kYed = R"(<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<graphml xmlns:y="http://www.yworks.com/xml/graphml">
  <key for="node" id="d5" attr.name="description" attr.type="string"/>
  <key for="node" id="d6" yfiles.type="nodegraphics"/>
  <graph edgedefault="directed" id="G">
    <node id="n0"><data key="d5"/><data key="d6"><y:ShapeNode>
      <y:Geometry height="30.0" width="40.0" x="5.0" y="20.0"/><y:NodeLabel>dock
        <y:LabelModel/></y:NodeLabel></y:ShapeNode></data></node>
    <node id="n1"><data key="d6"><y:ShapeNode>
      <y:Geometry height="20" width="40" x="100" y="0"/><y:NodeLabel>lift</y:NodeLabel>
    </y:ShapeNode></data></node>
    <edge id="e0" source="n0" target="n1"/>
  </graph>
</graphml>
)";

inline const std::string kGml = R"(graph [
  directed 0
  node [ id 0 label "west" x 0.0 y 0.0 ]
  node [ id 1 label "1" graphics [ x 1.0 y -.5e0 ] ]
  node [ id 2 pos +2 pos 0 ]
  edge [ source 0 target 1 weight 1.0 ]
  edge [ source 1 target 2 ]
]
)";

inline const std::string kNavGraph = R"(building_name: b
doors: {}
levels:
  L1:
    vertices:
    - [0.0, 0.0, {name: dock}]
    - [1.0, 0.0, {name: ''}]
    - [1.0, 2.0, {name: lift}]
    lanes: [[0, 1, {is_bidirectional: true, speed_limit: 0.5}], [1, 2, {is_bidirectional: false}]]
  L2:
    vertices: [[0, 0, {name: lift}], [3, 0, {}]]
    lanes: []
)";

using Places = std::vector<geometry::Point>;  ///< In thousandths.
using Edges = std::vector<std::pair<std::size_t, std::size_t>>;

inline std::string decimal(geometry::Length thousandths) {
  const std::int64_t value = thousandths.value(), part = value < 0 ? -value : value;
  std::string digits = std::to_string(part % 1000);
  digits.insert(0, 3 - digits.size(), '0');
  return (value < 0 ? "-" : "") + std::to_string(part / 1000) + "." + digits;
}

inline std::string graphml_of(const Places& places, const Edges& edges) {
  std::string text =
      "<graphml><key id=\"c\" for=\"node\" attr.name=\"coords\"/><graph edgedefault=\"directed\">";
  // In the opposite order.
  for (std::size_t v = places.size(); v-- > 0;)
    text += "<node id=\"" + std::to_string(v) + "\"><data key=\"c\">" + decimal(places[v].x) + "," +
            decimal(places[v].y) + "</data></node>\n";
  for (const auto& [a, b] : edges)
    text += "<edge source=\"" + std::to_string(a) + "\" target=\"" + std::to_string(b) + "\"/>\n";
  return text + "</graph></graphml>\n";
}

inline std::string gml_of(const Places& places, const Edges& edges) {
  std::string text = "graph [ directed 1\n";
  for (const auto& [a, b] : edges)
    text += "edge [ source " + std::to_string(a) + " target " + std::to_string(b) + " ]\n";
  for (std::size_t v = 0; v < places.size(); ++v)
    text += "node [ id " + std::to_string(v) + " x " + decimal(places[v].x) + " y " +
            decimal(places[v].y) + " ]\n";
  return text + "]\n";
}

inline std::string route_graph_of(const Places& places, const Edges& edges) {
  std::string text = "{\"type\": \"FeatureCollection\", \"features\": [", separator;
  for (const auto& [a, b] : edges) {
    text += separator + "{\"properties\": {\"startid\": " + std::to_string(a) +
            ", \"endid\": " + std::to_string(b) +
            "}, \"geometry\": {\"type\": \"LineString\", \"coordinates\": []}}";
    separator = ",\n";
  }
  for (std::size_t v = 0; v < places.size(); ++v) {
    text += separator + "{\"properties\": {\"id\": " + std::to_string(v) +
            "}, \"geometry\": {\"type\": \"Point\", \"coordinates\": [" + decimal(places[v].x) +
            ", " + decimal(places[v].y) + "]}}";
    separator = ",\n";
  }
  return text + "]}\n";
}

inline std::string lif_of(const Places& places, const Edges& edges) {
  const std::string type = "[{\"vehicleTypeId\": \"t\"}]";
  std::string
      text =
          "{\"metaInformation\": {\"lifVersion\": \"1.0.0\"}, \"layouts\": [{\"layoutId\": \"l\", "
          "\"nodes\": [",
      separator;
  for (std::size_t v = 0; v < places.size(); ++v) {
    text += separator + "{\"nodeId\": \"" + std::to_string(v) +
            "\", \"nodePosition\": {\"x\": " + decimal(places[v].x) +
            ", \"y\": " + decimal(places[v].y) + "}, \"vehicleTypeNodeProperties\": " + type + "}";
    separator = ",\n";
  }
  text += "], \"edges\": [";
  separator.clear();
  for (const auto& [a, b] : edges) {
    text += separator + "{\"edgeId\": \"e\", \"startNodeId\": \"" + std::to_string(a) +
            "\", \"endNodeId\": \"" + std::to_string(b) +
            "\", \"vehicleTypeEdgeProperties\": " + type + "}";
    separator = ",\n";
  }
  return text + "]}]}\n";
}

inline std::string nav_graph_of(const Places& places, const Edges& edges) {
  std::string text = "building_name: b\nlevels:\n  L1:\n    lanes:";
  if (edges.empty()) text += " []";
  for (const auto& [a, b] : edges)
    text += "\n    - [" + std::to_string(a) + ", " + std::to_string(b) + ", {}]";
  text += "\n    vertices:";
  for (const geometry::Point& place : places)
    text += "\n    - [" + decimal(place.x) + ", " + decimal(place.y) + ", {name: \"\"}]";
  return text + "\n";
}

}  // namespace quadrille::formats
