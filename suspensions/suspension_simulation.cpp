// Instants and steps of a suspension.
#include "viscontact/suspensions/suspension_simulation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/suspensions/setting_checks.hpp"
#include "viscontact/suspensions/simulation_content.hpp"
#include "viscontact/suspensions/step/sphere_order.hpp"

namespace viscontact::particles {
namespace {

/// The factor by which the flow has changed, if motions times it are near those of the new flow;
/// else 1.
double change_of(double now_before, double before_before) {
  const double change = before_before > 0 ? now_before / before_before : 1;
  const double size = std::abs(change);
  return size * SuspensionTuning::kMostChange >= 1 && size <= SuspensionTuning::kMostChange ? change
                                                                                            : 1;
}

}  // namespace

suspensions::InstantSolution SuspensionSimulation::Content::solve_instant() {
  set_flow(state.time, state.time);
  const double given = stress ? 1 : state.shear.rate;
  suspensions::SymmetricTensor given_strain;
  given_strain.add(given, strain);
  const auto pairs = find_pairs(lubrication().range);
  const suspensions::PairSystem system(
      lubrication(), radii,
      suspensions::placed(pairs, radii, SuspensionTuning::kLeastGap * mean_radius), *pool);
  suspensions::InstantProblem problem{.system = &system,
                                      .strain = given_strain,
                                      .viscosity = lubrication().viscosity,
                                      .volume = volume,
                                      .loads = given_loads(state.time, state.time),
                                      .stress = stress,
                                      .least_resistance = std::min(lubrication().drag, 1.0),
                                      .pool = pool.get()};
  problem.load_stress = add_repulsion(pairs, problem.loads).stress;
  suspensions::InstantSolution solution;
  if (lubrication().inertia) {
    // The velocities are given.
    state.shear.rate = given;
    solution.motions = relative_motions();
  } else {
    solution = suspensions::solve_instant(problem, std::vector<Motion>(radii.size()),
                                          SuspensionTuning::kInstantTolerance);
    state.shear.rate = given * solution.rate;
    set_velocities(solution.motions);
  }
  suspensions::check_plane_motions(setting, gradient_now(), state.time, state.time);
  set_cell();

  suspensions::SymmetricTensor rate;
  rate.add(solution.rate, given_strain);
  suspensions::StressSums sums;
  sums.film.stress = system.stresslets(solution.motions, rate);
  sums.film.power = sums.film.stress.contracted(rate);
  sums.repulsion.stress = problem.load_stress;
  sums.repulsion.power = problem.load_stress.contracted(rate);
  rheology = {.time = state.time, .strain = state.shear.strain};
  rheology.net_strain = state.shear.net_strain;
  rheology.pairs = pairs.size();
  rheology.smallest_gap = smallest_gap(pairs);
  suspensions::set_stresses(sums, rate, 0, lubrication().viscosity, volume, rheology);
  set_sign(rheology);
  return solution;
}

SuspensionSimulation::SuspensionSimulation(Setting setting, State state, int threads)
    : content_(std::make_unique<Content>()) {
  auto& content = *content_;
  content.setting = std::move(setting);
  content.state = std::move(state);
  content.pool = std::make_unique<ThreadPool>(threads);
  assert(content.setting.lubrication && !content.setting.fluid);
  assert(content.particles().dimension == 3 && content.particles().turn());
  check_setting(content.setting, largest_distance(content.lubrication(), content.particles()));
  content.restore_flow();
  content.mean_radius = mean_radius(content.particles());
  content.volume = content.volume_of_region();
  content.planes = suspensions::planes_beside(content.setting);
  content.radii = content.particles().radii;
  content.radii.resize(content.radii.size() + content.planes.size(),
                       std::numeric_limits<double>::infinity());
  check_flow_before(content.setting, content.state);
  if (content.state.steps == 0 && content.state.time == 0 && !content.state.shear.has_periods()) {
    content.state.shear = {};
    content.state.shear.offset = content.cell().moved_offset(content.lubrication().offset);
  }
  content.start_periods();
  content.wrap();
  content.set_cell();
  check_spheres(content.setting, content.particles(),
                content.smallest_gap(content.find_pairs(content.lubrication().range)));
}

SuspensionSimulation::~SuspensionSimulation() = default;
SuspensionSimulation::SuspensionSimulation(SuspensionSimulation&&) noexcept = default;

const State& SuspensionSimulation::state() const { return content_->state; }
const Rheology& SuspensionSimulation::rheology() const { return content_->rheology; }

std::span<double> SuspensionSimulation::added_forces() {
  content_->has_instant = false;
  return added_forces_for(content_->particles(), content_->setting);
}
std::span<double> SuspensionSimulation::added_torques() {
  content_->has_instant = false;
  return added_torques_for(content_->particles(), content_->setting);
}

const Rheology& SuspensionSimulation::solve_instant() {
  if (!content_->solve_instant().converged)
    throw Error(ErrorKind::kNotConverged,
                "the velocities of the suspension at t = {:.6g} have not converged; its smallest "
                "gap is {:.3g}: with a regularisation the films of such gaps resist less",
                content_->state.time, content_->rheology.smallest_gap);
  content_->has_instant = true;
  return content_->rheology;
}

std::vector<suspensions::ContactMemory> SuspensionSimulation::Content::memories(double h) const {
  std::vector<suspensions::ContactMemory> result;
  result.reserve(state.pairs.size() + state.walls.size());
  const double before = state.earlier_step > 0 ? 1 / state.earlier_step : 0;
  const auto add = [&](const Pair& pair, std::int32_t first, std::int32_t second, double sign) {
    suspensions::ContactMemory memory{first, second};
    memory.load = before * pair.impulse;
    memory.friction = sign * before * state.memories.of(pair.memory).friction();
    if (contacts_have_films()) memory.least_load = pair.gamma / h;
    result.push_back(memory);
  };
  for (const auto& pair : state.pairs) add(pair, pair.first, pair.second, 1);
  const auto spheres = static_cast<std::int32_t>(state.particles.count());
  for (const auto& pair : state.walls) add(pair, pair.second, spheres - 1 - pair.first, -1);
  std::ranges::sort(result, {}, [](const suspensions::ContactMemory& memory) {
    return std::pair(memory.first, memory.second);
  });
  return result;
}

void SuspensionSimulation::Content::move(const suspensions::StepSolution& solution, double h) {
  const auto& motions = solution.motions;
  auto& p = particles();
  const auto now = gradient_now();
  const auto carries = suspensions::matrix_of(suspensions::carried, now, h);
  const auto mean = suspensions::matrix_of(suspensions::mean_carried, now, h);
  const auto velocities = p.velocities, angular_velocities = p.angular_velocities;
  for (std::size_t k = 0; k < p.count(); ++k) {
    const Vector v = suspensions::vector_of(motions[k].along);
    const Vector x = suspensions::times(carries, p.position(k)) + h * suspensions::times(mean, v);
    std::ranges::copy(x, &p.positions[3 * k]);
  }
  state.shear.gradient = now;
  strain_by(h);
  move_periods(h);
  const auto unwrapped = p.positions;
  wrap();
  set_velocities(motions);
  turn_particles(
      p,
      [&] {
        std::vector<double> turns = p.angular_velocities;
        for (auto& turn : turns) turn *= h;
        return turns;
      }(),
      h);
  for (std::size_t k = 0; k < solution.changes.size(); ++k) {
    // A sphere that leaves the cell enters it with the velocity of its image.
    const Vector shift = p.position(k) - point_of(unwrapped.data(), k, 3);
    const Vector v = point_of(velocities.data(), k, 3) +
                     suspensions::vector_of(solution.changes[k].along) + flow_at(shift);
    const Vector w = point_of(angular_velocities.data(), k, 3) +
                     suspensions::vector_of(solution.changes[k].turn);
    std::ranges::copy(v, &p.velocities[3 * k]);
    std::ranges::copy(w, &p.angular_velocities[3 * k]);
  }
  set_cell();
}

void SuspensionSimulation::Content::strain_by(double h) {
  const double rate = std::sqrt(2 * strain.contracted(strain));
  const double net = h * rate * std::abs(state.shear.rate);
  const auto& wave = lubrication().wave;
  state.shear.strain +=
      wave && !stress ? h * rate * wave->mean_magnitude_over(state.time, state.time + h) : net;
  state.shear.net_strain += signed_rate_of_strain(gradient_now()) < 0 ? -net : net;
}

void SuspensionSimulation::Content::add_inertia(suspensions::StepProblem& problem) const {
  const auto& p = state.particles;
  const auto& gradient_of_step = problem.gradient;
  const Vector rotation = suspensions::rotation_of(gradient_of_step);
  const auto mean = suspensions::matrix_of(suspensions::mean_carried, gradient_of_step, problem.h);
  for (std::size_t k = 0; k < p.count(); ++k) {
    const Vector last = suspensions::vector_of(problem.motions[k].along);
    // The flow moves x by exp(h G) x - x = h G (mean x).
    const Vector flow =
        suspensions::times(gradient_of_step, suspensions::times(mean, p.position(k))) +
        suspensions::times(mean, last) - last;
    suspensions::SphereInertia inertia{p.masses[k], p.inertias[k]};
    inertia.start.along = suspensions::lanes_of(p.velocity(k) - flow);
    inertia.start.turn =
        suspensions::lanes_of(point_of(p.angular_velocities.data(), k, 3) - rotation);
    problem.inertia.push_back(inertia);
  }
}

void SuspensionSimulation::Content::remember(
    const std::vector<suspensions::ContactMemory>& contacts, double h) {
  const auto cell_now = cell();
  std::vector<Pair> pairs, walls;
  pairs.reserve(contacts.size());
  PairMemories memories_now;
  const auto spheres = static_cast<std::int32_t>(state.particles.count());
  for (const auto& contact : contacts) {
    const bool has_plane = contact.second >= spheres;
    Pair pair{contact.first, contact.second};
    if (has_plane) pair = {spheres - 1 - contact.second, contact.first};
    pair.impulse = h * contact.load;
    double borne_by_film = 0;
    if (contacts_have_films()) {
      const double lowest = setting.laws.film.lowest_gamma(radii[index_of(contact.first)],
                                                           radii[index_of(contact.second)]);
      pair.gamma = h * contact.least_load;
      borne_by_film = pair.gamma - lowest;
      FilmLaw::absorb(pair, 0, lowest);
    }
    if (!has_plane) {
      const Vector apart = state.particles.position(index_of(pair.second)) -
                           state.particles.position(index_of(pair.first));
      // The image of the second sphere that is near has the opposite shift.
      const auto periods = cell_now.periods_towards(apart);
      pair.image = image_number(-static_cast<int>(periods[0]), -static_cast<int>(periods[1]),
                                -static_cast<int>(periods[2]));
    }
    PairMemory memory;
    // Files have the friction on the sphere beside a plane.
    memory.set_friction((has_plane ? -h : h) * contact.friction);
    memory[Remembered::kSolidLoad] = std::max(pair.impulse - borne_by_film, 0.0);
    memories_now.set(pair.memory, memory);
    if (pair.impulse != 0 || pair.gamma != 0) (has_plane ? walls : pairs).push_back(pair);
  }
  memories_now.keep_only(pairs, walls);
  state.pairs = std::move(pairs);
  state.walls = std::move(walls);
  state.memories = std::move(memories_now);
}

suspensions::StepSolution SuspensionSimulation::Content::solve_step(double h,
                                                                    std::vector<NearPair> pairs,
                                                                    std::vector<Motion> start,
                                                                    bool takes_given_bounds) {
  suspensions::StepProblem problem;
  problem.takes_given_bounds = takes_given_bounds;
  problem.lubrication = lubrication();
  if (setting.laws.friction) problem.friction = setting.laws.friction->coefficient;
  if (contacts_have_films()) problem.contact_film = &setting.laws.film;
  problem.radii = radii;
  problem.mean_radius = mean_radius;
  problem.memories = memories(h);
  problem.pool = pool.get();
  problem.motions = std::move(start);
  problem.loads = given_loads(state.time, state.time + h);
  problem.gradient = gradient_now();
  problem.h = h;
  if (lubrication().inertia) add_inertia(problem);
  auto repulsion = add_repulsion(pairs, problem.loads);
  problem.pairs = std::move(pairs);
  const auto is_zero = [](const Motion& load) {
    return suspensions::dot(load.along, load.along) == 0 &&
           suspensions::dot(load.turn, load.turn) == 0;
  };
  if (std::ranges::all_of(problem.loads, is_zero)) problem.loads = std::vector<Motion>();
  if (stress) {
    auto& given = problem.stress.emplace();
    given.gradient = gradient;
    given.rate = state.shear.rate;
    given.of_fluid = 2 * lubrication().viscosity * volume * strain.contracted(strain);
    given.of_stress = volume * *stress;
    given.of_repulsion = repulsion.power;
  }
  auto solution = particles().count() > SuspensionTuning::kMostUnordered
                      ? suspensions::solve_in_order(
                            std::move(problem), suspensions::spatial_order(particles().positions))
                      : suspensions::SuspensionStep(std::move(problem)).solve();
  if (stress) state.shear.rate = solution.rate;
  repulsion.power *= state.shear.rate;
  solution.stresses.repulsion = repulsion;
  return solution;
}

double SuspensionSimulation::Content::first_length(double whole) const {
  if (!setting.laws.friction || !follows_a_halved_step()) return whole;
  double h = whole;
  while (h > SuspensionTuning::kMostGrowth * state.earlier_step) h /= 2;
  return h;
}

bool SuspensionSimulation::Content::follows_a_halved_step() const {
  if (!(state.earlier_step > 0)) return false;
  const double tiny = StepGrid::tiny(setting.time_step);
  const auto jumps = jump_times(setting);
  const auto is_jump = [&](double time) {
    return std::ranges::any_of(jumps, [&](double jump) { return std::abs(jump - time) <= tiny; });
  };
  const auto since = static_cast<double>(state.steps - state.grid_step);
  const bool is_on_grid =
      std::abs(state.grid_time + since * setting.time_step - state.time) <= tiny;
  if (!is_on_grid) return !is_jump(state.time);
  // The rest of a halved step ends on the grid, too, but not where a run ended or the flow changed.
  return since > 0 && state.earlier_step < setting.time_step - tiny &&
         !is_jump(state.time - state.earlier_step);
}

void SuspensionSimulation::Content::check_unsolved() const {
  if (unsolved < SuspensionTuning::kMostUnsolved) return;
  throw Error(ErrorKind::kNotConverged,
              "the spheres jam at t = {:.6g}, the strain {:.6g}: no motion was found that obeys "
              "Coulomb's law in {} steps one after the other; use a smaller volume fraction, less "
              "friction, or a shorter step",
              state.time, state.shear.strain, unsolved);
}

std::vector<Motion> SuspensionSimulation::Content::start_of_step(double h) {
  restore_flow();
  const auto stress_before = stress;
  const auto strain_before = strain_now();
  auto motions = relative_motions();
  set_flow(state.time, state.time + h);
  // With inertia the motions at the start are given, relative to the new flow.
  if (lubrication().inertia) motions = relative_motions();
  // Motions of a suspension at another rate are nearly proportional to it.
  const double change = stress && stress_before
                            ? change_of(*stress * *stress_before, *stress_before * *stress_before)
                            : change_of(strain_now().contracted(strain_before),
                                        strain_before.contracted(strain_before));
  if (stress) state.shear.rate *= change;
  if (change != 1 && !lubrication().inertia)
    for (auto& motion : motions) {
      motion.along *= change;
      motion.turn *= change;
    }
  return motions;
}

void SuspensionSimulation::Content::set_rheology(const suspensions::StepSolution& solution,
                                                 std::size_t pairs_in_range, int solutions) {
  rheology = {.time = state.time, .strain = state.shear.strain};
  rheology.net_strain = state.shear.net_strain;
  rheology.pairs = pairs_in_range;
  rheology.contacts = solution.touching;
  rheology.smallest_gap = solution.smallest_gap;
  rheology.dissipation = solution.dissipation;
  suspensions::set_stresses(solution.stresses, strain_now(), solution.least_rate,
                            lubrication().viscosity, volume, rheology);
  set_sign(rheology);
  rheology.solutions = solutions;
}

SuspensionSimulation::Content::MovedStep SuspensionSimulation::Content::move_by_step(double whole) {
  const auto start = state.shear;
  const double allowed = std::max(largest_overlap(), SuspensionTuning::kMostOverlap * mean_radius);
  const double first = first_length(whole);
  // After a step that was even shorter, lengths down to its own are tried.
  const double shortest = std::ldexp(whole, -SuspensionTuning::kMostHalvings);
  const double least = first < whole ? std::min(shortest, state.earlier_step) : shortest;
  const double most_for_friction = std::ldexp(whole, -SuspensionTuning::kMostForFriction);
  MovedStep step;
  for (step.h = first; step.h >= least; step.h /= 2) {
    // The first trial has to obey Coulomb's law.
    const bool takes_given_bounds = step.h <= most_for_friction && step.h < first;
    auto motions = start_of_step(step.h);
    auto pairs = find_pairs(search_range(step.h, motions));
    step.pairs_in_range = static_cast<std::size_t>(
        std::ranges::count_if(pairs, [&](const NearPair& pair) { return is_in_range(pair); }));
    step.solution = solve_step(step.h, std::move(pairs), std::move(motions), takes_given_bounds);
    const auto& solution = step.solution;
    step.iterations += solution.iterations;
    step.solutions += solution.solutions;
    const bool is_taken = solution.is_solved && std::isfinite(solution.dissipation) &&
                          (solution.converged || takes_given_bounds);
    if (is_taken) {
      suspensions::check_plane_motions(setting, gradient_now(), state.time, state.time + step.h);
      auto not_moved = state;
      move(solution, step.h);
      step.overlap = largest_overlap();
      if (step.overlap <= allowed) return step;
      state = std::move(not_moved);
    }
    state.shear = start;
  }
  restore_flow();
  throw Error(ErrorKind::kNotConverged,
              "the spheres jam at t = {:.6g}, the strain {:.6g}: a step of {:.3g} has no "
              "solution; use a smaller volume fraction, less friction, or a shorter step",
              state.time, start.strain, 2 * step.h);
}

StepReport SuspensionSimulation::step(double end) {
  auto& content = *content_;
  auto& state = content.state;
  StepReport report;
  report.time = state.time;
  const auto interval = content.grid().next(state, end);
  if (!interval) return report;
  content.check_images();
  content.check_unsolved();
  // The first step begins with these velocities, whatever their error.
  if (state.steps == 0 && !content.has_instant) content.solve_instant();
  content.has_instant = false;
  const auto moved = content.move_by_step(interval->h);
  const auto& solution = moved.solution;
  report.parts = 1;
  report.iterations = moved.iterations;
  report.contacts = solution.touching;
  report.residual = solution.residual;
  report.converged = solution.converged;
  if (!report.converged) report.excess = std::numeric_limits<double>::infinity();
  report.has_given_loads = solution.has_given_loads;
  report.largest_overlap = moved.overlap / content.mean_radius;
  content.unsolved = solution.has_given_loads ? content.unsolved + 1 : 0;
  auto taken = *interval;
  if (moved.h < interval->h) {
    // The next step goes on to the same point of the grid.
    taken.h = moved.h;
    taken.end = state.time + moved.h;
    taken.new_grid = interval->end - content.setting.time_step;
  }
  content.remember(solution.contacts, moved.h);
  state.time = taken.end;
  state.earlier_step = moved.h;
  StepGrid::count(state, taken);
  report.time = state.time;
  content.set_rheology(solution, moved.pairs_in_range, moved.solutions);
  return report;
}

}  // namespace viscontact::particles
