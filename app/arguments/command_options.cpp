// Options that several commands share, and checks of the files and models that they name.
#include "viscontact/app/arguments/command_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>
#include <thread>

#include "viscontact/app/arguments/interrupt.hpp"
#include "viscontact/common/files/locks.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/lubrication/terms.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/report/pictures/pdf.hpp"
#include "viscontact/results/run_folder.hpp"

namespace viscontact::app {
namespace {

/// The path with symbolic links resolved, also a link whose target does not exist yet, because an
/// output need not exist. Throws std::filesystem::filesystem_error if the system cannot resolve it.
std::filesystem::path resolved_place_of(std::filesystem::path path) {
  namespace fs = std::filesystem;
  constexpr int kMostLinks = 40;  // the limit of Linux; a larger number works, too
  path = fs::absolute(path);
  for (int i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(path)); ++i)
    path = path.parent_path() / fs::read_symlink(path);
  return fs::weakly_canonical(path.parent_path()) / path.filename();
}

}  // namespace

void check_outputs(const std::vector<std::string>& paths) {
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (paths[i].empty())
      throw Error(ErrorKind::kWrongUsage, "the name of an output is empty; give it a name");
    for (std::size_t j = 0; j < i; ++j)
      if (resolved_place_of(paths[i]) == resolved_place_of(paths[j]))
        throw Error(ErrorKind::kWrongUsage,
                    "{} would be written twice; give each output its own name", paths[i]);
  }
}

void check_picture(const std::string& path) {
  if (path.empty()) return;
  const auto* kind = results::picture_kind(path);
  if (kind == nullptr)
    throw Error(ErrorKind::kWrongUsage,
                "--plot: {} does not end in {}, the kinds of pictures that are written", path,
                names_of(results::kPictureKinds, " or "));
  results::refuse_other_kind(path, kind->marker, "picture");
}

void add_picture(CLI::App& command, results::PictureRequest& picture, const std::string& help) {
  // The limits of width and font size only catch mistyped numbers.
  auto* plot = add_value(command, "--plot", picture.path, kFile, help);
  add_value(command, "--width", picture.width, "N",
            "width of the picture: pixels of an SVG, points of a PDF; default: its own")
      ->check(CLI::Range(100, 10000))
      ->needs(plot);
  command.add_option("--font-size", picture.font_size, "of the picture, in the unit of its width")
      ->check(CLI::Range(2.0, 200.0))
      // CLI::Range accepts "nan", because each comparison with it is false.
      ->check([](const std::string& text) {
        return std::isfinite(std::strtod(text.c_str(), nullptr)) ? "" : text + " is not a number";
      })
      ->capture_default_str()
      ->needs(plot);
}

void check_models(std::string_view option, const std::vector<std::string>& names) {
  for (const auto& name : names)
    from_option(option, [&] { return reduced_model::find_model(name); });
}

int default_jobs() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

CLI::Validator one_of(std::vector<std::string> words) {
  return CLI::IsMember(std::move(words)).description("");
}

CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
  assert(least <= most);
  const auto check = [least, most](const std::string& text) {
    std::uint64_t value = 0;
    const char* const end = text.data() + text.size();
    const auto number = std::from_chars(text.data(), end, value);
    const bool is_right =
        number.ec == std::errc() && number.ptr == end && value >= least && value <= most;
    return is_right ? ""
                    : fmt::format("is {}; it must be a whole number from {} to {}, in digits", text,
                                  least, most);
  };
  return {check, ""};
}

CLI::Option* add_plots(CLI::App& command, std::string& plots) {
  return add_value(command, "--plots", plots, "pdf",
                   "also write each still picture as a PDF file, beside its SVG")
      ->check(one_of({"pdf"}));
}

void check_plots(const std::string& plots) {
  if (!plots.empty()) report::require_pdf_converter();
}

void make_plots(const std::string& plots, const std::string& folder) {
  if (plots.empty()) return;
  const LockedFolder lock(folder, results::kFolderIsLocked);
  report::write_pdfs(folder, interrupt_token());
}

CLI::Option* add_json(CLI::App& command, bool& json) {
  return command.add_flag("--json", json, "print the table as JSON");
}

