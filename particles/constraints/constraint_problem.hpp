// The contacts with friction and the bilateral constraints of one time step, docs/physics.md (5.6)
// to (5.9), in flat arrays, and the rows of a contact in them. Lengths, masses and times are in the
// units of the case. constraint_solver.hpp and the blows solve it. Nothing is thrown. A change must
// keep contacts without friction those of (5.4), and the angular momentum of a pair.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/particles/bodies/rigid_bodies.hpp"
#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/contact/friction_law.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/particles.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// Number of components of a rotation: the angle in the plane, or a vector in space.
template <int D>
inline constexpr int kTurns = D == 2 ? 1 : 3;

/// A displacement and a rotation: D numbers [L], then kTurns numbers [rad]. The same type holds an
/// impulse and its moment.
template <int D>
using Motion = std::array<double, static_cast<std::size_t>(D + kTurns<D>)>;

/// What moves as one: a particle, or a rigid body of several particles.
template <int D>
struct RigidUnit {
  /// Number of components of a rotation: 1 in the plane, 3 in space.
  static constexpr auto kTurnDirections = static_cast<std::size_t>(kTurns<D>);
  /// Number of entries of the matrix that takes a moment to a rotation.
  static constexpr std::size_t kTurnEntries = kTurnDirections * kTurnDirections;
  Motion<D> free{};     ///< h (u*, w*) of the motion without constraints
  double mobility = 0;  ///< h/m [T/M]
  std::array<double, kTurnEntries> turn_mobility{};          ///< h I^-1 [T/(M L^2)], row by row
  double inverse_mobility = 0;                               ///< m/h
  std::array<double, kTurnEntries> inverse_turn_mobility{};  ///< I/h

  /// h M^-1 times an impulse and moment.
  Motion<D> moved_by(const Motion<D>& impulse) const {
    return product(mobility, turn_mobility, impulse);
  }
  /// The impulse and moment that cause a motion.
  Motion<D> impulse_of(const Motion<D>& motion) const {
    return product(inverse_mobility, inverse_turn_mobility, motion);
  }

 private:
  static Motion<D> product(double factor, const std::array<double, kTurnEntries>& turns,
                           const Motion<D>& by) {
    constexpr auto d = static_cast<std::size_t>(D), r = static_cast<std::size_t>(kTurns<D>);
    Motion<D> result;
    for (std::size_t i = 0; i < d; ++i) result[i] = factor * by[i];
    for (std::size_t i = 0; i < r; ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < r; ++k) sum += turns[i * r + k] * by[d + k];
      result[d + i] = sum;
    }
    return result;
  }
};

/// The unit of a particle without a body: its mobility h/m [T/M] and turn mobility h/I [T/(M L^2)],
/// and its motion without constraints, D numbers `displacement` [L] and kTurns numbers `turn`
/// [rad].
template <int D>
RigidUnit<D> unit_of_particle(double mobility, double turn_mobility, const double* displacement,
                              const double* turn);

/// The unit of a rigid body with this motion without constraints.
template <int D>
RigidUnit<D> unit_of_body(const BodyStep& free);

/// The part of one unit in a row: it adds the product of `coefficients` and the motion of the unit
/// to the value of the row.
template <int D>
struct RowPart {
  std::int32_t unit = 0;     ///< number of a unit
  Motion<D> coefficients{};  ///< [1] for displacements, [L] for rotations
};

/// One scalar of a constraint after the motions of the units: `offset` and the products of its
/// parts [L]. A contact has the parts of its two units, or of one at an obstacle; a constraint may
/// have any number. What is at rest, like an obstacle, has no part.
struct ConstraintRow {
  double offset = 0;           ///< value of the row if no unit moves [L]
  std::size_t first_part = 0;  ///< number of the first part in ConstraintProblem::parts
  std::size_t parts = 0;       ///< number of parts, which follow each other
};

/// What bounds the friction of a contact.
enum class FrictionBound : unsigned char {
  kCoulomb,  ///< mu_s times the load of its solids, (5.7)
  kCone,     ///< the cone of the convex relaxation of a dry contact, (5.9)
  kGiven,    ///< mu_s times ConstraintBlock::given_load, (5.17)
};

