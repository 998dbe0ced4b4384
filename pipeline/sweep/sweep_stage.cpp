// Runs the rows of sweeps, and shares, gathers and submits those of particles (sweep_stage.hpp).
// Runs of particles are kept in their folders until the user deletes them, so that adding draws
// runs the new ones only.
#include "viscontact/pipeline/sweep/sweep_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/shell_words.hpp"
#include "viscontact/pipeline/particles/particle_simulation.hpp"
#include "viscontact/pipeline/particles/particles_earlier_run.hpp"
#include "viscontact/pipeline/sweep/particles_run.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::pipeline {
namespace {

namespace fs = std::filesystem;
using sweep::ParticlesSweep;

/// The runs of a sweep. If there are fewer rows than jobs, each run has several threads; the
/// results do not depend on their number.
ParticlesRuns runs_of(const ParticlesSweep& sweep, const SweepStageRequest& request,
                      std::uint64_t rows) {
  const auto runs_at_once =
      std::clamp<std::uint64_t>(rows, 1, static_cast<std::uint64_t>(request.jobs));
  return {sweep, request.output, VISCONTACT_VERSION, request.jobs / static_cast<int>(runs_at_once),
          request.keep_all};
}

void show_finished_rows(terminal::ProgressTimer& timer, std::uint64_t done, std::uint64_t size) {
  if (timer.is_due()) terminal::show_progress(fmt::format("sweep: {} of {} rows", done, size));
}

results::Inputs inputs_of(const ParticlesSweep& sweep) {
  results::Inputs inputs{{sweep.case_path()}, {}};
  if (!sweep.particles_file().empty()) inputs.given.push_back(sweep.particles_file());
  return inputs;
}

/// The remaining time in words, "about 3 min left", estimated from the rows of this call.
class Remaining {
 public:
  std::string after(std::uint64_t done, std::uint64_t size) {
    if (!first_) first_ = done;
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
    if (done <= *first_) return "";
    const double left =
        spent.count() / static_cast<double>(done - *first_) * static_cast<double>(size - done);
    return left > 90 ? fmt::format(", about {:.0f} min left", left / 60)
                     : fmt::format(", about {:.0f} s left", left);
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<std::uint64_t> first_;
};

/// Says at how many points models or strokes (`part`) failed, "; ... failed at 3 points"; empty if
/// none did.
std::string failures_in_words(const sweep::SweepOutcome& outcome, const std::string& part) {
  const auto points = [](std::uint64_t n) {
    return fmt::format("{} point{}", n, n == 1 ? "" : "s");
  };
  std::string text;
  if (outcome.without_result > 0)
    text += fmt::format("; every {} failed at {}", part, points(outcome.without_result));
  if (outcome.with_some_results > 0)
    text += fmt::format("; some {}s failed at {}", part, points(outcome.with_some_results));
  return text.empty() ? text : text + " (the column 'failure' says why)";
}

/// Computes the missing rows and returns their number.
std::uint64_t write_rows(const sweep::Study& study, const SweepStageRequest& request,
                         const results::Inputs& inputs,
                         const std::function<void(std::uint64_t, std::uint64_t)>& progress) {
  const auto computed =
      sweep::write_sweep(study, request.output, request.jobs,
                         results::output_text(request.output, TextKind::kHashComment, "",
                                              results::provenance_of(inputs)),
                         progress, request.stop);
  terminal::clear_progress();
  return computed;
}

/// Writes the table of means, unless it is there.
void write_means(const ParticlesSweep& sweep, const std::string& output) {
  if (sweep.points().draws == 0) return;
  const auto path = sweep::path_of_means(output);
  const auto table = sweep::table_of_means(sweep, output);
  if (!results::has_content(path, table))
    results::write_output(path, TextKind::kHashComment, table,
                          results::provenance_of(inputs_of(sweep)));
  terminal::say(
      fmt::format("sweep: means over {} draws in {}", sweep.points().draws, path.string()));
}

void write_tables(const ParticlesSweep& sweep, const SweepStageRequest& request,
                  sweep::ParticlesRunner run) {
  const auto& output = request.output;
  const auto study = sweep.study(VISCONTACT_VERSION, std::move(run));
  terminal::ProgressTimer timer;
  const auto computed = write_rows(
      study, request, inputs_of(sweep),
      [&](std::uint64_t done, std::uint64_t size) { show_finished_rows(timer, done, size); });
  write_means(sweep, output);
  const auto outcome = sweep::read_outcome(study, output);
  const auto failed = outcome.without_result + outcome.with_some_results;
  terminal::say((computed == 0 ? fmt::format("sweep: {} is up to date", output)
                               : fmt::format("sweep: {} rows in {}", study.size(), output)) +
                (failed == 0 ? ""
                             : fmt::format("; {} run{} failed (the column 'failure' says why)",
                                           failed, failed == 1 ? "" : "s")));
  if (failed == outcome.points)
    throw Error(ErrorKind::kNotConverged,
                fmt::format("{}: every run failed; the column 'failure' says why, in the first "
                            "row: {}",
                            output, outcome.first_failure));
}

/// The numbers of the rows whose run has not ended; with `failed`, also of those that failed.
std::vector<std::uint64_t> missing_rows(const ParticlesSweep& sweep, const ParticlesRuns& runs,
                                        bool failed) {
  std::vector<std::uint64_t> missing;
  for (std::uint64_t i = 0; i < sweep.points().rows(); ++i)
    if (failed ? !runs.has_succeeded(i) : !runs.ended(i)) missing.push_back(i);
  return missing;
}

/// Sets the time of a row from the first steps of the first one.
void measure_first_steps(const ParticlesSweep& sweep, const StopToken& stop, DryRun& run) {
  using Clock = std::chrono::steady_clock;
  const auto seconds_since = [](Clock::time_point time) {
    return std::chrono::duration<double>(Clock::now() - time).count();
  };
  const auto c = sweep.case_of(0);
  const auto start = Clock::now();
  ParticleSimulation simulation(c.setting, first_state(c, ""), 1, stop);
  // In a fluid the first step also estimates errors, and takes several times as long as the others.
  simulation.step(c.end_time);
  const double first = seconds_since(start);
  const auto after_first = Clock::now();
  const double tiny = 1e-6 * c.setting.time_step;
  constexpr double kEnough = 2;  // [s]
  while (simulation.state().time < c.end_time - tiny && seconds_since(start) < kEnough)
    simulation.step(c.end_time);
  const auto further = simulation.state().steps - 1;
  const double all = std::ceil(c.end_time / c.setting.time_step * (1 - 1e-9)) - 1;
  run.seconds_per_row =
      first + (further > 0 ? seconds_since(after_first) / static_cast<double>(further) : first) *
                  std::max(all, 0.0);
  run.basis = fmt::format("the first {} of {:.0f} steps of row 1, just computed", further + 1,
                          std::max(all, 0.0) + 1);
}

}  // namespace

void run_sweep(const sweep::Study& study, const SweepStageRequest& request,
               const results::Inputs& inputs, const std::string& part) {
  const auto& output = request.output;
  Remaining remaining;
  terminal::ProgressTimer timer;
  const auto computed =
      write_rows(study, request, inputs, [&](std::uint64_t done, std::uint64_t size) {
        if (timer.is_due())
          terminal::show_progress(
              fmt::format("sweep: {} of {}{}", done, size, remaining.after(done, size)));
      });
  const auto outcome = sweep::read_outcome(study, output);
  terminal::say((computed == 0 ? fmt::format("sweep: {} is up to date", output)
                               : fmt::format("sweep: {} rows in {}{}", study.size(), output,
                                             computed < study.size()
                                                 ? fmt::format(", {} of them already computed",
                                                               study.size() - computed)
                                                 : "")) +
                failures_in_words(outcome, part));
  if (outcome.without_result == outcome.points)
    throw Error(ErrorKind::kNotConverged,
                fmt::format("{}: every {} failed at every point; the column 'failure' says why, "
                            "at the first point: {}",
                            output, part, outcome.first_failure));
}

void sweep_particles(const ParticlesSweep& sweep, const SweepStageRequest& request) {
  const auto runs = runs_of(sweep, request, sweep.points().rows());
  write_tables(sweep, request, [&](std::uint64_t index, const StopToken& stop) {
    return runs.compute(index, stop);
  });
}

void share_of_sweep(const ParticlesSweep& sweep, const SweepStageRequest& request,
                    const Share& share) {
  if (share.number >= sweep.points().rows()) return;
  const std::uint64_t size = (sweep.points().rows() - share.number + share.count - 1) / share.count;
  const auto runs = runs_of(sweep, request, size);
  std::atomic<std::uint64_t> failed = 0;
  // Nothing is written here: results are kept in the folders of the runs.
  const auto run = [&](std::uint64_t index, const StopToken& stop) {
    if (!runs.compute(share.number + index * share.count, stop).failure.empty()) ++failed;
    return std::string();
  };
  terminal::say(fmt::format("sweep: {} rows of {}", size, request.output));
  terminal::ProgressTimer timer;
  const auto done = sweep::run_rows(
      size, 0, request.jobs, run,
      [&](std::uint64_t index, const std::string&) { show_finished_rows(timer, index + 1, size); },
      request.stop);
  terminal::clear_progress();
  if (done < size)
    throw Error(ErrorKind::kInterrupted,
                fmt::format("interrupted; the runs are kept in {}; the same command continues them",
                            runs.folder().string()));
  if (failed == size)
    throw Error(ErrorKind::kNotConverged,
                fmt::format("{}: every run of this task failed; result.json in the folder of each "
                            "run says why",
                            runs.folder().string()));
}

void gather_sweep(const ParticlesSweep& sweep, const SweepStageRequest& request) {
  const auto runs = runs_of(sweep, request, sweep.points().rows());
  const auto missing = missing_rows(sweep, runs, false);
  if (!missing.empty()) {
    std::string text = fmt::format(
        "{}: {} of {} rows are missing (the first is row {}); the "
        "finished ones are kept",
        request.output, missing.size(), sweep.points().rows(), missing[0] + 1);
    const auto folder = slurm_folder(request.output);
    if (fs::exists(folder)) text += fmt::format("; logs are in {}", folder.string());
    if (const auto copy = folder / sweep.case_path().filename();
        fs::exists(copy) && read_file(copy) != sweep.base_text())
      text += fmt::format("; the case was edited since {} was submitted", copy.string());
    throw Error(ErrorKind::kNotConverged, text);
  }
  write_tables(sweep, request, [&](std::uint64_t index, const StopToken&) {
    auto results = runs.ended(index);
    if (!results)
      throw_bad_input({runs.folder().string()},
                      fmt::format("has lost the run of row {} while it was read", index + 1));
    return *results;
  });
}

void submit_sweep(const ParticlesSweep& sweep, const ArrayRequest& request,
                  const std::vector<std::string>& options) {
  check_output_file(request.output);
  (void)split_words(request.options);  // throws if they are wrong, before Slurm is asked
  ArrayJob job;
  job.command = "sweep";
  job.is_running = "is being computed";
  job.results = "the tables";
  job.cases = {sweep.case_path().string()};
  job.copies = {{sweep.case_path().filename().string(), sweep.base_text()}};
  job.options = options;
  job.count = task_count(request, sweep.points().rows());
  refuse_second_job(job, request);
  const ParticlesRuns runs(sweep, request.output, VISCONTACT_VERSION, 1, false);
  std::vector<bool> has_rows(job.count);
  for (const auto row : missing_rows(sweep, runs, true)) has_rows[row % job.count] = true;
  for (std::size_t task = 0; task < job.count; ++task)
    if (has_rows[task]) job.tasks.push_back(task);
  submit(job, request);
}

DryRun dry_run(const ParticlesSweep& sweep, const std::string& output, const StopToken& stop) {
  const ParticlesRuns runs(sweep, output, VISCONTACT_VERSION, 1, false);
  DryRun run{output, sweep.points().rows(), 0, 0, 0, ""};
  double seconds = 0;
  for (std::uint64_t i = 0; i < sweep.points().rows(); ++i) {
    if (!runs.has_succeeded(i)) {
      if (runs.ended(i)) ++run.failed;
      continue;
    }
    ++run.finished;
    seconds += runs.seconds(i);
  }
  if (run.finished > 0) {
    run.seconds_per_row = seconds / static_cast<double>(run.finished);
    run.basis = "its finished rows";
  } else {
    measure_first_steps(sweep, stop, run);
  }
  return run;
}

}  // namespace viscontact::pipeline
