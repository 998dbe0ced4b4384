#include "tests/robustness/whole_outputs.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>
#include <vector>

#include "tests/program/sample_files.hpp"
#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/motion_table.hpp"
#include "viscontact/particle_runs/io/restart.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

bool is_unfinished(const fs::path& file) { return file.extension() == ".tmp"; }

/// Of a tabulation and of a sweep: appended to row by row.
bool is_journal(const fs::path& file) {
  return file.extension() == ".rows" || file.extension() == ".part";
}

bool is_trajectory(const fs::path& file) { return file.parent_path().filename() == "trajectories"; }

bool is_particles_csv(const fs::path& file) {
  const std::string name = file.filename();
  return name == "final_particles.csv" || name == "final_contacts.csv" || name == "steps.csv";
}

/// Throws if the file is not whole.
void read_whole(const fs::path& file) {
  const std::string name = file.filename();
  if (name == "table.csv")
    (void)lubrication::read_force_table(file);
  else if (name == "sweep.csv")
    (void)read_csv<1>(file, {"fluid.viscosity"}, 1);
  else if (is_trajectory(file))
    (void)reduced_model::read_trajectory(file);
  else if (name == "fit.json")
    (void)lubrication::read_fit(file);
  else if (name == "comparison.json")
    (void)reduced_model::read_comparison(file);
  else if (name == "restart.bin")
    (void)particles::read_restart(file);
  else if (is_particles_csv(file))
    EXPECT_THAT(read_file(file), ::testing::EndsWith("\n")) << file;
  else if (file.extension() == ".vtp" || file.extension() == ".pvd")
    EXPECT_THAT(read_file(file), ::testing::EndsWith("</VTKFile>\n")) << file;
  else if (file.extension() == ".json")
    EXPECT_TRUE(nlohmann::json::accept(read_file(file))) << file;
  else if (file.extension() == ".svg")
    EXPECT_THAT(read_file(file), ::testing::HasSubstr("</svg>")) << file;
  else if (file.extension() == ".html")
    EXPECT_THAT(read_file(file), ::testing::HasSubstr("</html>")) << file;
  else if (file.extension() == ".toml")
    (void)case_file::read_case(file);
  else
    ADD_FAILURE() << "who wrote " << file << "?";
}

std::string lines_without(const fs::path& file, std::string_view start) {
  std::istringstream lines(read_file(file));
  std::string kept;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with(start)) kept += line + "\n";
  return kept;
}

std::string numbers_of(const fs::path& file) {
  const std::string name = file.filename();
  if (name == "table.csv") {
    auto table = lubrication::read_force_table(file);
    for (auto& row : table.rows) row.seconds = 0;
    return lubrication::write_motion_table(table);
  }
  if (is_trajectory(file)) {
    auto trajectory = reduced_model::read_trajectory(file);
    trajectory.seconds = 0;
    trajectory.provenance.clear();
    return reduced_model::write_trajectory(trajectory);
  }
  if (name == "fit.json") {
    auto fit = lubrication::read_fit(file);
    fit.table_sha256.clear();
    return lubrication::write_fit(fit);
  }
  if (name == "comparison.json") {
    auto comparison = reduced_model::read_comparison(file);
    for (auto& model : comparison.models) model.seconds = 0;
    return reduced_model::write_comparison(comparison);
  }
  if (name == "sweep.csv" || is_particles_csv(file)) return lines_without(file, "#");
  if (file.extension() == ".vtp") return lines_without(file, "<!-- provenance: ");
  return "";  // pages and pictures of these numbers
}

}  // namespace

std::string quick_case_text() {
  std::string text =
      replaced(gentle_case_text(), "gaps = { from = 0.05, to = 1.5, count = 6, spacing = \"log\" }",
               "gaps = [0.1, 1.5]");
  text = replaced(text, "relative_accuracy = 1e-3", "relative_accuracy = 1e-2");
  return replaced(text, "basis = \"lecture\"", "terms = \"1/q\"");
}

void expect_whole_files(const fs::path& folder) {
  for (const auto& file : files_of(folder))
    if (!is_unfinished(file) && !is_journal(file)) {
      EXPECT_NO_THROW(read_whole(file)) << file;
    }
}

std::string numbers_below(const fs::path& folder) {
  std::string text;
  for (const auto& file : files_of(folder))
    text += file.lexically_relative(folder).string() + "\n" + numbers_of(file);
  return text;
}

int unfinished_below(const fs::path& folder) {
  return static_cast<int>(std::ranges::count_if(files_of(folder), is_unfinished));
}

}  // namespace viscontact
