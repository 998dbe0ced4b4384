// Holds, as flat arrays, the problem for the impulses of the contacts with friction and of the
// links (hinges, arms, springs, membranes) of one time step (docs/physics.md (5.6) to (5.9)), and
// makes the rows of contacts in it. A row is one scalar that depends linearly on the motions of
// particles: a gap, a tangential displacement of two surfaces, or the left side of a link's
// equation. Numbers in parentheses, such as (5.6), are equations of docs/physics.md. Nothing is
// checked or thrown; a NaN makes a residual NaN. constraint_system.cpp (the steps), impacts/
// (collisions) and fluid/fluid_friction.cpp make such problems, and the other files of constraints/
// solve them. A change must keep that contacts without friction obey (5.4), and that the impulses
// of a pair of particles do not change the angular momentum of the pair.
//
// Symbols: h > 0 [T] is the length of the step, M are the masses m [M] and moments of inertia I
// [M L^2] of all units, u the velocities and w the angular velocities, u* and w* those without
// contacts and links, J the coefficients of all rows, p the impulses of the rows. Units are any
// consistent ones; a row of angles has [rad] in place of [L], and [M L^2/T] in place of [M L/T].
// The film of a contact is a thin layer of fluid that takes up a part of its normal impulse. The
// number gamma^n <= 0 [M L/T] is minus the impulse that the film has absorbed, and gamma_min <= 0
// is the least value that gamma^n can have.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "viscontact/particles/bodies/rigid_bodies.hpp"
#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/contact/friction_law.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/particles.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// Number of components of a rotation: 1 for discs (D = 2), 3 for spheres (D = 3).
template <int D>
inline constexpr int kTurns = D == 2 ? 1 : 3;

/// A displacement and a rotation: D numbers [L], then kTurns numbers [rad]. The same type also
/// holds an impulse [M L/T] and its moment [M L^2/T].
template <int D>
using Motion = std::array<double, static_cast<std::size_t>(D + kTurns<D>)>;

/// The mass and the free motion of a unit: a particle, or a rigid body of several particles.
template <int D>
struct RigidUnit {
  /// Number of components of a rotation, kTurns.
  static constexpr auto kTurnDirections = static_cast<std::size_t>(kTurns<D>);
  /// Number of entries of the matrix that takes a moment to a rotation.
  static constexpr std::size_t kTurnEntries = kTurnDirections * kTurnDirections;
  Motion<D> free{};     ///< motion in the step without contacts and links, h (u*, w*) [L, rad]
  double mobility = 0;  ///< h/m [T/M], > 0
  std::array<double, kTurnEntries> turn_mobility{};          ///< h I^-1 [T/(M L^2)], row by row
  double inverse_mobility = 0;                               ///< m/h [M/T]
  std::array<double, kTurnEntries> inverse_turn_mobility{};  ///< I/h [M L^2/T], row by row

