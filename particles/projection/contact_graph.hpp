// The projection of one time step in flat arrays: contacts, bodies, and the two loops that every method is made of.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"

namespace viscontact::particles {

/// Two particles that may touch in this step, or a particle and a plane.
template <int D>
struct Contact {
  std::int32_t first = -1;       ///< particle, or -1: `second` meets a plane
  std::int32_t second = 0;       ///< particle
  std::array<double, D> normal;  ///< e_ij, unit, from first (or the plane) to second
  double gap = 0;      ///< D_ij at the step's begin, of a plane at the place of its end [L]
  double gamma = 0;    ///< gamma_ij^n <= 0 [M L/T]
  double impulse = 0;  ///< h lambda_ij [M L/T] >= gamma: a guess, then the solution
  double allowed =
      0;  ///< how far it may be from its conditions when the step has converged [L], > 0
  double tolerated = 0;  ///< overlap that is not pushed out [L], >= 0: `gap` is D plus this
};

/// physics.md (5), one step, in impulses p = h lambda. With u* = u^n + h f^n and the displacements h v = h u* + h M^-1 G^T p,
///
///     minimise  1/2 p^T W p + b^T p  over  p_ij >= gamma_ij^n,     W = h G M^-1 G^T,  b = D + h G u*   (gradient: D + h G v).
///
/// For gamma^n = 0 that is p >= 0, D + h G v >= 0, one of them 0. For gamma^n < 0 the pair is held at D + h G v = 0 by as much pull as its film has
/// left, -gamma^n: the impulse that is then missing lets it go within the step, the others' impulses known.
///
/// Here in units in which W has the diagonal 1: with w = W_cc = h/m_i + h/m_j, z = sqrt(w) p. What impulses z do to the bodies is their displacements
/// y = h M^-1 G^T p, B z for short; the gradient of contact c is then b_c/sqrt(w) + (e.(y_j - y_i))/sqrt(w), and z^T W z = sum |y_b|^2 m_b/h.
template <int D>
class ContactGraph {
 public:
  using Vec = std::array<double, D>;

  /// `displacements`: h u* of each body, flat [L]; `mobilities`: h/m of each [T/M]. A plane is one body more.
  ContactGraph(std::span<const Contact<D>> contacts, std::span<const double> displacements,
               std::span<const double> mobilities, ThreadPool& pool);

  std::size_t count() const { return rows_.size(); }
  std::size_t bodies() const { return offsets_.size() - 1; }
  ThreadPool& pool() const { return *pool_; }

  std::vector<double> z;            ///< scaled impulses
  std::vector<double> bound;        ///< of z: sqrt(w) gamma^n
  std::vector<double> linear_term;  ///< b/sqrt(w): the gradient at z = 0
  std::vector<double> scale;        ///< sqrt(w)
  std::vector<double> per_allowed;  ///< scale over the residual that is allowed of the contact
  std::size_t largest_island = 0;   ///< how many bodies are connected by contacts, at most
  /// Whether the solution only has to show which other contacts take part.
  bool is_rough = false;

