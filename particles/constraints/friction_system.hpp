// Friction of the contacts of a step: makes the problem of constraint_problem.hpp from the contacts
// and the rotation of their particles. Units are those of the case.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/particles/constraints/constraint_problem.hpp"
#include "viscontact/particles/contact/contact_law.hpp"
#include "viscontact/particles/contact/friction_law.hpp"
#include "viscontact/particles/domain/plane.hpp"
#include "viscontact/particles/particles.hpp"
#include "viscontact/particles/projection/contact_system.hpp"

namespace viscontact::particles {

/// A step with friction. `turns` are h w* of all particles before the solution and h w after it
/// [rad]; `turn_mobilities` are h/I [T/(M L^2)].
struct FrictionStep {
  FrictionLaw friction;
  ContactLaw law;
  std::span<const Plane> obstacles;
  double begin = 0, end = 0;  ///< of the step [T]
  std::span<double> turns;
  std::span<const double> turn_mobilities;
};

template <int D>
class FrictionSystem {
 public:
  /// All arguments must outlive this object. `displacements` and `mobilities` are those of
  /// ContactSystem.
  FrictionSystem(const FrictionStep& step, const Particles& particles,
                 std::span<double> displacements, std::span<const double> mobilities);

  /// Adds the contact that is next in the ContactSystem; `friction` is the guess (Pair::friction).
  void add(const Contact<D>& contact, const Vector& friction);

  /// Takes the place of ContactSystem::solve. Also sets the rotations h w of the bodies.
  /// `allowed_slip` is the largest residual of a tangential displacement [L]; a rough solution
  /// takes it for the gaps, too.
  SolverResult solve(ContactSystem<D>& system, bool is_rough, double allowed_slip,
                     int max_iterations);

  /// Impulse of friction on the second particle of contact number `c` [M L/T].
  const Vector& friction(std::size_t c) const { return frictions_[c]; }
  /// Residual of contact number `c` in the last solution [L].
  const BlockResidual& residual(std::size_t c) const { return residuals_[c]; }

 private:
  struct Tangents {
    std::array<Vector, static_cast<std::size_t>(D - 1)> directions;
    // Distances of the contact point from the centres of both particles [L].
    double first_arm = 0, second_arm = 0;
    Vector surface{};  // displacement of the surface of the obstacle in the step [L]
    double capacity = 0;
  };
  Tangents tangents_of(const Contact<D>& contact) const;
  RigidUnit<D> unit_of(std::int32_t particle, const double* free) const;
  void add_contact(const Contact<D>& contact, std::size_t c, const ContactSystem<D>& system,
                   double allowed_slip, ConstraintProblem<D>& problem) const;

  const FrictionStep& step_;
  const Particles& particles_;
  std::span<double> displacements_;
  std::span<const double> mobilities_;
  std::vector<double> free_turns_;  // h w* of all particles
  std::vector<Tangents> tangents_;  // of the contacts
  std::vector<Vector> frictions_;
  std::vector<BlockResidual> residuals_;
};

}  // namespace viscontact::particles
