// Checks and writes the copies of a run's inputs, and makes the comments that identify them.
#include "viscontact/pipeline/simulate/run_inputs.hpp"

#include <algorithm>
#include <filesystem>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/reduced_model/trajectory.hpp"
#include "viscontact/results/foreign_files.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::pipeline {
namespace {

namespace fs = std::filesystem;

/// Throws Error(kBadInput) if `copy` exists in a folder without a run and differs from `text` in
/// more than the record of how it was made.
void check_copy(const results::RunFolder& run, const fs::path& copy, const std::string& text,
                std::string_view kind) {
  if (!fs::is_regular_file(copy) || holds_a_run(run)) return;
  if (results::without_provenance(read_file(copy)) != results::without_provenance(text))
    throw_bad_input({copy.string()},
                    "is another {}, so it is not replaced; remove it first, or write elsewhere",
                    kind);
}

}  // namespace

bool holds_a_run(const results::RunFolder& run) {
  if (!fs::is_directory(run.trajectories())) return false;
  bool is_empty = true;
  for (const auto& entry : fs::directory_iterator(run.trajectories())) {
    is_empty = false;
    if (entry.is_regular_file() && results::is_written_by_viscontact(entry.path())) return true;
  }
  return is_empty;
}

void check_case_copies(const results::RunFolder& run, const case_file::Case& c) {
  check_copy(run, run.case_file(), c.text, "case");
  for (const auto& file : c.force_files)
    check_copy(run, run.beside_case(file), read_file(file), "force");
}

void check_fit_copy(const results::RunFolder& run, const std::string& fit_text) {
  check_copy(run, run.fit(), fit_text, "fit");
}

void write_copies(const results::RunFolder& run, const case_file::Case& c,
                  const std::string& fit_text) {
  // The folder comes first: if the run is interrupted below, holds_a_run() is true, so that the
  // next run may replace the copies.
  make_folder(run.trajectories());
  write_file(run.case_file(), c.text);
  for (const auto& file : c.force_files) write_file(run.beside_case(file), read_file(file));
  write_file(run.fit(), fit_text);
}

namespace {

// Another key or value of a comment makes `run` simulate all cases again.
constexpr const char* kBelowKey = "drag below the fit";
constexpr const char* kAboveKey = "drag above the fit";

}  // namespace

CsvComments identity_of_trajectory(const case_file::Case& c, const std::string& fit_text,
                                   const lubrication::OutsideInterval& outside) {
  CsvComments comments = {
      {"case", sha256(c.text)},
      {"fit", results::content_sha256(fit_text)},
      {"revision of the models", std::to_string(reduced_model::kModelsRevision)},
      {"version of Viscontact", VISCONTACT_VERSION}};
  std::string forces;
  for (const auto& file : c.force_files) forces += read_file(file);
  if (!c.force_files.empty()) comments["force"] = sha256(forces);
  if (outside.below != lubrication::BelowInterval::kError)
    comments[kBelowKey] = outside.below == lubrication::BelowInterval::kTheoryLimit
                              ? "theory's limit"
                              : "lubrication limit";
  if (outside.above != lubrication::AboveInterval::kError) comments[kAboveKey] = "Stokes' limit";
  return comments;
}

bool is_simulated(const results::RunFolder& run, const std::string& model,
                  const CsvComments& identity) {
  const auto file = run.trajectory(model);
  if (!std::filesystem::is_regular_file(file)) return false;
  try {
    const auto made_from = reduced_model::read_trajectory(file).provenance;
    const auto value = [](const CsvComments& of, const std::string& key) {
      const auto found = of.find(key);
      return found == of.end() ? std::string() : found->second;
    };
    const auto same = [&](const std::string& key) {
      return value(made_from, key) == value(identity, key);
    };
    // If `identity` lacks the two keys of the drag outside the fit's interval, it allows no such
    // gaps; then the trajectory must lack the keys, too.
    return same(kBelowKey) && same(kAboveKey) &&
           std::ranges::all_of(identity, [&](const auto& line) { return same(line.first); });
  } catch (const Error&) {
    return false;
  }
}

}  // namespace viscontact::pipeline
