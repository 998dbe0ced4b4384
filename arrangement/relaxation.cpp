// Only + - * / and sqrt are used, and nothing is fused (-ffp-contract=off in CMakeLists.txt), so
// that every machine computes the same bits.
#include "viscontact/arrangement/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "viscontact/arrangement/arrangement_tuning.hpp"

namespace viscontact::particles {
namespace {

using Tuning = ArrangementTuning;

double square_of(const Vector& x) { return x[0] * x[0] + x[1] * x[1] + x[2] * x[2]; }

/// The particles as points and their repulsion, of stiffness 1. The mass is 1 up to the mean size,
/// and of larger particles as their surface, because they have so many neighbours; otherwise they
/// would vibrate too fast for the time step. Stiffness and mass give the unit of time.
class OverlapRepulsion {
 public:
  explicit OverlapRepulsion(PlacedParticles& placed)
      : placed_(placed),
        slack_(Tuning::kRelaxationSlack * placed.distance()),
        centres_(placed.centres()),
        velocities_(placed.count()),
        forces_(placed.count()) {
    for (std::size_t k = 0; k < placed.count(); ++k) {
      const double ratio = std::min(1.0, placed.distance() / (2 * placed.reach(k)));
      per_mass_.push_back(placed.dimension() == 2 ? ratio : ratio * ratio);
    }
    list_pairs();
  }

  /// Sets the forces. Returns true if no gap is too small.
  bool update() {
    std::ranges::fill(forces_, Vector{});
    energy_ = 0;
    contacts_ = 0;
    bool all_free = true;
    for (const auto& [i, j, is_fixed, distance] : pairs_) {
      const Vector other = is_fixed ? placed_.fixed()[j].centre : centres_[j];
      const Vector apart = placed_.widest_places().difference(centres_[i], other);
      const double square = square_of(apart), aim = Tuning::kAim * distance;
      if (!(square < aim * aim)) continue;
      const double length = std::sqrt(square), overlap = aim - length;
      all_free = all_free && !(square < distance * distance);
      energy_ += 0.5 * overlap * overlap;
      ++contacts_;
      // Two particles with the same centre are separated along the first axis.
      const Vector push = length > 0 ? (overlap / length) * apart : Vector{overlap, 0, 0};
      forces_[i] = forces_[i] - push;
      if (!is_fixed) forces_[j] = forces_[j] + push;
    }
    return all_free;
  }
  double energy() const { return energy_; }
  /// Root mean square of the overlaps, over the mean least distance.
  double overlap() const {
    return contacts_ == 0
               ? 0
               : std::sqrt(2 * energy_ / static_cast<double>(contacts_)) / placed_.distance();
  }

  /// One step of FIRE.
  void step() {
    double power = 0, force2 = 0, speed2 = 0;
    for (std::size_t k = 0; k < centres_.size(); ++k) power += dot(forces_[k], velocities_[k]);
    if (power < 0) {
      std::ranges::fill(velocities_, Vector{});
      steps_downhill_ = 0;
      time_step_ *= Tuning::kSlower;
      mixing_ = Tuning::kMixing;
    } else if (++steps_downhill_ > Tuning::kDownhill) {
      time_step_ = std::min(time_step_ * Tuning::kFaster, Tuning::kLongestStep);
      mixing_ *= Tuning::kLessMixing;
    }
    for (std::size_t k = 0; k < centres_.size(); ++k) {
      forces_[k] = per_mass_[k] * forces_[k];  // an acceleration from here on
      velocities_[k] = velocities_[k] + time_step_ * forces_[k];
      force2 += square_of(forces_[k]);
      speed2 += square_of(velocities_[k]);
    }
    const double along = force2 > 0 ? mixing_ * std::sqrt(speed2 / force2) : 0;
    double fastest2 = 0;
    for (std::size_t k = 0; k < centres_.size(); ++k) {
      velocities_[k] = (1 - mixing_) * velocities_[k] + along * forces_[k];
      fastest2 = std::max(fastest2, square_of(velocities_[k]));
    }
    const double longest = Tuning::kLongestMove * placed_.distance();
    const double furthest = time_step_ * std::sqrt(fastest2);
    move(furthest > longest ? time_step_ * (longest / furthest) : time_step_);
  }

  /// Gives the centres to the particles.
  void give_back() {
    for (std::size_t k = 0; k < centres_.size(); ++k) placed_.move(k, centres_[k]);
  }

 private:
  void move(double time) {
    bool is_far = false;
    const bool is_bounded = !placed_.widest_places().are_unbounded();
    for (std::size_t k = 0; k < centres_.size(); ++k) {
      const auto& places = placed_.places(k);
      const Vector x = centres_[k] + time * velocities_[k];
      if (is_bounded) {
        const Vector place = places.nearest(x);
        // A wall stops the motion towards it.
        velocities_[k] = (1 / time) * places.difference(centres_[k], place);
        centres_[k] = place;
      } else {
        centres_[k] = places.wrapped(x);
      }
      is_far = is_far || square_of(places.difference(listed_[k], centres_[k])) > slack_ * slack_;
    }
    if (is_far) list_pairs();
  }

  void list_pairs() {
    give_back();
    pairs_ = placed_.pairs(2 * slack_);
    listed_ = centres_;
  }

  PlacedParticles& placed_;
  std::vector<double> per_mass_;
  double slack_;  // distance that a centre may move before pairs are listed anew [L]
  std::vector<Vector> centres_, velocities_, forces_, listed_;
  std::vector<ClosePair> pairs_;  // that may repel each other
  double energy_ = 0;
  std::size_t contacts_ = 0;
  double time_step_ = Tuning::kFirstStep, mixing_ = Tuning::kMixing;
  int steps_downhill_ = 0;
};

}  // namespace

Relaxation relax(PlacedParticles& placed, int most_steps) {
  OverlapRepulsion repulsion(placed);
  double before = std::numeric_limits<double>::infinity();
  int step = 0;
  for (; step < most_steps; ++step) {
    if (repulsion.update()) {
      repulsion.give_back();
      // The planes are tested here, and what rounding errors change.
      if (placed.are_all_free()) return {true, step, 0};
    }
    if (step % Tuning::kStepsOfCheck == 0) {
      if (repulsion.energy() > Tuning::kJammed * before) break;
      before = repulsion.energy();
    }
    repulsion.step();
  }
  repulsion.give_back();
  return {false, step, repulsion.overlap()};
}

}  // namespace viscontact::particles