/// A contact or a bilateral constraint. A contact has one row for its gap, and with friction D - 1
/// more for the tangential displacement of the surfaces; a bilateral constraint may have up to
/// kMostRows rows, which must be 0, or proportional to their impulses. The rows of a block have
/// parts of the same units, each of them once, in the same order.
struct ConstraintBlock {
  std::size_t row = 0;     ///< number of its first row
  std::size_t rows = 1;    ///< number of its rows
  bool is_contact = true;  ///< false: a bilateral constraint
  double lowest = 0;       ///< lower bound gamma^n of the normal impulse [M L/T]
  double friction = 0;     ///< mu_s >= 0
  /// Impulse gamma^n - gamma_min that the film of the contact can still absorb [M L/T], >= 0.
  double capacity = 0;
  /// Largest residuals with which it counts as converged [L], > 0: of the gap or bilateral rows,
  /// and of the tangential rows of a contact.
  double allowed = 0,    ///< of the gap or bilateral rows [L]
      allowed_slip = 0;  ///< of the tangential rows [L]
  /// Of a bilateral block: v + compliance p = 0 holds for the value v of each row and its impulse p
  /// [T/M], >= 0.
  double compliance = 0;
  /// Of a contact with more than one row. The impulses of kCone are in the FrictionCone, and such a
  /// contact has no film: `lowest` and `capacity` are 0.
  FrictionBound friction_bound = FrictionBound::kCoulomb;
  double given_load = 0;  ///< of kGiven [M L/T], >= 0
  /// Whether the impulses are in the cone of (5.9).
  bool is_in_cone() const { return rows > 1 && friction_bound == FrictionBound::kCone; }
  /// Whether the contact has a film, which may carry its impulse.
  bool has_film() const { return capacity > lowest; }
  /// Bound of the tangential impulse with this normal impulse [M L/T], of a contact that is not in
  /// a cone.
  double bound(double normal_impulse) const {
    return friction * (friction_bound == FrictionBound::kGiven
                           ? given_load
                           : FrictionLaw::carried(normal_impulse, capacity));
  }
};

/// Largest number of rows of a block.
inline constexpr std::size_t kMostRows = 3;

/// The problem of a step: find impulses p of the rows such that, with y = y* + h M^-1 J^T p, every
/// contact has gap >= 0, p_n >= lowest and one of them 0, every tangential impulse obeys Coulomb's
/// law, and every bilateral row is 0 or, with a compliance, -compliance p.
template <int D>
struct ConstraintProblem {
  std::vector<RigidUnit<D>> units;      ///< all particles and bodies that take part
  std::vector<RowPart<D>> parts;        ///< of the rows
  std::vector<ConstraintRow> rows;      ///< those of each block follow each other
  std::vector<ConstraintBlock> blocks;  ///< in the order of their rows
  std::vector<double> impulses;         ///< of the rows [M L/T]: a guess, then the solution
  /// Whether no contact has FrictionBound::kCoulomb, so that motions minimise a convex function.
  bool is_convex = false;
  /// Whether a rough solution of a convex problem is enough, which shows about how units move and
  /// which contacts carry load.
  bool is_rough = false;
  /// Whether given loads (ConstraintBlock::given_load) stay those that are given.
  bool keeps_loads = false;
  /// Whether bilateral rows hold long chains of units together, as those of a membrane, through
  /// which sweeps would carry impulses too slowly.
  bool has_long_chains = false;

  /// Adds a row with these parts and a guess of its impulse [M L/T].
  void add_row(double offset, std::span<const RowPart<D>> of_row, double impulse) {
    rows.push_back({offset, parts.size(), of_row.size()});
    parts.insert(parts.end(), of_row.begin(), of_row.end());
    impulses.push_back(impulse);
  }
  /// The parts of row `r`.
  std::span<const RowPart<D>> parts_of(std::size_t r) const {
    return std::span(parts).subspan(rows[r].first_part, rows[r].parts);
  }
  /// Value of row `r` for the motions `y`, without its offset [L].
  double product(std::size_t r, std::span<const Motion<D>> y) const {
    double sum = 0;
    for (const auto& [unit, coefficients] : parts_of(r)) {
      const auto& motion = y[static_cast<std::size_t>(unit)];
      for (std::size_t k = 0; k < motion.size(); ++k) sum += coefficients[k] * motion[k];
    }
    return sum;
  }
  /// Adds J^T p of row `r` with the impulse `p` to the impulses of the units.
  void add_impulse(std::size_t r, double p, std::span<Motion<D>> to) const {
    for (const auto& [unit, coefficients] : parts_of(r)) {
      auto& impulse = to[static_cast<std::size_t>(unit)];
      for (std::size_t k = 0; k < impulse.size(); ++k) impulse[k] += coefficients[k] * p;
    }
  }
};

