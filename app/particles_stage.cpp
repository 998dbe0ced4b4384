#include "app/particles_stage.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "app/command_options.hpp"
#include "app/particles_page.hpp"
#include "app/particles_picture.hpp"
#include "app/progress.hpp"
#include "app/provenance.hpp"
#include "case_file/particles_case.hpp"
#include "common/error.hpp"
#include "common/file.hpp"
#include "common/interrupt.hpp"
#include "common/locked_folder.hpp"
#include "common/number.hpp"
#include "particles/contacts_now.hpp"
#include "particles/particle_file.hpp"
#include "particles/playback.hpp"
#include "particles/restart.hpp"
#include "particles/vtk.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using particles::Playback;
using particles::Simulation;
using particles::StepReport;
using Clock = std::chrono::steady_clock;

/// What run.json says.
struct Record {
  std::int64_t steps = 0, unconverged = 0, iterations = 0;
  int most_iterations = 0;
  double first_time = 0, last_time = 0;
  double largest_residual = 0, largest_overlap = 0;
  std::string rows = "step,time,contacts,glued,iterations,residual,largest_overlap,converged\n";

  void add(std::int64_t step, const StepReport& report) {
    ++steps;
    unconverged += report.converged ? 0 : 1;
    iterations += report.iterations;
    most_iterations = std::max(most_iterations, report.iterations);
    largest_residual = std::max(largest_residual, report.residual);
    largest_overlap = std::max(largest_overlap, report.largest_overlap);
    last_time = report.time;
    // Beyond a million rows, 50 MB, every thousandth step and those that did not converge are enough.
    constexpr std::int64_t kMostRows = 1000000, kThen = 1000;
    if (steps > kMostRows && steps % kThen != 0 && report.converged) return;
    fmt::format_to(std::back_inserter(rows), "{},{},{},{},{},{},{},{}\n", step,
                   format_number(report.time), report.contacts, report.glued, report.iterations,
                   format_number(report.residual), format_number(report.largest_overlap),
                   report.converged ? 1 : 0);
  }
};

/// Frames written as they come, and kept to be drawn.
class Frames {
 public:
  Frames(fs::path folder, const Provenance& provenance, const particles::Particles& particles)
      : folder_(std::move(folder)), provenance_(provenance) {
    playback_.dimension = particles.dimension;
    playback_.radii.assign(particles.radii.begin(), particles.radii.end());
  }

  void add(const Simulation& simulation) {
    const auto& state = simulation.state();
    auto contacts = particles::contacts_of(simulation.setting(), state);
    const auto name = fmt::format("particles_{:05}.vtp", files_.size());
    write_output(folder_ / name, TextKind::kXml, particles::write_vtp(state.particles, contacts),
                 provenance_);
    files_.emplace_back(state.time, name);
    if ((files_.size() - 1) % every_ != 0) return;
    keep(simulation, std::move(contacts));
  }

  /// The last state is always among them.
  void end(const Simulation& simulation) {
    if (files_.empty()) return;  // not even the first could be written
    if (files_.back().first < simulation.state().time) add(simulation);
    if (playback_.frames.back().time < simulation.state().time)
      keep(simulation, particles::contacts_of(simulation.setting(), simulation.state()));
  }

  const Playback& playback() const { return playback_; }
  const std::vector<std::pair<double, std::string>>& files() const { return files_; }

 private:
  void keep(const Simulation& simulation, std::vector<particles::ContactNow> contacts) {
    const auto& state = simulation.state();
    particles::Frame frame;
    frame.time = state.time;
    frame.positions.assign(state.particles.positions.begin(), state.particles.positions.end());
    for (const auto& plane : simulation.setting().planes)
      frame.planes.push_back(plane.at(state.time));
    frame.contacts = std::move(contacts);
    kept_bytes_ += frame.positions.size() * sizeof(float) +
                   frame.contacts.size() * sizeof(particles::ContactNow);
    playback_.frames.push_back(std::move(frame));
    // Beyond what a page can show, every second is enough.
    constexpr std::size_t kMostBytes = std::size_t{256} << 20U;
    if (kept_bytes_ > kMostBytes && playback_.frames.size() > 4) {
      std::vector<particles::Frame> half;
      for (std::size_t i = 0; i < playback_.frames.size(); i += 2)
        half.push_back(std::move(playback_.frames[i]));
      playback_.frames = std::move(half);
      kept_bytes_ /= 2;
      every_ *= 2;
    }
  }

