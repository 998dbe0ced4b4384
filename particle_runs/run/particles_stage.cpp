// Errors of a step are thrown after the results are written. restart.bin is written last.
#include "viscontact/particle_runs/run/particles_stage.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <exception>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "viscontact/arrangement/pouring.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/files/locks.hpp"
#include "viscontact/particle_runs/case/particles_case.hpp"
#include "viscontact/particle_runs/io/contact_file.hpp"
#include "viscontact/particle_runs/io/particle_file.hpp"
#include "viscontact/particle_runs/io/restart.hpp"
#include "viscontact/particle_runs/run/particles_earlier_run.hpp"
#include "viscontact/particle_runs/run/particles_folder.hpp"
#include "viscontact/particle_runs/run/particles_pages.hpp"
#include "viscontact/particle_runs/run/run_log.hpp"
#include "viscontact/particle_runs/run/start_simulation.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/results/run_folder.hpp"
#include "viscontact/suspensions/suspension_simulation.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::particles {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Times of the run closer than this [T] count as equal. It is above rounding errors, and
/// Simulation::step() makes no shorter steps.
double tiny_time(const ParticlesCase& c) { return 1e-6 * c.setting.time_step; }

/// A run with its simulation and its files. It can be saved after any step.
class Run {
 public:
  /// The references must outlive this object. `log` is new or that of the run to continue.
  Run(const ParticlesCase& c, ParticleSimulation& simulation, fs::path folder,
      const results::Provenance& provenance, RunLog& log, const StopToken& stop)
      : case_(c),
        simulation_(simulation),
        flow_(flow_of(simulation)),
        suspension_(suspension_of(simulation)),
        folder_(std::move(folder)),
        provenance_(provenance),
        log_(log),
        stop_(stop) {
    assert(fs::is_directory(folder_));
  }

  /// Computes steps until the end time, until a stop is requested, or until a step cannot be
  /// computed. In the last case the function returns the error of this step, and the state stays
  /// that before the step; otherwise it returns null. Throws Error(kBadInput) if a file cannot be
  /// written, and the errors of the fluid solver if it fails between two steps.
  std::exception_ptr simulate() {
    if (log_.record().frames == 0) {
      try {
        compute_start();
      } catch (const Error&) {
        return std::current_exception();
      }
      add_frame();
    }
    save(with_costs(log_.record()));
    double next_frame = frame_after(log_.record().last_frame);
    while (!is_at_end() && !stop_.stop_requested()) {
      StepReport report;
      try {
        report = simulation_.step(case_.end_time);
      } catch (const Error&) {
        return std::current_exception();
      }
      if (flow_ != nullptr) {
        log_.totals().unknowns = flow_->unknowns();
        if (log_.lacks_flow()) log_.add_flow(flow_->flow());
      }
      log_.add_step(report, simulation_.state(), simulation_.rebounds());
      if (suspension_ != nullptr) log_.add_rheology(suspension_->rheology());
      if (report.time >= next_frame - tiny_time(case_)) {
        add_frame();
        next_frame = frame_after(report.time);
      }
      tell(report);
      // The time between two savings [s] is shorter in a fluid with inertia, because a signal can
      // end the solver, and then the flow since the last saving is lost.
      const auto& fluid = case_.setting.fluid;
      const double save_every = fluid && fluid->has_inertia() ? 10 : 60;  // [s]
      if (!is_at_end() && seconds_since(last_saved_) > save_every) save(with_costs(log_.record()));
    }
    return {};
  }

  /// Writes all files that are written at the end, and restart.bin. Returns the text of run.json.
  std::string write_results() {
    terminal::clear_progress();
    // The record is taken before the last frame is added, because an uninterrupted run has no such
    // frame: a run that continues from here removes it.
    auto record = log_.record();
    const auto& state = simulation_.state();
    if (record.last_frame < state.time) add_frame();
    add_last_flow();
    log_.sync();
    write("final_particles.csv", TextKind::kHashComment, final_particles());
    write("final_contacts.csv", TextKind::kHashComment,
          write_contacts(state.particles, contacts_of(case_.setting, state),
                         case_.setting.laws.friction.has_value()));
    write_pages(case_, folder_, provenance_, record.totals.regime);
    record = with_costs(std::move(record));
    auto json = run_json(case_, record.totals, state);
    // Forces of the fluid are not in restart.bin. A run that is killed before this line computes
    // its last step again.
    write("run.json", TextKind::kJson, json);
    save(record);
    return json;
  }

