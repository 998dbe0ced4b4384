// The state of a suspension and what its steps share.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/particles/domain/bounded_region.hpp"
#include "viscontact/particles/steps/step_times.hpp"
#include "viscontact/suspensions/cell/pair_search.hpp"
#include "viscontact/suspensions/cell/planes.hpp"
#include "viscontact/suspensions/cell/sheared_cell.hpp"
#include "viscontact/suspensions/cell/strained_lattice.hpp"
#include "viscontact/suspensions/instant.hpp"
#include "viscontact/suspensions/pairs/pair_sizes.hpp"
#include "viscontact/suspensions/pairs/pair_system.hpp"
#include "viscontact/suspensions/step/suspension_step.hpp"
#include "viscontact/suspensions/suspension_simulation.hpp"
#include "viscontact/suspensions/values/stress_sums.hpp"

namespace viscontact::particles {

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
  // If a flow changes at most by this factor, the motions of its last step times it begin a step.
  static constexpr double kMostChange = 10;
  // Overlap that no step leaves, in mean radii: half of what is allowed.
  static constexpr double kMostOverlap = 5e-8;
  // A step that is not solved is taken in half of its length, and so on. If only the stress or
  // Coulomb's law are not right, a part is taken after fewer halvings. The spheres jam if
  // there is no solution after the last halving, or none that obeys Coulomb's law in so many steps
  // one after the other. At the edge of jamming up to 5 follow each other.
  static constexpr int kMostHalvings = 7, kMostForFriction = 3, kMostUnsolved = 20;
  // Near jamming a step with friction is at most so many times as long as the last one, because
  // most longer ones have no solution.
  static constexpr double kMostGrowth = 8;
  // More spheres than this are sorted, because their numbers do not fit into the nearest cache.
  static constexpr std::size_t kMostUnordered = 1024;
  // Largest range of the search without a box, in mean radii.
  static constexpr double kMostSearch = 100;
};

/// Of the centres of a pair that may come into the range of lubrication [L].
inline double largest_distance(const PairLubrication& lubrication, const Particles& particles) {
  return suspensions::largest_distance(particles.radii,
                                       std::max(lubrication.range, SuspensionTuning::kLeastSearch));
}

