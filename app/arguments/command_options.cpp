// Options that several commands of app/ share, and checks of the files and models that a command
// line names; main.cpp, commands/ and help/ use them. Widths are 100 to 10000 and font sizes 2 to
// 200, both in pixels of an SVG or points of a PDF; --jobs is 1 to 1024, --tasks 1 to 4000000. A
// wrong option is an Error(kWrongUsage) or, if CLI11 checks it, a CLI::ParseError; a file that
// --plot must not replace is an Error(kBadInput), and a path that cannot be resolved is a
// std::filesystem::filesystem_error. The list `options` in with_files_apart() must contain every
// option for which a command calls CLI11's expected(0, 1), which allows an option without its
// value. The names of the options of array jobs (jobs of many tasks on a Slurm cluster) must stay,
// because submitted scripts contain them.
#include "viscontact/app/arguments/command_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

/// The path of the file that `path` names, with symbolic links resolved. A link whose target does
/// not exist yet is resolved, too, because an output need not exist yet. Throws
/// std::filesystem::filesystem_error if the system cannot resolve it.
std::filesystem::path resolved_place_of(std::filesystem::path path) {
  namespace fs = std::filesystem;
  constexpr int kMostLinks = 40;  // the limit of Linux; a larger number works, too
  path = fs::absolute(path);
  for (int i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(path)); ++i)
    path = path.parent_path() / fs::read_symlink(path);
  return fs::weakly_canonical(path.parent_path()) / path.filename();
}

}  // namespace

/// Checks the paths of all outputs of a command; there may be none. Throws Error(kWrongUsage) if a
/// path is empty or two of them name the same file.
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

/// Checks the path that --plot gives; an empty path is accepted. Throws Error(kWrongUsage) for an
/// unknown ending (the known ones are .svg, .pdf, .png and .gp), and Error(kBadInput) if the file
/// exists, but is no picture of this kind that Viscontact wrote.
void check_picture(const std::string& path) {
  if (path.empty()) return;
  const auto* kind = results::picture_kind(path);
  if (kind == nullptr)
    throw Error(ErrorKind::kWrongUsage,
                "--plot: {} does not end in {}, the kinds of pictures that are written", path,
                names_of(results::kPictureKinds, " or "));
  results::refuse_other_kind(path, kind->marker, "picture");
}

/// Adds the options --plot, --width and --font-size to `command`. CLI11 stores their values in
/// `picture`, which must outlive `command`. `help` is the text of --plot in --help.
void add_picture(CLI::App& command, results::PictureRequest& picture, const std::string& help) {
  // The limits of width and font size only catch mistyped numbers; other limits would do as well.
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

/// Throws Error(kWrongUsage), which names `option`, if one of `names` is not the name of a model of
/// motion. The list may be empty.
void check_models(std::string_view option, const std::vector<std::string>& names) {
  for (const auto& name : names)
    from_option(option, [&] { return reduced_model::find_model(name); });
}

int default_jobs() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

CLI::Validator one_of(std::vector<std::string> words) {
  return CLI::IsMember(std::move(words)).description("");
}

/// A check that accepts a whole number from `least` to `most`, both included, written in digits
/// without a sign. For any other text CLI11 throws CLI::ValidationError.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
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

/// Adds the option --jobs, which sets `jobs`, the number of processes or threads that run at once.
/// `help` is its text in --help.
CLI::Option* add_jobs(CLI::App& command, int& jobs, const std::string& help) {
  // The default is given in words and not as a number of cores, because the manual is made on one
  // machine and read on another.
  return command.add_option("-j,--jobs", jobs, help)
      ->check(CLI::Range(1, 1024))  // a free limit; few machines have more cores
      ->default_str("one for each core");
}

/// The arguments of a command line, from the name of the command on, in an order that CLI11 reads
/// correctly: an option without its value before a file, as in `fit --fix own.csv`, is moved to the
/// end or to just before "--". Throws nothing.
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

/// Adds the options of array jobs. CLI11 stores their values in `o`, which must outlive `command`.
/// `results` is what --help calls the output, such as "the table".
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

/// Throws Error(kWrongUsage) if --tasks or --slurm-options is given without --launcher slurm, or if
/// --task is not K/T with 0 <= K < T.
void check_array_options(const ArrayOptions& o) {
  if (!o.is_slurm() && (o.tasks > 0 || !o.slurm_options.empty()))
    throw Error(ErrorKind::kWrongUsage, "--tasks and --slurm-options need --launcher slurm");
  (void)share_of(o);
}

/// The rows that --task K/T asks for: the rows K, K+T, K+2T, ..., counted from 0. Without this
/// option these are all rows. Throws Error(kWrongUsage) unless the option has this form with whole
/// numbers 0 <= K < T.
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

/// The request for an array job that computes the rows of the table or folder `output`. It has a
/// number of tasks only if --tasks is given, and a number `jobs` of rows at once only if --jobs is
/// given, whose CLI11 object is `jobs_option`. Nothing is checked or thrown.
pipeline::ArrayRequest array_request(const ArrayOptions& o, const std::string& output,
                                     const CLI::Option& jobs_option, int jobs) {
  return {output, o.tasks > 0 ? std::optional(o.tasks) : std::nullopt,
          jobs_option.count() > 0 ? std::optional(jobs) : std::nullopt, o.slurm_options,
          interrupt_token()};
}

}  // namespace viscontact::app