  /// y = B z, D numbers a body. Returns z^T W z.
  double to_bodies(std::span<const double> values, std::span<double> y) const {
    return pool_->sum_of_blocks<double>(bodies(), [&](std::size_t begin, std::size_t end) {
      double form = 0;
      for (std::size_t b = begin; b < end; ++b) {
        Vec sum{};
        for (auto k = offsets_[b]; k < offsets_[b + 1]; ++k) {
          const auto& share = shares_[static_cast<std::size_t>(k)];
          const double value = values[static_cast<std::size_t>(share.contact)];
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

  /// into = y + factor * into, the same combination of displacements. Returns the form z^T W z of the sum.
  double combine(std::span<const double> y, double factor, std::span<double> into) const;

  /// (W z)_c of y = B z: what the displacements change of the gradient of contact c.
  double to_contact(std::size_t c, const double* y) const {
    const auto& row = rows_[c];
    return product(row, y + static_cast<std::size_t>(row.first) * D,
                   y + static_cast<std::size_t>(row.second) * D);
  }

  /// y += B (change of z_c).
  void add(std::size_t c, double change, double* y) const {
    const auto& row = rows_[c];
    add(row, change, y + static_cast<std::size_t>(row.first) * D,
        y + static_cast<std::size_t>(row.second) * D);
  }

  // The same two within a block of the pool, on the block's own bodies: another block's contacts do not see them.

  /// Zero for each body of the block that begins at contact `begin`, D numbers each.
  std::vector<double> block_bodies(std::size_t begin) const {
    return std::vector<double>(block_bodies_[begin / ThreadPool::kBlock] * D);
  }
  double to_contact_in_block(std::size_t c, const double* y) const {
    return product(rows_[c], y + static_cast<std::size_t>(in_block_[c][0]) * D,
                   y + static_cast<std::size_t>(in_block_[c][1]) * D);
  }
  void add_in_block(std::size_t c, double change, double* y) const {
    add(rows_[c], change, y + static_cast<std::size_t>(in_block_[c][0]) * D,
        y + static_cast<std::size_t>(in_block_[c][1]) * D);
  }

  bool is_free(std::size_t c) const { return z[c] > bound[c]; }

  /// Calls visit(c', W_cc') for each contact c' that has a particle in common with c, but for c itself, whose W_cc is 1.
  template <class Visit>
  void visit_neighbours(std::size_t c, const Visit& visit) const {
    const auto& row = rows_[c];
    const auto visit_at = [&](std::int32_t body, double of_body) {
      const auto b = static_cast<std::size_t>(body);
      for (auto k = offsets_[b]; k < offsets_[b + 1]; ++k) {
        const auto& share = shares_[static_cast<std::size_t>(k)];
        const auto other = static_cast<std::size_t>(share.contact);
        if (other == c) continue;
        double entry = 0;
        for (std::size_t d = 0; d < D; ++d) entry += row.normal[d] * share.push[d];
        visit(other, of_body * inverse_mobilities_[b * D] * entry);
      }
    };
    visit_at(row.first, -row.of_first);
    visit_at(row.second, row.of_second);
  }

  /// How far contact c is from its conditions, |min(D + h G v, w (p - gamma^n))|, over what is
  /// allowed of it, at impulse z_c with gradient g_c. The contact has converged where it is <= 1.
  double residual(std::size_t c, double z_c, double gradient) const {
    return per_allowed[c] * std::abs(std::min(gradient, z_c - bound[c]));
  }

  /// h lambda of the contacts, in the order in which they were given.
  void impulses(std::span<double> impulses) const {
    // A film that is spent has given all that it had taken, not all but rounding.
    for (std::size_t c = 0; c < count(); ++c)
      impulses[c] = z[c] == bound[c] ? gamma_[c] : z[c] / scale[c];
  }

 private:
  struct Row {
    std::int32_t first, second;  // of a plane: a body that does not move, the last
    Vec normal;
    double per_root;             // 1/sqrt(w)
    double of_first, of_second;  // (h/m)/sqrt(w)
  };
  struct Share {
    std::int32_t contact;
    Vec push;  // of a z of 1
  };
  // Discs' vectors are one register, and GCC 12 does not see it.
  using Pair [[gnu::vector_size(16)]] = double;
  static Pair pair(const double* from) { return Pair{from[0], from[1]}; }

  static double product(const Row& row, const double* yi, const double* yj) {
    if constexpr (D == 2) {
      const Pair parts = pair(row.normal.data()) * (pair(yj) - pair(yi));
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

  std::vector<Row> rows_;
  std::vector<double> gamma_;  // as given
  std::vector<std::array<std::int32_t, 2>>
      in_block_;                           // first, second, among the bodies of the contact's block
  std::vector<std::size_t> block_bodies_;  // how many bodies each block has
  std::vector<std::int32_t> offsets_;      // of the shares of each body
  std::vector<Share> shares_;              // in order of contacts
  // m/h of each displacement, D numbers a body; 0 of the body that does not move.
  std::vector<double> inverse_mobilities_;
  ThreadPool* pool_;
};

extern template class ContactGraph<2>;
extern template class ContactGraph<3>;

}  // namespace viscontact::particles