 private:
  static double seconds_since(Clock::time_point time) {
    return std::chrono::duration<double>(Clock::now() - time).count();
  }
  bool is_at_end() const { return simulation_.state().time >= case_.end_time - tiny_time(case_); }
  void write(const char* name, TextKind kind, const std::string& text) const {
    results::write_output(folder_ / name, kind, text, provenance_);
  }

  /// The time at which the next frame after `time` is due [T]: the start of the run plus a whole
  /// number of intervals. The frame is written after the first step that reaches this time.
  double frame_after(double time) const {
    const double first = log_.totals().first_time;
    const double interval = std::max(case_.frame_interval, case_.setting.time_step);
    return first + (std::floor((time + tiny_time(case_) - first) / interval) + 1) * interval;
  }

  /// The flow at the end of the run, which no step computes. An interrupted run adds nothing,
  /// because the next step computes this flow when the run continues; nor does a run in a sheared
  /// cell, because the solver would compute the flow around images that have not moved. If the flow
  /// cannot be computed, only a warning says so, because all steps are done. Throws
  /// Error(kInterrupted) at a stop.
  void add_last_flow() {
    if (cell_of(case_.setting).is_sheared()) return;
    if (!is_at_end() || stop_.stop_requested() || !log_.lacks_flow()) return;
    std::optional<FlowField> flow;
    try {
      flow = flow_->flow_at_present();
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::kInterrupted) throw;
      terminal::warn("particles: warning: the flow at the end of the run is missing ({})",
                     error.what());
    }
    if (flow) log_.add_flow(*flow);
  }

  /// Computes the velocities at the start of spheres with lubrication, which the first frame has;
  /// if no step follows, also their rheology. If a step follows, a warning is enough where they do
  /// not converge, because steps bear smaller gaps.
  void compute_start() {
    // After a step the velocities are those of the step, with which the next one begins.
    if (suspension_ == nullptr || simulation_.state().steps > 0) return;
    try {
      const auto& rheology = suspension_->solve_instant();
      if (is_at_end()) log_.add_rheology(rheology);
    } catch (const Error& error) {
      if (is_at_end() || error.kind() != ErrorKind::kNotConverged) throw;
      terminal::warn("particles: warning: {}; the first frame has them as they are", error.what());
    }
  }

  void add_frame() {
    std::vector<double> link_force_errors;
    if (flow_ != nullptr) link_force_errors = flow_->force_errors().of_links;
    log_.add_frame(simulation_.state(), link_force_errors);
  }

  std::string final_particles() {
    const auto reported = simulation_.reported_particles();
    if (flow_ == nullptr) return write_particles(reported, {}, simulation_.state().given_loads);
    const auto forces = flow_->fluid_forces();
    const auto errors = flow_->force_errors().of_fluid;
    return write_particles(reported, FluidForces{forces, errors});
  }

  /// Adds the computing time of this call [s] and takes the larger memory [MiB].
  RunRecord with_costs(RunRecord record) {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    auto& totals = record.totals;
    totals.seconds += seconds_since(begin_);
    double peak = static_cast<double>(usage.ru_maxrss) / 1024;
    if (flow_ != nullptr) peak += flow_->solver_peak_memory_mebibytes();
    totals.peak_memory_mebibytes = std::max(totals.peak_memory_mebibytes, peak);
    return record;
  }

  /// Writes restart.bin after all other files are on the disk. The files then contain at least what
  /// the record says, and a run that is killed at any time can continue.
  void save(const RunRecord& record) {
    log_.sync();
    const auto state = simulation_.state_to_save();
    write("restart.bin", TextKind::kHashComment,
          record_comment(record, state.steps) + write_restart(state));
    last_saved_ = Clock::now();
  }

  void tell(const StepReport& report) {
    if (!progress_.is_due()) return;
    terminal::show_progress(fmt::format(
        "particles: t = {:.4g} of {:.4g}, {} contacts, {} iterations, {:.3g} s{}", report.time,
        case_.end_time, report.contacts, report.iterations, seconds_since(begin_),
        terminal::time_left(seconds_since(begin_),
                            (report.time - first_time_) / (case_.end_time - first_time_))));
  }

  const ParticlesCase& case_;
  ParticleSimulation& simulation_;
  FlowSimulation* flow_;              // null without a fluid
  SuspensionSimulation* suspension_;  // null without lubrication
  fs::path folder_;
  const results::Provenance& provenance_;
  RunLog& log_;
  StopToken stop_;
  double first_time_ = simulation_.state().time;  // at which this call began [T]
  Clock::time_point begin_ = Clock::now(), last_saved_ = begin_;
  terminal::ProgressTimer progress_;
};

