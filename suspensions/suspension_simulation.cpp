// The state of a suspension and its instantaneous problem.
#include "viscontact/suspensions/suspension_simulation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/particles/steps/step_times.hpp"
#include "viscontact/suspensions/instant.hpp"
#include "viscontact/suspensions/pair_search.hpp"
#include "viscontact/suspensions/pair_system.hpp"
#include "viscontact/suspensions/sheared_cell.hpp"
#include "viscontact/suspensions/stress_sums.hpp"
#include "viscontact/suspensions/suspension_step.hpp"

namespace viscontact::particles {
namespace {

using suspensions::Motion;
using suspensions::NearPair;
using suspensions::ShearedCell;

struct SuspensionTuning {
  // Of an instant, relative; errors of the power are about its square.
  static constexpr double kInstantTolerance = 1e-11;
  // Gaps below this fraction of the mean radius count as rounding errors.
  static constexpr double kLeastGap = 1e-12;
  // In mean radii: the least range of the search, because spheres move in a step.
  static constexpr double kLeastSearch = 0.2;
  // Error of a given stress, relative, and solutions of a step for it.
  static constexpr double kStressTolerance = 1e-8;
  static constexpr int kMostRates = 12;
  // Overlap at the start, in mean radii, that counts as rounding errors of a file.
  static constexpr double kMostStartOverlap = 1e-6;
  // Overlap that no step leaves, in mean radii: half of what is allowed, because a step that cannot
  // end before it is still taken for a millionth of its length.
  static constexpr double kMostOverlap = 5e-8;
};

void check_cell(const Setting& setting, const Particles& particles) {
  const auto& lubrication = *setting.lubrication;
  const auto periods = periods_of(setting.domain);
  const double distance = suspensions::largest_distance(particles.radii, lubrication.range);
  for (const double period : periods)
    if (period > 0 && period < 2 * distance)
      throw Error(
          ErrorKind::kBadInput,
          "the period {} is too short for the range of lubrication: it must be at least {}, "
          "twice the largest distance of a pair",
          period, 2 * distance);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (periods[j] > 0 && lubrication.gradient[i][j] != 0 && !(i == 0 && j == 1))
        throw Error(ErrorKind::kBadInput,
                    "the flow changes along a periodic axis; only a velocity along x may change, "
                    "along y");
  if (periods[1] > 0 && !(periods[0] > 0) && lubrication.gradient[0][1] != 0)
    throw Error(ErrorKind::kBadInput, "a shear flow with a period along y needs one along x");
}

void check_spheres(const Setting& setting, const Particles& particles, double smallest_gap) {
  if (!setting.given_motions.empty())
    throw Error(ErrorKind::kBadInput,
                "spheres with lubrication cannot have given motions; give them forces");
  if (smallest_gap < -SuspensionTuning::kMostStartOverlap * mean_radius(particles))
    throw Error(ErrorKind::kBadInput, "two spheres overlap by {} at the start; they must not",
                -smallest_gap);
}

}  // namespace

struct SuspensionSimulation::Content {
  Setting setting;
  State state;
  std::array<Vector, 3> gradient{};  // of the flow of rate 1
  suspensions::SymmetricTensor strain{};
  double mean_radius = 1, volume = 0;
  Rheology rheology;

  const PairLubrication& lubrication() const { return *setting.lubrication; }
  Particles& particles() { return state.particles; }
  /// Those of viscous contact, (9.14).
  bool contacts_have_films() const { return lubrication().pairs == PairTerms::kNone; }
  ShearedCell cell() const {
    ShearedCell cell;
    if (const auto* box = std::get_if<BoxDomain>(&setting.domain)) cell.from = box->from;
    cell.lengths = periods_of(setting.domain);
    cell.offset = state.shear.offset;
    return cell;
  }
  double box_volume() const {
    const double measured = measure(setting.domain);
    return measured > 0 ? measured : std::numeric_limits<double>::infinity();
  }
  /// The image displacements that tables of contacts need.
  void set_cell() {
    auto& shown = particles().cell;
    shown = cell_of(setting.domain);
    const double slope = shown.lengths[1] > 0 ? state.shear.offset / shown.lengths[1] : 0;
    // A displacement without a velocity is that of a gradient which acted for the time 1.
    const double rate = state.shear.rate * gradient[0][1];
    shown.gradient = {0, rate != 0 ? rate : slope, 0, 0};
    shown.moved_for = rate != 0 ? slope / rate : 1;
  }
  void wrap() {
    const auto cell_now = cell();
    for (std::size_t k = 0; k < particles().count(); ++k) {
      const Vector x = cell_now.wrapped(particles().position(k));
      std::ranges::copy(x, &particles().positions[3 * k]);
    }
  }

