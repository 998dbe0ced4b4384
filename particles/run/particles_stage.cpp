// A run of many particles: checks, continues an earlier run, computes time steps, saves and writes
// the results. restart.bin must be written after steps.csv and particles.pvd (Run::save), so that a
// run that is killed at any time can be continued.
#include "viscontact/particles/run/particles_stage.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/files/locked_folder.hpp"
#include "viscontact/particles/case/particles_case.hpp"
#include "viscontact/particles/current_contacts.hpp"
#include "viscontact/particles/io/particle_file.hpp"
#include "viscontact/particles/io/restart.hpp"
#include "viscontact/particles/io/vtk.hpp"
#include "viscontact/particles/picture/particles_page.hpp"
#include "viscontact/particles/picture/particles_picture.hpp"
#include "viscontact/particles/run/particle_simulation.hpp"
#include "viscontact/particles/run/particles_earlier_run.hpp"
#include "viscontact/particles/run/particles_folder.hpp"
#include "viscontact/particles/run/particles_frames.hpp"
#include "viscontact/particles/run/particles_record.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/results/run_folder.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::particles {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Writes the page and the still picture of the frames.
void write_pages(const ParticleFrames& frames, const std::string& title, const fs::path& folder,
                 const results::Provenance& provenance) {
  constexpr int kPanels = 4;  // states in the still picture
  results::write_output(folder / "particles.html", TextKind::kHtml,
                        particles_page(frames.playback(), title), provenance);
  results::write_output(folder / "particles.svg", TextKind::kSvg,
                        particles_picture(frames.playback(), title, kPanels), provenance);
}

/// A run with its state, frames and record, which can be written at any time.
class Run {
 public:
  /// `record` and `frames` are new ones, or those of the interrupted run that this one continues.
  Run(const ParticlesCase& c, ParticleSimulation& simulation, fs::path folder,
      const results::Provenance& provenance, StepRecord record, ParticleFrames frames,
      const StopToken& stop)
      : case_(c),
        simulation_(simulation),
        folder_(std::move(folder)),
        provenance_(provenance),
        frames_(std::move(frames)),
        record_(std::move(record)),
        earlier_(record_),
        stop_(stop) {}

  /// Computes steps until the end time, or until a stop is requested.
  void simulate() {
    if (frames_.files().empty()) add_frame();
    save();
    const auto times = frame_times(case_, record_.first_time);
    double next_frame = times.after(frames_.files().back().first);
    while (simulation_.state().time < case_.end_time - times.tiny && !stop_.stop_requested()) {
      const auto report = simulation_.step(case_.end_time);
      record_.add(simulation_.state().steps, report);
      frames_.add_rebounds(simulation_.state().particles, simulation_.rebounds());
      if (simulation_.has_fluid()) {
        record_.unknowns = simulation_.fluid().unknowns();
        if (frames_.lacks_flow(case_.setting)) frames_.add_flow(simulation_.fluid().flow());
      }
      if (report.time >= next_frame - times.tiny) {
        add_frame();
        next_frame = times.after(report.time);
      }
      tell(report);
      // If a signal ends the solver of a fluid with inertia, the flow since the last call is lost.
      const auto& fluid = case_.setting.fluid;
      const double save_every = fluid && fluid->has_inertia() ? 10 : 60;  // [s]
      const bool is_at_end = simulation_.state().time >= case_.end_time - times.tiny;
      if (!is_at_end && seconds_since(last_saved_) > save_every) save();
    }
  }

  /// Writes all files of the run. Returns the text of run.json.
  std::string write_results() {
    terminal::clear_progress();
    frames_.end(case_.setting, simulation_.state(), link_force_errors());
    add_last_flow();
    const auto& state = simulation_.state();
    write("final_particles.csv", TextKind::kHashComment, final_particles());
    write("final_contacts.csv", TextKind::kHashComment,
          write_contacts(state.particles, contacts_of(case_.setting, state)));
    write_pages(frames_, case_.title, folder_, provenance_);
    auto json = run_json(case_, with_costs(), state);
    // Forces of the fluid are not in restart.bin. A run that is killed before this line computes
    // its last step again.
    write("run.json", TextKind::kJson, json);
    save();
    return json;
  }

  const StepRecord& record() const { return record_; }

 private:
  static double seconds_since(Clock::time_point time) {
    return std::chrono::duration<double>(Clock::now() - time).count();
  }
  void write(const char* name, TextKind kind, const std::string& text) const {
    results::write_output(folder_ / name, kind, text, provenance_);
  }

