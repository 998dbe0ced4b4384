// `tabulate`: computes all rows here or those of one task, submits a job to Slurm, or gathers the
// rows of such a job.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/app/arguments/interrupt.hpp"
#include "viscontact/app/commands/commands.hpp"
#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/pipeline/dry_run.hpp"
#include "viscontact/pipeline/tabulate/picture_stage.hpp"
#include "viscontact/pipeline/tabulate/tabulate_stage.hpp"
#include "viscontact/rolling/case/rolling_case.hpp"
#include "viscontact/swimmer/job/swimmer_stage.hpp"

namespace viscontact::app {

namespace {

struct TabulateOptions {
  std::vector<std::string> case_files,  ///< at least one
      motions;                          ///< names of motions; empty: as the cases say
  std::string output,                   ///< path of the table or folder
      plot;                             ///< gaps [L] separated by commas; may be empty
  ArrayOptions array;                   ///< of a job on a cluster
  int jobs = default_jobs();            ///< number of rows at once, >= 1
  bool dry_run = false,                 ///< says how long the rows take, computes none
      json = false;                     ///< --dry-run prints JSON
  /// CLI11's objects, whose count() is 0 if the option was not given.
  const CLI::Option *jobs_option = nullptr, *plot_option = nullptr;
};

/// Gaps [L] separated by commas; gaps_to_picture() checks later that they are gaps of the case.
std::vector<double> read_gaps(const std::string& text) {
  std::vector<double> gaps;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const auto gap = parse_number(word);
    if (!gap)
      throw Error(ErrorKind::kWrongUsage,
                  "--plot: '{}' is not a number; give gaps of the case, separated by commas", word);
    gaps.push_back(*gap);
  }
  return gaps;
}

/// "--motion" and "NAMES" for the command line of the tasks of a job; nothing without --motion.
std::vector<std::string> motion_words(const TabulateOptions& o) {
  if (o.motions.empty()) return {};
  return {"--motion", fmt::format("{}", fmt::join(o.motions, ","))};
}

/// Reads the cases. For one case of one motion, `output` is the file of the table; for one case of
/// several motions it is a folder with a table MOTION.csv for each. For several cases it is a
/// folder with CASE.csv or CASE/MOTION.csv, where CASE is the name of the case file without its
/// ending. The names in `motions`, if any, replace the key `motion` of the cases. Throws
/// Error(kWrongUsage) if two tables would have the same name, and Error(kBadInput) if a case has
/// neither [tabulation] nor [swimmer].
std::vector<pipeline::CaseTable> read_case_tables(const std::vector<std::string>& case_files,
                                                  const std::filesystem::path& output,
                                                  const std::vector<std::string>& motions) {
  const auto name_of = [&](const std::string& file) {
    return case_files.size() == 1 ? output : output / std::filesystem::path(file).stem();
  };
  const auto csv_of = [&](const std::string& file) {
    return case_files.size() == 1 ? output : std::filesystem::path(name_of(file).string() + ".csv");
  };
  std::map<std::filesystem::path, std::string> case_of;
  for (const auto& file : case_files)
    if (const auto [other, is_new] = case_of.insert({name_of(file), file}); !is_new)
      throw Error(ErrorKind::kWrongUsage,
                  "{} and {} would both be tabulated to {}; rename one of them", other->second,
                  file, csv_of(file).string());
  std::vector<pipeline::CaseTable> tables;
  for (const auto& file : case_files) {
    const auto name = name_of(file), csv = csv_of(file);
    const auto kind = case_file::kind_of_case(file);
    if (kind == case_file::CaseKind::kSwimmer) {
      if (!motions.empty())
        throw Error(ErrorKind::kWrongUsage,
                    "--motion: {} is a case of a swimmer, whose spheres move along the axis", file);
      tables.push_back(swimmer::case_table(swimmer::read_swimmer_case(file), csv));
      continue;
    }
    auto tabulation =
        kind == case_file::CaseKind::kRolling
            ? rolling::read_rolling_case(file).tabulation
            : std::optional(case_file::required_tabulation(case_file::read_case(file)));
    if (!tabulation)
      throw_bad_input({file, 0, "tabulation"}, "the section [tabulation] is missing");
    if (!motions.empty())
      tabulation->motions = with_place(
          "--motion", [&] { return freefem_axi::parse_motions(motions, tabulation->geometry); });
    const bool several = tabulation->motions.size() > 1;
    const auto path_of = [&](lubrication::MotionKind motion) {
      return several ? name / (std::string(to_string(motion)) + ".csv") : csv;
    };
    std::ranges::move(pipeline::case_tables(file, read_file(file), *tabulation, path_of),
                      std::back_inserter(tables));
  }
  return tables;
}

/// The motions whose flows are drawn: those without strain.
auto pictured(const pipeline::CaseTable& one) {
  auto motions = one.motions;
  std::erase_if(motions, [](const auto& motion) { return lubrication::is_strain(motion.first); });
  return motions;
}

/// If only some rows fail, their error is thrown when all other work is done.
void tabulate_cases(const TabulateOptions& o) {
  check_array_options(o.array);
  check_outputs({o.output});
  const auto gaps = read_gaps(o.plot);
  const auto tables = read_case_tables(o.case_files, o.output, o.motions);
  for (const auto& one : tables) {
    results::refuse_other_kind(one.table.string(), "# case: ", "table");
    for (const auto& other : one.plan.companions)
      results::refuse_other_kind(other.path.string(), "# case: ", "table");
  }
  // The gaps of the pictures of each table are checked before any work is done.
  std::vector<std::vector<double>> pictures;
  if (o.plot_option->count() > 0)
    for (const auto& one : tables) {
      if (!one.tabulation)
        throw Error(ErrorKind::kWrongUsage,
                    "--plot: {} has no section [tabulation]; flows are drawn only for one sphere",
                    one.case_path.string());
      pictures.push_back(
          with_place("--plot", [&] { return pipeline::gaps_to_picture(*one.tabulation, gaps); }));
      for (const auto& [motion, table] : pictured(one))
        pipeline::check_pictures(pictures.back(), pipeline::picture_folder(table));
    }
  if (o.dry_run) {
    std::vector<pipeline::DryRun> runs;
    for (const auto& one : tables) runs.push_back(pipeline::dry_run(one));
    fmt::print("{}", pipeline::dry_run_text(runs, o.jobs, o.json));
    return;
  }
  pipeline::RowFailure failure;
  if (o.array.is_slurm())
    with_remedy(kRemedyOfSlurm, [&] {
      pipeline::submit_to_slurm(tables, array_request(o.array, o.output, *o.jobs_option, o.jobs),
                                motion_words(o));
    });
  else if (o.array.gather)
    with_remedy(kRemedyOfGather, [&] {
      failure = pipeline::gather_stage(tables, pipeline::slurm_folder(o.output), interrupt_token());
    });
  else if (!o.array.task.empty())
    pipeline::share_stage(tables, share_of(o.array), o.jobs, interrupt_token());
  else
    failure = pipeline::tabulate_stage(tables, o.jobs, interrupt_token());
  for (std::size_t i = 0; i < pictures.size(); ++i)
    for (const auto& [motion, table] : pictured(tables[i]))
      pipeline::picture_stage(*tables[i].tabulation, motion, pictures[i],
                              pipeline::picture_folder(table), tables[i].case_path,
                              interrupt_token());
  if (failure) throw Error(*failure);
}

}  // namespace

