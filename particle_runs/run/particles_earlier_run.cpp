// A run is continued only if restart.bin records the inputs and the version of this call.
#include "viscontact/particle_runs/run/particles_earlier_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "viscontact/arrangement/species.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/constraint_rows/link_rows.hpp"
#include "viscontact/particle_runs/io/restart.hpp"
#include "viscontact/particle_runs/io/vtk.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/results/foreign_files.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::particles {
namespace {

namespace fs = std::filesystem;

/// Says how the inputs (their order and hashes) or the versions differ; empty if they are equal.
std::string difference(const results::Provenance& before, const results::Provenance& now) {
  const auto version = [](const results::Provenance& provenance) {
    const auto found = provenance.versions.find("Viscontact");
    return found == provenance.versions.end() ? std::string() : found->second;
  };
  if (version(before) != version(now))
    return fmt::format("was made by Viscontact {}, and this is Viscontact {}", version(before),
                       version(now));
  if (before.inputs.size() != now.inputs.size()) return "has other input files";
  for (std::size_t i = 0; i < now.inputs.size(); ++i)
    if (now.inputs[i].sha256.empty() || before.inputs[i].sha256 != now.inputs[i].sha256)
      return fmt::format("was made from another version of {}", now.inputs[i].file);
  return "";
}

/// Says how the source differs; empty if it adds the same particles at the same times.
std::string difference(const SourceProgress& before, const Source& now) {
  if (before.begin_of_case != now.begin)
    return fmt::format("begins at {}, not {}", before.begin_of_case, now.begin);
  if (before.rate != now.rate)
    return fmt::format("pours {} particles in a unit of time, not {}", before.rate, now.rate);
  if (before.seed != now.seed) return "has another seed";
  if (before.species != hash_of(now.species))
    return "has particles of other radii, densities, masses or shares";
  return "";
}

/// Throws Error(kBadInput), which names `restart`, unless the state has the particles of the case,
/// with the same radii and masses, and then those that its sources have added, and only contacts
/// with obstacles of the case. Places and velocities may be any.
void check_same_particles(const State& state, const ParticlesCase& c, const fs::path& restart) {
  const auto& p = state.particles;
  const auto differs = [&](const std::string& what) {
    throw_bad_input(
        {restart.string()},
        "has other particles than {}: {}; a case that continues a run must have the same particles "
        "and sources in the same order, and may have more sources after them",
        c.path.string(), what);
  };
  if (p.dimension != c.particles.dimension)
    differs(fmt::format("{} dimensions, not {}", p.dimension, c.particles.dimension));
  const auto& sources = c.setting.sources;
  if (state.sources.size() > sources.size())
    differs(fmt::format("{} sources, not {}", state.sources.size(), sources.size()));
  std::size_t count = c.particles.count(), ids = 0;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    std::size_t poured = 0;
    if (s < state.sources.size()) {
      if (const auto how = difference(state.sources[s], sources[s]); !how.empty())
        differs(fmt::format("source[{}] {}", s, how));
      poured = static_cast<std::size_t>(state.sources[s].poured);
    }
    count += poured;
    ids += std::max(poured, sources[s].due(sources[s].end));
  }
  if (ids > ids_left(c.particles))
    differs(fmt::format("its sources need {} ids, and {} are left", ids, ids_left(c.particles)));
  if (p.count() != count) differs(fmt::format("{} particles, not {}", p.count(), count));
  const auto begins_with = [](const std::vector<double>& all, const std::vector<double>& begin) {
    return std::equal(begin.begin(), begin.end(), all.begin());
  };
  if (!begins_with(p.radii, c.particles.radii)) differs("other radii");
  if (!begins_with(p.masses, c.particles.masses)) differs("other masses");
  const auto obstacles = obstacles_of(c.setting).size();
  const auto check_first = [&](std::int32_t first) {
    if (first < 0 && static_cast<std::size_t>(-1 - first) >= obstacles)
      differs(fmt::format("a contact with obstacle {}, which the case does not have", first));
  };
  const auto& planes = c.setting.planes;
  if (!state.planes.empty() && state.planes.size() != planes.size())
    differs(fmt::format("{} planes, not {}", state.planes.size(), planes.size()));
  for (std::size_t k = 0; k < state.planes.size(); ++k)
    if (!planes[k].load && state.planes[k] != PlaneMotion{})
      differs(fmt::format("a load that has moved plane {}, which has none in the case",
                          -static_cast<std::ptrdiff_t>(obstacles - planes.size() + k + 1)));
  for (const auto& load : state.given_loads)
    if (!c.setting.given_motions.contains(load.particle))
      differs(
          fmt::format("a given motion of particle {}", c.particles.id(index_of(load.particle))));
  for (const auto& film : state.walls) check_first(film.first);
  for (const auto& impact : state.impact_impulses) check_first(impact.first);
}

/// The restart file stores no ids and shapes, nor those of particles that sources have added.
void take_over_ids_and_shapes(State& state, const ParticlesCase& c) {
  state.particles.ids = c.particles.ids;
  add_missing_ids(state.particles);
  state.particles.shapes = c.particles.shapes;
  add_missing_shapes(state.particles);
}