void warn_of_jam(const StepTotals& record) {
  if (record.jammed > 0)
    terminal::warn(
        "particles: warning: the particles jam in {} steps, first at t = {:.6g}: no motion of them "
        "gives way to the given motion of {}, so that the load on it grows without bound "
        "(run.json: jammed_steps); let this motion end before, or give a force or pressure in its "
        "place",
        record.jammed, record.first_jam, record.jammed_bodies);
}

/// Warns if links push so hard that steps do not resolve how what they push buckles, or if films in
/// a fluid pull so hard that what they pull may vibrate with a growing amplitude.
void warn_of_buckling(const ParticlesCase& c, const StepTotals& record) {
  if (record.buckling == 0) return;
  // Where a vibration has grown, the forces of its films say nothing about the step that is stable.
  const bool may_grow = c.setting.fluid && (c.particles.has_other_shapes() ||
                                            c.setting.fluid->coupling == Coupling::kSplitting);
  if (c.setting.fluid)
    terminal::warn(
        "particles: warning: in {} of {} steps a link pushes so hard that what it pushes buckles "
        "within the step, and rounding errors decide how, or a film of a particle that is no disc "
        "(with coupling = "
        "\"splitting\" any film) pulls so hard that what it pulls may vibrate across it with a "
        "growing amplitude (run.json: buckling_steps); a time_step of {:.2g} resolves it",
        record.buckling, record.steps,
        c.setting.time_step / (may_grow ? record.first_buckling : record.largest_buckling));
  else
    terminal::warn(
        "particles: warning: in {} of {} steps a link (or the area that a membrane keeps) pushes "
        "so hard that what it pushes buckles within the step, and rounding errors decide how "
        "(run.json: buckling_steps); a time_step of {:.2g} resolves it",
        record.buckling, record.steps, c.setting.time_step / std::sqrt(record.largest_buckling));
}

void warn_of_springs(const StepTotals& record) {
  if (record.lacks_springs > 0)
    terminal::warn(
        "particles: warning: {} of {} steps have a solution only if films that pull keep their "
        "directions, with which vibrations across them may grow (run.json: steps_without_springs); "
        "use a shorter time_step",
        record.lacks_springs, record.steps);
}

/// Warns if steps are too long for advection = "characteristics" to be right to about 1 %.
void warn_of_advection(const ParticlesCase& c, const StepTotals& record) {
  if (record.advection_errors > 0)
    terminal::warn(
        "particles: warning: in {} of {} steps the velocity of the fluid changes so much along its "
        "paths that forces of advection = \"characteristics\" are off by more than about 1 % "
        "(run.json: advection_error is {:.2g}, and should be at most {}); a time_step of {:.2g} "
        "would do, or advection = \"semi_implicit\"",
        record.advection_errors, record.steps, record.largest_advection_error, kNamedAdvectionError,
        c.setting.time_step * kNamedAdvectionError / record.largest_advection_error);
}

void warn_of_case(const ParticlesCase& c) {
  for (const auto& warning : c.warnings) terminal::warn("particles: warning: {}", warning);
  const auto up =
      c.particles.dimension == 1 ? 0U : static_cast<unsigned>(c.particles.dimension) - 1;
  if (c.setting.gravity[up] > 0)
    terminal::warn(
        "particles: warning: space.gravity points upwards (its last component, {:.6g}, is > 0); "
        "gravity towards the floor is negative",
        c.setting.gravity[up]);
}

