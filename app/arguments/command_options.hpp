// Options that several commands have, and checks of the values of options.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/pipeline/slurm/array_job.hpp"
#include "viscontact/results/foreign_files.hpp"
#include "viscontact/results/picture_kind.hpp"

namespace viscontact::app {

// The type name of an option says what its value is. --help and the manual page show it, and
// self_description.cpp offers files, folders or models for it. An option whose value is one of
// several words has the type name "word|word".
inline constexpr const char* kFile = "FILE";
inline constexpr const char* kFolder = "DIR";
inline constexpr const char* kModel = "MODEL";
inline constexpr const char* kModels = "MODEL,...";

/// Adds an option whose value has the type name `type` and is stored in `value`, which must outlive
/// `command`. `name` is written as CLI11 demands: "-o,--output" is an option, and a word without
/// dashes, such as "CASE", is an argument. `help` is its text in --help. This and the other
/// functions that add an option throw CLI::OptionAlreadyAdded if the command has it.
template <class Value>
CLI::Option* add_value(CLI::App& command, const std::string& name, Value& value,
                       const std::string& type, const std::string& help) {
  return command.add_option(name, value, help)->type_name(type);
}

/// A check that accepts only these words. It has no description, because --help shows the words in
/// the type name. For another value CLI11 throws CLI::ValidationError.
CLI::Validator one_of(std::vector<std::string> words);

/// A check that accepts only a whole number from `least` to `most`, written in digits without a
/// sign. For another value CLI11 throws CLI::ValidationError.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t most);

/// Calls `read`, which turns the value of the option `option` into an object, and returns what it
/// returns. An Error(kBadInput) becomes an Error(kWrongUsage) that names the option.
template <class Read>
auto from_option(std::string_view option, const Read& read) {
  try {
    return read();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kBadInput) throw;
    throw Error(ErrorKind::kWrongUsage, std::string(option) + ": " + error.what(), error.at());
  }
}

/// Throws Error(kWrongUsage), which names the option, if one of `names` is not the name of a model
/// of motion.
void check_models(std::string_view option, const std::vector<std::string>& names);

/// Throws Error(kWrongUsage) if an output has an empty name or two outputs are the same file, and
/// std::filesystem::filesystem_error if a path cannot be resolved.
void check_outputs(const std::vector<std::string>& paths);

/// Throws Error(kWrongUsage) unless the ending of the file that --plot names is .svg, .pdf, .png or
/// .gp (results::kPictureKinds). Throws Error(kBadInput) if `path` is a file that cannot be read,
/// or that is no picture of this kind written by Viscontact. Does nothing if `path` is empty.
void check_picture(const std::string& path);

/// Adds the options --plot, whose help is `help`, --width (100 to 10000) and --font-size (2 to
/// 200), which set `picture`, which must outlive `command`. The unit of both numbers is a pixel of
/// an SVG, a point of a PDF, or two pixels of a PNG. Without --width the picture has its own width;
/// the font size is 14 by default.
void add_picture(CLI::App& command, results::PictureRequest& picture, const std::string& help);

/// Adds the option --plots, which sets `plots` to "pdf". make_plots() then obeys it.
CLI::Option* add_plots(CLI::App& command, std::string& plots);

/// Throws Error(kExternalProgram) if make_plots() cannot do what --plots asks for.
void check_plots(const std::string& plots);

/// Writes the PDF files that --plots asks for, in the folder of a run, which must not be locked by
/// this process. Does nothing if `plots` is empty. Throws the errors of report::write_pdfs(), and
/// Error(kBadInput) if another process uses the folder.
void make_plots(const std::string& plots, const std::string& folder);

/// The default of --jobs: the number of cores, or 1 if this number is unknown.
int default_jobs();

/// Adds the option -j, --jobs, which sets `jobs`, the number of processes or threads at once, to a
/// number from 1 to 1024.
CLI::Option* add_jobs(CLI::App& command, int& jobs, const std::string& help);

CLI::Option* add_json(CLI::App& command, bool& json);

/// Returns the arguments of a command line, from the command's name on, in an order that CLI11
/// reads correctly. An option whose value may be left out (`fit --fix`, `tabulate --plot`,
/// `simulate --lubrication-limit`) would take the word after it as its value even if that is the
/// command's file, as in `fit --fix own.csv`. In this case the option is moved to the end of the
/// arguments or, if they contain the word "--", to just before it.
std::vector<std::string> with_files_apart(std::vector<std::string> arguments);

/// The values of the options of array jobs on a Slurm cluster (docs/cluster.md), which `tabulate`
/// and `sweep` have: --launcher, --tasks, --slurm-options, --gather and --task. Submitted scripts
/// contain them.
struct ArrayOptions {
  std::string launcher = "local",  ///< "local": computes here; "slurm": submits a job
      slurm_options,               ///< words for sbatch, quoted as in a shell; may be empty
      task;                        ///< "K/T": rows K, K+T, ... from 0; 0 <= K < T; empty: all
  std::size_t tasks = 0;           ///< 1 to 4000000; 0: one for each row, at most 1000
  bool gather = false;             ///< writes tables from finished rows, computes none
  /// CLI11's objects of --launcher, --gather and --task, by which a command declares that other
  /// options exclude them; nullptr before add_array_options().
  CLI::Option *launcher_option = nullptr, *gather_option = nullptr, *task_option = nullptr;

  bool is_slurm() const { return launcher == "slurm"; }
};

/// Adds the options of array jobs. They set the members of `o`, which must outlive `command`.
/// `results` is what --help calls the output of the command, such as "the tables".
void add_array_options(CLI::App& command, ArrayOptions& o, const std::string& results);

/// Throws Error(kWrongUsage) if --tasks or --slurm-options is given without --launcher slurm, or if
/// --task is not K/T with 0 <= K < T.
void check_array_options(const ArrayOptions& o);

/// The rows that --task asks for: those whose number, from 0, leaves the remainder K when divided
/// by T. All rows if the option is not given. Throws as check_array_options() does for --task.
pipeline::Share share_of(const ArrayOptions& o);

/// The request for an array job that computes the rows of the table or folder `output`.
/// `jobs_option` is CLI11's object of --jobs. `jobs` is the value of --jobs, the number of rows
/// that a task computes at once, >= 1; if --jobs is not given, the request has no such number.
pipeline::ArrayRequest array_request(const ArrayOptions& o, const std::string& output,
                                     const CLI::Option& jobs_option, int jobs);

/// Calls `call`. If it throws Error(kNotConverged), because rows are missing, or
/// Error(kExternalProgram), because Slurm failed, "; " and `remedy` are appended to the message.
template <class Call>
void with_remedy(std::string_view remedy, const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kNotConverged && error.kind() != ErrorKind::kExternalProgram)
      throw;
    throw Error(error.kind(), std::string(error.what()) + "; " + std::string(remedy), error.at());
  }
}

/// Arguments of with_remedy(), the options that help if a submission or --gather fails.
inline constexpr std::string_view kRemedyOfSlurm =
    "see --slurm-options, --tasks, or leave out --launcher slurm";
inline constexpr std::string_view kRemedyOfGather =
    "the same command without --gather computes the missing rows here, or with --launcher slurm or "
    "--task elsewhere";

}  // namespace viscontact::app
