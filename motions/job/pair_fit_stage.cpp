// Prints what the fit of each resistance is worth, and tells which tables of a folder are missing.
#include "viscontact/motions/job/pair_fit_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <nlohmann/json.hpp>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/common/text/shell_words.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::motions {
namespace {

namespace fs = std::filesystem;
using lubrication::MotionKind;

/// The line that is printed for a resistance: its residuals, and the coefficient of the leading
/// term beside that of theory.
std::string words_of(const NamedEntry& entry, const EntryFit& one) {
  std::string text = fmt::format("  {:<10}  residual {:.1e} at most (relative)", entry.name,
                                 one.fit.largest_relative_residual);
  const auto& d = one.fit.diagnostics;
  if (d && d->left_out_inner)
    text +=
        fmt::format(", {:.1e} of a row that was left out", d->left_out_inner->relative_residual);
  for (const auto& term : one.fit.terms)
    if (one.theory && term.name == entry.leading_term)
      text += fmt::format("; {}: {:.7g}, theory {:.7g}", term.name, term.coefficient, *one.theory);
  return text;
}

fs::path table_of(const fs::path& folder, MotionKind motion) {
  return folder / fmt::format("{}.csv", to_string(motion));
}

/// False if the file was copied: its provenance names another path. True if there is no provenance
/// or no path in it.
bool is_where_made(const fs::path& file) {
  const auto provenance = results::read_provenance(file);
  if (!provenance || provenance->folder.empty()) return true;
  return fs::weakly_canonical(fs::path(provenance->folder) / provenance->output) ==
         fs::weakly_canonical(file);
}

/// Part of a message: why `folder` may lack a table that was asked for together with `file`, and
/// what the user can do. `motions` are the motions that were asked for.
std::string reason_and_remedy(const fs::path& folder, const fs::path& file,
                              const std::string& motions) {
  const auto name = file.filename().string();
  const auto rerun = fmt::format("viscontact rerun {}", shell_word(file.string()));
  if (is_where_made(file))
    return fmt::format(
        "because the tabulation of {} that made {} has not ended, or its table was removed; '{}' "
        "completes it",
        motions, name, rerun);
  return fmt::format(
      "although the tabulation that made {} was one of {}; {} was copied from another folder, from "
      "which the rest can be copied, too, or '{} -o {}' computes it",
      name, motions, name, rerun, shell_word(folder.string()));
}

/// Throws Error(kBadInput) if the head of one of `files` names a motion whose table is not in the
/// folder.
void check_complete(const fs::path& folder, const std::vector<fs::path>& files) {
  for (const auto& file : files) {
    auto comments = read_csv_comments(read_file(file));
    std::vector<std::string> missing;
    for (const auto motion : with_place(file.string() + ": # motions", [&] {
           return lubrication::parse_motions_in_words(comments["motions"]);
         }))
      if (const auto table = table_of(folder, motion); !fs::exists(table))
        missing.push_back(table.filename().string());
    if (!missing.empty())
      throw_bad_input({folder.string()},
                      "lacks {}, {}, and tables that are named one by one are fitted as they are",
                      fmt::join(missing, ", "),
                      reason_and_remedy(folder, file, comments["motions"]));
  }
}

}  // namespace

std::vector<fs::path> pair_table_files(const std::vector<std::string>& paths) {
  std::vector<fs::path> files;
  for (const auto& path : paths) {
    if (!fs::is_directory(path)) {
      files.emplace_back(path);
      continue;
    }
    std::vector<fs::path> tables;
    for (const auto& motion : lubrication::all_motions())
      if (const auto file = table_of(path, motion.kind); fs::exists(file)) tables.push_back(file);
    if (tables.empty())
      throw_bad_input({path}, "has none of the tables approach.csv, slide.csv, ... of a pair");
    check_complete(path, tables);
    files.insert(files.end(), tables.begin(), tables.end());
  }
  return files;
}

bool are_of_pair(const std::vector<std::string>& paths, const std::vector<fs::path>& files) {
  return files.size() > 1 ||
         std::ranges::any_of(paths,
                             [](const std::string& path) { return fs::is_directory(path); }) ||
         (files.size() == 1 && lubrication::is_motion_table(files.front()));
}

PairTables read_pair_tables(const std::vector<fs::path>& files) {
  PairTables tables;
  for (const auto& file : files) {
    auto table = lubrication::read_motion_table(file);
    if (!tables.try_emplace(table.motion, table).second)
      throw_bad_input({file.string()}, "is the second table of its motion; give one of each");
  }
  return tables;
}

void fit_pair_stage(const std::vector<fs::path>& files, const fs::path& fit_path,
                    const PairFitSettings& settings, const StopToken& stop) {
  assert(!files.empty());
  const auto provenance = results::provenance_of({files, {}});
  const std::string place = files.front().string();
  auto fit = with_place(files.size() == 1 ? place : place + " ...",
                        [&] { return fit_pair(read_pair_tables(files), settings, stop); });
  fit.versions = results::library_versions();
  for (const auto& [which, one] : fit.entries)
    for (const auto& warning : one.fit.diagnostics->warnings)
      terminal::warn("fit: warning: {}: {}", pair_entries()[static_cast<std::size_t>(which)].name,
                     warning);
  const std::string text = write_pair_fit(fit);
  if (results::has_content(fit_path, text)) {
    terminal::say("fit: {} is up to date", fit_path.string());
    return;
  }
  results::write_output(fit_path, TextKind::kJson, text, provenance);
  terminal::say("fit: {} entries at gaps from {:.6g} to {:.6g}", fit.entries.size(),
                fit.gap_interval[0], fit.gap_interval[1]);
  for (const auto& [which, one] : fit.entries)
    terminal::say(words_of(pair_entries()[static_cast<std::size_t>(which)], one));
}

void compare_pair_bases_stage(const std::vector<fs::path>& files, PairFitSettings settings,
                              bool json, const StopToken& stop) {
  assert(!files.empty());
  const auto tables = read_pair_tables(files);
  nlohmann::ordered_json all;
  std::string text = fmt::format("{:<20}", "basis");
  std::vector<std::string> lines;
  for (const auto basis : pair_bases()) {
    settings.basis = basis;
    const auto fit = with_place(files.front().string() + " ...",
                                [&] { return fit_pair(tables, settings, stop); });
    auto& line = lines.emplace_back(fmt::format("{:<20}", basis));
    for (const auto& [which, one] : fit.entries) {
      const auto& name = pair_entries()[static_cast<std::size_t>(which)].name;
      if (lines.size() == 1) text += fmt::format("{:>12}", name);
      line += fmt::format("{:>12.1e}", one.fit.largest_relative_residual);
      auto& object = all[std::string(basis)][std::string(name)];
      object["largest_relative_residual"] = one.fit.largest_relative_residual;
      object["condition_number"] = one.fit.condition_number;
      if (one.fit.diagnostics && one.fit.diagnostics->left_out_inner)
        object["left_one_out"] = one.fit.diagnostics->left_out_inner->relative_residual;
    }
  }
  fmt::print("{}", json ? all.dump(2) + "\n"
                        : "largest relative residual\n" + text + "\n" +
                              fmt::format("{}\n", fmt::join(lines, "\n")));
}

}  // namespace viscontact::motions