  /// Adds the flow around the particles where they are at the end, which no step computes. A run
  /// that was interrupted computes it in its next step, when it continues.
  void add_last_flow() {
    const auto& state = simulation_.state();
    const bool is_at_end = state.time >= case_.end_time - frame_times(case_, 0).tiny;
    if (!is_at_end || stop_.stop_requested() || !frames_.lacks_flow(case_.setting)) return;
    try {
      frames_.add_flow(simulation_.fluid().flow_at_present());
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kExternalProgram) throw;
      terminal::warn(fmt::format(
          "particles: warning: the flow at the end of the run is missing ({})", error.what()));
    }
  }

  void add_frame() { frames_.add(case_.setting, simulation_.state(), link_force_errors()); }

  std::span<const double> link_force_errors() {
    if (!simulation_.has_fluid()) return {};
    return simulation_.fluid().force_errors().of_links;
  }

  std::string final_particles() {
    const auto reported = simulation_.reported_particles();
    if (!simulation_.has_fluid()) return write_particles(reported);
    const auto& fluid = simulation_.fluid();
    return write_particles(reported,
                           FluidForces{fluid.fluid_forces(), fluid.force_errors().of_fluid});
  }

  /// The sums, with computing time and memory of this call and the calls before it.
  StepTotals with_costs() const {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    StepTotals record = record_;
    record.seconds += seconds_since(begin_);
    double peak = static_cast<double>(usage.ru_maxrss) / 1024;
    if (simulation_.has_fluid()) peak += simulation_.fluid().solver_peak_memory_mebibytes();
    record.peak_memory_mebibytes = std::max(record.peak_memory_mebibytes, peak);
    return record;
  }

  /// Writes the files from which a killed run is continued, and the list of frames. A run continues
  /// from the step of restart.bin, so restart.bin is written last: whenever the process is killed,
  /// the other files contain that step. steps.csv may be newer than restart.bin by one call of this
  /// function; therefore it contains the record of the previous call, too.
  void save() {
    const auto record = with_costs();
    write("particles.pvd", TextKind::kXml, write_pvd(frames_.files()));
    if (simulation_.has_fluid()) {
      write("flow.pvd", TextKind::kXml, write_pvd(frames_.flows()));
      write("motion.csv", TextKind::kHashComment, frames_.motion());
      write("contacts.csv", TextKind::kHashComment, frames_.contacts());
    }
    if (!case_.setting.links.empty())
      write("links.pvd", TextKind::kXml, write_pvd(frames_.links()));
    for (const auto& [name, text] : frames_.tables())
      write(name.c_str(), TextKind::kHashComment, text);
    write("steps.csv", TextKind::kHashComment,
          (earlier_.last_step == record.last_step ? "" : record_comment(earlier_)) +
              record_comment(record) + record_.rows);
    // In a fluid with inertia the solver has a part of the state.
    write("restart.bin", TextKind::kHashComment,
          simulation_.has_fluid() ? write_restart(simulation_.fluid().state_to_save())
                                  : write_restart(simulation_.state()));
    earlier_ = record;
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
  fs::path folder_;
  const results::Provenance& provenance_;
  ParticleFrames frames_;
  StepRecord record_;
  StepTotals earlier_;  // the sums when restart.bin was last written
  StopToken stop_;
  double first_time_ = simulation_.state().time;  // of this call [T]
  Clock::time_point begin_ = Clock::now(), last_saved_ = begin_;
  terminal::ProgressTimer progress_;
};

