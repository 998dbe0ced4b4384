// Runs stay in their folders until the user deletes them, so that a sweep with more draws computes
// only the new ones.
#include "viscontact/particle_runs/sweep/particles_sweep_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/shell_words.hpp"
#include "viscontact/particle_runs/run/particles_earlier_run.hpp"
#include "viscontact/particle_runs/run/start_simulation.hpp"
#include "viscontact/particle_runs/sweep/particles_run.hpp"
#include "viscontact/pipeline/sweep_stage.hpp"
#include "viscontact/suspensions/suspension_simulation.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::particles {
namespace {

namespace fs = std::filesystem;

/// The runs of `rows` rows. If there are fewer rows than jobs, each run has several threads;
/// results do not depend on it.
ParticlesRuns runs_of(const ParticlesSweep& sweep, const ParticlesSweepRequest& request,
                      std::uint64_t rows) {
  assert(request.jobs >= 1);
  const auto runs_at_once =
      std::clamp<std::uint64_t>(rows, 1, static_cast<std::uint64_t>(request.jobs));
  return {sweep,
          request.output,
          VISCONTACT_VERSION,
          request.jobs / static_cast<int>(runs_at_once),
          request.keep_all,
          request.start_solver};
}

void show_finished_rows(terminal::ProgressTimer& timer, std::uint64_t done, std::uint64_t size) {
  if (timer.is_due()) terminal::show_progress(fmt::format("sweep: {} of {} rows", done, size));
}

results::Inputs inputs_of(const ParticlesSweep& sweep) {
  results::Inputs inputs{{sweep.case_path()}, {}};
  for (const auto& file : sweep.files()) inputs.given.push_back(file);
  return inputs;
}

/// Writes the table of means over draws, unless a file with this content exists. `output` is the
/// path of the file of the rows.
void write_means(const ParticlesSweep& sweep, const std::string& output) {
  if (sweep.points().draws == 0) return;
  const auto path = path_of_means(output);
  const auto table = table_of_means(sweep, output);
  if (!results::has_content(path, table))
    results::write_output(path, TextKind::kHashComment, table,
                          results::provenance_of(inputs_of(sweep)));
  terminal::say("sweep: means over {} draws in {}", sweep.points().draws, path.string());
}

/// Calls `run` for each row that is not in the file of the rows, writes this file and the table of
/// means, and says on the terminal how many runs failed. Throws the errors of sweep_particles().
void write_tables(const ParticlesSweep& sweep, const ParticlesSweepRequest& request,
                  ParticlesRunner run) {
  const auto& output = request.output;
  const auto study = sweep.study(VISCONTACT_VERSION, std::move(run));
  terminal::ProgressTimer timer;
  const auto computed = pipeline::write_rows(
      study, {output, request.jobs, request.stop}, inputs_of(sweep),
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
                "{}: every run failed; the column 'failure' says why, in the first row: {}", output,
                outcome.first_failure);
}

/// The numbers of the rows whose run has not ended or, if `failed` is true, has failed; increasing.
std::vector<std::uint64_t> missing_rows(const ParticlesSweep& sweep, const ParticlesRuns& runs,
                                        bool failed) {
  std::vector<std::uint64_t> missing;
  for (std::uint64_t i = 0; i < sweep.points().rows(); ++i)
    if (failed ? !runs.has_succeeded(i) : !runs.ended(i)) missing.push_back(i);
  return missing;
}

double seconds_since(std::chrono::steady_clock::time_point time) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - time).count();
}

struct StepCost {
  double time = 0;     ///< of the motion [T]
  double seconds = 0;  ///< computing time of a step there [s]
};