CLI::Option* add_jobs(CLI::App& command, int& jobs, const std::string& help) {
  // The default is given in words and not as a number of cores, because the manual is made on one
  // machine and read on another.
  return command.add_option("-j,--jobs", jobs, help)
      ->check(CLI::Range(1, 1024))  // few machines have more cores
      ->default_str("one for each core");
}

std::vector<std::string> with_files_apart(std::vector<std::string> arguments) {
  struct Option {
    std::string_view command, name;
    bool (*is_value)(std::string_view word);  // true: a value, even if `word` also names a file
  };
  constexpr auto is_number = [](std::string_view word) {
    return parse_number(word.substr(0, word.find(','))).has_value();
  };
  constexpr auto is_term = [](std::string_view word) {
    return word.starts_with(lubrication::kLeadingTerm);
    // Every option for which a command calls CLI11's expected(0, 1).
  };
  constexpr auto is_limit = [](std::string_view word) {
    return word == "fitted" || word == "theory";
  };
  const auto options = std::to_array<Option>({{"fit", "--fix", is_term},
                                              {"tabulate", "--plot", is_number},
                                              {"simulate", "--lubrication-limit", is_limit}});
  const auto is_file = [](const std::string& word) {
    std::error_code ignored;  // exists() fails for words that cannot be names of files
    return word.ends_with(".csv") || word.ends_with(".toml") ||
           std::filesystem::exists(word, ignored);
  };
  for (const auto& option : options) {
    if (arguments.empty() || arguments[0] != option.command) continue;
    // Words behind "--" are files, even if one has the name of an option.
    const auto end = std::ranges::find(arguments, "--");
    const auto at = std::find(arguments.begin(), end, option.name);
    if (at == end || at + 1 == end) continue;
    if (option.is_value(at[1]) || !is_file(at[1])) continue;
    // At its new place the option is the last word or stands before "--", so that no word follows
    // that CLI11 could take as its value.
    std::rotate(at, at + 1, end);
  }
  return arguments;
}

void add_array_options(CLI::App& command, ArrayOptions& o, const std::string& results) {
  o.launcher_option = add_value(command, "--launcher", o.launcher, "local|slurm",
                                "local: compute here; slurm: submit an array job")
                          ->check(one_of({"local", "slurm"}))
                          ->capture_default_str();
  command
      .add_option("--tasks", o.tasks,
                  "tasks of the array job; default: one for each row, at most 1000")
      ->check(CLI::Range(1, 4000000));  // about the largest MaxArraySize of Slurm
  add_value(command, "--slurm-options", o.slurm_options, "OPTIONS",
            "more options for sbatch, in one argument");
  o.gather_option = command.add_flag(
      "--gather", o.gather,
      fmt::format("write {} from the rows of an array job, and compute no row", results));
  o.task_option = command.add_option("--task", o.task,
                                     "K/T: compute only the rows K, K+T, ..., and write no table "
                                     "(as each task of the array job does)");
  o.gather_option->excludes(o.launcher_option);
  o.task_option->excludes(o.launcher_option)->excludes(o.gather_option);
}

void check_array_options(const ArrayOptions& o) {
  if (!o.is_slurm() && (o.tasks > 0 || !o.slurm_options.empty()))
    throw Error(ErrorKind::kWrongUsage, "--tasks and --slurm-options need --launcher slurm");
  (void)share_of(o);
}

pipeline::Share share_of(const ArrayOptions& o) {
  pipeline::Share share;
  if (o.task.empty()) return share;
  const char* const end = o.task.data() + o.task.size();
  const auto number = std::from_chars(o.task.data(), end, share.number);
  if (number.ec == std::errc() && number.ptr != end && *number.ptr == '/') {
    const auto count = std::from_chars(number.ptr + 1, end, share.count);
    if (count.ec == std::errc() && count.ptr == end && share.number < share.count) return share;
  }
  throw Error(ErrorKind::kWrongUsage, "--task is '{}'; it must be K/T with 0 <= K < T", o.task);
}

pipeline::ArrayRequest array_request(const ArrayOptions& o, const std::string& output,
                                     const CLI::Option& jobs_option, int jobs) {
  assert(jobs >= 1);
  return {output, o.tasks > 0 ? std::optional(o.tasks) : std::nullopt,
          jobs_option.count() > 0 ? std::optional(jobs) : std::nullopt, o.slurm_options,
          interrupt_token()};
}

}  // namespace viscontact::app
