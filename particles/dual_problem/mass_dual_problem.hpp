// The problem for the impulses of contacts in a time step (dual_problem.hpp; docs/physics.md (5.4))
// without a fluid, where only the masses of particles resist impulses: the contacts and bodies in
// flat arrays, products with the matrix W, a sparse factor of W, and the solver. Lengths [L],
// masses [M] and times [T] are in any consistent units. With the impulse p and the mobility w [T/M]
// of a contact, z is w^(1/2) p, a gradient is a gap divided by w^(1/2), both in L (M/T)^(1/2), and
// W has no dimension. Nothing is checked or thrown; a solution comes with its residual. The sources
// of this folder use it; other folders use contact_system.hpp. A change must keep the order of all
// sums, because the results must have the same bits for any number of threads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/dual_problem/dual_problem.hpp"

namespace viscontact::particles {

/// The dual problem with the mobility S = h M^-1, where h is the length of the step [T] and M the
/// diagonal matrix of the masses m of the bodies [M]. A body here is one particle. A contact c of
/// the bodies i and j with the unit normal e, from i to j, has Contact::w = h/m_i + h/m_j, and the
/// scaled W has the diagonal 1. The impulses p of the contacts displace the bodies by y = h M^-1
/// G^T p [L]. G^T p sums, at each body, e p of the contacts in which the body is j, and -e p of
/// those in which it is i. y = B z is linear in the scaled impulses z = sqrt(w) p. b_c [L] is the
/// gap of contact c after the displacements without contacts. The scaled gradient of contact c and
/// the quadratic form of W are
///
///     b_c/sqrt(w) + (e.(y_j - y_i))/sqrt(w),   z^T W z = sum over the bodies b of |y_b|^2 m_b/h.
template <int D>
class MassDualProblem : public DualProblem {
 public:
  /// A vector of the plane or of space.
  using Vec = std::array<double, D>;

  /// `contacts` must have `allowed` > 0 and the `w` above. `displacements` says how far each body
  /// moves in the step without contacts [L], D numbers for each. `mobilities` holds h/m of each
  /// body [T/M], > 0, or 0 for a body whose motion is given. All other obstacles together are one additional body, which does not move.
  /// `body_of` has the number of the body of each particle; if it is empty, particles and bodies
  /// have the same numbers. `pool` must outlive the object.
  MassDualProblem(std::span<const Contact<D>> contacts, std::span<const double> displacements,
                  std::span<const double> mobilities, ThreadPool& pool,
                  std::span<const std::int32_t> body_of = {});

  /// Number of bodies, of which the last one represents all obstacles.
  std::size_t bodies() const { return offsets_.size() - 1; }
  std::size_t displacement_count() const { return bodies() * D; }  ///< numbers in a vector y = B z
  /// The threads. Each takes blocks of ThreadPool::kBlock contacts or bodies.
  ThreadPool& pool() const { return *pool_; }

  /// Number of bodies in the largest set of bodies that contacts connect; 0 if it is unknown. It
  /// affects only the choice of methods.
  std::size_t largest_island = 0;
  bool is_rough = false;  ///< true: the caller needs the solution only to find further contacts