/// Throws Error(kInterrupted) if the run was interrupted, Error(kNotConverged) if a step missed the
/// tolerances by more than the factor kStillAResult.
void warn_or_fail(const ParticlesCase& c, const StepTotals& record, const State& state,
                  const fs::path& folder, const StopToken& stop) {
  terminal::say(
      "particles: {} steps to t = {:.6g}, {:.3g} iterations a step, largest residual {:.2g}, "
      "largest overlap {:.2g} mean radii; {}",
      record.steps, record.last_time,
      static_cast<double>(record.iterations) /
          static_cast<double>(std::max<std::int64_t>(record.steps, 1)),
      record.largest_residual, record.largest_overlap, (folder / "particles.html").string());
  if (const auto viscosity = record.rheology.mean(0)) {
    const auto error = record.rheology.standard_error(0);
    terminal::say("particles: the mean viscosity is {:.6g}{} times that of the fluid", *viscosity,
                  error ? fmt::format(" (standard error {:.2g})", *error) : "");
  }
  if (const auto regime = in_words(record.regime); !regime.empty())
    terminal::say("particles: {}", regime);
  for (const auto& warning : warnings_of(c, record.regime))
    terminal::warn("particles: warning: {}", warning);
  if (record.divided > 0)
    terminal::say(
        "particles: {} of {} steps were computed in parts, because particles are fast or Coulomb's "
        "law was not solved (steps.csv says in how many)",
        record.divided, record.steps);
  const bool is_suspension = c.setting.lubrication.has_value();
  if (record.unconverged > 0 && is_suspension)
    terminal::warn(
        "particles: warning: {} of {} steps did not converge (steps.csv says which); use a shorter "
        "step",
        record.unconverged, record.steps);
  if (record.unconverged > 0 && !is_suspension)
    terminal::warn(
        "particles: warning: {} of {} steps did not reach the tolerances {} and {}, {}",
        record.unconverged, record.steps, c.setting.solver.tolerance,
        c.setting.solver.impulse_tolerance,
        record.failed > 0
            ? fmt::format("{} of them by more than a factor of {}", record.failed, kStillAResult)
            : fmt::format("by less than a factor of {} (steps.csv says which)", kStillAResult));
  if (record.given_loads > 0)
    terminal::warn(
        "particles: warning: in {} of {} steps given loads bound the friction, because {} was not "
        "solved ({})",
        record.given_loads, record.steps,
        c.setting.laws.friction->method == FrictionMethod::kConvex ? "the convex relaxation"
                                                                   : "Coulomb's law",
        is_suspension ? "docs/suspensions.md, \"Limits\""
                      : "docs/particles.md, \"A step that does not converge\"");
  warn_of_jam(record);
  warn_of_buckling(c, record);
  warn_of_springs(record);
  warn_of_advection(c, record);
  if (record.unresolved > 0)
    terminal::warn(
        "particles: warning: {} contacts were computed although their particles move past each "
        "other by more than half the sum of their radii even in a {}th of the time step (steps.csv "
        "says when); use a shorter time_step",
        record.unresolved, 1 << Simulation::kMostHalvings);
  if (stop.stop_requested())
    terminal::say("particles: interrupted at t = {:.6g}; the same command continues from there",
                  record.last_time);
  stop.throw_if_stop_requested();
  for (const auto& [source, count, radius] : waiting_particles(c.setting.sources, state))
    terminal::warn(
        "particles: warning: {} particles of source[{}] are due and have not come: no place was "
        "free in its region for the next one, of radius {:.6g}; the source must have a lower rate, "
        "smaller particles, or a larger region",
        count, source, radius);
  if (record.failed > 0 && is_suspension)
    throw Error(ErrorKind::kNotConverged,
                "{}: {} of {} steps did not converge: residuals are up to {:.2g} mean radii. All "
                "results are written, and steps.csv says which steps; use a shorter step",
                c.path.string(), record.failed, record.steps, record.largest_residual);
  if (record.failed > 0)
    throw Error(ErrorKind::kNotConverged,
                "{}: {} of {} steps did not converge: residuals are up to {:.2g} (of gaps, "
                "friction and links; solver.tolerance is {}) and {:.2g} (of the impulses; "
                "solver.impulse_tolerance is {}). All results are written, and steps.csv says "
                "which steps; raise "
                "solver.max_iterations ({}) or the tolerances",
                c.path.string(), record.failed, record.steps, record.largest_residual,
                c.setting.solver.tolerance, record.largest_impulse_residual,
                c.setting.solver.impulse_tolerance, c.setting.solver.max_iterations);
}

/// Warns of a fixed mesh of many unknowns, as fine everywhere as on the smallest particle.
void warn_of_fine_mesh(const ParticlesCase& c, const Particles& particles) {
  if (!c.setting.fluid || c.setting.fluid->mesh != FluidMesh::kFixed || particles.count() == 0)
    return;
  constexpr double kPerTriangle = 4.6;   // unknowns of velocity and pressure, on a large mesh
  constexpr double kManyUnknowns = 6e4;  // about ten seconds of one core for each step
  const double edge = 2 * std::numbers::pi * std::ranges::min(particles.radii) /
                      c.setting.fluid->edges_per_particle;
  const auto* cylinder = std::get_if<CylinderDomain>(&c.setting.domain);
  const double area =
      cylinder != nullptr ? cylinder->radius * cylinder->height : measure(c.setting.domain);
  const double unknowns = kPerTriangle * area / (std::numbers::sqrt3 / 4 * edge * edge);
  if (unknowns < kManyUnknowns) return;
  terminal::warn(
      "particles: warning: the fixed mesh has about {:.2g} unknowns, which take about {:.2g} s of "
      "one core for each step and more for estimates of errors, because all edges are as short as "
      "those on the smallest particle; mesh = \"fitted\" needs far fewer, and half of "
      "edges_per_particle needs a fourth",
      unknowns, std::ceil(unknowns / 1e4));
}

