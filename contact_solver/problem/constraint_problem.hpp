// The problem for the impulses of the contacts with friction and the links of one step, (5.6) to
// (5.9), docs/physics.md; also the equation numbers below.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "viscontact/common/index.hpp"
#include "viscontact/contact_solver/problem/contact_conditions.hpp"

namespace viscontact::contact_solver {

template <int D>
inline constexpr int kTurns = D == 2 ? 1 : 3;

/// A displacement [L] and a rotation [rad], or an impulse [M L/T] and its moment [M L^2/T].
template <int D>
using Motion = std::array<double, static_cast<std::size_t>(D + kTurns<D>)>;

/// The mass and the free motion of a unit: a particle, or a rigid body of several particles.
template <int D>
struct RigidUnit {
  static constexpr auto kTurnDirections = static_cast<std::size_t>(kTurns<D>);
  static constexpr std::size_t kTurnEntries = kTurnDirections * kTurnDirections;
  Motion<D> free{};  ///< motion without contacts and links, h (u*, w*) [L, rad]; h [T] is the step
  double mobility = 0;                                       ///< h/m [T/M], > 0
  std::array<double, kTurnEntries> turn_mobility{};          ///< h I^-1 [T/(M L^2)], row by row
  double inverse_mobility = 0;                               ///< m/h [M/T]
  std::array<double, kTurnEntries> inverse_turn_mobility{};  ///< I/h [M L^2/T], row by row

  /// The motion that an impulse and a moment cause.
  Motion<D> moved_by(const Motion<D>& impulse) const {
    return product(mobility, turn_mobility, impulse);
  }
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

/// What one unit adds to the value of a row: the inner product of `coefficients` and its motion.
template <int D>
struct RowPart {
  std::int32_t unit = 0;     ///< place in ConstraintProblem::units
  Motion<D> coefficients{};  ///< [1] for displacements, [L] for rotations; any sign
};

/// A scalar that depends linearly on the motions of units, `offset` plus its parts: a gap, a
/// tangential displacement of surfaces, or the left side of a link's equation [L]. A row of angles
/// has [rad] in place of [L], and its impulse [M L^2/T] in place of [M L/T].
struct ConstraintRow {
  double offset = 0;  ///< value of the row if no unit moves [L]
  std::size_t first_part = 0;
  std::size_t parts = 0;  ///< they follow each other in ConstraintProblem::parts
};

/// What bounds the tangential impulse of a contact, with the coefficient of friction mu_s. The load
/// of the solids is the part of the normal impulse that the film, a thin layer of fluid, does not
/// absorb.
enum class FrictionBound : unsigned char {
  /// mu_s times the load of the solids in the solution: Coulomb's law, (5.7).
  kCoulomb,
  /// The convex relaxation of Coulomb's law, (5.9), for contacts without a film.
  kCone,
  /// mu_s times ConstraintBlock::given_load, (5.17).
  kGiven,
};

/// A contact, or the equations of a link. A contact has one row for its gap and, with friction, D -
/// 1 more for the tangential displacements of its surfaces. All rows of a block have parts of the
/// same units, each once, in the same order.
struct ConstraintBlock {
  std::size_t row = 0;
  std::size_t rows = 1;    ///< 1 to kMostRows
  bool is_contact = true;  ///< false: a link
  /// True: the row is the geometric stiffness of another block, (5.21).
  bool is_geometric = false;
  /// Lower bound of the normal impulse [M L/T]: in a step gamma^n <= 0, minus the impulse that the
  /// film has absorbed; in a collision it may be > 0.
  double lowest = 0;
  double friction = 0;  ///< mu_s [1], >= 0
  /// Impulse gamma^n - gamma_min that the film can still absorb [M L/T], >= 0; may be infinite.
  double capacity = 0;
  double allowed = 0,    ///< largest residual of the gap, or of the rows of a link [L], > 0
      allowed_slip = 0;  ///< largest residual of the tangential rows [L], > 0
  /// Compliance of a link [T/M], >= 0: the value v and the impulse p of each row obey v +
  /// compliance p = 0.
  double compliance = 0;
  /// For blocks of more than one row. With kCone `lowest` and `capacity` must be 0.
  FrictionBound friction_bound = FrictionBound::kCoulomb;
  double given_load = 0;  ///< load that bounds the friction with kGiven [M L/T], >= 0
  /// True: without an impulse the contact only demands a gap >= 0. With kCone (5.9) would demand a
  /// gap of at least mu_s times the slip of the surfaces, and push them apart.
  bool is_optional = false;
  bool is_in_cone() const { return rows > 1 && friction_bound == FrictionBound::kCone; }
  /// True if the contact has a film, which takes the first part of a normal impulse.
  bool has_film() const { return capacity > lowest; }
  /// Largest tangential impulse [M L/T] at this normal impulse [M L/T]; without meaning with kCone.
  double bound(double normal_impulse) const {
    return friction * (friction_bound == FrictionBound::kGiven
                           ? given_load
                           : load_of_solids(normal_impulse, capacity));
  }
};

inline constexpr std::size_t kMostRows = 3;

/// Find impulses p of the rows and motions y = y* + h M^-1 J^T p of the units, with the motions y*
/// = h (u*, w*) without contacts and links, the masses and moments of inertia M and the
/// coefficients J of the rows. A contact with the normal impulse p_n has a gap >= 0 and p_n >=
/// lowest, and at least one of both is an equality. Friction obeys its FrictionBound. A row of a
/// link has the value -compliance p.
template <int D>
struct ConstraintProblem {
  std::vector<RigidUnit<D>> units;  ///< all units that have a contact or link
  std::vector<RowPart<D>> parts;
  std::vector<ConstraintRow> rows;  ///< in the order of the blocks
  std::vector<ConstraintBlock> blocks;
  std::vector<double> impulses;  ///< of all rows [M L/T]: a guess, then the solution
  /// True if no contact with friction has kCoulomb: the solution minimises a convex function.
  bool is_convex = false;
  /// True if an approximate solution of a convex problem is enough.
  bool is_rough = false;
  /// True if `impulses` solve a convex problem with similar offsets. The solver first takes
  /// proximal steps from them, and otherwise uses the most accurate interior points.
  bool is_near = false;
  /// False: the solver replaces each given_load by the load of a first solution, and solves again.
  bool keeps_loads = false;