  fs::path folder_;
  const Provenance& provenance_;
  Playback playback_;
  std::vector<std::pair<double, std::string>> files_;
  std::size_t every_ = 1, kept_bytes_ = 0;
};

particles::State first_state(const ParticlesCase& c, const std::string& restart) {
  particles::State state;
  if (restart.empty()) {
    state.particles = c.particles;
    return state;
  }
  state = particles::read_restart(restart);
  const auto& p = state.particles;
  const auto differs = [&](const std::string& what) {
    throw_bad_input({restart}, fmt::format("is of other particles than {}: {}; a case that "
                                           "continues a run must have the same particles in the "
                                           "same order",
                                           c.path.string(), what));
  };
  if (p.dimension != c.particles.dimension)
    differs(fmt::format("{} dimensions, not {}", p.dimension, c.particles.dimension));
  if (p.count() != c.particles.count())
    differs(fmt::format("{}, not {}", p.count(), c.particles.count()));
  if (p.radii != c.particles.radii) differs("with other radii");
  if (p.masses != c.particles.masses) differs("with other masses");
  for (const auto& film : state.walls)
    if (static_cast<std::size_t>(-1 - film.first) >= c.setting.planes.size())
      differs(fmt::format("at plane {}, which is not there", -film.first));
  if (state.time > c.end_time * (1 - 1e-9))
    throw_bad_input({restart},
                    fmt::format("is at time {} and {} ends at {}, so that nothing is left to do",
                                state.time, c.path.string(), c.end_time));
  // Another step than before begins a grid of times of its own.
  const double on_grid =
      state.grid_time + static_cast<double>(state.steps - state.grid_step) * c.setting.time_step;
  if (std::abs(on_grid - state.time) > 1e-6 * c.setting.time_step) {
    state.grid_time = state.time;
    state.grid_step = state.steps;
  }
  return state;
}

nlohmann::ordered_json record_of(const ParticlesCase& c, const Record& record,
                                 const Simulation& simulation, double seconds) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto steps = static_cast<double>(std::max<std::int64_t>(record.steps, 1));
  nlohmann::ordered_json json;
  json["title"] = c.title;
  json["particles"] = simulation.state().particles.count();
  json["dimension"] = simulation.state().particles.dimension;
  json["from_time"] = record.first_time;
  json["to_time"] = record.last_time;
  json["time_step"] = c.setting.time_step;
  json["steps"] = record.steps;
  json["unconverged_steps"] = record.unconverged;
  json["iterations"] = record.iterations;
  json["mean_iterations"] = static_cast<double>(record.iterations) / steps;
  json["largest_iterations"] = record.most_iterations;
  json["tolerance"] = c.setting.solver.tolerance;
  json["largest_residual"] = record.largest_residual;
  json["largest_overlap"] = record.largest_overlap;
  json["final_overlap"] = particles::largest_overlap(simulation.setting(), simulation.state());
  json["seconds"] = seconds;
  json["peak_memory_mebibytes"] = static_cast<double>(usage.ru_maxrss) / 1024;
  return json;
}

constexpr const char* kResults[] = {
    "particles.pvd",      "particles.html", "particles.svg", "final_particles.csv",
    "final_contacts.csv", "steps.csv",      "restart.bin",   "run.json"};

/// A file of the name of a frame.
bool is_named_as_frame(const fs::path& path) {
  constexpr std::string_view kBegin = "particles_", kEnd = ".vtp";
  constexpr std::size_t kDigits = 5;
  const std::string name = path.filename();
  if (!name.starts_with(kBegin) || !name.ends_with(kEnd) ||
      name.size() < kBegin.size() + kDigits + kEnd.size())
    return false;
  const auto digits =
      std::string_view(name).substr(kBegin.size(), name.size() - kBegin.size() - kEnd.size());
  return std::ranges::all_of(digits, [](char d) { return d >= '0' && d <= '9'; });
}