  Vector flow_at(const Vector& x) const {
    return state.shear.rate * suspensions::times(gradient, x);
  }
  std::vector<Motion> relative_motions() const {
    const auto& p = state.particles;
    const Vector rotation = state.shear.rate * suspensions::rotation_of(gradient);
    std::vector<Motion> motions(p.count());
    for (std::size_t k = 0; k < motions.size(); ++k) {
      motions[k].along = suspensions::lanes_of(p.velocity(k) - flow_at(p.position(k)));
      motions[k].turn =
          suspensions::lanes_of(point_of(p.angular_velocities.data(), k, 3) - rotation);
    }
    return motions;
  }
  void set_velocities(const std::vector<Motion>& motions) {
    auto& p = particles();
    const Vector rotation = state.shear.rate * suspensions::rotation_of(gradient);
    for (std::size_t k = 0; k < motions.size(); ++k) {
      std::ranges::copy(suspensions::vector_of(motions[k].along) + flow_at(p.position(k)),
                        &p.velocities[3 * k]);
      std::ranges::copy(suspensions::vector_of(motions[k].turn) + rotation,
                        &p.angular_velocities[3 * k]);
    }
  }

  /// The mean factor on the gradient of the setting; 1 with a given stress.
  double given_rate(double from, double to) const {
    const auto& factor = lubrication().rate_factor;
    if (factor.pieces.empty() || lubrication().stress) return 1;
    return to > from ? factor.mean(from, to)[0] : factor.value(from)[0];
  }
  std::array<Vector, 3> gradient_now() const {
    auto now = gradient;
    for (auto& row : now) row = state.shear.rate * row;
    return now;
  }

  /// Forces and torques that do not depend on the motion.
  std::vector<Motion> given_loads(double time) const {
    const auto& p = state.particles;
    std::vector<Motion> loads(p.count());
    const auto at = [&](const auto& map, std::size_t k) {
      const auto found = map.find(static_cast<std::int32_t>(k));
      return found == map.end() ? Vector{} : found->second.value(time);
    };
    for (std::size_t k = 0; k < loads.size(); ++k) {
      const double mass = p.masses.empty() ? 0 : p.masses[k];
      loads[k].along = suspensions::lanes_of(mass * setting.gravity + at(setting.forces, k) +
                                             added_force(setting, k, 3));
      loads[k].turn = suspensions::lanes_of(at(setting.torques, k) + added_torque(setting, k, 3));
    }
    return loads;
  }
  /// Adds the repulsion of the pairs to `loads`. Returns its part of the stress sums.
  suspensions::StressPart add_repulsion(const std::vector<NearPair>& pairs,
                                        std::vector<Motion>& loads) const {
    suspensions::StressPart sum;
    if (!lubrication().repulsion) return sum;
    const auto [amplitude, length] = *lubrication().repulsion;
    for (const auto& pair : pairs) {
      const auto i = index_of(pair.first), j = index_of(pair.second);
      const double a = state.particles.radii[i], b = state.particles.radii[j];
      const double distance = norm(pair.apart);
      const double force = amplitude * a * b / (a + b) * std::exp(-(distance - a - b) / length);
      const auto push = suspensions::lanes_of((force / distance) * pair.apart);
      loads[i].along -= push;
      loads[j].along += push;
      sum.add_pair_force(suspensions::vector_of(push), pair.apart, gradient_now());
    }
    return sum;
  }
  std::vector<NearPair> find_pairs(double least_range = 0) const {
    return suspensions::near_pairs(cell(), state.particles.positions, state.particles.radii,
                                   std::max(lubrication().range, least_range));
  }
  double smallest_gap(const std::vector<NearPair>& pairs) const {
    double smallest = std::numeric_limits<double>::infinity();
    for (const auto& pair : pairs)
      smallest = std::min(smallest, norm(pair.apart) - state.particles.radii[index_of(pair.first)] -
                                        state.particles.radii[index_of(pair.second)]);
    return smallest;
  }

