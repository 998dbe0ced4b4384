// Conjugate gradients for the velocities of all spheres, preconditioned by blocks of
// spheres and by the translation of all.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "viscontact/suspensions/lanes.hpp"
#include "viscontact/suspensions/resistance.hpp"

namespace viscontact::suspensions {

/// The inverse of the 6 x 6 block of each sphere in R, and the inverse of what all spheres resist
/// together: with little drag the blocks alone do not see a translation of all spheres.
class alignas(kLaneAlignment) BlockPreconditioner {
 public:
  explicit BlockPreconditioner(const Resistance& resistance);
  Motion times(std::size_t sphere, const Motion& load) const;
  /// The common translation by the sum of the forces on all spheres.
  Lanes translation_by(const Lanes& force) const {
    return translation_[0] * force[0] + translation_[1] * force[1] + translation_[2] * force[2];
  }

 private:
  struct alignas(kLaneAlignment) Inverse {
    std::array<Motion, 6> columns;
  };
  std::vector<Inverse> inverses_;
  std::array<Lanes, 3> translation_{};
};

class ConjugateGradients {
 public:
  struct Result {
    int iterations = 0;
    double start = 0, residual = 0;  ///< r.M^-1 r, a power [M L^2/T^3]
    bool converged = true;
    bool stagnates = false;  ///< rounding errors keep the residual from falling
  };
  /// A residual r.M^-1 r [M L^2/T^3] at which the iteration ends, and a part of that at its start.
  struct End {
    double residual = 0;
    double reduction = 0;
  };
  /// Solves R motions = loads from the given motions on. The iteration also ends where rounding
  /// errors keep the residual from falling.
  Result solve(const Resistance& resistance, const BlockPreconditioner& preconditioner,
               std::span<const Motion> loads, std::span<Motion> motions, const End& end,
               int most_iterations);

 private:
  std::vector<Motion> residual_, direction_, product_;
};

inline Motion BlockPreconditioner::times(std::size_t sphere, const Motion& load) const {
  const auto& c = inverses_[sphere].columns;
  const Lanes &f = load.along, &t = load.turn;
  return {c[0].along * f[0] + c[1].along * f[1] + c[2].along * f[2] + c[3].along * t[0] +
              c[4].along * t[1] + c[5].along * t[2],
          c[0].turn * f[0] + c[1].turn * f[1] + c[2].turn * f[2] + c[3].turn * t[0] +
              c[4].turn * t[1] + c[5].turn * t[2]};
}

}  // namespace viscontact::suspensions