  /// `offset` is in [L], `impulse` is a guess [M L/T].
  void add_row(double offset, std::span<const RowPart<D>> of_row, double impulse) {
    rows.push_back({offset, parts.size(), of_row.size()});
    parts.insert(parts.end(), of_row.begin(), of_row.end());
    impulses.push_back(impulse);
  }
  std::span<const RowPart<D>> parts_of(std::size_t r) const {
    assert(r < rows.size());
    return std::span(parts).subspan(rows[r].first_part, rows[r].parts);
  }
  /// Value of row `r` [L] for the motions `y` of all units, without the offset of the row.
  double product(std::size_t r, std::span<const Motion<D>> y) const {
    assert(y.size() == units.size());
    double sum = 0;
    for (const auto& [unit, coefficients] : parts_of(r)) {
      const auto& motion = y[static_cast<std::size_t>(unit)];
      for (std::size_t k = 0; k < motion.size(); ++k) sum += coefficients[k] * motion[k];
    }
    return sum;
  }
  /// Adds J^T p, the impulses that the impulse `p` of row `r` exerts, to those of all units.
  void add_impulse(std::size_t r, double p, std::span<Motion<D>> to) const {
    assert(to.size() == units.size());
    for (const auto& [unit, coefficients] : parts_of(r)) {
      auto& impulse = to[static_cast<std::size_t>(unit)];
      for (std::size_t k = 0; k < impulse.size(); ++k) impulse[k] += coefficients[k] * p;
    }
  }
};

/// The motions y* + h M^-1 J^T p of all units with the impulses p of all rows [M L/T].
template <int D>
std::vector<Motion<D>> motions(const ConstraintProblem<D>& problem,
                               std::span<const double> impulses);

/// Makes the problem convex: each contact with friction gets FrictionBound::kGiven with the load of
/// its solids at problem.impulses, (5.17). The solution violates Coulomb's law if its loads differ
/// from these.
template <int D>
void give_loads(ConstraintProblem<D>& problem);

/// Optional contacts with kCone and without an impulse get FrictionBound::kGiven with the load 0,
/// with which methods that solve for all blocks at once do not push them apart.
template <int D>
void bind_optional(ConstraintProblem<D>& problem);

/// The changes of the rows of `block` by unit impulses [T/M], > 0 in rows of contacts: entries on
/// the diagonal of J h M^-1 J^T. The tangential rows of a contact of spheres have the larger
/// eigenvalue of their part, which does not depend on the choice of the tangents. Numbers beyond
/// the rows are 0.
template <int D>
std::array<double, kMostRows> block_mobilities(const ConstraintProblem<D>& problem,
                                               const ConstraintBlock& block);

template <int D>
std::vector<double> row_mobilities(const ConstraintProblem<D>& problem);

/// How much a block violates its conditions [L]; 0 at the solution.
struct BlockResidual {
  double normal = 0,   ///< that of the gap, or of the rows of a link [L], >= 0
      tangential = 0;  ///< that of the tangential rows [L], >= 0; 0 without friction
  /// The larger of normal/allowed and tangential/allowed_slip [1]; NaN if one is NaN.
  double share(const ConstraintBlock& block) const {
    const double of_normal = normal / block.allowed;
    const double of_slip = tangential == 0 ? 0 : tangential / block.allowed_slip;
    return largest_or_nan(of_normal, of_slip);
  }
};
/// The residual of `block` for the values `v` [L], impulses `p` [M L/T] and mobilities `w` > 0
/// [T/M] of its rows, where p_n and p_t are the normal and tangential impulses and v_t the
/// tangential values:
/// - of a contact |min(gap, w (p_n - lowest))| and, with friction, w |p_t - P(p_t - v_t/w)|, where
///   P projects tangential impulses on those of a magnitude up to bound();
/// - of a contact that is_optional and has no impulse the overlap;
/// - of another contact with kCone the normal and the tangential part of w |p - P(p - v/w)|, where P
///   projects impulses on the FrictionCone;
/// - of a link the largest |v + compliance p|.
/// It is at least w p times `rounding`, the relative rounding error of the impulses from which
/// motions were computed, because such errors of large impulses move units too far.
BlockResidual residual_of(const ConstraintBlock& block, const double* v, const double* p,
                          const double* w,
                          double rounding = std::numeric_limits<double>::epsilon());

/// `motions` are those of all units. `block` may be a copy of a block with another FrictionBound.
template <int D>
BlockResidual residual_after(const ConstraintProblem<D>& problem, const ConstraintBlock& block,
                             std::span<const Motion<D>> motions);

}  // namespace viscontact::contact_solver