/// Prints the messages of the earlier call that finished the run, and throws the same error.
void tell_finished(const ParticlesCase& c, const EarlierRun& run, const fs::path& folder, bool json,
                   const StopToken& stop) {
  if (json) fmt::print("{}", results::without_provenance(read_file(folder / "run.json")));
  terminal::say("particles: {} is up to date", folder.string());
  warn_or_fail(c, run.record.totals, run.state, folder, stop);
}

void write_files_of_all_frames(const ParticlesRequest& request, const ParticlesCase& c,
                               const results::Provenance& provenance) {
  if (request.hdf5) write_hdf5(c, request.folder, provenance);
  if (request.xyz) write_xyz(c, request.folder, provenance);
}

void run_case(const ParticlesRequest& request, const ParticlesCase& c);

/// Runs the case of contact alone in its folder below that of the request. Returns the error of
/// steps that did not converge, because the run beside it is wanted all the same.
std::exception_ptr run_compared(const ParticlesRequest& request, const ParticlesCase& c) {
  auto beside = request;
  beside.folder = compared_folder(request.folder).string();
  beside.json = false;
  terminal::say("particles: the same with pairs = \"none\", in {}", beside.folder);
  try {
    run_case(beside, compared_case(c));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kNotConverged) throw;
    return std::current_exception();
  }
  return {};
}

/// Does the work of run_particles() with the case, which must be that of the request or its
/// compared_case().
void run_case(const ParticlesRequest& request, const ParticlesCase& c) {
  std::vector<fs::path> inputs = {c.path};
  for (const auto& file : files_of(c)) inputs.push_back(file);
  if (!request.restart.empty()) inputs.emplace_back(request.restart);
  const results::Provenance provenance = results::provenance_of({inputs, {}});
  const fs::path folder = request.folder;
  check_inputs_stay(c, request.restart, folder);
  auto state = first_state(c, request.restart);
  const LockedFolder lock(folder, results::kFolderIsLocked);
  check_results(folder);
  const auto failure_beside = c.compares ? run_compared(request, c) : nullptr;
  RunLog log(c, folder, provenance);
  if (const auto earlier = find_earlier_run(c, folder, provenance, log)) {
    if (is_finished(*earlier, c, tiny_time(c), folder)) {
      write_files_of_all_frames(request, c, provenance);
      tell_finished(c, *earlier, folder, request.json, request.stop);
      if (failure_beside) std::rethrow_exception(failure_beside);
      return;
    }
    log.resume(earlier->record);
    // These files would lack the new frames.
    for (const auto* name : {"particles.h5", "particles.xyz"}) remove_file(folder / name);
    terminal::say("particles: the run in {} continues from t = {:.6g}, after step {}",
                  folder.string(), earlier->state.time, earlier->state.steps);
    state = earlier->state;
  } else {
    remove_results(folder);
    log.totals().first_time = log.totals().last_time = state.time;
  }
  warn_of_case(c);
  warn_of_fine_mesh(c, state.particles);
  const auto simulation = start_simulation(c.setting, std::move(state), request.threads,
                                           request.start_solver, request.stop);
  Run run(c, *simulation, folder, provenance, log, request.stop);
  // If a file cannot be written, or the fluid solver fails between two steps, simulate() throws;
  // the same command continues from restart.bin.
  const auto failure = run.simulate();
  std::string json;
  try {
    json = run.write_results();
    write_files_of_all_frames(request, c, provenance);
  } catch (const Error&) {
    if (!failure) throw;
  }
  if (failure) {
    warn_of_jam(log.totals());
    std::rethrow_exception(failure);
  }
  if (request.json) fmt::print("{}", json);
  warn_or_fail(c, log.totals(), simulation->state(), folder, request.stop);
  if (failure_beside) std::rethrow_exception(failure_beside);
}

}  // namespace

void run_particles(const ParticlesRequest& request) {
  assert(request.threads >= 1);
  if (request.hdf5) require_hdf5();
  run_case(request, read_particles_case(request.case_file));
}

}  // namespace viscontact::particles
