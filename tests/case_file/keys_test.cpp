// Every key of the lecture's case: missing, of another type, not finite, out of range; and a
// stranger in every table.
#include <gtest/gtest.h>

#include <cctype>
#include <ostream>
#include <string>
#include <vector>

#include "tests/case_file/edited_case.hpp"
#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"

namespace viscontact::case_file {
namespace {

enum class Kind { kNumber, kCount, kText, kNumbers, kTable, kTables };

struct KeyRules {
  LectureKey key;
  Kind kind;
  std::vector<const char*> out_of_range;  // values of the right type that are refused
  bool required = true;
};

// NOLINTNEXTLINE(readability-function-size): a table of all keys
std::vector<KeyRules> all_keys() {
  const std::vector<const char*> not_positive = {"0", "0.0", "-1", "-1e-300"};
  return {
      {{"title", "\"Sphere pushed towards a plane for 2, pulled back after\""}, Kind::kText, {}},
      {{"fluid.viscosity", "3.0"}, Kind::kNumber, not_positive},
      {{"sphere.radius", "1.0"}, Kind::kNumber, not_positive},
      {{"sphere.mass", "20.0"}, Kind::kNumber, not_positive},
      {{"tabulation.gaps", "{ from = 1e-3, to = 2.0, count = 40, spacing = \"log\" }"},
       Kind::kTable,
       {}},
      {{"tabulation.gaps.from", "1e-3"}, Kind::kNumber, not_positive},
      {{"tabulation.gaps.to", "2.0"}, Kind::kNumber, {"0", "-1", "1e-3", "1e-4"}},
      {{"tabulation.gaps.count", "40"},
       Kind::kCount,
       {"1", "0", "-40", "100001", "9223372036854775807"}},
      {{"tabulation.gaps.spacing", "\"log\""}, Kind::kText, {"\"\"", "\"Log\"", "\"logarithmic\""}},
      {{"tabulation.reference_velocities", "[-1.0]"},
       Kind::kNumbers,
       {"[0.0]", "[-1.0, 0]", "[]", "[-1, -2, -1.0]"}},
      {{"tabulation.container", "{ radius = 40.0, height = 80.0 }"}, Kind::kTable, {}},
      {{"tabulation.container.radius", "40.0"}, Kind::kNumber, {"0", "-40", "1.0", "0.5"}},
      {{"tabulation.container.height", "80.0"}, Kind::kNumber, {"0", "-80", "4.0", "3"}},
      {{"tabulation.relative_accuracy", "1e-5"}, Kind::kNumber, {"0", "-1e-5", "1.0", "2"}},
      {{"tabulation.geometry", "{ kind = \"plane\" }"}, Kind::kTable, {}, false},
      {{"tabulation.geometry.kind", "\"plane\""},
       Kind::kText,
       {"\"torus\"", "\"Plane\"", "\"free surface\"", "\"\""}},
      {{"fit.basis", "\"lecture\""}, Kind::kText, {"\"Lecture\"", "\"\"", "\"cubic\""}, false},
      {{"fit.weights", "\"relative\""}, Kind::kText, {"\"none\"", "\"\""}, false},
      {{"motion.initial_gap", "1.0"}, Kind::kNumber, not_positive},
      {{"motion.initial_velocity", "0.0"}, Kind::kNumber, {}},
      {{"motion.end_time", "4.0"}, Kind::kNumber, not_positive},
      {{"motion.external_force",
        "[ { until = 2.0, value = -200.0 }, { until = 4.0, value = 200.0 } ]"},
       Kind::kTables,
       {"[]", "[ { until = 3.9, value = 1 } ]",
        "[ { until = 4, value = 1 }, { until = 4, value = 2 } ]",
        "[ { until = 4, value = 1 }, { until = 2, value = 2 } ]"}},
      {{"motion.external_force[0].until", "2.0"}, Kind::kNumber, not_positive},
      {{"motion.external_force[0].value", "-200.0"}, Kind::kNumber, {}},
      {{"reference.time_step", "1e-3"}, Kind::kNumber, not_positive, false},
      {{"inertial.relative_tolerance", "1e-9"},
       Kind::kNumber,
       {"0", "-1e-9", "1e-14", "0.1"},
       false},
      {{"viscous_contact.time_step", "1e-3"}, Kind::kNumber, not_positive, false},
      {{"viscous_contact.roughness", "[0.0, 0.0]"},
       Kind::kNumbers,
       {"[-1e-3, 0]", "[0, -1e-3]", "[]", "[0.1]", "[0, 0, 0]", "[0.5, 0.5]", "[2, 0]"},
       false},
      {{"viscous_contact.threshold_gap", "0.1"}, Kind::kNumber, not_positive, false},
      {{"published.minimal_gap", "3e-3"}, Kind::kNumber, not_positive},
      {{"published.source", "\"Lefebvre 2008\""}, Kind::kText, {}},
  };
}

/// Values that are not of the kind, with what is never finite among them.
std::vector<const char*> wrong_types(Kind kind) {
  switch (kind) {
    case Kind::kNumber:
      return {"\"3.0\"", "true", "[3.0]", "{ a = 1 }", "2008-01-23", "nan", "-nan", "inf", "-inf"};
    case Kind::kCount:
      return {"\"40\"", "true", "[40]", "{ a = 1 }", "2.5", "40.0", "nan", "inf"};
    case Kind::kText:
      return {"1", "1.5", "false", "[\"log\"]", "{ a = 1 }", "nan"};
    case Kind::kNumbers:
      return {"1.0",          "\"1.0\"",        "{ a = 1 }",  "[\"1.0\", \"1.0\"]",
              "[true, true]", "[[1.0], [1.0]]", "[nan, 0.1]", "[inf, 0.1]",
              "[0.1, -inf]"};
    case Kind::kTable:
      return {"1.0", "\"bounded\"", "true"};
    case Kind::kTables:
      return {"1.0", "\"-200\"", "{ until = 4.0, value = 1.0 }", "[1.0, 2.0]",
              "[ { until = 4.0, value = 1.0 }, 3 ]"};
  }
  return {};
}

/// For the messages of GoogleTest.
void PrintTo(const KeyRules& rules, std::ostream* stream) { *stream << rules.key.path; }

class CaseKey : public ::testing::TestWithParam<KeyRules> {};

TEST_P(CaseKey, IsMissedByNameWithTheLineOfItsTable) {
  const auto& rules = GetParam();
  const auto edited = without_key(rules.key);
  if (rules.required) {
    expect_refused(edited, rules.key.path);
  } else {
    EXPECT_NO_THROW(read_text(edited.text));
  }
}

TEST_P(CaseKey, IsRefusedWithAnotherTypeOrWithoutAFiniteValue) {
  const auto& rules = GetParam();
  for (const auto* value : wrong_types(rules.kind)) {
    SCOPED_TRACE(value);
    expect_refused(with_value(rules.key, value), rules.key.path);
  }
}

TEST_P(CaseKey, IsRefusedOutOfItsRange) {
  const auto& rules = GetParam();
  for (const auto* value : rules.out_of_range) {
    SCOPED_TRACE(value);
    expect_refused(with_value(rules.key, value), rules.key.path);
  }
}

std::string key_name(const ::testing::TestParamInfo<KeyRules>& info) {
  std::string name;
  for (const char c : std::string(info.param.key.path))
    name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Of, CaseKey, ::testing::ValuesIn(all_keys()), key_name);

struct Stranger {
  const char* path;    // as the error names it
  const char* before;  // once in the file; the stranger is written after it
  const char* text;
  int lines_below;  // of the stranger, from where `before` begins
};

/// The table that a path leads to, for a test's name.
std::string table_name(const std::string& path) {
  std::string table = path.substr(0, path.rfind('.'));
  for (char& c : table)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return table;
}

void PrintTo(const Stranger& stranger, std::ostream* stream) { *stream << stranger.path; }

class UnknownKey : public ::testing::TestWithParam<Stranger> {};

TEST_P(UnknownKey, IsRefusedByNameWithItsLine) {
  const auto& stranger = GetParam();
  auto edited = with_text(stranger.before, std::string(stranger.before) + stranger.text);
  edited.line += stranger.lines_below;
  expect_refused(edited, stranger.path);
}

INSTANTIATE_TEST_SUITE_P(
    In, UnknownKey,
    ::testing::Values(
        Stranger{"colour", "pulled back after\"\n", "colour = 1\n", 1},
        Stranger{"particles", "[published]\n", "minimal_gap = 1\nsource = \"\"\n[particles]\n", 3},
        Stranger{"fluid.colour", "[fluid]\n", "colour = 1\n", 1},
        Stranger{"sphere.colour", "[sphere]\n", "colour = 1\n", 1},
        Stranger{"tabulation.colour", "[tabulation]\n", "colour = 1\n", 1},
        Stranger{"tabulation.gaps.colour", "gaps = { ", "colour = 1, ", 0},
        Stranger{"tabulation.container.colour", "container = { ", "colour = 1, ", 0},
        Stranger{"tabulation.geometry.velocity_ratio", "geometry = { ", "velocity_ratio = 1, ", 0},
        Stranger{"fit.colour", "[fit]\n", "colour = 1\n", 1},
        Stranger{"motion.colour", "[motion]\n", "colour = 1\n", 1},
        Stranger{"motion.external_force[0].from", "external_force = [ { ", "from = 0, ", 0},
        Stranger{"motion.external_force[1].from", "}, { ", "from = 2, ", 0},
        Stranger{"reference.colour", "[reference]\n", "colour = 1\n", 1},
        Stranger{"inertial.colour", "[inertial]\n", "colour = 1\n", 1},
        Stranger{"viscous_contact.colour", "[viscous_contact]\n", "colour = 1\n", 1},
        Stranger{"published.colour", "[published]\n", "colour = 1\n", 1}),
    [](const auto& parameter) { return "Table_" + table_name(parameter.param.path); });

TEST(CaseSections, AreMissedByName) {
  for (const std::string name : {"fluid", "sphere"}) {
    // Under another name its keys are nobody's; what is missed comes first.
    const TemporaryFolder folder;
    const auto file = folder.file("case.toml", with_text("[" + name + "]", "[other]").text);
    EXPECT_THAT(bad_input([&] { read_case(file); }), IsAt(file.string(), name));
  }
}

TEST(CaseCounts, SayThatADecimalPointIsNotAllowed) {
  const LectureKey count = {"tabulation.gaps.count", "40"};
  expect_refused(with_value(count, "40.0"), count.path, "40.0");
  expect_refused(with_value(count, "2.5"), count.path);
}

}  // namespace
}  // namespace viscontact::case_file