void add_tabulate(CLI::App& app) {
  auto* command = app.add_subcommand(
      "tabulate", "compute forces with FreeFEM on the grid of gaps and velocities of each case");
  auto o = std::make_shared<TabulateOptions>();
  add_value(*command, "CASE", o->case_files, kFile, "case files (TOML)")->required();
  add_value(*command, "-o,--output", o->output, kFile,
            "table to write (CSV); for several motions, a folder in which each gets MOTION.csv; "
            "for several cases, a folder in which each gets CASE.csv or CASE/MOTION.csv")
      ->required();
  add_value(
      *command, "--motion", o->motions, "MOTION,...",
      "approach, slide, roll, spin, axial_strain, shear_strain, twofold_strain, or all: motions "
      "in place of the cases' own")
      ->delimiter(',');
  o->jobs_option = add_jobs(*command, o->jobs,
                            "number of FreeFEM processes at once; default in each Slurm task: 1");
  add_array_options(*command, o->array, "the tables");
  auto* plot =
      add_value(
          *command, "--plot", o->plot, "[GAP,GAP,...]",
          "gaps of the case, comma-separated (none: the smallest, the middle and the largest): "
          "draws mesh and flow of their rows (SVG, VTK) in a folder beside the table")
          ->expected(0, 1);
  auto* dry = command->add_flag("--dry-run", o->dry_run,
                                "print how many rows there are and about how long they take");
  auto* json = add_json(*command, o->json);
  json->needs(dry);
  for (auto* option : {o->array.launcher_option, o->array.gather_option, o->array.task_option})
    dry->excludes(option);
  dry->excludes(plot);
  plot->excludes(o->array.launcher_option);
  o->plot_option = plot;
  o->array.task_option->excludes(plot);
  command->callback([o] { tabulate_cases(*o); });
}

}  // namespace viscontact::app
