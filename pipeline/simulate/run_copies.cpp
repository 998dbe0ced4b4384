// Checks and writes the copies of a run's inputs in its folder. A file of the user in the way is an
// Error(kBadInput). A change must keep the order of writing (write_copies), by which files of the
// user are told from copies.
#include "viscontact/pipeline/simulate/run_copies.hpp"

#include <fmt/format.h>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/results/foreign_files.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::pipeline {
namespace {

namespace fs = std::filesystem;

/// Throws Error(kBadInput) if `copy` exists in a folder without a run and differs from `text` in
/// more than its provenance. `kind` names the kind of file in the message.
void check_copy(const results::RunFolder& run, const fs::path& copy, const std::string& text,
                std::string_view kind) {
  if (!fs::is_regular_file(copy) || holds_a_run(run)) return;
  if (results::without_provenance(read_file(copy)) != results::without_provenance(text))
    throw_bad_input(
        {copy.string()},
        fmt::format("is another {}, so it is not replaced; remove it first, or write elsewhere",
                    kind));
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
  make_folder(run.trajectories());
  write_file(run.case_file(), c.text);
  for (const auto& file : c.force_files) write_file(run.beside_case(file), read_file(file));
  write_file(run.fit(), fit_text);
}

}  // namespace viscontact::pipeline
