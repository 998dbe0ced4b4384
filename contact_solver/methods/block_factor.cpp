// Left-looking LU or Cholesky factorisation: each column of L is computed from all earlier ones.
#include "viscontact/contact_solver/methods/block_factor.hpp"

#include <metis.h>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <type_traits>
#include <utility>

#include "viscontact/contact_solver/methods/fastest_instructions.hpp"

namespace viscontact::contact_solver {
namespace {

constexpr std::size_t index(std::int32_t number) { return static_cast<std::size_t>(number); }

/// Returns work(), which computes products of K x K blocks. They take most of the time of large
/// packings of spheres, and are up to 1.7 times as fast with wide vectors. Discs, whose blocks are
/// small, gain nothing.
template <int K, class Work>
bool with_blocks(const Work& work) {
  if constexpr (K == 6)
    return by_fastest_instructions(work);
  else
    return work();
}

/// c -= a b for three different blocks.
template <int K, class Block>
inline void subtract_product(const Block& a, const Block& b, Block& c) {
  constexpr auto k = static_cast<std::size_t>(K);
  for (std::size_t i = 0; i < k; ++i) {
    // `row` stays in registers. `c` would not, because it may be the same block as `a` or `b`.
    std::array<double, k> row;
    for (std::size_t j = 0; j < k; ++j) row[j] = c[i * k + j];
    for (std::size_t l = 0; l < k; ++l)
      for (std::size_t j = 0; j < k; ++j) row[j] -= a[i * k + l] * b[l * k + j];
    for (std::size_t j = 0; j < k; ++j) c[i * k + j] = row[j];
  }
}

template <int K, class Block>
inline Block transposed(const Block& a) {
  constexpr auto k = static_cast<std::size_t>(K);
  Block result;
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < k; ++j) result[j * k + i] = a[i * k + j];
  return result;
}

// A block on the diagonal can have eigenvalues that differ by a factor of 1e9. Products with its
// inverse would lose the digits of the small ones; substitutions with its factors keep them.

/// With the inverses of the diagonal entries of L. Returns false if `a` is not positive definite.
template <int K, class Block>
inline bool cholesky(Block& a) {
  constexpr auto k = static_cast<std::size_t>(K);
  for (std::size_t j = 0; j < k; ++j) {
    double pivot = a[j * k + j];
    for (std::size_t l = 0; l < j; ++l) pivot -= a[j * k + l] * a[j * k + l];
    if (!(pivot > 0) || !std::isfinite(pivot)) return false;
    const double inverse = 1 / std::sqrt(pivot);
    a[j * k + j] = inverse;
    for (std::size_t i = j + 1; i < k; ++i) {
      double sum = a[i * k + j];
      for (std::size_t l = 0; l < j; ++l) sum -= a[i * k + l] * a[j * k + l];
      a[i * k + j] = sum * inverse;
    }
  }
  return true;
}

/// Replaces x by L^-1 x, for the factor L of cholesky().
template <int K>
inline void substitute(const std::array<double, static_cast<std::size_t>(K* K)>& factor,
                       double* x) {
  constexpr auto k = static_cast<std::size_t>(K);
  for (std::size_t i = 0; i < k; ++i) {
    for (std::size_t l = 0; l < i; ++l) x[i] -= factor[i * k + l] * x[l];
    x[i] *= factor[i * k + i];
  }
}

/// Replaces x by L^-T x, for the factor L of cholesky().
template <int K>
inline void substitute_back(const std::array<double, static_cast<std::size_t>(K* K)>& factor,
                            double* x) {
  constexpr auto k = static_cast<std::size_t>(K);
  for (std::size_t i = k; i-- > 0;) {
    for (std::size_t l = i + 1; l < k; ++l) x[i] -= factor[l * k + i] * x[l];
    x[i] *= factor[i * k + i];
  }
}

/// 1 over the root of each diagonal entry, or 1 if it is 0: scales for rows of different units.
template <int K, class Block>
std::array<double, static_cast<std::size_t>(K)> scales_of_rows(const Block& a) {
  std::array<double, static_cast<std::size_t>(K)> scales;
  for (std::size_t i = 0; i < scales.size(); ++i) {
    const double root = std::sqrt(std::abs(a[i * scales.size() + i]));
    scales[i] = root > 0 ? 1 / root : 1;
  }
  return scales;
}

/// Replaces a block by its factors L, with the diagonal 1, and U, with the inverses of its diagonal
/// entries. The row whose scaled entry is largest is exchanged with that of the diagonal. `sign`
/// changes if the determinant is negative. Returns false if the block is singular, infinite or NaN.
template <int K, class Block, class Pivots>
bool factorise_block(std::array<double, static_cast<std::size_t>(K)> scales, Block& a,
                     Pivots& pivots, int& sign) {
  constexpr auto k = static_cast<std::size_t>(K);
  for (std::size_t j = 0; j < k; ++j) {
    std::size_t pivot = j;
    for (std::size_t i = j + 1; i < k; ++i)
      if (scales[i] * std::abs(a[i * k + j]) > scales[pivot] * std::abs(a[pivot * k + j]))
        pivot = i;
    if (!(std::abs(a[pivot * k + j]) > 0) || !std::isfinite(a[pivot * k + j])) return false;
    pivots[j] = static_cast<unsigned char>(pivot);
    if (pivot != j) {
      for (std::size_t c = 0; c < k; ++c) std::swap(a[pivot * k + c], a[j * k + c]);
      std::swap(scales[pivot], scales[j]);
    }
    const double inverse = 1 / a[j * k + j];
    if ((inverse < 0) != (pivot != j)) sign = -sign;
    a[j * k + j] = inverse;
    for (std::size_t i = j + 1; i < k; ++i) {
      const double by = a[i * k + j] *= inverse;
      for (std::size_t c = j + 1; c < k; ++c) a[i * k + c] -= by * a[j * k + c];
    }
  }
  return true;
}

/// Replaces `x`, K rows of kColumns numbers, by the solution X of D X = x for a factorised block D.
template <int K, std::size_t kColumns, class Block, class Pivots>
inline void solve_block(const Block& factors, const Pivots& pivots, double* x) {
  constexpr auto k = static_cast<std::size_t>(K);
  for (std::size_t j = 0; j < k; ++j) {
    const std::size_t pivot = pivots[j];
    if (pivot != j)
      for (std::size_t c = 0; c < kColumns; ++c)
        std::swap(x[pivot * kColumns + c], x[j * kColumns + c]);
  }
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t l = 0; l < i; ++l)
      for (std::size_t c = 0; c < kColumns; ++c)
        x[i * kColumns + c] -= factors[i * k + l] * x[l * kColumns + c];
  for (std::size_t i = k; i-- > 0;) {
    for (std::size_t l = i + 1; l < k; ++l)
      for (std::size_t c = 0; c < kColumns; ++c)
        x[i * kColumns + c] -= factors[i * k + l] * x[l * kColumns + c];
    for (std::size_t c = 0; c < kColumns; ++c) x[i * kColumns + c] *= factors[i * k + i];
  }
}

