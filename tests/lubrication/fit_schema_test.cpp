// That docs/fit.schema.json and the reader mean the same file: every rule of the schema, applied to
// a good file, is one the reader has too.
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/fitting/samples.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::lubrication {
namespace {

using Json = nlohmann::json;
using nlohmann::literals::operator""_json_pointer;

Json schema() {
  return Json::parse(
      read_file(std::filesystem::path(VISCONTACT_SOURCE_FOLDER) / "docs" / "fit.schema.json"));
}

/// A fit that has everything a fit file may hold: a held term, an outlier, a failed row, a warning.
Json good_file() {
  auto table = fitting::exact_drag_table(fitting::fifty_gaps(), {-1}, 3, 1);
  table.geometry = "plane";
  table.leading_coefficient = 50;
  table.rows[20].force *= 2;
  table.failed_rows = {{"gap 0.5, velocity -1", "no solution"}};
  for (auto& row : table.rows) row.relative_error_estimate = 1e-5;
  fitting::FitSettings settings;
  settings.loss = Loss::kHuber;
  Fit fit = fitting::fit_force_table(table, settings);
  fit.versions = {{"Ceres", "2.1.0"}};
  auto json = Json::parse(write_fit(fit));
  json["provenance"] = {{"command", {"viscontact", "fit"}}};  // as the command adds it
  return json;
}

/// A value of each type that the schema does not allow: "number", "string", ... are the keys.
const Json kOneOfEach = {{"number", 1.5},        {"string", "text"}, {"array", Json::array({1})},
                         {"object", {{"x", 1}}}, {"boolean", true},  {"null", nullptr}};

class Schema : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_NO_THROW(read(good_file())); }

  void read(const Json& json) const { read_fit(folder_.file("fit.json", json.dump())); }

  /// Applies each rule of `rules` (a schema of type object) to the object at `pointer` in a good
  /// file.
  void expect_object_rules(const Json& rules, const std::string& pointer) const {
    const Json::json_pointer place(pointer);
    const Json good = good_file();
    ASSERT_EQ(rules.at("additionalProperties"), false);
    expect_refused(changed(good, place, [](Json& object) { object["surplus"] = 1; }), "surplus");
    for (const auto& [key, rule] : rules.at("properties").items()) {
      SCOPED_TRACE(key);
      ASSERT_TRUE(good.at(place).contains(key))
          << "in the schema, but not in what write_fit writes";
      expect_value_rules(rule, key, place);
    }
    for (const auto& [key, value] : good.at(place).items())
      EXPECT_TRUE(rules.at("properties").contains(key))
          << key << " is written, but not in the schema";
    const auto required = rules.at("required").get<std::set<std::string>>();
    for (const auto& [key, rule] : rules.at("properties").items()) {
      const auto without = changed(good, place, [&key = key](Json& object) { object.erase(key); });
      if (required.contains(key))
        expect_refused(without, key);
      else
        EXPECT_NO_THROW(read(without)) << key << " is optional";
    }
    for (const auto& key : required) EXPECT_TRUE(rules.at("properties").contains(key)) << key;
  }

  void expect_refused(const Json& json, const std::string& key) const {
    EXPECT_THAT(bad_input([&] { read(json); }), Names(key)) << json.dump();
  }

 private:
  template <class Change>
  static Json changed(Json json, const Json::json_pointer& place, Change&& change) {
    change(json.at(place));
    return json;
  }

  void expect_value_rules(const Json& rule, const std::string& key,
                          const Json::json_pointer& place) const {
    const Json good = good_file();
    const auto refused = [&](const Json& value) {
      expect_refused(changed(good, place, [&](Json& object) { object[key] = value; }), key);
    };
    const auto read_well = [&](const Json& value) {
      EXPECT_NO_THROW(read(changed(good, place, [&](Json& object) { object[key] = value; })))
          << value;
    };
    for (const auto& [type, value] : kOneOfEach.items())
      if (!is_type(rule.at("type"), type)) refused(value);
    if (rule.at("type") == "object" && rule.contains("properties")) {
      expect_object_rules(rule, (place / key).to_string());
      return;
    }
    for (const auto& [name, argument] : rule.items()) {
      if (name == "minLength") {
        refused("");
      } else if (name == "enum") {
        refused("no such word");
      } else if (name == "minimum") {
        refused(argument.get<double>() - 1e-9);
        if (rule.at("type") == "integer") refused(argument.get<double>() + 0.5);
        read_well(argument);
      } else if (name == "exclusiveMinimum") {
        refused(argument);
        read_well(argument.get<double>() + 1e-9);
      } else if (name == "not") {
        refused(argument.at("const"));
        read_well(-argument.at("const").get<double>() - 1e-9);
      } else if (name == "minItems" || name == "maxItems") {
        Json items = good.at(place).at(key);
        while (name == "minItems" && items.size() >= argument) items.erase(0);
        while (name == "maxItems" && items.size() <= argument) items.push_back(items.back());
        refused(items);
      } else if (name == "items") {
        expect_element_type(argument, key, refused, good.at(place).at(key));
      } else if (name == "additionalProperties") {
        for (const auto& [type, value] : kOneOfEach.items())
          if (!is_type(argument.at("type"), type)) refused({{"Ceres", value}});
      } else {
        EXPECT_TRUE(name == "type" || name == "description")
            << "the test does not know the rule " << name;
      }
    }
  }

  /// True if a value of that type of kOneOfEach is allowed by a rule's `type`: 1.5 is no integer.
  static bool is_type(const Json& rule, const std::string& type) {
    return rule.is_array() ? std::find(rule.begin(), rule.end(), type) != rule.end() : rule == type;
  }

  template <class Refused>
  static void expect_element_type(const Json& rule, const std::string& key, const Refused& refused,
                                  const Json& good) {
    for (const auto& [type, value] : kOneOfEach.items()) {
      if (is_type(rule.at("type"), type)) continue;
      Json elements = good;
      elements[0] = value;
      SCOPED_TRACE(key + "[0] = " + value.dump());
      refused(elements);
    }
    if (rule.contains("items")) {
      Json elements = good;
      elements[0][0] = "text";
      refused(elements);
    }
    if (rule.contains("exclusiveMinimum")) {
      Json elements = good;
      elements[0] = rule.at("exclusiveMinimum");
      refused(elements);
    }
  }

  TemporaryFolder folder_;
};