  /// The motion that an impulse and a moment cause: h M^-1 times impulse and moment.
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

/// The unit of a particle that belongs to no rigid body. `mobility` is h/m [T/M] and
/// `turn_mobility` h/I [T/(M L^2)], both > 0. The motion of the particle without contacts and links
/// has D numbers `displacement` [L] and kTurns numbers `turn` [rad].
template <int D>
RigidUnit<D> unit_of_particle(double mobility, double turn_mobility, const double* displacement,
                              const double* turn);

/// The unit of a rigid body. Its motion without contacts and links, its mobilities and their
/// inverses are those of `free`.
template <int D>
RigidUnit<D> unit_of_body(const BodyStep& free);

/// What one unit adds to the value of a row: the inner product of `coefficients` and the motion of
/// the unit.
template <int D>
struct RowPart {
  std::int32_t unit = 0;     ///< place in ConstraintProblem::units
  Motion<D> coefficients{};  ///< [1] for displacements, [L] for rotations; any sign
};

/// A row of the problem. Its value after the motions of the units is `offset` plus the sum of its
/// parts. The row of a contact has a part for each of its particles, that of a link any number.
struct ConstraintRow {
  double offset = 0;           ///< value of the row if no unit moves [L]
  std::size_t first_part = 0;  ///< number of the first part in ConstraintProblem::parts
  std::size_t parts = 0;       ///< number of parts, which follow each other there
};

/// What bounds the magnitude of the tangential impulse of a contact. mu_s is the coefficient of
/// friction. The load of the solids is the part of the normal impulse that the film does not
/// absorb.
enum class FrictionBound : unsigned char {
  /// The bound is mu_s times the load of the solids in the solution: Coulomb's law, (5.7).
  kCoulomb,
  /// The bound is that of the convex relaxation of Coulomb's law, (5.9). Contacts with a film must
  /// not have it.
  kCone,
  /// The bound is mu_s times the load ConstraintBlock::given_load, (5.17).
  kGiven,
};

/// A contact, or the equations of a link (a bilateral constraint). A contact has one row for its
/// gap and, with friction, D - 1 more for the tangential displacements of its surfaces. A link has
/// up to kMostRows rows, whose values must be -compliance times their impulses. All rows of a block
/// have parts of the same units, each once, in the same order.
struct ConstraintBlock {
  std::size_t row = 0;     ///< number of its first row
  std::size_t rows = 1;    ///< number of its rows, 1 to kMostRows
  bool is_contact = true;  ///< false: a link
  /// True if the row is the geometric stiffness of another block, docs/physics.md (5.21).
  bool is_geometric = false;
  /// Lower bound of the normal impulse [M L/T]. In a step it is gamma^n <= 0 before the step; in a
  /// collision (impacts/) it may be > 0.
  double lowest = 0;
  double friction = 0;  ///< mu_s [1], >= 0
  /// Impulse gamma^n - gamma_min that the film can still absorb [M L/T], >= 0; infinite: no limit.
  double capacity = 0;
  double allowed = 0,    ///< largest residual of the gap, or of the rows of a link [L], > 0
      allowed_slip = 0;  ///< largest residual of the tangential rows [L], > 0
  /// Compliance of a link [T/M], >= 0; 0 for a rigid link. The value v and the impulse p of each of
  /// its rows obey v + compliance p = 0.
  double compliance = 0;
  /// The bound of the friction, for blocks of more than one row only. With kCone `lowest` and
  /// `capacity` must be 0, because there must be no film.
  FrictionBound friction_bound = FrictionBound::kCoulomb;
  double given_load = 0;  ///< load that bounds the friction with kGiven [M L/T], >= 0
  /// True if the impulses obey (5.9), that is, are in the FrictionCone.
  bool is_in_cone() const { return rows > 1 && friction_bound == FrictionBound::kCone; }
  /// True if the contact has a film, which takes the first part of a normal impulse.
  bool has_film() const { return capacity > lowest; }
  /// Largest tangential impulse [M L/T], >= 0, at the normal impulse `normal_impulse` [M L/T]. It
  /// has no meaning with kCone.
  double bound(double normal_impulse) const {
    return friction * (friction_bound == FrictionBound::kGiven
                           ? given_load
                           : FrictionLaw::carried(normal_impulse, capacity));
  }
};

/// Largest number of rows of a block.
inline constexpr std::size_t kMostRows = 3;

/// The problem of a step: find impulses p of the rows and motions y = y* + h M^-1 J^T p of the
/// units, where y* = h (u*, w*) are the motions without contacts and links. They must obey the
/// following. A contact with the normal impulse p_n has a gap >= 0 and p_n >= lowest, and at least
/// one of both is an equality. Friction obeys its FrictionBound. A row of a link has the value
/// -compliance p.
template <int D>
struct ConstraintProblem {
  std::vector<RigidUnit<D>> units;      ///< all units that have a contact or link
  std::vector<RowPart<D>> parts;        ///< parts of all rows, in the order of the rows
  std::vector<ConstraintRow> rows;      ///< rows of all blocks, in the order of the blocks
  std::vector<ConstraintBlock> blocks;  ///< all contacts and links
  std::vector<double> impulses;         ///< of all rows [M L/T]: a guess, then the solution
  /// True if no contact with friction has kCoulomb, so that the solution minimises a convex
  /// function.
  bool is_convex = false;
  /// True if an approximate solution of a convex problem is enough.
  bool is_rough = false;
  /// True if `impulses` solve a convex problem whose offsets differ little from those of this one.
  /// The solver then first takes proximal steps from these impulses. If the steps do not suffice,
  /// it uses interior points that are as accurate as rounding errors permit.
  bool is_near = false;
  /// If false, the solver replaces each given_load by the load of a first solution, and solves
  /// again.
  bool keeps_loads = false;