/// The bodies in the order of their elimination. METIS orders many bodies and AMD few ones, or all
/// if METIS fails.
template <int K>
std::vector<std::int32_t> order_of_elimination(std::size_t bodies,
                                               std::span<const std::array<std::int32_t, 2>> edges) {
  const auto count = static_cast<Eigen::Index>(bodies);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(2 * edges.size() + bodies);
  for (const auto& edge : edges) {
    entries.emplace_back(edge[0], edge[1], 1.0);
    entries.emplace_back(edge[1], edge[0], 1.0);
  }
  std::vector<std::int32_t> order(bodies);
  Eigen::SparseMatrix<double> pattern(count, count);
  // With this number of bodies or more, METIS saves more time than it takes: a factorisation takes
  // 0.58 of the time with the order of AMD for 2000 spheres, and 0.86 of it for 10 000 discs.
  constexpr std::size_t kManyBodies = K == 6 ? 500 : 5000;
  static_assert(std::is_same_v<idx_t, std::int32_t>);
  if (bodies >= kManyBodies && !edges.empty()) {
    pattern.setFromTriplets(entries.begin(), entries.end());
    idx_t size = static_cast<idx_t>(bodies);
    std::vector<idx_t> places(bodies);
    if (METIS_NodeND(&size, pattern.outerIndexPtr(), pattern.innerIndexPtr(), nullptr, nullptr,
                     order.data(), places.data()) == METIS_OK)
      return order;
  }
  // Eigen's AMD needs the diagonal in the pattern, but METIS must not get it.
  for (Eigen::Index b = 0; b < count; ++b) entries.emplace_back(b, b, 1.0);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation(count);
  permutation.setIdentity(count);
  if (bodies > 1) Eigen::AMDOrdering<int>()(pattern, permutation);
  std::ranges::copy(permutation.indices(), order.begin());
  return order;
}

}  // namespace

