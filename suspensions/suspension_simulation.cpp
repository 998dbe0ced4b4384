// The state of a suspension and its instantaneous problem.
#include "viscontact/suspensions/suspension_simulation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/suspensions/instant.hpp"
#include "viscontact/suspensions/pair_search.hpp"
#include "viscontact/suspensions/pair_system.hpp"
#include "viscontact/suspensions/sheared_cell.hpp"
#include "viscontact/suspensions/stress_sums.hpp"

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
  suspensions::SymmetricTensor add_repulsion(const std::vector<NearPair>& pairs,
                                             std::vector<Motion>& loads) const {
    suspensions::SymmetricTensor sum;
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
      sum.add_dyad(-force / distance, pair.apart, pair.apart);
    }
    return sum;
  }
  std::vector<NearPair> find_pairs() const {
    return suspensions::near_pairs(cell(), state.particles.positions, state.particles.radii,
                                   lubrication().range);
  }
  double smallest_gap(const std::vector<NearPair>& pairs) const {
    double smallest = std::numeric_limits<double>::infinity();
    for (const auto& pair : pairs)
      smallest = std::min(smallest, norm(pair.apart) - state.particles.radii[index_of(pair.first)] -
                                        state.particles.radii[index_of(pair.second)]);
    return smallest;
  }

  suspensions::InstantSolution solve_instant();
};

suspensions::InstantSolution SuspensionSimulation::Content::solve_instant() {
  const auto pairs = find_pairs();
  const suspensions::PairSystem system(lubrication(), state.particles.radii, pairs,
                                       SuspensionTuning::kLeastGap * mean_radius);
  suspensions::InstantProblem problem{&system,
                                      strain,
                                      lubrication().viscosity,
                                      volume,
                                      given_loads(state.time),
                                      {},
                                      lubrication().stress};
  problem.softest = std::min(lubrication().drag, 1.0);
  problem.load_stress = add_repulsion(pairs, problem.loads);
  auto solution = suspensions::solve_instant(problem, std::vector<Motion>(state.particles.count()),
                                             SuspensionTuning::kInstantTolerance);
  state.shear.rate = solution.rate;
  set_velocities(solution.motions);
  set_cell();

  suspensions::SymmetricTensor rate;
  rate.add(solution.rate, strain);
  suspensions::StressSums sums;
  sums.film = system.stresslets(solution.motions, rate);
  sums.repulsion = problem.load_stress;
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
}

SuspensionSimulation::~SuspensionSimulation() = default;

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

StepReport SuspensionSimulation::step(double /*end*/) {
  throw Error(ErrorKind::kWrongUsage, "steps of suspensions are not there yet");
}

}  // namespace viscontact::particles
