#include "app/run_copies.hpp"

#include <fmt/format.h>

#include "common/csv.hpp"
#include "common/file.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

/// True if a trajectory in the folder says that it was made from the text of that hash.
bool was_used(const RunFolder& run, const std::string& key, const std::string& hash) {
  if (!fs::is_directory(run.trajectories())) return false;
  for (const auto& entry : fs::directory_iterator(run.trajectories())) {
    if (entry.path().extension() != ".csv" || !entry.is_regular_file()) continue;
    const auto comments = read_csv_comments(read_file(entry.path()));
    if (const auto found = comments.find(key); found != comments.end() && found->second == hash)
      return true;
  }
  return false;
}

[[noreturn]] void refuse(const fs::path& path, std::string_view kind) {
  throw_bad_input({path.string()},
                  fmt::format("is there and is another {}, of which nothing in this folder was "
                              "made; remove it first, or write elsewhere",
                              kind));
}

}  // namespace

std::string text_of_forces(const Case& c) {
  std::string text;
  for (const auto& file : c.force_files) text += read_file(file);
  return text;
}

void check_case_copies(const RunFolder& run, const Case& c) {
  if (const auto copy = run.case_file(); fs::is_regular_file(copy))
    if (const auto text = read_file(copy); text != c.text && !was_used(run, "case", sha256(text)))
      refuse(copy, "case");
  std::string there;
  const fs::path* other = nullptr;
  for (const auto& file : c.force_files) {
    const auto copy = run.beside_case(file);
    if (!fs::is_regular_file(copy)) continue;
    const auto text = read_file(copy);
    there += text;
    if (text != read_file(file)) other = &file;
  }
  if (other != nullptr && !was_used(run, "force", sha256(there)))
    refuse(run.beside_case(*other), "force");
}

void check_fit_copy(const RunFolder& run, const std::string& fit_text) {
  if (!fs::is_regular_file(run.fit())) return;
  if (const auto text = read_file(run.fit());
      text != fit_text && !was_used(run, "fit", sha256(text)))
    refuse(run.fit(), "fit");
}

void write_copies(const RunFolder& run, const Case& c, const std::string& fit_text) {
  write_file(run.case_file(), c.text);
  for (const auto& file : c.force_files) write_file(run.beside_case(file), read_file(file));
  write_file(run.fit(), fit_text);
}

}  // namespace viscontact