/// Computes steps from `state` for about a second, or to the end; `state` gets the state after
/// them. The very first step of a motion is not in the mean, because in a fluid it also estimates
/// errors; `first` gets its seconds.
StepCost cost_of_steps(const ParticlesCase& c, const StartFluidSolver& start_solver,
                       const StopToken& stop, State& state, double& first) {
  constexpr double kEnough = 1;  // [s]; a step may take longer
  StepCost cost{state.time, 0};
  const auto simulation = start_simulation(c.setting, std::move(state), 1, start_solver, stop);
  auto start = std::chrono::steady_clock::now();
  simulation->step(c.end_time);
  first = seconds_since(start);
  cost.seconds = first;
  start = std::chrono::steady_clock::now();
  int steps = 0;
  while (seconds_since(start) < kEnough &&
         simulation->state().time + 1e-6 * c.setting.time_step < c.end_time) {
    simulation->step(c.end_time);
    cost.seconds = seconds_since(start) / ++steps;
  }
  state = simulation->state_to_save();
  return cost;
}

/// Moves `state` on to `time` [T] or, if that takes more than about four seconds, not so far: a
/// fall without contacts takes little time. The steps are longer than those of the case, because
/// only the kind of the motion matters. A step that cannot be computed ends this.
void move_on_roughly(const ParticlesCase& c, const StartFluidSolver& start_solver,
                     const StopToken& stop, double time, State& state) {
  // Seconds, and how many times as long a step is. A much longer step may take minutes, because
  // many particles meet in it.
  constexpr double kLongest = 4, kLonger = 4;
  auto setting = c.setting;
  setting.time_step *= kLonger;
  const auto start = std::chrono::steady_clock::now();
  const auto simulation = start_simulation(setting, std::move(state), 1, start_solver, stop);
  try {
    while (simulation->state().time < time && seconds_since(start) < kLongest)
      simulation->step(time);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kNotConverged) throw;
  }
  state = simulation->state_to_save();
  state.grid_time = state.time;
  state.grid_step = state.steps;
}

/// Times steps of the first row at the beginning, in the middle and at the end of its motion,
/// because particles that have come together take longer than those that fall. Between these times
/// the cost of a step is linear.
void measure_steps(const ParticlesSweep& sweep, const StartFluidSolver& start_solver,
                   const StopToken& stop, pipeline::DryRun& run) {
  const auto c = sweep.case_of(0);
  State state = first_state(c, "");
  double first = 0, unused = 0;
  if (!(c.end_time > 0)) {
    const auto start = std::chrono::steady_clock::now();
    const auto simulation = start_simulation(c.setting, std::move(state), 1, start_solver, stop);
    suspension_of(*simulation)->solve_instant();
    run.seconds_per_row = seconds_since(start);
    run.basis = "the velocities of row 1, just computed";
    return;
  }
  std::vector<StepCost> costs = {cost_of_steps(c, start_solver, stop, state, first)};
  const double last_step = c.end_time - c.setting.time_step;
  for (const double time : {c.end_time / 2, last_step}) {
    if (!(state.time < time)) continue;
    move_on_roughly(c, start_solver, stop, time, state);
    if (state.time < c.end_time)
      costs.push_back(cost_of_steps(c, start_solver, stop, state, unused));
  }
  double mean = costs.front().seconds * costs.front().time / c.end_time +
                costs.back().seconds * (1 - costs.back().time / c.end_time);
  for (std::size_t k = 1; k < costs.size(); ++k)
    mean += (costs[k].time - costs[k - 1].time) / c.end_time *
            (costs[k].seconds + costs[k - 1].seconds) / 2;
  const double all = std::max(std::ceil(c.end_time / c.setting.time_step * (1 - 1e-9)), 1.0);
  run.seconds_per_row = first + mean * (all - 1);
  std::vector<std::string> times;
  for (const auto& cost : costs) times.push_back(fmt::format("{:.3g}", cost.time));
  run.basis = fmt::format("steps of row 1 at the time{} {}, just computed, of {:.0f} steps",
                          times.size() > 1 ? "s" : "", fmt::join(times, ", "), all);
}

}  // namespace

void sweep_particles(const ParticlesSweep& sweep, const ParticlesSweepRequest& request) {
  const auto runs = runs_of(sweep, request, sweep.points().rows());
  write_tables(sweep, request, [&](std::uint64_t index, const StopToken& stop) {
    return runs.compute(index, stop);
  });
}

