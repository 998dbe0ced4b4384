// Collects the provenance of the run's files.
#include "viscontact/report/report_origin.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/shell_words.hpp"
#include "viscontact/report/html.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/results/versions.hpp"

namespace viscontact {
namespace {

/// The command as a user would type it in a shell.
std::string command_line(const std::vector<std::string>& words) {
  std::string line;
  for (const auto& word : words) {
    line += (line.empty() ? "" : " ") + shell_word(word);
  }
  return line;
}

std::optional<Provenance> provenance_or_none(const std::filesystem::path& path) {
  try {
    return read_provenance(path);
  } catch (const Error&) {
    return {};
  }
}

std::string hash_cell(const std::string& sha256) {
  return "<code class=hash>" + escaped(sha256) + "</code>";
}

}  // namespace

std::string origin_section(const RunResults& run) {
  std::string made, inputs;
  auto versions = library_versions();
  versions.insert(run.fit.versions.begin(), run.fit.versions.end());
  if (run.table) versions.insert(run.table->versions.begin(), run.table->versions.end());
  std::vector<std::string> files;
  if (run.table) files.emplace_back("table.csv");
  files.emplace_back("fit.json");
  if (!run.trajectories.empty())
    files.push_back("trajectories/" + run.trajectories.front().model + ".csv");
  files.emplace_back("comparison.json");
  for (const auto& file : files) {
    const auto path = run.folder.path / file;
    if (!std::filesystem::exists(path)) continue;
    const auto provenance = provenance_or_none(path);
    made += table_row(
        link_to(run.folder, file),
        provenance ? escaped(provenance->made) : "not recorded, or damaged",
        provenance ? "<code>" + escaped(command_line(provenance->command)) + "</code>" : "",
        hash_cell(sha256(read_file(path))));
    if (!provenance) continue;
    versions.insert(provenance->versions.begin(), provenance->versions.end());
    for (const auto& input : provenance->inputs)
      inputs += table_row(link_to(run.folder, file), escaped(input.file), hash_cell(input.sha256));
  }
  std::string programs;
  for (const auto& [program, version] : versions)
    programs += fmt::format("{}{}&nbsp;{}", programs.empty() ? "" : ", ", escaped(program),
                            escaped(version));
  std::string text = fmt::format(
      "<div class=scroll><table class=words><thead><tr><th>file</th><th>made (UTC)</th><th>by</th>"
      "<th>SHA-256</th></tr></thead><tbody>\n{}</tbody></table></div>\n",
      made);
  if (!inputs.empty())
    text += fmt::format(
        "<div class=scroll><table class=words><thead><tr><th>file</th><th>made from</th>"
        "<th>SHA-256</th></tr></thead><tbody>\n{}</tbody></table></div>\n",
        inputs);
  return text + fmt::format("<p>Programs and libraries: {}.</p>\n", programs);
}

}  // namespace viscontact
