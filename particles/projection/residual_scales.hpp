// The scales by which the residuals of a projection are measured: lengths, the impulses at work in
// each contact, and rounding errors. Lengths [L] and impulses [M L/T] are in the units of the case;
// nothing is thrown. step_projection.hpp uses it. A change must keep the scales independent of
// units.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/particles/dual_problem/contact_system.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// Scales of one contact.
struct ResidualScale {
  double w = 0;         ///< h (1/m_i + 1/m_j) [T/M]
  double impulse = 0;   ///< impulses at work in the contact [M L/T]
  double rounding = 0;  ///< rounding errors of the gap after the step [L], > 0
  /// Allowed residual [L]: at most `length` [L], and at most the residual that stands for
  /// `fraction` of the impulses at work. The second limit is never below the rounding errors.
  double allowed(double length, double fraction) const {
    return std::min(length, std::max(fraction * impulse * w, rounding));
  }
};

/// Computes the ResidualScale of each contact of a step.
template <int D>
class ResidualScales {
 public:
  /// Measures the impulses at work for the present impulses of `system` and the displacements h v
  /// of all particles. `mobilities` are h/m of all particles. The arguments must outlive this
  /// object.
  ResidualScales(const State& state, double h, std::span<const double> displacements,
                 std::span<const double> mobilities, ContactSystem<D>& system);

  /// Scales of a contact or link between `particles`, of which negative numbers are obstacles, and
  /// which need not take part. `w` is the change of its gap per impulse [T/M]. `length` [L] is the
  /// size of the coordinates from which the gap is computed as a difference. Of the impulses at
  /// work on the particles the smallest counts, because an impulse that is small for a heavy
  /// particle may be all that moves a light one. The rounding errors are those of the gap, of the
  /// displacements of its particles, and of a solution for all impulses of its island.
  ResidualScale of(std::span<const std::int32_t> particles, double w, double length);
  /// Scales of a contact.
  ResidualScale of(const Contact<D>& contact) {
    return of(std::array{contact.first, contact.second}, contact.w, std::abs(contact.gap));
  }

 private:
  /// Contribution of a particle to the scales of its contacts.
  struct ParticleScale {
    double impulse = 0;  ///< impulse at work on the particle [M L/T]
    /// Sum of h |u_d| over the components d of the velocity u before the step [L].
    double moved = 0;
  };
  ParticleScale of_particle(std::int32_t particle, const double* moves) const;

  const State& state_;
  double h_;
  std::span<const double> displacements_, mobilities_;
  ContactSystem<D>& system_;
  std::vector<ParticleScale> body_scales_;
  std::vector<double> island_impulses_;  // largest sqrt(w) p of each island, at its root
};

}  // namespace viscontact::particles