struct SuspensionSimulation::Content {
  Setting setting;
  State state;
  std::array<Vector, 3> gradient{};  // of the flow of rate 1, in the last step
  suspensions::SymmetricTensor strain{};
  std::optional<double> stress;  // of the last step, if it is given
  double mean_radius = 1, volume = 0;
  std::optional<suspensions::StrainedLattice> lasting;  // if the periods of the state are its
  double strain_sign = 1;  // of the net strain of the state, in the direction of `lasting`
  std::vector<suspensions::PlaneBody> planes;
  std::vector<double> radii;  // of all bodies, the planes after the spheres
  Rheology rheology;
  std::unique_ptr<ThreadPool> pool;
  int unsolved = 0;          // steps one after the other in which Coulomb's law is not right
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
    if (state.shear.has_periods()) cell.lattice.emplace(state.shear.periods, middle_of_box());
    return cell;
  }
  Vector middle_of_box() const {
    const auto& box = std::get<BoxDomain>(setting.domain);
    return 0.5 * (box.from + box.to);
  }
  double volume_of_region() const {
    const double measured =
        size_of_region(setting.domain, positions_of(setting.planes, state.time), 3);
    return measured > 0 ? measured : std::numeric_limits<double>::infinity();
  }
  /// The image displacements that tables of contacts need.
  void set_cell() {
    auto& shown = particles().cell;
    shown = cell_of(setting.domain);
    if (state.shear.has_periods()) {
      shown.vectors = state.shear.periods;
      return;
    }
    if (shown.lengths[0] > 0 && shown.lengths[1] > 0) shown.offset = state.shear.offset;
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
    std::vector<Motion> motions(radii.size());
    for (std::size_t k = 0; k < p.count(); ++k) {
      motions[k].along = suspensions::lanes_of(p.velocity(k) - flow_at(p.position(k)));
      motions[k].turn =
          suspensions::lanes_of(point_of(p.angular_velocities.data(), k, 3) - rotation);
    }
    return motions;
  }
  void set_velocities(const std::vector<Motion>& motions) {
    auto& p = particles();
    const Vector rotation = state.shear.rate * suspensions::rotation_of(gradient);
    for (std::size_t k = 0; k < p.count(); ++k) {
      std::ranges::copy(suspensions::vector_of(motions[k].along) + flow_at(p.position(k)),
                        &p.velocities[3 * k]);
      std::ranges::copy(suspensions::vector_of(motions[k].turn) + rotation,
                        &p.angular_velocities[3 * k]);
    }
  }

  /// Sets the flow, or the stress, between two times within one piece, or at a time.
  void set_flow(double from, double to) {
    const double middle =
        to > from ? from + (to - from) / 2 : from + StepGrid::tiny(setting.time_step);
    const auto flow = lubrication().flow_at(middle);
    gradient = flow.gradient;
    strain = suspensions::strain_rate_of(gradient);
    stress = flow.stress;
    const double factor = lubrication().factor(from, to);
    if (stress)
      *stress *= factor;
    else
      state.shear.rate = factor;
  }
  /// Sets them as they were in the last step, by the state alone.
  void restore_flow() {
    const double rate = state.shear.rate;
    set_flow(state.time - state.earlier_step, state.time);
    state.shear.rate = rate;
  }
  suspensions::SymmetricTensor strain_now() const {
    suspensions::SymmetricTensor now;
    now.add(state.shear.rate, strain);
    return now;
  }
  /// Gives the shear rate, which is a magnitude, the sign of the flow.
  void set_sign(Rheology& of) const {
    if (signed_rate_of_strain(gradient_now()) < 0 && of.shear_rate > 0) of.shear_rate *= -1;
  }
  std::array<Vector, 3> gradient_now() const {
    auto now = gradient;
    for (auto& row : now) row = state.shear.rate * row;
    return now;
  }

  /// Forces and torques that do not depend on the motion, means between two times.
  std::vector<Motion> given_loads(double from, double to) const {
    const auto& p = state.particles;
    std::vector<Motion> loads(radii.size());
    const auto at = [&](const auto& map, std::size_t k) {
      const auto found = map.find(static_cast<std::int32_t>(k));
      if (found == map.end()) return Vector{};
      return to > from ? found->second.mean(from, to) : found->second.value(from);
    };
    for (std::size_t k = 0; k < p.count(); ++k) {
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
    const auto sizes = sizes_of(pair);
    return norm(pair.apart) < sizes.contact_distance + lubrication().range * sizes.mean;
  }
  suspensions::PairSizes sizes_of(const NearPair& pair) const {
    return suspensions::sizes_of(radii[index_of(pair.first)], radii[index_of(pair.second)]);
  }
  /// Adds the repulsion of the pairs to `loads`. Returns its part of the stress sums at the rate 1.
  suspensions::StressPart add_repulsion(const std::vector<NearPair>& pairs,
                                        std::vector<Motion>& loads) const {
    suspensions::StressPart sum;
    if (!lubrication().repulsion) return sum;
    const auto [amplitude, length] = *lubrication().repulsion;
    for (const auto& pair : pairs) {
      const auto i = index_of(pair.first), j = index_of(pair.second);
      const auto sizes = sizes_of(pair);
      const double distance = norm(pair.apart);
      if (!is_in_range(pair)) continue;
      const double force =
          amplitude * sizes.reduced * std::exp(-(distance - sizes.contact_distance) / length);
      const auto push = suspensions::lanes_of((force / distance) * pair.apart);
      loads[i].along -= push;
      loads[j].along += push;
      sum.add_pair_force(suspensions::vector_of(push), pair.apart, gradient);
    }
    return sum;
  }
  std::vector<NearPair> find_pairs(double range) const {
    const auto& p = state.particles;
    auto pairs = suspensions::near_pairs(cell(), p.positions, p.radii, range, pool.get());
    suspensions::add_plane_pairs(planes, p.positions, p.radii, range, pairs);
    return pairs;
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
    most = std::min(most, cell().least_height() / diameter - 2);
    const double by_flow = sheared < 2 ? 2 * sheared / (1 - sheared / 2) : most;
    const double least = std::max(lubrication().range, SuspensionTuning::kLeastSearch);
    return std::max(std::min(by_flow + 2 * h * fastest / mean_radius, most), least);
  }
  double smallest_gap(const std::vector<NearPair>& pairs) const {
    double smallest = std::numeric_limits<double>::infinity();
    for (const auto& pair : pairs)
      smallest = std::min(smallest, norm(pair.apart) - sizes_of(pair).contact_distance);
    return smallest;
  }

  /// Steps end where the flow changes.
  StepGrid grid() const { return StepGrid(setting.time_step, false, jump_times(setting)); }
  suspensions::InstantSolution solve_instant();
  std::vector<suspensions::ContactMemory> memories(double h) const;
  /// `start` are motions near the solution. Sets the rate if the stress is given.
  suspensions::StepSolution solve_step(double h, std::vector<NearPair> pairs,
                                       std::vector<Motion> start, bool takes_given_bounds);
  /// The largest overlap of two spheres where they are [L], 0 if there is none.
  double largest_overlap() const { return std::max(-smallest_gap(find_pairs(0)), 0.0); }
  void add_inertia(suspensions::StepProblem& problem) const;
  // Sets the period vectors, if the cell needs them, and turns the box and its spheres.
  void start_periods();
  // Sets `lasting` if it has the periods of the state.
  void find_lasting(const FlowPath& path);
  // `back` is the net strain at all times from now on, at least, <= 0.
  void check_lasting(double back) const;
  void turn_box(const suspensions::Matrix& turn);
  // Adds the strains of a step.
  void strain_by(double h);
  void move_periods(double h);
  // Throws Error(kNotConverged) if images are too near for the search of pairs.
  void check_images() const;
  void move(const suspensions::StepSolution& solution, double h);
  void remember(const std::vector<suspensions::ContactMemory>& contacts, double h);

  /// The length [T] of the first trial of a step whose whole length is `whole`.
  double first_length(double whole) const;
  // Whether the last step, or the one whose rest it was, was halved because it was not solved, and
  // is not short because a run or a piece of the flow ended. Follows from the state.
  bool follows_a_halved_step() const;
  // Throws Error(kNotConverged) after too many steps in which Coulomb's law is not right.
  void check_unsolved() const;
  // Sets the flow of a step. Returns motions near its solution.
  std::vector<Motion> start_of_step(double h);
  struct MovedStep {
    suspensions::StepSolution solution{};
    double h = 0, overlap = 0;  // [T], [L]
    std::size_t pairs_in_range = 0;
    int iterations = 0, solutions = 0;  // of all trials
  };
  /// Moves the spheres by a step of the length `whole` [T] or, if it is not solved, by its half and
  /// so on. Throws Error(kNotConverged), with the state as it was, if no length has a solution.
  MovedStep move_by_step(double whole);
  void set_rheology(const suspensions::StepSolution& solution, std::size_t pairs_in_range,
                    int solutions);
};

}  // namespace viscontact::particles
