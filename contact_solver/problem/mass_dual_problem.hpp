// The problem (5.4), docs/physics.md, where only masses resist impulses. Sums have a fixed order,
// so that results do not depend on the number of threads.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "viscontact/common/index.hpp"
#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/contact_solver/problem/dual_problem.hpp"

namespace viscontact::contact_solver {

/// A frictionless contact of two bodies.
template <int D>
struct GapRow {
  std::int32_t first = -1;       ///< number of a body; -1: an obstacle, which does not move
  std::int32_t second = 0;       ///< number of another body
  std::array<double, D> normal;  ///< unit normal [1] from `first` to `second`
  double gap = 0;                ///< if no body moves [L]
  ContactBounds bounds;
};

/// The dual problem with the mobility S = h M^-1, the length h of the step over the masses m [M] of
/// bodies; a body here is one particle. A contact c of the bodies i and j with the unit normal e,
/// from i to j, has ContactBounds::w = h/m_i + h/m_j, and the scaled W has the diagonal 1. The
/// impulses p displace the bodies by y = h M^-1 G^T p = B z [L], where G^T p sums, at each body, e
/// p of the contacts in which the body is j, and -e p of those in which it is i. b_c [L] is the gap
/// of contact c after the displacements without contacts. The scaled gradient of contact c and the
/// quadratic form of W are
///
///     b_c/sqrt(w) + (e.(y_j - y_i))/sqrt(w),   z^T W z = sum over the bodies b of |y_b|^2 m_b/h.
template <int D>
class MassDualProblem : public DualProblem {
 public:
  using Vec = std::array<double, D>;

  /// `contacts` have the `w` above. `displacements` are those without contacts [L], D for each
  /// body, `mobilities` are h/m [T/M], or 0 for a body whose motion is given. All obstacles
  /// together are one additional body. `pool` must outlive the object.
  MassDualProblem(std::span<const GapRow<D>> contacts, std::span<const double> displacements,
                  std::span<const double> mobilities, ThreadPool& pool);

  /// The last body represents all obstacles.
  std::size_t bodies() const { return offsets_.size() - 1; }
  std::size_t displacement_count() const { return bodies() * D; }  ///< numbers in y = B z
  ThreadPool& pool() const { return *pool_; }

  /// Number of bodies in the largest island, for the choice of methods; 0 if it is unknown.
  std::size_t largest_island = 0;
  bool is_rough = false;  ///< true: the solution serves only to find further contacts

  /// Computes y = B z [L] for z = `values`. Returns z^T W z.
  double to_bodies(std::span<const double> values, std::span<double> y) const {
    assert(values.size() == count() && y.size() == displacement_count());
    return pool_->sum_of_blocks<double>(bodies(), [&](std::size_t begin, std::size_t end) {
      double form = 0;
      for (std::size_t b = begin; b < end; ++b) {
        Vec sum{};
        for (auto k = offsets_[b]; k < offsets_[b + 1]; ++k) {
          const auto& share = shares_[index_of(k)];
          const double value = values[index_of(share.contact)];
          for (std::size_t d = 0; d < D; ++d) sum[d] += share.push[d] * value;
        }
        double square = 0;
        for (std::size_t d = 0; d < D; ++d) {
          y[b * D + d] = sum[d];
          square += sum[d] * sum[d];
        }
        form += square * inverse_mobilities_[b * D];
      }
      return form;
    });
  }

  /// Replaces `into` by y + factor * into, which is B z for some z. Returns z^T W z for this z.
  double combine(std::span<const double> y, double factor, std::span<double> into) const;

  double to_contact(std::size_t c, const double* y) const {
    assert(c < rows_.size());
    const auto& row = rows_[c];
    return product(row, y + index_of(row.first) * D, y + index_of(row.second) * D);
  }

  // The next three functions are for sweeps through the contacts of one block of the thread pool,
  // with the displacements that only these cause.

  /// Zeros, D for each body of the block that begins at contact `begin`.
  std::vector<double> block_bodies(std::size_t begin) const {
    assert(begin % ThreadPool::kBlock == 0);
    return std::vector<double>(block_bodies_[begin / ThreadPool::kBlock] * D);
  }
  /// to_contact() from the displacements `y` of the bodies of the block of contact `c`.
  double to_contact_in_block(std::size_t c, const double* y) const {
    return product(rows_[c], y + index_of(in_block_[c][0]) * D, y + index_of(in_block_[c][1]) * D);
  }
  /// Adds B (change of z_c) to the displacements `y` of the bodies of the block of contact `c`.
  void add_in_block(std::size_t c, double change, double* y) const {
    add(rows_[c], change, y + index_of(in_block_[c][0]) * D, y + index_of(in_block_[c][1]) * D);
  }