template <int K>
void BlockFactor<K>::analyse(std::size_t bodies, std::span<const Edge> edges, bool is_symmetric) {
  assert(std::ranges::all_of(
      edges, [&](const Edge& edge) { return index(edge[0]) < bodies && index(edge[1]) < bodies; }));
  is_symmetric_ = is_symmetric;
  order_ = order_of_elimination<K>(bodies, edges);
  place_.resize(bodies);
  for (std::size_t k = 0; k < bodies; ++k) place_[index(order_[k])] = k;
  find_pattern(edges);
  diagonal_.resize(bodies);
  pivots_.resize(is_symmetric ? 0 : bodies);
  below_.resize(rows_.size());
  above_.resize(is_symmetric ? 0 : rows_.size());
  first_in_row_.resize(bodies);
  next_in_row_.resize(bodies);
  next_entry_.resize(bodies);
  entry_in_row_.resize(bodies);
  permuted_.resize(bodies);
}

template <int K>
void BlockFactor<K>::find_pattern(std::span<const Edge> edges) {
  // The rows of L in a column are those of A in the column and those of each child of the column:
  // an earlier column whose first block is in the row with the number of this column.
  const std::size_t bodies = order_.size();
  std::vector<std::vector<std::int32_t>> columns(bodies), children(bodies);
  for (const auto& edge : edges) {
    const auto a = place_[static_cast<std::size_t>(edge[0])];
    const auto b = place_[static_cast<std::size_t>(edge[1])];
    columns[std::min(a, b)].push_back(static_cast<std::int32_t>(std::max(a, b)));
  }
  offsets_.assign(1, 0);
  rows_.clear();
  for (std::size_t j = 0; j < bodies; ++j) {
    auto& column = columns[j];
    for (const auto child : children[j]) {
      const auto begin = rows_.begin() + static_cast<std::ptrdiff_t>(offsets_[index(child)]) + 1;
      const auto end = rows_.begin() + static_cast<std::ptrdiff_t>(offsets_[index(child) + 1]);
      column.insert(column.end(), begin, end);
    }
    std::ranges::sort(column);
    column.erase(std::unique(column.begin(), column.end()), column.end());
    rows_.insert(rows_.end(), column.begin(), column.end());
    offsets_.push_back(rows_.size());
    if (!column.empty()) children[index(column.front())].push_back(static_cast<std::int32_t>(j));
    column = {};
  }
  edges_.clear();
  for (const auto& edge : edges) {
    const auto a = place_[index(edge[0])], b = place_[index(edge[1])];
    const auto begin = rows_.begin() + static_cast<std::ptrdiff_t>(offsets_[std::min(a, b)]);
    const auto end = rows_.begin() + static_cast<std::ptrdiff_t>(offsets_[std::min(a, b) + 1]);
    const auto found = std::lower_bound(begin, end, static_cast<std::int32_t>(std::max(a, b)));
    edges_.push_back({static_cast<std::size_t>(found - rows_.begin()), a < b ? 1U : 0U});
  }
}