TEST_F(Schema, RulesOfTheFileAreTheReaders) { expect_object_rules(schema(), ""); }

TEST_F(Schema, RulesOfATermAreTheReaders) {
  expect_object_rules(schema().at("properties").at("terms").at("items"), "/terms/0");
}

TEST_F(Schema, RulesOfAnOutlierAreTheReaders) {
  expect_object_rules(schema().at("/properties/diagnostics/properties/outliers/items"_json_pointer),
                      "/diagnostics/outliers/0");
}

TEST_F(Schema, AllowsNoTermsInTheFileOfTheExactDragAlone) {
  EXPECT_EQ(schema().at("/if/properties/basis/const"_json_pointer), kExactPlane);
  EXPECT_EQ(schema().at("/then/properties/terms/maxItems"_json_pointer), 0);
  EXPECT_EQ(schema().at("/else/properties/terms/minItems"_json_pointer), 1);
  Json exact = Json::parse(write_fit(exact_plane_fit(3, 1)));
  EXPECT_NO_THROW(read(exact));
  Json fitted = good_file();
  exact["terms"] = fitted["terms"];
  expect_refused(exact, "terms");
  fitted["terms"] = Json::array();
  expect_refused(fitted, "terms");
}

TEST_F(Schema, KnowsEveryWeights) {
  const Json words = schema().at("properties").at("weights").at("enum");
  for (const std::string word : words) EXPECT_NO_THROW(parse_weights(word));
}

TEST_F(Schema, KnowsEveryLossAndMisfit) {
  const Json losses = schema().at("/properties/loss/enum"_json_pointer);
  for (const std::string word : losses) EXPECT_NO_THROW(parse_loss(word));
  const Json misfits = schema().at("/properties/diagnostics/properties/misfit/enum"_json_pointer);
  for (const std::string word : misfits) EXPECT_NO_THROW(parse_misfit(word));
}

TEST_F(Schema, IsOfTheDraftItClaims) {
  EXPECT_EQ(schema().at("$schema"), "https://json-schema.org/draft/2020-12/schema");
}

}  // namespace
}  // namespace viscontact::lubrication
