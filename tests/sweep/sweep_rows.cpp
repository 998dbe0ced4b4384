#include "tests/sweep/sweep_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/number.hpp"

namespace viscontact::sweep {

std::filesystem::path data(const std::string& name) {
  return std::filesystem::path(VISCONTACT_SOURCE_FOLDER) / "data" / name;
}

std::string study_text(const std::string& name,
                       const std::vector<std::pair<std::string, std::string>>& changes) {
  std::string text = read_file(data("cases/" + name));
  const auto replace = [&](const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    if (at == std::string::npos || text.find(from, at + 1) != std::string::npos)
      throw std::logic_error("not once in " + name + ": " + from);
    text.replace(at, from.size(), to);
  };
  for (const auto& [from, to] : changes) replace(from, to);
  if (text.find("\"../fits/") != std::string::npos)
    replace("\"../fits/", "\"" + data("fits").string() + "/");
  return text;
}

SpherePlan plan_of(const std::filesystem::path& path) {
  return planned_sphere(case_file::read_case(path));
}

SpherePlan shipped(const std::string& name) { return plan_of(data("cases/" + name)); }

SpherePlan varied(SpherePlan plan, const std::vector<std::string>& vary) {
  plan.points.variations.clear();
  plan.points.place.reset();  // as --vary does
  for (const auto& text : vary) plan.points.variations.push_back(parse_variation(text));
  return plan;
}

SpherePlan with_models(SpherePlan plan, std::vector<std::string> models,
                       const std::string& reference) {
  plan.models = std::move(models);
  plan.reference = reference;
  return plan;
}

std::map<std::string, std::string> fields_of(const Study& study, const std::string& row) {
  EXPECT_TRUE(row.ends_with('\n') && std::ranges::count(row, '\n') == 1) << row;
  std::vector<std::string> values(1);
  for (const char c : row.substr(0, row.size() - 1))
    if (c == ',')
      values.emplace_back();
    else
      values.back() += c;
  const auto columns = study.columns();
  EXPECT_EQ(values.size(), columns.size()) << row;
  std::map<std::string, std::string> fields;
  for (std::size_t i = 0; i < std::min(values.size(), columns.size()); ++i)
    fields[columns[i]] = values[i];
  return fields;
}

std::map<std::string, std::string> row_of(const SpherePlan& plan, std::uint64_t index) {
  const auto study = sphere_study(plan, "");
  return fields_of(study, study.row(index));
}

double number(const std::map<std::string, std::string>& fields, const std::string& column) {
  const auto value = parse_number(fields.at(column));
  EXPECT_TRUE(value) << column << " is '" << fields.at(column) << "'";
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

std::vector<std::map<std::string, std::string>> run_whole(const SpherePlan& plan) {
  std::vector<std::map<std::string, std::string>> rows;
  const auto study = sphere_study(plan, "");
  const auto compute = [&](std::uint64_t index, const StopToken&) { return study.row(index); };
  run_rows(study.size(), 0, 2, compute, [&](std::uint64_t, const std::string& row) {
    rows.push_back(fields_of(study, row));
    EXPECT_EQ(rows.back().at("failure"), "");
  });
  EXPECT_EQ(rows.size(), plan.points.rows());
  return rows;
}

std::vector<double> column(const std::vector<std::map<std::string, std::string>>& rows,
                           const std::string& name) {
  std::vector<double> values;
  for (const auto& row : rows) values.push_back(number(row, name));
  return values;
}

}  // namespace viscontact::sweep
