// Sweeps of the shipped studies and their rows, by column.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/sweep/sphere_study.hpp"

namespace viscontact::sweep {

std::filesystem::path data(const std::string& name);

/// The text of a shipped case with changes, each a text that occurs once and its replacement. Its
/// paths are absolute, so that it runs in any folder.
std::string study_text(const std::string& name,
                       const std::vector<std::pair<std::string, std::string>>& changes);

SpherePlan plan_of(const std::filesystem::path& path);

SpherePlan shipped(const std::string& name);

SpherePlan varied(SpherePlan plan, const std::vector<std::string>& vary);

SpherePlan with_models(SpherePlan plan, std::vector<std::string> models,
                       const std::string& reference);

/// The fields of a row by the names of their columns. Fails the test if the row has more or fewer
/// fields than columns.
std::map<std::string, std::string> fields_of(const Study& study, const std::string& row);

std::map<std::string, std::string> row_of(const SpherePlan& plan, std::uint64_t index);

double number(const std::map<std::string, std::string>& fields, const std::string& column);

/// All rows, none of which may have failed.
std::vector<std::map<std::string, std::string>> run_whole(const SpherePlan& plan);

std::vector<double> column(const std::vector<std::map<std::string, std::string>>& rows,
                           const std::string& name);

}  // namespace viscontact::sweep