/// Motions y* + h M^-1 J^T p of all units.
template <int D>
std::vector<Motion<D>> motions(const ConstraintProblem<D>& problem,
                               std::span<const double> impulses);

/// Gives each contact with friction the load that its solids have with problem.impulses, (5.17), in
/// place of Coulomb's law, which makes the problem convex. Its solution has exact gaps, films and
/// bilateral rows, and friction that takes energy; what it lacks of Coulomb's law is the difference
/// between the loads of the solution and those that are given.
template <int D>
void give_loads(ConstraintProblem<D>& problem);

/// w of each row: what a unit impulse on the row changes in it, J h M^-1 J^T [T/M].
template <int D>
std::vector<double> row_mobilities(const ConstraintProblem<D>& problem);

/// Residual of a block [L] for values `v` of its rows, their impulses `p` and mobilities `w`: of a
/// contact the larger of |min(gap, w (p_n - lowest))| and, with friction, of w |p_t - P(p_t -
/// v_t/w)|, where P projects on the bound of the friction; of a contact in the cone of (5.9) those
/// of w |p - P(p - v/w)|, where P projects on the cone; of a bilateral constraint the largest |v +
/// compliance p|.
struct BlockResidual {
  double normal = 0,   ///< of the gap or bilateral rows [L], >= 0
      tangential = 0;  ///< of the tangential rows [L], >= 0; 0 without friction
  /// The larger of both, divided by what is allowed.
  double share(const ConstraintBlock& block) const {
    const double of_normal = normal / block.allowed;
    const double of_slip = tangential == 0 ? 0 : tangential / block.allowed_slip;
    return largest_or_nan(of_normal, of_slip);
  }
};
/// The residual of `block`. `v`, `p` and `w` point to the numbers of the first row of the block.
BlockResidual residual_of(const ConstraintBlock& block, const double* v, const double* p,
                          const double* w);

/// What the tangential rows of a contact need besides the contact.
template <int D>
struct ContactTangents {
  std::array<Vector, static_cast<std::size_t>(D - 1)> directions;  ///< unit vectors
  /// Distances of the contact point from the centres of both particles [L].
  double first_arm = 0,  ///< from the centre of the first particle
      second_arm = 0;    ///< from the centre of the second particle
  Vector surface{};      ///< displacement of the surface of the obstacle in the step [L]
  double capacity = 0;   ///< ConstraintBlock::capacity
};

/// The tangents of a contact in a step from time `begin` to `end` [T]; `capacity` is left 0.
template <int D>
ContactTangents<D> tangents_of(const Contact<D>& contact, const Particles& particles,
                               std::span<const Plane> obstacles, double begin, double end);

/// Part of a row for one unit: the displacement along `direction` of the point that is at `arm` [L]
/// from the centre of the unit.
template <int D>
Motion<D> displacement_row(const Vector& direction, const Vector& arm) {
  Motion<D> row{};
  for (std::size_t d = 0; d < static_cast<std::size_t>(D); ++d) row[d] = direction[d];
  const Vector moment = cross(arm, direction);
  if constexpr (D == 2)
    row[2] = moment[2];
  else
    for (std::size_t d = 0; d < 3; ++d) row[3 + d] = moment[d];
  return row;
}

/// A particle of a contact as a part of its unit.
struct ContactSide {
  std::int32_t unit = -1;  ///< -1: an obstacle
  Vector offset{};         ///< from the centre of the unit to that of the particle [L]
};

/// Adds row number `k` of a contact, with a guess of its impulse [M L/T]: its gap (0), or the
/// tangential displacement of the surface of the second particle relative to that of the first
/// along direction `k` - 1.
template <int D>
void add_contact_row(const Contact<D>& contact, const ContactTangents<D>& tangents,
                     const ContactSide& first, const ContactSide& second, std::size_t k,
                     double impulse, ConstraintProblem<D>& problem);

}  // namespace viscontact::particles