template <int K>
void BlockFactor<K>::clear() {
  std::ranges::fill(diagonal_, Block{});
  std::ranges::fill(below_, Block{});
  std::ranges::fill(above_, Block{});
}

template <int K>
bool BlockFactor<K>::factorise() {
  std::ranges::fill(first_in_row_, -1);
  sign_ = 1;
  return with_blocks<K>([this] {
    for (std::size_t j = 0; j < order_.size(); ++j)
      if (!factorise_column(j)) return false;
    return true;
  });
}

template <int K>
bool BlockFactor<K>::factorise_column(std::size_t j) {
  // The columns before j must have been computed.
  constexpr auto kSize = static_cast<std::size_t>(K);
  // The scales are those of the block of A, before products of other columns are subtracted.
  const auto scales = scales_of_rows<K>(diagonal_[j]);
  for (auto e = offsets_[j]; e < offsets_[j + 1]; ++e) entry_in_row_[index(rows_[e])] = e;
  for (auto column = first_in_row_[j]; column >= 0;) {
    const auto k = index(column);
    column = next_in_row_[k];
    const auto begin = next_entry_[k];
    const Block left = below_[begin];
    const Block right = is_symmetric_ ? transposed<K>(left) : above_[begin];
    subtract_product<K>(left, right, diagonal_[j]);
    for (auto e = begin + 1; e < offsets_[k + 1]; ++e) {
      const auto into = entry_in_row_[index(rows_[e])];
      subtract_product<K>(below_[e], right, below_[into]);
      if (!is_symmetric_) subtract_product<K>(left, above_[e], above_[into]);
    }
    enlist(k, begin + 1);
  }
  if (is_symmetric_) {
    if (!cholesky<K>(diagonal_[j])) return false;
    for (auto e = offsets_[j]; e < offsets_[j + 1]; ++e)
      for (std::size_t i = 0; i < kSize; ++i) substitute<K>(diagonal_[j], &below_[e][i * kSize]);
  } else {
    if (!factorise_block<K>(scales, diagonal_[j], pivots_[j], sign_)) return false;
    for (auto e = offsets_[j]; e < offsets_[j + 1]; ++e)
      solve_block<K, kSize>(diagonal_[j], pivots_[j], above_[e].data());
  }
  enlist(j, offsets_[j]);
  return true;
}

template <int K>
void BlockFactor<K>::enlist(std::size_t k, std::size_t entry) {
  next_entry_[k] = entry;
  if (entry == offsets_[k + 1]) return;
  auto& first = first_in_row_[index(rows_[entry])];
  next_in_row_[k] = first;
  first = static_cast<std::int32_t>(k);
}

