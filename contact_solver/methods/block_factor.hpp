// Factors of sparse matrices of small dense blocks with a symmetric pattern (BlockFactor), and such
// matrices for contacts and links (UnitMatrix).
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/contact_solver/problem/constraint_problem.hpp"

namespace viscontact::contact_solver {

/// Factorises a square matrix A = (L + D) (I + U): L has the blocks below the diagonal, D those on
/// it, U those above it. A has blocks of K x K numbers (K = 3: discs, 6: spheres) in any unit, and
/// two blocks off the diagonal for each pair of bodies (particles or rigid bodies) that are
/// connected. Rows are exchanged within a block only. Dense blocks are several times as fast as a
/// sparse factorisation of single numbers. Few bodies are eliminated in the order of minimum degree
/// (AMD: Amestoy, Davis & Duff 1996), many in the order of nested dissection (METIS: Karypis &
/// Kumar 1998). If A is declared symmetric, it must be positive definite. Its factorisation is then
/// L L^T (Cholesky), which takes half of the time of LU. The caller calls analyse(), then clear(),
/// adds to the blocks, and calls factorise() and solve(); the steps from clear() on can be
/// repeated.
template <int K>
class BlockFactor {
 public:
  using Block = std::array<double, static_cast<std::size_t>(K* K)>;  ///< row by row
  using Vec = std::array<double, static_cast<std::size_t>(K)>;

  /// Two different bodies that are connected.
  using Edge = std::array<std::int32_t, 2>;

  /// Finds the order of elimination and the pattern of L. A pair may occur several times in
  /// `edges`.
  void analyse(std::size_t bodies, std::span<const Edge> edges, bool is_symmetric);

  std::size_t bodies() const { return order_.size(); }
  /// Number of blocks of L, and of U.
  std::size_t entries() const { return rows_.size(); }

  /// Sets A to 0.
  void clear();
  /// Block of A on the diagonal, to which the caller adds.
  Block& diagonal(std::size_t body) { return diagonal_[place_[body]]; }
  /// Block of A for an edge of analyse(), to which the caller adds. Its rows belong to body `from`,
  /// 0 or 1, of the edge, its columns to the other one. If A is symmetric, is_below() must be true.
  Block& off_diagonal(std::size_t edge, std::size_t from) {
    assert(edge < edges_.size() && from < 2);
    const auto& place = edges_[edge];
    assert(!is_symmetric_ || place.later == from);
    return (place.later == from ? below_ : above_)[place.entry];
  }
  /// True if the block off_diagonal(edge, from) is below the diagonal.
  bool is_below(std::size_t edge, std::size_t from) const { return edges_[edge].later == from; }

  /// Replaces A by its factors. Returns false, with unusable factors, if a block on the diagonal
  /// becomes singular, infinite or NaN, or, for a symmetric A, is not positive definite.
  bool factorise();
  /// 1 or -1; 1 if A is symmetric. Like solve(), only after a factorise() that returned true.
  int sign_of_determinant() const { return sign_; }

  /// Replaces `values`, one Vec for each body, by A^-1 times `values`. Two threads must not call it
  /// at once, because it uses a work array of the object.
  void solve(std::span<Vec> values) const;

 private:
  struct EdgePlace {
    std::size_t entry;  // place of its blocks in below_ and above_
    std::size_t later;  // which body of the edge is eliminated later: 0 or 1
  };
  void find_pattern(std::span<const Edge> edges);
  bool factorise_column(std::size_t j);
  void enlist(std::size_t k, std::size_t entry);

  // Columns and rows are counted by places in the order of elimination, entries are blocks of L.
  std::vector<std::int32_t> order_;   // body that is eliminated at each place
  std::vector<std::size_t> place_;    // place of each body in the order
  std::vector<std::size_t> offsets_;  // first entry of each column of L; at the end their number
  std::vector<std::int32_t> rows_;    // row of each entry, increasing in a column
  std::vector<EdgePlace> edges_;
  std::vector<Block> diagonal_;  // blocks of A, then the factors of the blocks of D
  // Of each block of D: the row with which each row was exchanged.
  std::vector<std::array<unsigned char, static_cast<std::size_t>(K)>> pivots_;
  std::vector<Block> below_;  // blocks of A below the diagonal, then L
  std::vector<Block> above_;  // blocks of A above the diagonal, in the order of below_; then U
  // For factorise(): for each row a linked list, which -1 ends, of the columns whose next entry is
  // in this row.
  std::vector<std::int32_t> first_in_row_, next_in_row_;
  std::vector<std::size_t> next_entry_;    // the next entry of each column
  std::vector<std::size_t> entry_in_row_;  // the entry of the present column in each row
  mutable std::vector<Vec> permuted_;
  bool is_symmetric_ = false;
  int sign_ = 1;
};

/// The matrix M/h + sum of weight * row^T other over pairs of rows of `problem`, with the masses
/// and moments of inertia M of all units over the length h of the step [M/T, M L^2/T].
template <int D>
class UnitMatrix {
 public:
  /// `problem` must outlive this object. Its units, its blocks and the coefficients of its rows
  /// must not change. If `is_symmetric`, the matrix must be so, and is factorised in half of the
  /// time.
  UnitMatrix(const ConstraintProblem<D>& problem, bool is_symmetric);

  void set_to_masses();  ///< to M/h
  /// Adds weight * row^T other for two rows, which may be the same, of constraint block `b`.
  /// `weight` has any sign and the unit [M/T], for rows of angles [M L^2/T]. If the matrix is
  /// symmetric and the rows differ, other^T row must be added, too.
  void add_product(std::size_t b, std::size_t row, std::size_t other, double weight);
  /// Replaces the matrix by its factors; false if this fails, as of BlockFactor.
  bool factorise() { return factor_.factorise(); }
  int sign_of_determinant() const { return factor_.sign_of_determinant(); }
  /// Replaces the impulses on all units by the motions that the impulses cause.
  void solve(std::span<Motion<D>> values) const { factor_.solve(values); }
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
  // Number of the first edge of each block. A block has an edge for each pair of its units, in the
  // order in which its rows name them.
  std::vector<std::size_t> first_edge_;
};

}  // namespace viscontact::contact_solver
