// The matrices of Newton's methods for the constraints of a step: inverse mobilities of the units
// and products of rows (constraint_problem.hpp). Units are those of the case. Nothing is thrown.
// Used by interior_points.hpp, proximal_step.hpp and contradiction.cpp.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "viscontact/particles/constraints/block_factor.hpp"
#include "viscontact/particles/constraints/constraint_problem.hpp"

namespace viscontact::particles {

/// The sum of M/h, a block for each unit, and of products of rows of one block of constraints. It
/// need not be symmetric; with `kIsSymmetric` it must be, and is factorised in half of the time.
template <int D, bool kIsSymmetric = false>
class UnitMatrix {
 public:
  /// `problem` must outlive this object.
  explicit UnitMatrix(const ConstraintProblem<D>& problem);

  void set_to_masses();  ///< sets the matrix to M/h
  /// Adds weight * row^T other, for two rows of constraint block `b`. To a symmetric matrix the
  /// product of the rows in the other order must be added, too.
  void add_product(std::size_t b, std::size_t row, std::size_t other, double weight);
  /// Replaces the matrix by its factors. Returns false if it is singular.
  bool factorise() { return factor_.factorise(); }
  /// Sign of its determinant, 1 or -1. Needs factorise().
  int sign_of_determinant() const { return factor_.sign_of_determinant(); }
  /// Replaces impulses by the motions that they cause. Needs factorise().
  void solve(std::span<Motion<D>> values) const { factor_.solve(values); }
  /// The motions that impulses cause. Needs factorise().
  std::vector<Motion<D>> solution_of(std::span<const Motion<D>> impulses) const {
    std::vector<Motion<D>> motions(impulses.begin(), impulses.end());
    solve(motions);
    return motions;
  }

 private:
  static constexpr int kMotion = D + kTurns<D>;

  const ConstraintProblem<D>& problem_;
  BlockFactor<kMotion, kIsSymmetric> factor_;
  // Number of the first edge of each block: one for each pair of its units, of which the first is
  // that of the earlier part.
  std::vector<std::size_t> first_edge_;
};

}  // namespace viscontact::particles