  /// Calls visit(c', W_cc') for each contact c' != c that shares a particle with contact c, twice,
  /// with two parts of the entry, if they share both.
  template <class Visit>
  void visit_neighbours(std::size_t c, const Visit& visit) const {
    const auto& row = rows_[c];
    const auto visit_at = [&](std::int32_t body, double of_body) {
      const auto b = index_of(body);
      for (auto k = offsets_[b]; k < offsets_[b + 1]; ++k) {
        const auto& share = shares_[index_of(k)];
        const auto other = index_of(share.contact);
        if (other == c) continue;
        double entry = 0;
        for (std::size_t d = 0; d < D; ++d) entry += row.normal[d] * share.push[d];
        visit(other, of_body * inverse_mobilities_[b * D] * entry);
      }
    };
    visit_at(row.first, -row.of_first);
    visit_at(row.second, row.of_second);
  }

 private:
  struct Row {
    // The body of an obstacle is the last one.
    std::int32_t first, second;
    Vec normal;
    double per_root;             // 1/sqrt(w)
    double of_first, of_second;  // (h/m)/sqrt(w) of the first and the second body
  };
  struct Share {
    std::int32_t contact;
    Vec push;  // displacement of the body if z of this contact is 1
  };
  // A vector of the plane fits into one register, but GCC 12 does not use it without this type.
  using Double2 [[gnu::vector_size(16)]] = double;
  static Double2 load(const double* from) { return Double2{from[0], from[1]}; }

  static double product(const Row& row, const double* yi, const double* yj) {
    if constexpr (D == 2) {
      const Double2 parts = load(row.normal.data()) * (load(yj) - load(yi));
      return (parts[0] + parts[1]) * row.per_root;
    } else {
      double sum = 0;
      for (std::size_t d = 0; d < D; ++d) sum += row.normal[d] * (yj[d] - yi[d]);
      return sum * row.per_root;
    }
  }
  static void add(const Row& row, double change, double* yi, double* yj) {
    const Vec normal = row.normal;
    const double of_first = change * row.of_first, of_second = change * row.of_second;
    for (std::size_t d = 0; d < D; ++d) yi[d] -= normal[d] * of_first;
    for (std::size_t d = 0; d < D; ++d) yj[d] += normal[d] * of_second;
  }

  void list_shares();
  // In the order in which contacts of a block name them; with a single block they keep their
  // numbers.
  void number_bodies_of_blocks();

  std::vector<Row> rows_;
  // For each contact its two bodies among those of its block.
  std::vector<std::array<std::int32_t, 2>> in_block_;
  std::vector<std::size_t> block_bodies_;
  std::vector<std::int32_t> offsets_;
  std::vector<Share> shares_;  // what contacts add to the motion of each body, in their order
  // m/h of each displacement [M/T], D for each body; 0 for the body of the obstacles.
  std::vector<double> inverse_mobilities_;
  ThreadPool* pool_;
};

/// A sparse Cholesky factor of the scaled W between chosen contacts. Chains, and packings at rest,
/// have about as many contacts with impulses as degrees of freedom. W is then so ill-conditioned
/// that iterations are many, for a chain about as many as it has contacts.
template <int D>
class FreeSetFactor {
 public:
  /// `epsilon` [1] is added to the diagonal of W, which is 1, because W is singular if several
  /// impulses cause the same motion. 1e-10 is far above rounding errors, and far below 1.
  explicit FreeSetFactor(double epsilon = 1e-10);
  ~FreeSetFactor();

  /// Factorises W between the contacts c with free[c] != 0. Returns false, and leaves no factor, if
  /// it would have so many entries that iterations are cheaper (as in packings of spheres), or if W
  /// is singular. Calls with the same number of contacts must be for the same ones, because they
  /// share an order of elimination.
  bool factorise(const MassDualProblem<D>& problem, const std::vector<char>& free);
  bool exists() const;

  /// Sets `solved` to (W + epsilon I)^-1 gradient for the contacts of the factor, and to 0 for
  /// others.
  void solve(std::span<const double> gradient, std::span<double> solved) const;

  /// Applies the factor as a preconditioner, symmetric and positive definite on the contacts that
  /// are free now, and returns the inner product of `solved` and `gradient`. Free contacts without
  /// factor keep their gradient; others get 0. `problem` may have further contacts at its end since
  /// factorise().
  double precondition(const MassDualProblem<D>& problem, std::span<const double> gradient,
                      std::span<double> solved) const;

 private:
  struct Factor;
  double epsilon_;
  std::unique_ptr<Factor> factor_;
};

/// Improves the guess problem.z until all residuals are at most 1, or about `max_iterations` are
/// done: by projected conjugate gradients (mprgp.hpp), preconditioned by sweeps of symmetric
/// Gauss-Seidel or a FreeSetFactor, and by Newton's method (active_set_newton.hpp). The table of
/// DualLadder says when. SolverResult::stages lists what ran. Of redundant
/// contacts only sums of impulses are determined. `factor` may come from an earlier call for the
/// same step with fewer contacts, and may be replaced. SolverResult::residual is > 1 without a
/// solution.
template <int D>
SolverResult solve_dual_problem(MassDualProblem<D>& problem, int max_iterations,
                                FreeSetFactor<D>& factor);

}  // namespace viscontact::contact_solver
