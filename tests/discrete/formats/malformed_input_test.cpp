// SPDX-License-Identifier: MIT
//
// Every file in data/malformed is refused for the reason, at the line and with the code that
// data/malformed/expected.tsv states; every file in data/valid is read.
#include <gmock/gmock.h>

#include <set>

#include "discrete/formats/io_support.hpp"
#include "quadrille/discrete/instance_json.hpp"
#include "quadrille/discrete/instance_yaml.hpp"
#include "quadrille/discrete/plan_formats.hpp"

namespace quadrille::discrete {
namespace {

using ::testing::HasSubstr;

struct Expectation {
  std::string file;
  long line = 0;
  std::string code;
  std::string message;
};

void PrintTo(const Expectation& expected, std::ostream* out) { *out << expected.file; }

std::vector<Expectation> expectations() {
  std::vector<Expectation> all;
  std::istringstream in(testing::text_of(testing::data("malformed/expected.tsv")));
  for (std::string row; std::getline(in, row);) {
    std::istringstream fields(row);
    Expectation expected;
    std::string line;
    std::getline(fields, expected.file, '\t');
    std::getline(fields, line, '\t');
    std::getline(fields, expected.code, '\t');
    std::getline(fields, expected.message);
    expected.line = std::stol(line);
    all.push_back(expected);
  }
  return all;
}

std::string name_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::io:
      return "io";
    case ErrorCode::syntax:
      return "syntax";
    case ErrorCode::invalid_instance:
      return "invalid_instance";
    case ErrorCode::no_plan:
      return "no_plan";
    case ErrorCode::out_of_range:
      return "out_of_range";
    case ErrorCode::invalid_plan:
      return "invalid_plan";
    case ErrorCode::internal:
      return "internal";
  }
  return "?";
}

std::shared_ptr<const Graph> small_graph() {
  return std::make_shared<const Graph>(read_map(testing::data("valid/small.map")).value().graph());
}

template <class T>
std::optional<Error> error_of(const Result<T>& result) {
  if (result) return std::nullopt;
  return result.error();
}

/// Reads a file as its name says: plans and two agents of scenarios on small.map.
std::optional<Error> read(const std::filesystem::path& path) {
  const auto extension = path.extension();
  if (extension == ".map") return error_of(read_map(path));
  if (extension == ".scen") {
    const auto scenario = read_scenario(path);
    return scenario ? error_of(make_instance(small_graph(), *scenario, 2)) : scenario.error();
  }
  const bool plan = path.stem() == "plan" || path.stem() == "result" || extension == ".plan";
  if (plan) return error_of(read_plan(path, *small_graph()));
  if (extension == ".json") return error_of(read_instance_json(path));
  return error_of(read_instance_yaml(path));
}

class MalformedInput : public ::testing::TestWithParam<Expectation> {};

TEST_P(MalformedInput, IsRefusedWithFileLineAndReason) {
  const auto path = testing::data("malformed/" + GetParam().file);
  const auto error = read(path);
  ASSERT_TRUE(error.has_value()) << "was accepted";
  EXPECT_EQ(error->where.file, path.string());
  EXPECT_EQ(error->where.line, GetParam().line) << error->message;
  EXPECT_EQ(name_of(error->code), GetParam().code) << error->message;
  EXPECT_THAT(error->message, HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(Files, MalformedInput, ::testing::ValuesIn(expectations()),
                         [](const auto& test) {
                           std::string name = test.param.file;
                           for (char& c : name)
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           return name;
                         });

TEST(MalformedInputs, AreAllExpected) {
  std::set<std::string> listed, present;
  for (const Expectation& expected : expectations()) listed.insert(expected.file);
  for (const auto& entry : std::filesystem::directory_iterator(testing::data("malformed")))
    if (entry.path().extension() != ".tsv") present.insert(entry.path().filename().string());
  EXPECT_EQ(listed, present);
  EXPECT_GT(listed.size(), 140u);
}

TEST(ValidInputs, AreRead) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(testing::data("valid"))) {
    const auto error = read(entry.path());
    EXPECT_FALSE(error.has_value()) << error->to_string();
    ++files;
  }
  EXPECT_GE(files, 15);
}

TEST(Files, ThatCannotBeReadAreIoErrors) {
  for (const char* name : {"no/such/file.map", "valid"}) {
    const auto map = read_map(testing::data(name));
    ASSERT_FALSE(map.has_value());
    EXPECT_EQ(map.error().code, ErrorCode::io);
    EXPECT_EQ(map.error().where.file, testing::data(name).string());
  }
  EXPECT_THAT(read_map(testing::data("valid")).error().message, HasSubstr("is a directory"));
  EXPECT_THAT(read_map(testing::data("no.map")).error().message, HasSubstr("cannot be opened: "));
  EXPECT_EQ(read_scenario(testing::data("none")).error().code, ErrorCode::io);
  EXPECT_EQ(read_instance_json(testing::data("none")).error().code, ErrorCode::io);
  EXPECT_EQ(read_instance_yaml(testing::data("none")).error().code, ErrorCode::io);
  EXPECT_EQ(read_plan(testing::data("none"), *small_graph()).error().code, ErrorCode::io);
}

TEST(Files, OfADeviceThatNeverEndsAreRefused) {
  std::ifstream zeros("/dev/zero");
  if (!zeros.is_open()) GTEST_SKIP() << "no /dev/zero here";
  const auto map = read_map(zeros, "/dev/zero");
  ASSERT_FALSE(map.has_value());
  EXPECT_THAT(map.error().to_string(), HasSubstr("/dev/zero:1: a NUL byte"));
}

}  // namespace
}  // namespace quadrille::discrete
