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
  // Overlap that no step leaves, in mean radii: half of what is allowed.
  static constexpr double kMostOverlap = 5e-8;
  // A step that is not solved is taken in half of its length, and so on. If only the stress or
  // Coulomb's law are not right, the last part is taken after fewer halvings.
  static constexpr int kMostHalvings = 7, kMostForFriction = 3;
  // Largest range of the search without a box, in mean radii.
  static constexpr double kMostSearch = 100;
};

void check_cell(const Setting& setting, const Particles& particles) {
  const auto& lubrication = *setting.lubrication;
  const auto periods = periods_of(setting.domain);
  const double distance = suspensions::largest_distance(
      particles.radii, std::max(lubrication.range, SuspensionTuning::kLeastSearch));
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
  bool has_instant = false;  // whether `rheology` and the velocities are those of the present state

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
  /// Whether the gap of a pair is below the range, beyond which pairs have neither films nor
  /// repulsion and are listed only because they may come near in a step.
  bool is_in_range(const NearPair& pair) const {
    const auto& radii = state.particles.radii;
    const double sum = radii[index_of(pair.first)] + radii[index_of(pair.second)];
    return norm(pair.apart) < (1 + lubrication().range / 2) * sum;
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
      if (!is_in_range(pair)) continue;
      const double force = amplitude * a * b / (a + b) * std::exp(-(distance - a - b) / length);
      const auto push = suspensions::lanes_of((force / distance) * pair.apart);
      loads[i].along -= push;
      loads[j].along += push;
      sum.add_pair_force(suspensions::vector_of(push), pair.apart, gradient_now());
    }
    return sum;
  }
  std::vector<NearPair> find_pairs(double range) const {
    return suspensions::near_pairs(cell(), state.particles.positions, state.particles.radii, range);
  }
  /// Range [in mean radii] of pairs that may come near in a step of length h: twice what the flow
  /// closes of it, and what the last motions, relative to the flow, close.
  double search_range(double h, const std::vector<Motion>& motions) const {
    const double sheared =
        h * std::sqrt(2 * strain.contracted(strain)) * std::abs(state.shear.rate);
    double fastest = 0;
    for (const auto& motion : motions)
      fastest = std::max(fastest, norm(suspensions::vector_of(motion.along)));
    double most = SuspensionTuning::kMostSearch;
    const double diameter = suspensions::largest_distance(state.particles.radii, 0);
    for (const double period : periods_of(setting.domain))
      if (period > 0) most = std::min(most, period / diameter - 2);
    const double by_flow = sheared < 2 ? 2 * sheared / (1 - sheared / 2) : most;
    const double least = std::max(lubrication().range, SuspensionTuning::kLeastSearch);
    return std::max(std::min(by_flow + 2 * h * fastest / mean_radius, most), least);
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
  /// `before` are the motions of the last step. Sets the rate if the stress is given, and then looks
  /// for no other rate if it `gives_up` a step whose friction is not right.
  suspensions::StepSolution solve_step(double h, const std::vector<NearPair>& pairs,
                                       const std::vector<Motion>& before, bool gives_up);
  /// The largest overlap of two spheres where they are [L], 0 if there is none.
  double largest_overlap() const {
    return std::max(-smallest_gap(suspensions::near_pairs(cell(), state.particles.positions,
                                                          state.particles.radii, 0)),
                    0.0);
  }
  void move(const std::vector<Motion>& motions, double h);
  void remember(const std::vector<suspensions::ContactMemory>& contacts, double h);
};