template <int K>
void BlockFactor<K>::solve(std::span<Vec> values) const {
  assert(values.size() == order_.size());
  constexpr auto kSize = static_cast<std::size_t>(K);
  for (std::size_t j = 0; j < order_.size(); ++j) permuted_[j] = values[index(order_[j])];
  for (std::size_t j = 0; j < order_.size(); ++j) {
    if (is_symmetric_)
      substitute<K>(diagonal_[j], permuted_[j].data());
    else
      solve_block<K, 1>(diagonal_[j], pivots_[j], permuted_[j].data());
    const Vec solved = permuted_[j];
    for (auto e = offsets_[j]; e < offsets_[j + 1]; ++e) {
      Vec& later = permuted_[index(rows_[e])];
      const Block& below = below_[e];
      for (std::size_t i = 0; i < kSize; ++i)
        for (std::size_t k = 0; k < kSize; ++k) later[i] -= below[i * kSize + k] * solved[k];
    }
  }
  for (std::size_t j = order_.size(); j-- > 0;) {
    Vec sum{};
    for (auto e = offsets_[j]; e < offsets_[j + 1]; ++e) {
      const Vec& later = permuted_[index(rows_[e])];
      const Block& block = is_symmetric_ ? below_[e] : above_[e];
      for (std::size_t i = 0; i < kSize; ++i)
        for (std::size_t k = 0; k < kSize; ++k)
          sum[i] += block[is_symmetric_ ? k * kSize + i : i * kSize + k] * later[k];
    }
    for (std::size_t i = 0; i < kSize; ++i) permuted_[j][i] -= sum[i];
    if (is_symmetric_) substitute_back<K>(diagonal_[j], permuted_[j].data());
  }
  for (std::size_t j = 0; j < order_.size(); ++j) values[index(order_[j])] = permuted_[j];
}

template class BlockFactor<3>;
template class BlockFactor<6>;

template <int D>
UnitMatrix<D>::UnitMatrix(const ConstraintProblem<D>& problem, bool is_symmetric)
    : problem_(problem), is_symmetric_(is_symmetric) {
  std::vector<typename BlockFactor<kMotion>::Edge> edges;
  for (const auto& block : problem.blocks) {
    first_edge_.push_back(edges.size());
    const auto parts = problem.parts_of(block.row);
    for (std::size_t i = 0; i < parts.size(); ++i)
      for (std::size_t j = i + 1; j < parts.size(); ++j)
        edges.push_back({parts[i].unit, parts[j].unit});
  }
  factor_.analyse(problem.units.size(), edges, is_symmetric);
}

template <int D>
void UnitMatrix<D>::set_to_masses() {
  constexpr auto k = static_cast<std::size_t>(kMotion), d = static_cast<std::size_t>(D);
  factor_.clear();
  for (std::size_t u = 0; u < problem_.units.size(); ++u) {
    const auto& unit = problem_.units[u];
    auto& block = factor_.diagonal(u);
    for (std::size_t i = 0; i < d; ++i) block[i * k + i] = unit.inverse_mobility;
    for (std::size_t i = d; i < k; ++i)
      for (std::size_t j = d; j < k; ++j)
        block[i * k + j] = unit.inverse_turn_mobility[(i - d) * (k - d) + j - d];
  }
}

template <int D>
void UnitMatrix<D>::add_product(std::size_t b, std::size_t row, std::size_t other, double weight) {
  constexpr auto k = static_cast<std::size_t>(kMotion);
  const auto add = [&](auto& into, const Motion<D>& left, const Motion<D>& right) {
    for (std::size_t i = 0; i < k; ++i)
      for (std::size_t j = 0; j < k; ++j) into[i * k + j] += weight * left[i] * right[j];
  };
  const auto left = problem_.parts_of(row), right = problem_.parts_of(other);
  assert(b < first_edge_.size() && left.size() == right.size());
  auto edge = first_edge_[b];
  for (std::size_t i = 0; i < left.size(); ++i) {
    add(factor_.diagonal(static_cast<std::size_t>(left[i].unit)), left[i].coefficients,
        right[i].coefficients);
    // In a symmetric matrix only blocks below the diagonal are stored.
    for (std::size_t j = i + 1; j < left.size(); ++j, ++edge) {
      if (!is_symmetric_ || factor_.is_below(edge, 0))
        add(factor_.off_diagonal(edge, 0), left[i].coefficients, right[j].coefficients);
      if (!is_symmetric_ || factor_.is_below(edge, 1))
        add(factor_.off_diagonal(edge, 1), left[j].coefficients, right[i].coefficients);
    }
  }
}

template class UnitMatrix<2>;
template class UnitMatrix<3>;

}  // namespace viscontact::contact_solver