  /// Adds a row with this offset [L], the parts `of_row`, and a guess of its impulse [M L/T].
  void add_row(double offset, std::span<const RowPart<D>> of_row, double impulse) {
    rows.push_back({offset, parts.size(), of_row.size()});
    parts.insert(parts.end(), of_row.begin(), of_row.end());
    impulses.push_back(impulse);
  }
  /// The parts of row `r`, from 0 to rows.size() - 1.
  std::span<const RowPart<D>> parts_of(std::size_t r) const {
    return std::span(parts).subspan(rows[r].first_part, rows[r].parts);
  }
  /// Value of row `r` [L] for the motions `y` of all units, without the offset of the row.
  double product(std::size_t r, std::span<const Motion<D>> y) const {
    double sum = 0;
    for (const auto& [unit, coefficients] : parts_of(r)) {
      const auto& motion = y[static_cast<std::size_t>(unit)];
      for (std::size_t k = 0; k < motion.size(); ++k) sum += coefficients[k] * motion[k];
    }
    return sum;
  }
  /// Adds the impulses that the impulse `p` of row `r` exerts on its units, J^T p, to `to`, which
  /// has one entry for each unit.
  void add_impulse(std::size_t r, double p, std::span<Motion<D>> to) const {
    for (const auto& [unit, coefficients] : parts_of(r)) {
      auto& impulse = to[static_cast<std::size_t>(unit)];
      for (std::size_t k = 0; k < impulse.size(); ++k) impulse[k] += coefficients[k] * p;
    }
  }
};

/// The motions y* + h M^-1 J^T p of all units with the impulses p = `impulses` of all rows [M L/T].
template <int D>
std::vector<Motion<D>> motions(const ConstraintProblem<D>& problem,
                               std::span<const double> impulses);

/// Makes the problem convex: each contact with friction gets FrictionBound::kGiven, with the load
/// of its solids at problem.impulses as given_load, (5.17). is_convex and keeps_loads become true,
/// and is_rough becomes false. The solution has exact gaps, films and links, but it violates
/// Coulomb's law if its loads differ from the given ones.
template <int D>
void give_loads(ConstraintProblem<D>& problem);

/// The mobilities of the rows of `block` [T/M], > 0 in rows of contacts, otherwise >= 0. A mobility
/// is the change of the value of a row by a unit impulse on the row, an entry on the diagonal of J
/// h M^-1 J^T. Mobilities of rows of angles are in [T/(M L^2)]. In place of two diagonal entries
/// the two tangential rows of a contact of spheres have the larger eigenvalue of their part of the
/// matrix, which does not depend on the choice of the tangents. Numbers beyond the rows are 0.
template <int D>
std::array<double, kMostRows> block_mobilities(const ConstraintProblem<D>& problem,
                                               const ConstraintBlock& block);

/// The block_mobilities() of all blocks, in the order of the rows.
template <int D>
std::vector<double> row_mobilities(const ConstraintProblem<D>& problem);

/// The residual of a block: how much it violates its conditions [L]; 0 at the solution.
struct BlockResidual {
  double normal = 0,   ///< that of the gap, or of the rows of a link [L], >= 0
      tangential = 0;  ///< that of the tangential rows [L], >= 0; 0 without friction
  /// The larger of normal/block.allowed and tangential/block.allowed_slip [1]; NaN if one is NaN.
  double share(const ConstraintBlock& block) const {
    const double of_normal = normal / block.allowed;
    const double of_slip = tangential == 0 ? 0 : tangential / block.allowed_slip;
    return largest_or_nan(of_normal, of_slip);
  }
};
/// The residual of `block` for the values `v` [L] of its rows, their impulses `p` [M L/T] and
/// mobilities `w` > 0 [T/M]. Each pointer points to the number of the first row of the block, which
/// those of its other rows follow. With the normal impulse p_n, the tangential impulses p_t and the
/// values v_t of tangential rows, the residual is
/// - of a contact |min(gap, w (p_n - lowest))| and, with friction, w |p_t - P(p_t - v_t/w)|, where
///   P projects tangential impulses on those of a magnitude up to bound();
/// - of a contact with kCone the normal and the tangential part of w |p - P(p - v/w)|, where P
///   projects impulses on the FrictionCone;
/// - of a link the largest |v + compliance p|.
/// The residual is at least w p times `rounding`, the relative rounding error of the impulses from
/// which motions were computed: if impulses are so large that this error is not allowed, their
/// rounding errors move units too far.
BlockResidual residual_of(const ConstraintBlock& block, const double* v, const double* p,
                          const double* w,
                          double rounding = std::numeric_limits<double>::epsilon());

/// The residual of `block` [L] for the motions of all units and the impulses of the problem.
/// `block` is a block of the problem or a copy of it with another FrictionBound.
template <int D>
BlockResidual residual_after(const ConstraintProblem<D>& problem, const ConstraintBlock& block,
                             std::span<const Motion<D>> motions);

/// The properties of a contact that add_contact_row() needs besides its normal and gap.
template <int D>
struct ContactTangents {
  /// Unit vectors at right angles to the normal and to each other.
  std::array<Vector, static_cast<std::size_t>(D - 1)> directions;
  double first_arm = 0,  ///< from the first particle's centre to the contact [L]; 0 at an obstacle
      second_arm = 0;    ///< from the second particle's centre to the contact [L], > 0
  Vector surface{};      ///< displacement of an obstacle at the contact point in the step [L]
  double capacity = 0;   ///< ConstraintBlock::capacity [M L/T]
};

/// The tangents and arms of a contact in a step from the time `begin` to the time `end` > `begin`
/// [T]. Contact::obstacle is a place in `obstacles`. The result has the capacity 0; the caller must
/// set `capacity`.
template <int D>
ContactTangents<D> tangents_of(const Contact<D>& contact, const Particles& particles,
                               std::span<const Plane> obstacles, double begin, double end);

/// The coefficients of a row for one unit, with which the row is the displacement [L], along the
/// unit vector `direction`, of the point of the unit at the vector `arm` [L] from its centre.
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

/// The unit of a particle of a contact, and the place of the particle in the unit.
struct ContactSide {
  std::int32_t unit = -1;  ///< place in ConstraintProblem::units; -1: its motion is given
  Vector offset{};         ///< from the centre of the unit to that of the particle [L]
  Vector displacement{},   ///< of a particle whose motion is given, in the step [L]
      turn{};              ///< of such a particle [rad], of a disc in component 2
};

/// Adds row number `k` of a contact to `problem`, with the guess `impulse` of the impulse of the
/// row [M L/T]. Row 0 is the gap of the contact. Row k from 1 to D - 1 is the displacement of the
/// surface of the second particle relative to that of the first particle or obstacle, along
/// tangents.directions[k - 1]. The unit of a plane under a load moves along its normal only. Sides
/// without a unit add their given motions to the offset of the row.
template <int D>
void add_contact_row(const Contact<D>& contact, const ContactTangents<D>& tangents,
                     const ContactSide& first, const ContactSide& second, std::size_t k,
                     double impulse, ConstraintProblem<D>& problem);

}  // namespace viscontact::particles
