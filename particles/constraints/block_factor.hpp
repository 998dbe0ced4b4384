// Sparse LU factorisation of a matrix of small dense blocks with a symmetric pattern, one block row
// for each rigid body, and the matrices of Newton's methods for the constraints of a step that it
// factorises. Numbers have the units of the matrix. Nothing is thrown. Used by
// constraint_system.cpp, interior_points.hpp and proximal_step.hpp. A change must keep the order of
// all sums, so that results do not depend on the number of threads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/particles/constraints/constraint_problem.hpp"

namespace viscontact::particles {

/// Factorises A = (L + D) (I + U) without exchange of rows between bodies, where A has blocks of
/// K x K numbers (3: a disc, 6: a sphere) and two blocks off the diagonal for each pair of bodies
/// that constraints connect. Dense blocks make it several times as fast as a factorisation of
/// single numbers. Few bodies are eliminated in the order of minimum degree (AMD: Amestoy, Davis &
/// Duff 1996, "An approximate minimum degree ordering algorithm"), many in that of nested dissection
/// (METIS: Karypis & Kumar 1998, "A fast and high quality multilevel scheme for partitioning
/// irregular graphs"). A symmetric A must be positive definite and becomes L L^T (Cholesky), in half
/// of the time, because only its blocks on and below the diagonal are stored and computed.
template <int K>
class BlockFactor {
 public:
  using Block = std::array<double, static_cast<std::size_t>(K* K)>;  ///< row by row
  using Vec = std::array<double, static_cast<std::size_t>(K)>;       ///< numbers of one body

  /// Two bodies, first != second, in any order.
  using Edge = std::array<std::int32_t, 2>;

  /// Finds the order of elimination and the pattern of L for `bodies` bodies that `edges` connect;
  /// an edge may occur several times. `is_symmetric` says that A is symmetric.
  void analyse(std::size_t bodies, std::span<const Edge> edges, bool is_symmetric);

  /// Number of bodies that analyse() was given.
  std::size_t bodies() const { return order_.size(); }
  /// Number of blocks of L, and of U.
  std::size_t entries() const { return rows_.size(); }

  /// Sets A to 0.
  void clear();
  /// Block of A on the diagonal, to which the caller adds.
  Block& diagonal(std::size_t body) { return diagonal_[place_[body]]; }
  /// Block of A of edge number `edge` of analyse(), to which the caller adds: its rows belong to
  /// edge[from], its columns to the other body. Of a symmetric A it must be below the diagonal.
  Block& off_diagonal(std::size_t edge, std::size_t from) {
    const auto& place = edges_[edge];
    return (place.later == from ? below_ : above_)[place.entry];
  }
  /// Whether that block is below the diagonal in the order of elimination.
  bool is_below(std::size_t edge, std::size_t from) const { return edges_[edge].later == from; }

  /// Replaces A by its factors. Returns false if a block on the diagonal becomes singular, or
  /// is not positive definite where A is symmetric.
  bool factorise();
  /// Sign of the determinant of A, 1 or -1. Needs factorise().
  int sign_of_determinant() const { return sign_; }

  /// Replaces the values of the bodies by A^-1 times them. Needs factorise().
  void solve(std::span<Vec> values) const;

 private:
  struct EdgePlace {
    std::size_t entry;
    std::size_t later;  // which of the two bodies is eliminated later
  };
  void find_pattern(std::span<const Edge> edges);
  bool factorise_column(std::size_t j);
  void enlist(std::size_t k, std::size_t entry);

  std::vector<std::int32_t> order_;   // body that is eliminated at each place
  std::vector<std::size_t> place_;    // place of each body in the order
  std::vector<std::size_t> offsets_;  // first entry of each column of L
  std::vector<std::int32_t> rows_;    // place of the row of each entry, increasing in a column
  std::vector<EdgePlace> edges_;
  std::vector<Block> diagonal_;  // of A; then the factors of the blocks of D
  std::vector<std::array<unsigned char, static_cast<std::size_t>(K)>> pivots_;  // of these factors
  std::vector<Block> below_;  // of A below the diagonal; then L
  std::vector<Block> above_;  // of A above the diagonal, entry by entry as below_; then U
  // For factorise(): the columns whose next entry is in a given row, as linked lists; the next
  // entry of each column; and the entry of the present column in each row.
  std::vector<std::int32_t> first_in_row_, next_in_row_;
  std::vector<std::size_t> next_entry_, entry_in_row_;
  mutable std::vector<Vec> permuted_;
  bool is_symmetric_ = false;
  int sign_ = 1;
};

/// The sum of M/h, a block for each unit, and of products of rows of one block of constraints.
template <int D>
class UnitMatrix {
 public:
  /// `problem` must outlive this object. A matrix that `is_symmetric` is factorised in half of the
  /// time.
  UnitMatrix(const ConstraintProblem<D>& problem, bool is_symmetric);

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
  bool is_symmetric_;
  BlockFactor<kMotion> factor_;
  // Number of the first edge of each block: one for each pair of its units, of which the first is
  // that of the earlier part.
  std::vector<std::size_t> first_edge_;
};

}  // namespace viscontact::particles