/// Says how the run ended, after its files are written. Throws Error(kInterrupted) if the run was
/// interrupted, Error(kNotConverged) if a step did not converge.
void warn_or_fail_if_not_converged(const ParticlesCase& c, const StepTotals& record,
                                   const fs::path& folder, const StopToken& stop) {
  terminal::say(fmt::format(
      "particles: {} steps to t = {:.6g}, {:.3g} iterations a step, largest residual {:.2g}, "
      "largest overlap {:.2g} mean radii; {}",
      record.steps, record.last_time,
      static_cast<double>(record.iterations) /
          static_cast<double>(std::max<std::int64_t>(record.steps, 1)),
      record.largest_residual, record.largest_overlap, (folder / "particles.html").string()));
  if (record.unconverged > 0)
    terminal::warn(
        fmt::format("particles: warning: {} of {} steps did not reach the tolerances {} and {}",
                    record.unconverged, record.steps, c.setting.solver.tolerance,
                    c.setting.solver.impulse_tolerance));
  if (record.unresolved > 0)
    terminal::warn(fmt::format(
        "particles: warning: {} contacts were computed although their particles move past each "
        "other by more than half the sum of their radii even in a {}th of the time step "
        "(steps.csv says when); use a shorter time_step",
        record.unresolved, 1 << Simulation::kMostHalvings));
  if (stop.stop_requested())
    terminal::say(
        fmt::format("particles: interrupted at t = {:.6g}; the same command continues from there",
                    record.last_time));
  stop.throw_if_stop_requested();
  if (record.unconverged > 0)
    throw Error(
        ErrorKind::kNotConverged,
        fmt::format("{}: {} of {} steps did not converge: residuals are up to {:.2g} (of "
                    "the gaps; solver.tolerance is {}) and {:.2g} (of the impulses; "
                    "solver.impulse_tolerance is {}). All results are written, and "
                    "steps.csv says which steps; raise solver.max_iterations ({}) or the "
                    "tolerances",
                    c.path.string(), record.unconverged, record.steps, record.largest_residual,
                    c.setting.solver.tolerance, record.largest_impulse_residual,
                    c.setting.solver.impulse_tolerance, c.setting.solver.max_iterations));
}

/// For a run that was finished before this call: prints the messages of the call that finished it,
/// and throws the same error.
void tell_finished(const ParticlesCase& c, const EarlierRun& run, const fs::path& folder, bool json,
                   const StopToken& stop) {
  if (json) fmt::print("{}", results::without_provenance(read_file(folder / "run.json")));
  terminal::say(fmt::format("particles: {} is up to date", folder.string()));
  warn_or_fail_if_not_converged(c, run.record, folder, stop);
}

}  // namespace

void run_particles(const ParticlesRequest& request) {
  const ParticlesCase c = read_particles_case(request.case_file);
  std::vector<fs::path> inputs = {c.path};
  if (!c.particles_file.empty()) inputs.push_back(c.particles_file);
  if (!request.restart.empty()) inputs.emplace_back(request.restart);
  const results::Provenance provenance = results::provenance_of({inputs, {}});
  const fs::path folder = request.folder;
  check_inputs_stay(c, request.restart, folder);
  auto state = first_state(c, request.restart);
  const LockedFolder lock(folder, results::kFolderIsLocked);
  check_results(folder);
  auto earlier = find_earlier_run(c, folder, provenance);
  if (earlier && is_finished(*earlier, c, folder)) {
    tell_finished(c, *earlier, folder, request.json, request.stop);
    return;
  }
  const auto& fluid = c.setting.fluid;
  StepRecord record(fluid.has_value(), fluid && fluid->has_inertia());
  ParticleFrames frames(folder, provenance, c.setting, c.particles);
  if (earlier) {
    // This removes frames that were written after the last restart.bin, and the frame that was
    // written because of the interrupt.
    remove_other_frames(earlier->frames.files(), folder);
    terminal::say(fmt::format("particles: the run in {} continues from t = {:.6g}, after step {}",
                              folder.string(), earlier->state.time, earlier->state.steps));
    state = std::move(earlier->state);
    record = std::move(earlier->record);
  } else {
    remove_results(folder);
    record.first_time = record.last_time = state.time;
    record.last_step = state.steps;
  }
  ParticleSimulation simulation(c.setting, std::move(state), request.threads, request.start_solver,
                                request.stop);
  Run run(c, simulation, folder, provenance, std::move(record),
          earlier ? std::move(earlier->frames) : std::move(frames), request.stop);
  try {
    run.simulate();
  } catch (const Error&) {
    // If a step cannot be computed, the state before this step is written. If the error came from
    // writing, a second error of writing is ignored and the first is thrown.
    try {
      run.write_results();
    } catch (const Error&) {
    }
    throw;
  }
  const auto json = run.write_results();
  if (request.json) fmt::print("{}", json);
  warn_or_fail_if_not_converged(c, run.record(), folder, request.stop);
}

void report_particles(const fs::path& folder) {
  check_results(folder);
  auto files = results::given_inputs(folder / "particles.pvd");
  const auto c = read_particles_case(files.front());
  files.push_back(folder / "particles.pvd");
  if (c.setting.fluid) files.push_back(folder / "flow.pvd");
  const auto provenance = results::provenance_of({files, {}});
  ParticleFrames frames(folder, provenance, c.setting, c.particles);
  frames.read_all(c.setting);
  write_pages(frames, c.title, folder, provenance);
  terminal::say(fmt::format("report: {0}/particles.html, {0}/particles.svg", folder.string()));
}

}  // namespace viscontact::particles