void share_of_sweep(const ParticlesSweep& sweep, const ParticlesSweepRequest& request,
                    const pipeline::Share& share) {
  assert(share.number < share.count);
  if (share.number >= sweep.points().rows()) return;
  const std::uint64_t size = (sweep.points().rows() - share.number + share.count - 1) / share.count;
  const auto runs = runs_of(sweep, request, size);
  std::atomic<std::uint64_t> failed = 0;
  // The rows are not written into a table: compute() keeps the results in the folders of the runs.
  const auto run = [&](std::uint64_t index, const StopToken& stop) {
    if (!runs.compute(share.number + index * share.count, stop).failure.empty()) ++failed;
    return std::string();
  };
  terminal::say("sweep: {} rows of {}", size, request.output);
  terminal::ProgressTimer timer;
  const auto done = sweep::run_rows(
      size, 0, request.jobs, run,
      [&](std::uint64_t index, const std::string&) { show_finished_rows(timer, index + 1, size); },
      request.stop);
  terminal::clear_progress();
  if (done < size)
    throw Error(ErrorKind::kInterrupted,
                "interrupted; the runs are kept in {}; the same command continues them",
                runs.folder().string());
  if (failed == size)
    throw Error(ErrorKind::kNotConverged,
                "{}: every run of this task failed; result.json in the folder of each run says why",
                runs.folder().string());
}

void gather_sweep(const ParticlesSweep& sweep, const ParticlesSweepRequest& request) {
  const auto runs = runs_of(sweep, request, sweep.points().rows());
  const auto missing = missing_rows(sweep, runs, false);
  if (!missing.empty()) {
    std::string text = fmt::format(
        "{}: {} of {} rows are missing (the first is row {}); the finished ones are kept",
        request.output, missing.size(), sweep.points().rows(), missing[0] + 1);
    const auto folder = pipeline::slurm_folder(request.output);
    if (fs::exists(folder)) text += fmt::format("; logs are in {}", folder.string());
    if (const auto copy = folder / sweep.case_path().filename();
        fs::exists(copy) && read_file(copy) != sweep.base_text())
      text += fmt::format("; the case was edited since {} was submitted", copy.string());
    throw Error(ErrorKind::kNotConverged, text);
  }
  write_tables(sweep, request, [&](std::uint64_t index, const StopToken&) {
    auto results = runs.ended(index);
    if (!results)
      throw_bad_input({runs.folder().string()}, "has lost the run of row {} while it was read",
                      index + 1);
    return *results;
  });
}

void submit_sweep(const ParticlesSweep& sweep, const pipeline::ArrayRequest& request,
                  const std::vector<std::string>& options) {
  check_output_file(request.output);
  (void)split_words(request.options);  // throws if they are wrong, before Slurm is asked
  pipeline::ArrayJob job;
  job.command = "sweep";
  job.is_running = "is being computed";
  job.results = "the tables";
  job.cases = {sweep.case_path().string()};
  job.copies = {{sweep.case_path().filename().string(), sweep.base_text()}};
  job.options = options;
  job.count = pipeline::task_count(request, sweep.points().rows());
  pipeline::refuse_second_job(job, request);
  const ParticlesRuns runs(sweep, request.output, VISCONTACT_VERSION, 1, false, {});
  std::vector<bool> has_rows(job.count);
  for (const auto row : missing_rows(sweep, runs, true)) has_rows[row % job.count] = true;
  for (std::size_t task = 0; task < job.count; ++task)
    if (has_rows[task]) job.tasks.push_back(task);
  pipeline::submit(job, request);
}

pipeline::DryRun dry_run(const ParticlesSweep& sweep, const std::string& output,
                         const StartFluidSolver& start_solver, const StopToken& stop) {
  const ParticlesRuns runs(sweep, output, VISCONTACT_VERSION, 1, false, {});
  pipeline::DryRun run{output, sweep.points().rows(), 0, 0, 0, ""};
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
    measure_steps(sweep, start_solver, stop, run);
  }
  return run;
}

}  // namespace viscontact::particles