/// The restart file stores the motion of bodies only. Throws Error(kBadInput) if it has another
/// number of bodies or of forces of links.
void take_over_bodies(State& state, const ParticlesCase& c, const fs::path& restart) {
  const auto moving = std::move(state.particles.bodies.bodies);
  state.particles.bodies = c.particles.bodies;
  if (!c.particles.bodies.empty())
    state.particles.bodies.of_particle.resize(state.particles.count(), -1);
  auto& bodies = state.particles.bodies.bodies;
  if (moving.size() != bodies.size())
    throw_bad_input(
        {restart.string()},
        "has {} rigid bodies, and {} has {}; a case that continues a run must have the same bodies",
        moving.size(), c.path.string(), bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) bodies[b].BodyMotion::operator=(moving[b]);
  const auto forces = c.setting.links.force_count(c.particles.dimension);
  if (!state.link_forces.empty() && state.link_forces.size() != forces)
    throw_bad_input({restart.string()}, "has the forces of other hinges, springs or arms than {}",
                    c.path.string());
}

/// Throws Error(kBadInput) if a hinge of the state is turned beyond its stop, because the first
/// step would turn it back at once: the earlier run had another stop.
void check_stops(const State& state, const ParticlesCase& c, const fs::path& restart) {
  // A step may leave a point at the distance of one mean radius from the hinge beyond the stop by
  // solver.tolerance mean radii, which is the angle solver.tolerance [rad].
  constexpr double kBeyond = 1e-3;  // [rad]
  const double allowed = std::max(kBeyond, 10 * c.setting.solver.tolerance);
  for (const auto& stop : stop_equations(c.setting.links, state.particles))
    if (const double left = stop.rows.front().value; left < -allowed)
      throw_bad_input({restart.string()}, "has hinge {} turned beyond its {} in {} by {:.3g} rad",
                      stop.number,
                      stop.parts().front().direction[2] > 0 ? "lowest_angle" : "highest_angle",
                      c.path.string(), -left);
}

}  // namespace

State first_state(const ParticlesCase& c, const std::string& restart) {
  State state;
  if (restart.empty()) {
    state.particles = c.particles;
    return state;
  }
  state = read_restart(restart);
  check_same_particles(state, c, restart);
  take_over_ids_and_shapes(state, c);
  take_over_bodies(state, c, restart);
  if (c.particles.turn() && !state.particles.turn()) {
    // In the earlier run particles did not turn, so that its restart file has no angles.
    state.particles.angles = c.particles.angles;
    state.particles.orientations = c.particles.orientations;
    state.particles.angular_velocities = c.particles.angular_velocities;
    state.particles.inertias = c.particles.inertias;
    add_rotation(state.particles);
  }
  check_stops(state, c, restart);
  if (state.time > c.end_time * (1 - 1e-9))  // 1e-9 and 1e-6 are above rounding errors
    throw_bad_input({restart},
                    "is at time {}, but {} ends at {}, so there is no time left to simulate",
                    state.time, c.path.string(), c.end_time);
  // If the time step has changed, steps end at multiples of the new time step after the time of
  // this state (State::grid_time).
  const double on_grid =
      state.grid_time + static_cast<double>(state.steps - state.grid_step) * c.setting.time_step;
  if (std::abs(on_grid - state.time) > 1e-6 * c.setting.time_step) {
    state.grid_time = state.time;
    state.grid_step = state.steps;
  }
  return state;
}

std::optional<EarlierRun> find_earlier_run(const ParticlesCase& c, const fs::path& folder,
                                           const results::Provenance& provenance,
                                           const RunLog& log) {
  const auto restart = folder / "restart.bin";
  if (!fs::is_regular_file(restart)) return {};
  try {
    const auto head = results::read_head(restart);
    const auto before = results::provenance_in(head, restart.string());
    const std::string other =
        before ? difference(*before, provenance) : "does not say what it was made from";
    if (!other.empty()) {
      terminal::say("particles: the run in {} {}, so it is replaced by a run from the start",
                    folder.string(), other);
      return {};
    }
    EarlierRun run{read_restart(restart), read_record(head, restart)};
    check_same_particles(run.state, c, restart);
    take_over_ids_and_shapes(run.state, c);
    take_over_bodies(run.state, c, restart);
    log.check(run.record);
    return run;
  } catch (const Error& error) {
    terminal::say(
        "particles: the run in {} cannot be continued ({}), so it is replaced by a run from the "
        "start",
        folder.string(), error.what());
    return {};
  }
}

bool is_finished(const EarlierRun& run, const ParticlesCase& c, double tiny,
                 const fs::path& folder) {
  assert(tiny >= 0);
  if (run.state.time < c.end_time - tiny) return false;
  const auto is_there = [&](const auto& name) { return fs::is_regular_file(folder / name); };
  const auto written_at_end = std::to_array<const char*>(
      {"particles.html", "particles.svg", "final_particles.csv", "final_contacts.csv"});
  if (!std::ranges::all_of(written_at_end, is_there)) return false;
  if (c.setting.lubrication && !is_there("pair_distribution.csv")) return false;
  const bool has_box = !std::holds_alternative<std::monostate>(c.setting.domain);
  if (c.setting.lubrication && has_box && !is_there("rheology.svg")) return false;
  try {
    // run.json is the last file that a run writes before restart.bin.
    const auto json = nlohmann::json::parse(read_file(folder / "run.json"));
    if (json.at("to_time") != run.state.time) return false;
    for (const auto& [name, end] : run.record.files)
      if (name.ends_with(".pvd"))
        for (const auto& [time, frame] : read_pvd(folder / name))
          if (!is_there(frame)) return false;
    return true;
  } catch (const std::exception&) {
    return false;  // a damaged file: the run continues and writes it again
  }
}

}  // namespace viscontact::particles