  /// Computes y = B z [L], D numbers for each body, for z = `values`, one number for each contact.
  /// Returns z^T W z.
  double to_bodies(std::span<const double> values, std::span<double> y) const {
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

  /// Returns entry c of W z for y = B z: the part of the gradient of contact c that y causes.
  double to_contact(std::size_t c, const double* y) const {
    const auto& row = rows_[c];
    return product(row, y + index_of(row.first) * D, y + index_of(row.second) * D);
  }

  // The next three functions are for sweeps through the contacts of one block of the thread pool.
  // Their displacements are only those that the contacts of this block cause.

  /// Returns zeros, D for each body of the block that begins at contact `begin`, which must be a
  /// multiple of ThreadPool::kBlock.
  std::vector<double> block_bodies(std::size_t begin) const {
    return std::vector<double>(block_bodies_[begin / ThreadPool::kBlock] * D);
  }
  /// Returns the same as to_contact(), but from the displacements `y` of the bodies of the block of
  /// contact `c`.
  double to_contact_in_block(std::size_t c, const double* y) const {
    return product(rows_[c], y + index_of(in_block_[c][0]) * D, y + index_of(in_block_[c][1]) * D);
  }
  /// Adds B (change of z_c) to the displacements `y` of the bodies of the block of contact `c`.
  void add_in_block(std::size_t c, double change, double* y) const {
    add(rows_[c], change, y + index_of(in_block_[c][0]) * D, y + index_of(in_block_[c][1]) * D);
  }

  /// Calls visit(c', W_cc') for each contact c' != c that shares a particle with contact c. If two
  /// contacts share both particles, `visit` is called twice, with two parts of the entry.
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
    // Numbers of the two bodies; that of an obstacle is the last one, whose body does not move.
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
  void number_bodies_of_blocks();

  std::vector<Row> rows_;
  // For each contact, the numbers of its first and second body among the bodies of its block.
  std::vector<std::array<std::int32_t, 2>> in_block_;
  std::vector<std::size_t> block_bodies_;  // number of bodies of each block
  std::vector<std::int32_t> offsets_;      // index of the first share of each body
  std::vector<Share> shares_;              // the shares of each body, in the order of its contacts
  // m/h of each displacement [M/T], D equal numbers for each body; 0 for the body of the planes.
  std::vector<double> inverse_mobilities_;
  ThreadPool* pool_;
};

/// A sparse Cholesky factor of the scaled matrix W between chosen contacts. dual_solver.cpp uses it
/// as a solver and as a preconditioner. The chosen contacts are the free ones, whose z is above the
/// bound.
///
/// Chains, and packings at rest, have about as many contacts with impulses as degrees of freedom. W
/// is then so ill-conditioned that iterative methods need many iterations, for a chain about as
/// many as it has contacts. The factor gives the z of all chosen contacts in one step.
template <int D>
class FreeSetFactor {
 public:
  /// `epsilon` [1], >= 0, is added to the diagonal of W, which is 1, because W is singular if
  /// several impulses cause the same motion. 1e-10 is far above rounding errors, and far below 1.
  explicit FreeSetFactor(double epsilon = 1e-10);
  ~FreeSetFactor();

  /// Factorises W between the contacts c with free[c] != 0; `free` has one number for each contact.
  /// Returns false, and leaves no factor, if the factor would have so many entries that iterations
  /// without it are cheaper (as in packings of spheres), or if W cannot be factorised. Calls with
  /// the same number of contacts must be for the same contacts, because they share one order of
  /// elimination.
  bool factorise(const MassDualProblem<D>& problem, const std::vector<char>& free);
  /// True if the last factorise() succeeded.
  bool exists() const;

  /// Sets `solved` to (W + epsilon I)^-1 gradient for the contacts of the factor, and to 0 for all
  /// others. Both arrays have one number for each contact. exists() must be true.
  void solve(std::span<const double> gradient, std::span<double> solved) const;

  /// Applies the factor to `gradient` as a preconditioner, and sets `solved` to the result. The
  /// preconditioner is symmetric and positive definite on the contacts that are free now. Free
  /// contacts that the factor does not have keep their gradient; contacts that are not free get 0.
  /// `problem` is that of factorise(), or that problem with further contacts at its end. Returns
  /// the inner product of `solved` and `gradient`. exists() must be true.
  double precondition(const MassDualProblem<D>& problem, std::span<const double> gradient,
                      std::span<double> solved) const;

 private:
  struct Factor;
  double epsilon_;
  std::unique_ptr<Factor> factor_;
};

/// Solves the dual problem by projected conjugate gradients (mprgp.hpp). Their preconditioner is a
/// sweep of symmetric Gauss-Seidel or, if many iterations are needed and the factor is cheap, a
/// FreeSetFactor. Newton's method (active_set_newton.hpp) is tried first on chains of contacts, and
/// on other problems after many iterations.
///
/// Improves the guess problem.z until all residuals are at most 1, or until `max_iterations` > 0
/// are done; a few more may be made. If contacts are redundant, the velocities determine only sums
/// of their impulses, and the single impulses depend on the guess. `factor` may come from an
/// earlier call for the same step, whose problem may have had fewer contacts. This function uses it
/// and may replace it. The returned SolverResult::residual is larger than 1 if the problem is not
/// solved; a contact with a residual NaN does not count in it.
template <int D>
SolverResult solve_dual_problem(MassDualProblem<D>& problem, int max_iterations,
                                FreeSetFactor<D>& factor);

}  // namespace viscontact::particles