/// Refuses a file that is no result of ours; by its head, where each says how it was made: the rest may be a gigabyte.
void check_is_ours(const fs::path& path) {
  if (!fs::is_regular_file(path)) return;
  constexpr std::size_t kHead = 65536;
  std::string head(kHead, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (file.gcount() > 0 && head.find("provenance") == std::string::npos)
    throw_bad_input({path.string()},
                    "is there and is no result of ours; remove it first, or write elsewhere");
}

/// Takes away what an earlier run left in the folder, so that at no time there is a mixture of two.
void remove_earlier_run(const fs::path& folder) {
  for (const auto* name : kResults) remove_file(folder / name);
  std::vector<fs::path> frames;
  for (const auto& entry : fs::directory_iterator(folder))
    if (is_named_as_frame(entry.path())) frames.push_back(entry.path());
  for (const auto& frame : frames) remove_file(frame);
}

/// Refuses to write over what is no result of ours.
void check_folder_is_ours(const fs::path& folder) {
  for (const auto* name : kResults) check_is_ours(folder / name);
  for (const auto& entry : fs::directory_iterator(folder))
    if (is_named_as_frame(entry.path())) check_is_ours(entry.path());
}

/// Refuses to write over what the run is made from.
void check_inputs_stay(const ParticlesCase& c, const fs::path& restart, const fs::path& folder) {
  std::error_code none;
  if (!restart.empty() && fs::equivalent(fs::absolute(restart).parent_path(), folder, none))
    throw_bad_input(
        {restart.string()},
        "belongs to the run in the output folder, whose frames and record would be lost; "
        "choose another folder");
  for (const auto& input : {c.path, c.particles_file}) {
    if (input.empty()) continue;
    for (const auto* output : kResults) {
      std::error_code ignored;
      if (fs::equivalent(input, folder / output, ignored))
        throw_bad_input({input.string()}, "would be overwritten by the run's " +
                                              std::string(output) + "; choose another folder");
    }
  }
}

/// A run on its way: everything in it is there to be written at any time.
class Run {
 public:
  Run(const ParticlesCase& c, Simulation& simulation, fs::path folder, const Provenance& provenance)
      : case_(c),
        simulation_(simulation),
        folder_(std::move(folder)),
        provenance_(provenance),
        frames_(folder_, provenance, simulation.state().particles) {
    record_.first_time = record_.last_time = simulation_.state().time;
  }

  /// To the end, or until it is interrupted.
  void simulate() {
    frames_.add(simulation_);
    save();
    // Times that differ by rounding are equal.
    const double tiny = 1e-6 * case_.setting.time_step;
    const double every = std::max(case_.frame_interval, case_.setting.time_step);
    double next_frame = record_.first_time + every;
    while (simulation_.state().time < case_.end_time - tiny && !interrupted()) {
      const auto report = simulation_.step(case_.end_time);
      record_.add(simulation_.state().steps, report);
      if (report.time >= next_frame - tiny) {
        frames_.add(simulation_);
        next_frame = record_.first_time +
                     (std::floor((report.time + tiny - record_.first_time) / every) + 1) * every;
      }
      tell(report);
      constexpr double kSaveEvery = 60;  // seconds
      if (seconds_since(last_saved_) > kSaveEvery) save();
    }
  }

  /// All that there is to see and to go on from. Returns the record.
  std::string write_results() {
    clear_progress();
    frames_.end(simulation_);
    save();
    const auto& state = simulation_.state();
    write("final_particles.csv", TextKind::kHashComment,
          particles::write_particles(state.particles));
    write("final_contacts.csv", TextKind::kHashComment,
          particles::write_contacts(particles::contacts_of(case_.setting, state)));
    constexpr int kPanels = 4;
    write("particles.html", TextKind::kHtml, particles_page(frames_.playback(), case_.title));
    write("particles.svg", TextKind::kSvg,
          particles_picture(frames_.playback(), case_.title, kPanels));
    const auto json = record_of(case_, record_, simulation_, seconds_since(begin_)).dump(2) + "\n";
    write("run.json", TextKind::kJson, json);
    return json;
  }

  const Record& record() const { return record_; }

 private:
  static double seconds_since(Clock::time_point time) {
    return std::chrono::duration<double>(Clock::now() - time).count();
  }
  void write(const char* name, TextKind kind, const std::string& text) const {
    write_output(folder_ / name, kind, text, provenance_);
  }

  /// What a killed run is gone on from, and the frames so far.
  void save() {
    write("restart.bin", TextKind::kHashComment, particles::write_restart(simulation_.state()));
    write("particles.pvd", TextKind::kXml, particles::write_pvd(frames_.files()));
    write("steps.csv", TextKind::kHashComment, record_.rows);
    last_saved_ = Clock::now();
  }

  void tell(const StepReport& report) {
    constexpr double kEvery = 0.2;  // seconds
    if (seconds_since(last_word_) < kEvery) return;
    show_progress(fmt::format(
        "particles: t = {:.4g} of {:.4g}, {} contacts, {} iterations, {:.3g} s", report.time,
        case_.end_time, report.contacts, report.iterations, seconds_since(begin_)));
    last_word_ = Clock::now();
  }

  const ParticlesCase& case_;
  Simulation& simulation_;
  fs::path folder_;
  const Provenance& provenance_;
  Frames frames_;
  Record record_;
  Clock::time_point begin_ = Clock::now(), last_word_ = begin_, last_saved_ = begin_;
};

/// The last words on a run that was written. Throws if it was interrupted or has a step that did not converge.
void judge(const ParticlesCase& c, const Record& record, const fs::path& folder) {
  say(fmt::format(
      "particles: {} steps to t = {:.6g}, {:.3g} iterations a step, largest residual {:.2g}, "
      "largest overlap {:.2g} mean radii; {}",
      record.steps, record.last_time,
      static_cast<double>(record.iterations) /
          static_cast<double>(std::max<std::int64_t>(record.steps, 1)),
      record.largest_residual, record.largest_overlap, (folder / "particles.html").string()));
  if (record.unconverged > 0)
    warn(fmt::format("particles: warning: {} of {} steps did not reach the tolerance {}",
                     record.unconverged, record.steps, c.setting.solver.tolerance));
  if (interrupted())
    say(fmt::format("particles: interrupted at t = {:.6g}; --restart {} goes on", record.last_time,
                    (folder / "restart.bin").string()));
  throw_if_interrupted();
  if (record.unconverged > 0)
    throw Error(ExitCode::kNotConverged,
                fmt::format("{}: {} of {} steps have a residual up to {:.2g}, not {}; all is "
                            "written, steps.csv says which; raise solver.max_iterations or "
                            "solver.tolerance, or do walls leave too little room?",
                            c.path.string(), record.unconverged, record.steps,
                            record.largest_residual, c.setting.solver.tolerance));
}

}  // namespace

void run_particles(const ParticlesRequest& request) {
  const ParticlesCase c = read_particles_case(request.case_file);
  std::vector<fs::path> inputs = {c.path};
  if (!c.particles_file.empty()) inputs.push_back(c.particles_file);
  if (!request.restart.empty()) inputs.emplace_back(request.restart);
  const Provenance provenance = provenance_of({inputs, {}});
  const fs::path folder = request.folder;
  check_inputs_stay(c, request.restart, folder);
  Simulation simulation(c.setting, first_state(c, request.restart), request.threads);
  const LockedFolder ours(folder, kFolderIsHeld);
  check_folder_is_ours(folder);
  remove_earlier_run(folder);

  Run run(c, simulation, folder, provenance);
  try {
    run.simulate();
  } catch (const Error&) {
    // A step that cannot be computed left the state before it: that is kept, too, unless it is the writing that failed.
    try {
      run.write_results();
    } catch (const Error&) {
    }
    throw;
  }
  const auto json = run.write_results();
  if (request.json) fmt::print("{}", json);
  judge(c, run.record(), folder);
}

}  // namespace viscontact