suspensions::InstantSolution SuspensionSimulation::Content::solve_instant() {
  const double given = given_rate(state.time, state.time);
  suspensions::SymmetricTensor given_strain;
  given_strain.add(given, strain);
  const auto pairs = find_pairs(lubrication().range);
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
    throw Error(ErrorKind::kNotConverged, "the velocities of the suspension have not converged");
  content_->has_instant = true;
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
    double borne_by_film = 0;
    if (contacts_have_films()) {
      const double lowest =
          setting.laws.film.lowest_gamma(state.particles.radii[index_of(pair.first)],
                                         state.particles.radii[index_of(pair.second)]);
      pair.gamma = h * contact.least_load;
      borne_by_film = pair.gamma - lowest;
      FilmLaw::absorb(pair, 0, lowest);
    }
    const Vector apart = state.particles.position(index_of(pair.second)) -
                         state.particles.position(index_of(pair.first));
    // The image of the second sphere that is near has the opposite shift.
    const auto periods = cell().periods_towards(apart);
    pair.image = image_number(-static_cast<int>(periods[0]), -static_cast<int>(periods[1]),
                              -static_cast<int>(periods[2]));
    PairMemory memory;
    memory.set_friction(h * contact.friction);
    memory[Remembered::kSolidLoad] = std::max(pair.impulse - borne_by_film, 0.0);
    memories_now.set(pair.memory, memory);
    if (pair.impulse != 0 || pair.gamma != 0) pairs.push_back(pair);
  }
  memories_now.keep_only(pairs);
  state.pairs = std::move(pairs);
  state.memories = std::move(memories_now);
}

suspensions::StepSolution SuspensionSimulation::Content::solve_step(
    double h, const std::vector<NearPair>& pairs, const std::vector<Motion>& before,
    bool gives_up) {
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
    // Half of the step is solved instead.
    if (converged || !solution.is_solved || (gives_up && !solution.converged)) break;
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
  if (state.steps == 0 && !content.has_instant) content.solve_instant();
  content.has_instant = false;
  const State start = state;
  const auto before = content.relative_motions();
  const double allowed =
      std::max(content.largest_overlap(), SuspensionTuning::kMostOverlap * content.mean_radius);
  double h = interval->h;
  suspensions::StepSolution solution;
  std::size_t pairs_in_range = 0;
  int solutions = 0, halvings = 0;
  for (;; ++halvings, h /= 2) {
    if (halvings > SuspensionTuning::kMostHalvings)
      throw Error(ErrorKind::kNotConverged,
                  "the spheres jam at t = {:.6g}, the strain {:.6g}: a step of {:.3g} has no "
                  "solution without overlap; use a smaller volume fraction, less friction, or a "
                  "shorter step",
                  start.time, start.shear.strain, 2 * h);
    state = start;
    const auto pairs = content.find_pairs(content.search_range(h, before));
    pairs_in_range = static_cast<std::size_t>(std::ranges::count_if(
        pairs, [&](const NearPair& pair) { return content.is_in_range(pair); }));
    solution = content.solve_step(h, pairs, before, halvings < SuspensionTuning::kMostForFriction);
    report.iterations += solution.iterations;
    solutions += solution.solutions;
    if (!solution.is_solved || !std::isfinite(solution.dissipation)) continue;
    if (!solution.converged && halvings < SuspensionTuning::kMostForFriction) continue;
    content.move(solution.motions, h);
    report.largest_overlap = content.largest_overlap();
    if (report.largest_overlap <= allowed) break;
  }
  report.largest_overlap /= content.mean_radius;
  report.parts = 1;
  report.contacts = solution.touching;
  report.residual = solution.residual;
  report.converged = solution.converged;
  if (!report.converged) report.excess = std::numeric_limits<double>::infinity();
  report.has_given_loads = solution.has_given_loads;
  auto taken = *interval;
  if (halvings > 0) {
    // The next step goes on to the same point of the grid.
    taken.h = h;
    taken.end = state.time + h;
    taken.new_grid = interval->end - content.setting.time_step;
  }
  content.remember(solution.contacts, h);
  state.time = taken.end;
  state.earlier_step = h;
  StepGrid::count(state, taken);
  report.time = state.time;

  auto& rheology = content.rheology;
  rheology = {.time = state.time, .strain = state.shear.strain};
  rheology.pairs = pairs_in_range;
  rheology.contacts = solution.touching;
  rheology.smallest_gap = solution.smallest_gap;
  rheology.dissipation = solution.dissipation;
  suspensions::SymmetricTensor rate;
  rate.add(state.shear.rate, content.strain);
  suspensions::set_stresses(solution.stresses, rate, content.lubrication().viscosity,
                            content.volume, rheology);
  rheology.solutions = solutions;
  return report;
}

}  // namespace viscontact::particles