  suspensions::InstantSolution solve_instant();
  std::vector<suspensions::ContactMemory> memories(double h) const;
  /// `before` are the motions of the last step. Sets the rate if the stress is given.
  suspensions::StepSolution solve_step(double h, const std::vector<NearPair>& pairs,
                                       const std::vector<Motion>& before);
  /// The part of a step of length h up to which spheres that move by `motions` do not overlap.
  double free_part(const std::vector<NearPair>& pairs, const std::vector<Motion>& motions,
                   double h) const;
  void move(const std::vector<Motion>& motions, double h);
  void remember(const std::vector<suspensions::ContactMemory>& contacts, double h);
};

suspensions::InstantSolution SuspensionSimulation::Content::solve_instant() {
  const double given = given_rate(state.time, state.time);
  suspensions::SymmetricTensor given_strain;
  given_strain.add(given, strain);
  const auto pairs = find_pairs();
  const suspensions::PairSystem system(
      lubrication(), state.particles.radii,
      suspensions::placed(pairs, state.particles.radii, SuspensionTuning::kLeastGap * mean_radius));
  suspensions::InstantProblem problem{
      &system, given_strain,        lubrication().viscosity, volume, given_loads(state.time),
      {},      lubrication().stress};
  problem.softest = std::min(lubrication().drag, 1.0);
  problem.load_stress = add_repulsion(pairs, problem.loads).stress;
  auto solution = suspensions::solve_instant(problem, std::vector<Motion>(state.particles.count()),
                                             SuspensionTuning::kInstantTolerance);
  state.shear.rate = given * solution.rate;
  set_velocities(solution.motions);
  set_cell();

  suspensions::SymmetricTensor rate;
  rate.add(solution.rate, given_strain);
  suspensions::StressSums sums;
  sums.film.stress = system.stresslets(solution.motions, rate);
  sums.film.power = sums.film.stress.contracted(rate);
  sums.repulsion.stress = problem.load_stress;
  sums.repulsion.power = problem.load_stress.contracted(rate);
  rheology = {.time = state.time, .strain = state.shear.strain};
  rheology.pairs = pairs.size();
  rheology.smallest_gap = smallest_gap(pairs);
  suspensions::set_stresses(sums, rate, lubrication().viscosity, volume, rheology);
  return solution;
}

SuspensionSimulation::SuspensionSimulation(Setting setting, State state, int /*threads*/)
    : content_(std::make_unique<Content>()) {
  auto& content = *content_;
  content.setting = std::move(setting);
  content.state = std::move(state);
  assert(content.setting.lubrication && !content.setting.fluid);
  assert(content.particles().dimension == 3 && content.particles().turn());
  check_cell(content.setting, content.particles());
  content.gradient = content.lubrication().gradient;
  content.strain = suspensions::strain_rate_of(content.gradient);
  content.mean_radius = mean_radius(content.particles());
  content.volume = content.box_volume();
  if (content.state.steps == 0 && content.state.time == 0) {
    content.state.shear = {};
    content.state.shear.offset = content.cell().moved_offset(content.lubrication().offset);
  }
  content.wrap();
  content.set_cell();
  check_spheres(content.setting, content.particles(), content.smallest_gap(content.find_pairs()));
}

SuspensionSimulation::~SuspensionSimulation() = default;
SuspensionSimulation::SuspensionSimulation(SuspensionSimulation&&) noexcept = default;

const State& SuspensionSimulation::state() const { return content_->state; }
const Rheology& SuspensionSimulation::rheology() const { return content_->rheology; }

std::span<double> SuspensionSimulation::added_forces() {
  return added_forces_for(content_->particles(), content_->setting);
}
std::span<double> SuspensionSimulation::added_torques() {
  return added_torques_for(content_->particles(), content_->setting);
}

const Rheology& SuspensionSimulation::solve_instant() {
  if (!content_->solve_instant().converged)
    throw Error(ErrorKind::kNotConverged, "the velocities of the suspension have not converged");
  return content_->rheology;
}

std::vector<suspensions::ContactMemory> SuspensionSimulation::Content::memories(double h) const {
  std::vector<suspensions::ContactMemory> result;
  for (const auto& pair : state.pairs) {
    suspensions::ContactMemory memory{pair.first, pair.second};
    const double before = state.earlier_step > 0 ? 1 / state.earlier_step : 0;
    memory.load = before * pair.impulse;
    memory.friction = before * state.memories.of(pair.memory).friction();
    if (contacts_have_films()) memory.least_load = pair.gamma / h;
    result.push_back(memory);
  }
  return result;
}

double SuspensionSimulation::Content::free_part(const std::vector<NearPair>& pairs,
                                                const std::vector<Motion>& motions,
                                                double h) const {
  const auto now = gradient_now();
  const double overlap = SuspensionTuning::kMostOverlap * mean_radius;
  const auto is_free = [&](const NearPair& pair, double part) {
    const auto i = index_of(pair.first), j = index_of(pair.second);
    const double sum = state.particles.radii[i] + state.particles.radii[j];
    const Vector change = suspensions::vector_of(motions[j].along - motions[i].along);
    const Vector apart = suspensions::carried(now, part * h, pair.apart) +
                         part * h * suspensions::mean_carried(now, part * h, change);
    return norm(apart) - sum >= std::min(norm(pair.apart) - sum, -overlap);
  };
  double part = 1;
  for (const auto& pair : pairs)
    while (part > 1e-6 && !is_free(pair, part)) part /= 2;
  return part;
}

void SuspensionSimulation::Content::move(const std::vector<Motion>& motions, double h) {
  auto& p = particles();
  const auto now = gradient_now();
  for (std::size_t k = 0; k < p.count(); ++k) {
    const Vector v = suspensions::vector_of(motions[k].along);
    const Vector x =
        suspensions::carried(now, h, p.position(k)) + h * suspensions::mean_carried(now, h, v);
    std::ranges::copy(x, &p.positions[3 * k]);
  }
  const double displacement = h * now[0][1] * periods_of(setting.domain)[1];
  state.shear.offset = cell().moved_offset(displacement);
  state.shear.strain += h * std::sqrt(2 * strain.contracted(strain)) * std::abs(state.shear.rate);
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
  set_cell();
}

void SuspensionSimulation::Content::remember(
    const std::vector<suspensions::ContactMemory>& contacts, double h) {
  std::vector<Pair> pairs;
  PairMemories memories_now;
  for (const auto& contact : contacts) {
    Pair pair{contact.first, contact.second};
    pair.impulse = h * contact.load;
    if (contacts_have_films()) {
      pair.gamma = h * contact.least_load;
      FilmLaw::absorb(pair, 0,
                      setting.laws.film.lowest_gamma(state.particles.radii[index_of(pair.first)],
                                                     state.particles.radii[index_of(pair.second)]));
    }
    const Vector apart = state.particles.position(index_of(pair.second)) -
                         state.particles.position(index_of(pair.first));
    // The image of the second sphere that is near has the opposite shift.
    const auto periods = cell().periods_towards(apart);
    pair.image = image_number(-static_cast<int>(periods[0]), -static_cast<int>(periods[1]),
                              -static_cast<int>(periods[2]));
    PairMemory memory;
    memory.set_friction(h * contact.friction);
    memories_now.set(pair.memory, memory);
    if (pair.impulse != 0 || pair.gamma != 0) pairs.push_back(pair);
  }
  memories_now.keep_only(pairs);
  state.pairs = std::move(pairs);
  state.memories = std::move(memories_now);
}

suspensions::StepSolution SuspensionSimulation::Content::solve_step(
    double h, const std::vector<NearPair>& pairs, const std::vector<Motion>& before) {
  suspensions::StepProblem problem;
  problem.lubrication = lubrication();
  if (setting.laws.friction) problem.friction = setting.laws.friction->coefficient;
  if (contacts_have_films()) problem.contact_film = &setting.laws.film;
  problem.radii = state.particles.radii;
  problem.mean_radius = mean_radius;
  problem.pairs = pairs;
  problem.memories = memories(h);
  problem.motions = before;
  const double first_rate = state.shear.rate;
  const auto solve_at = [&](double rate) {
    state.shear.rate = rate;
    auto now = problem;
    // Motions of a suspension at another rate are nearly proportional to it.
    for (auto& motion : now.motions) {
      if (first_rate == 0) break;
      motion.along *= rate / first_rate;
      motion.turn *= rate / first_rate;
    }
    now.loads = given_loads(state.time);
    now.gradient = gradient_now();
    now.h = h;
    const auto repulsion = add_repulsion(pairs, now.loads);
    auto solution = suspensions::SuspensionStep(std::move(now)).solve();
    solution.stresses.repulsion = repulsion;
    return solution;
  };
  if (!lubrication().stress) return solve_at(given_rate(state.time, state.time + h));

  // The rate by the secant method, because the stress is nearly proportional to it.
  const double target = *lubrication().stress;
  const auto stress_of = [&](const suspensions::StepSolution& solution) {
    Rheology found;
    suspensions::SymmetricTensor now;
    now.add(state.shear.rate, strain);
    suspensions::set_stresses(solution.stresses, now, lubrication().viscosity, volume, found);
    return found.viscosity * lubrication().viscosity * state.shear.rate * gradient[0][1];
  };
  double rate = first_rate;
  auto solution = solve_at(rate);
  double error = stress_of(solution) - target, slope = (error + target) / rate;
  int iterations = solution.iterations, solutions = solution.solutions;
  bool converged = false;
  for (int k = 0; k < SuspensionTuning::kMostRates; ++k) {
    converged = std::abs(error) <= SuspensionTuning::kStressTolerance * std::abs(target);
    if (converged) break;
    const double next = rate - error / slope;
    if (!(next * rate > 0)) break;
    solution = solve_at(next);
    const double found = stress_of(solution) - target;
    if (found != error && next != rate) slope = (found - error) / (next - rate);
    rate = next;
    error = found;
    iterations += solution.iterations;
    solutions += solution.solutions;
  }
  solution.converged = solution.converged && converged;
  solution.iterations = iterations;
  solution.solutions = solutions;
  return solution;
}

StepReport SuspensionSimulation::step(double end) {
  auto& content = *content_;
  auto& state = content.state;
  StepReport report;
  report.time = state.time;
  const auto interval = StepGrid(content.setting.time_step).next(state, end);
  if (!interval) return report;
  if (state.steps == 0) content.solve_instant();
  double h = interval->h;
  const auto pairs = content.find_pairs(SuspensionTuning::kLeastSearch);
  const auto before = content.relative_motions();
  auto solution = content.solve_step(h, pairs, before);

  if (!std::isfinite(solution.dissipation))
    throw Error(ErrorKind::kNotConverged, "the step from time {} has no solution", state.time);
  report.parts = 1;
  report.iterations = solution.iterations;
  report.contacts = solution.touching;
  report.residual = solution.residual;
  report.converged = solution.converged;
  report.has_given_loads = solution.has_given_loads;
  report.largest_overlap = std::max(-solution.smallest_gap / content.mean_radius, 0.0);
  const double part = content.free_part(pairs, solution.motions, h);
  auto taken = *interval;
  if (part < 1) {
    // The step ends before spheres overlap.
    report.converged = false;
    report.excess = std::numeric_limits<double>::infinity();
    h *= part;
    taken.h = h;
    taken.end = state.time + h;
    taken.new_grid = taken.end;
  }
  content.move(solution.motions, h);
  content.remember(solution.contacts, h);
  state.time = taken.end;
  state.earlier_step = h;
  StepGrid::count(state, taken);
  report.time = state.time;

  auto& rheology = content.rheology;
  rheology = {.time = state.time, .strain = state.shear.strain};
  rheology.pairs = pairs.size();
  rheology.contacts = solution.touching;
  rheology.smallest_gap =
      part < 1 ? content.smallest_gap(content.find_pairs()) : solution.smallest_gap;
  rheology.dissipation = solution.dissipation;
  suspensions::SymmetricTensor rate;
  rate.add(state.shear.rate, content.strain);
  suspensions::set_stresses(solution.stresses, rate, content.lubrication().viscosity,
                            content.volume, rheology);
  rheology.solutions = solution.solutions;
  return report;
}

}  // namespace viscontact::particles
