// SPDX-License-Identifier: MIT
#include "quadrille/text/sniff.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace quadrille::text {
namespace {

struct Case {
  FileKind kind;
  std::string text;
};

const std::vector<Case> kCases = {
    {FileKind::unknown, ""},
    {FileKind::unknown, " \r\n\t"},
    {FileKind::unknown, "hello"},
    {FileKind::unknown, "<svg/>"},
    {FileKind::unknown, "{\"a\": {\"quadrille\": 1}}"},
    {FileKind::movingai_map, "type octile\nheight 1\nwidth 1\nmap\n.\n"},
    {FileKind::movingai_map, "height 1\nwidth 1\nmap\n.\n"},
    {FileKind::movingai_scenario, "version 1\n"},
    {FileKind::own_instance, "{\"quadrille\": \"instance\", \"version\": 1, \"grid\": {}}"},
    {FileKind::own_roadmap, " {\"version\":1,\"quadrille\":\"instance\",\"roadmap\":{\"a\":[]}}"},
    {FileKind::own_plan, "{\"quadrille\": \"plan\", \"version\": 1, \"plan\": []}"},
    {FileKind::own_plan, "{\"quadrille\": \"0.2\", \"status\": \"optimal\", \"plan\": [[1]]}"},
    {FileKind::own_export, "agent,time,x,y,vx,vy\n0,0,0,0,0,0\n"},
    {FileKind::lif, "{\"layouts\": [], \"metaInformation\": {\"lifVersion\": \"1.0.0\"}}"},
    {FileKind::geojson, "{\"type\": \"FeatureCollection\", \"features\": []}"},
    {FileKind::gml, "graph [\n  node [ id 0 ]\n]\n"},
    {FileKind::gml, "Creator \"yFiles\"\nVersion 2.1\ngraph\n[\n]\n"},
    {FileKind::gml, "# made by hand\ngraph\n[\n]\n"},
    {FileKind::graphml, "<?xml version='1.0'?>\n<!-- <root> -->\n<graphml xmlns=\"x\"></graphml>"},
    {FileKind::node_link, "{\"directed\": false, \"nodes\": [], \"links\": []}"},
    {FileKind::ccbs_grid, "<root><map><width>1</width></map></root>"},
    {FileKind::ccbs_task, "<root>\n<agent start_id=\"0\" goal_id=\"1\"/></root>"},
    {FileKind::ccbs_log, "<root><map/><agent start_id=\"0\"/><log><agent/></log></root>"},
    {FileKind::ccbs_settings, "<root><algorithm><agent_size>1</agent_size></algorithm></root>"},
    {FileKind::nav_graph, "building_name: b\nlevels:\n  L1:\n    vertices: []\n"},
    {FileKind::nav_graph, "levels: {L1: {vertices: []}}\n"},
    {FileKind::building, "coordinate_system: reference_image\nlevels:\n  L1: {}\n"},
    {FileKind::building, "name: b\nlevels:\n  L1:\n    measurements:\n    - []\n"},
    {FileKind::rmf_scenario, "agents: {}\noccupancy: {}\ncell_size: 1.0\n"},
    {FileKind::libmrp_instance, "map: {dimensions: [1, 1]}\nagents: []\n"},
    {FileKind::libmrp_instance, "{map: {dimensions: [1, 1]}, agents: []}"},
    {FileKind::libmrp_roadmap, "roadmap:\n  undirected: true\nagents: []\n"},
    {FileKind::libmrp_schedule, "statistics:\n  cost: 1\nschedule:\n  agent0: []\n"},
    {FileKind::libmrp_schedule, "cost: 5\nschedule:\n  agent0: []\n"},
    {FileKind::lacam_result, "agents=1\nmap_file=a.map\nsolution=\n0:(0,0),\n"},
    {FileKind::visualizer_plan, "0:(0,0),\n"},
    {FileKind::cbsh2_paths, "Agent 0:(0,0)->\n"},
    {FileKind::tracker_csv, "map_name,scen_type,type_id,agents,\"solution_plan\"\n"},
    {FileKind::planviz, "{\"actionModel\": \"MAPF\", \"actualPaths\": []}"},
    {FileKind::lorr_problem, "{\"mapFile\": \"a\", \"taskFile\": \"b\"}"},
    {FileKind::lorr_locations, "# version for LoRR 2026\n400\n"},
    {FileKind::vda5050, "{\"orderId\": \"a\", \"nodes\": []}"},
    {FileKind::occupancy_yaml, "image: a.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n"},
    {FileKind::boox, "Locations: 8\n0: 0.0, 0.0\n"},
    {FileKind::asprilo, "% made by hand\ninit(object(node,1),value(at,(1,1))).\n"},
};

TEST(Sniff, KnowsWhatPeopleBring) {
  for (const Case& one : kCases) EXPECT_EQ(sniff(one.text), one.kind) << one.text;
}

TEST(Sniff, HasWordsForEachKind) {
  for (const Case& one : kCases) {
    if (one.kind == FileKind::unknown) continue;
    EXPECT_FALSE(in_words(one.kind).empty()) << one.text;
    EXPECT_FALSE(where_it_belongs(one.kind).empty()) << one.text;
  }
  EXPECT_EQ(describe(FileKind::lif), "this is a layout in VDMA's LIF: it belongs to --roadmap");
  EXPECT_EQ(in_words(FileKind::unknown), "");
}

TEST(Sniff, RefusesOtherKindsOnly) {
  const std::string map = "type octile\n";
  EXPECT_EQ(refuse_other(map, "f", {FileKind::movingai_map}), std::nullopt);
  EXPECT_EQ(refuse_other("hello", "f", {FileKind::movingai_map}), std::nullopt);
  const auto error = refuse_other(map, "f", {FileKind::lif, FileKind::gml});
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->to_string(),
            "f:1: this is a map of MovingAI's: it belongs to --map, or to --roadmap");
}

TEST(Sniff, TakesAnyText) {
  std::mt19937_64 random(3);
  for (int n = 0; n < 20'000; ++n) {
    std::string text = kCases[random() % kCases.size()].text;
    for (std::uint64_t hits = random() % 4; hits > 0 && !text.empty(); --hits) {
      const std::size_t at = random() % text.size();
      if (random() % 2 == 0)
        text.resize(at);
      else
        text[at] = "{}[]\"'\\<>:,=\n #-"[random() % 16];
    }
    (void)sniff(text);
  }
}

TEST(Sniff, IsLinear) {
  // Ten million brackets, keys, and elements that are never closed.
  for (const char* const piece :
       {"{\"a\":", "[", "a: b\n", "<root ", "\"", "{'", "# x\n", "<!--"}) {
    std::string text = piece[0] == '"' ? "{" : "";
    while (text.size() < 10'000'000) text += piece;
    (void)sniff(text);
  }
}

}  // namespace
}  // namespace quadrille::text
