// Left-looking LU factorisation by columns and rows of blocks (block_factor.hpp). Numbers have the
// units of the matrix. A singular matrix is no error: factorise() returns false. A change must keep
// the order of sums.
#include "viscontact/particles/constraints/block_factor.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <utility>

namespace viscontact::particles {
namespace {

constexpr std::size_t index(std::int32_t number) { return static_cast<std::size_t>(number); }

/// c -= a b.
template <int K, class Block>
inline void subtract_product(const Block& a, const Block& b, Block& c) {
  constexpr auto k = static_cast<std::size_t>(K);
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t l = 0; l < k; ++l)
      for (std::size_t j = 0; j < k; ++j) c[i * k + j] -= a[i * k + l] * b[l * k + j];
}

/// Replaces a block by its inverse (Gauss-Jordan with exchange of rows). Changes `sign` if the
/// determinant is negative. Returns false if the block is singular.
template <int K, class Block>
bool invert(Block& a, int& sign) {
  constexpr auto k = static_cast<std::size_t>(K);
  Block inverse{};
  for (std::size_t i = 0; i < k; ++i) inverse[i * k + i] = 1;
  for (std::size_t j = 0; j < k; ++j) {
    std::size_t pivot = j;
    for (std::size_t i = j + 1; i < k; ++i)
      if (std::abs(a[i * k + j]) > std::abs(a[pivot * k + j])) pivot = i;
    if (!(std::abs(a[pivot * k + j]) > 0) || !std::isfinite(a[pivot * k + j])) return false;
    const double factor = 1 / a[pivot * k + j];
    if ((factor < 0) != (pivot != j)) sign = -sign;
    for (std::size_t c = 0; c < k; ++c) {
      std::swap(a[pivot * k + c], a[j * k + c]);
      std::swap(inverse[pivot * k + c], inverse[j * k + c]);
      a[j * k + c] *= factor;
      inverse[j * k + c] *= factor;
    }
    for (std::size_t i = 0; i < k; ++i) {
      const double by = a[i * k + j];
      if (i == j || by == 0) continue;
      for (std::size_t c = 0; c < k; ++c) {
        a[i * k + c] -= by * a[j * k + c];
        inverse[i * k + c] -= by * inverse[j * k + c];
      }
    }
  }
  a = inverse;
  return true;
}

}  // namespace

template <int K>
void BlockFactor<K>::analyse(std::size_t bodies, std::span<const Edge> edges) {
  using Matrix = Eigen::SparseMatrix<double>;
  const auto count = static_cast<Eigen::Index>(bodies);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(2 * edges.size() + bodies);
  for (Eigen::Index b = 0; b < count; ++b) entries.emplace_back(b, b, 1.0);
  for (const auto& edge : edges) {
    entries.emplace_back(edge[0], edge[1], 1.0);
    entries.emplace_back(edge[1], edge[0], 1.0);
  }
  Matrix pattern(count, count);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation(count);
  if (bodies > 1) {
    Eigen::AMDOrdering<int>()(pattern, permutation);
  } else {
    permutation.setIdentity(count);
  }
  order_.resize(bodies);
  place_.resize(bodies);
  for (std::size_t k = 0; k < bodies; ++k) {
    order_[k] = permutation.indices()[static_cast<Eigen::Index>(k)];
    place_[static_cast<std::size_t>(order_[k])] = k;
  }
  find_pattern(edges);
  diagonal_.resize(bodies);
  below_.resize(rows_.size());
  above_.resize(rows_.size());
  first_in_row_.resize(bodies);
  next_entry_.resize(bodies);
  entry_in_row_.resize(bodies);
  permuted_.resize(bodies * static_cast<std::size_t>(K));
}

/// The rows of a column are those of A, and those of the columns whose first row is this column.
template <int K>
void BlockFactor<K>::find_pattern(std::span<const Edge> edges) {
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
  std::vector<std::int32_t> next_in_row(order_.size(), -1);
  std::ranges::fill(first_in_row_, -1);
  sign_ = 1;
  for (std::size_t j = 0; j < order_.size(); ++j)
    if (!factorise_column(j, next_in_row)) return false;
  return true;
}

template <int K>
bool BlockFactor<K>::factorise_column(std::size_t j, std::vector<std::int32_t>& next_in_row) {
  for (auto e = offsets_[j]; e < offsets_[j + 1]; ++e) entry_in_row_[index(rows_[e])] = e;
  for (auto column = first_in_row_[j]; column >= 0;) {
    const auto k = index(column);
    column = next_in_row[k];
    const auto begin = next_entry_[k];
    const Block left = below_[begin], right = above_[begin];
    subtract_product<K>(left, right, diagonal_[j]);
    for (auto e = begin + 1; e < offsets_[k + 1]; ++e) {
      const auto into = entry_in_row_[index(rows_[e])];
      subtract_product<K>(below_[e], right, below_[into]);
      subtract_product<K>(left, above_[e], above_[into]);
    }
    enlist(k, begin + 1, next_in_row);
  }
  if (!invert<K>(diagonal_[j], sign_)) return false;
  for (auto e = offsets_[j]; e < offsets_[j + 1]; ++e) {
    Block product{};
    subtract_product<K>(diagonal_[j], above_[e], product);
    for (std::size_t i = 0; i < product.size(); ++i) above_[e][i] = -product[i];
  }
  enlist(j, offsets_[j], next_in_row);
  return true;
}

/// Puts column k into the list of the row of its entry `entry`, its next one.
template <int K>
void BlockFactor<K>::enlist(std::size_t k, std::size_t entry,
                            std::vector<std::int32_t>& next_in_row) {
  next_entry_[k] = entry;
  if (entry == offsets_[k + 1]) return;
  auto& first = first_in_row_[index(rows_[entry])];
  next_in_row[k] = first;
  first = static_cast<std::int32_t>(k);
}

template <int K>
void BlockFactor<K>::solve(std::span<double> values) const {
  constexpr auto kSize = static_cast<std::size_t>(K);
  using Vec = std::array<double, kSize>;
  const auto load = [&](std::size_t j) {
    Vec v;
    for (std::size_t i = 0; i < kSize; ++i) v[i] = permuted_[j * kSize + i];
    return v;
  };
  for (std::size_t j = 0; j < order_.size(); ++j)
    for (std::size_t i = 0; i < kSize; ++i)
      permuted_[j * kSize + i] = values[index(order_[j]) * kSize + i];
  for (std::size_t j = 0; j < order_.size(); ++j) {
    const Vec right = load(j);
    Vec solved{};
    for (std::size_t i = 0; i < kSize; ++i)
      for (std::size_t k = 0; k < kSize; ++k) solved[i] += diagonal_[j][i * kSize + k] * right[k];
    for (std::size_t i = 0; i < kSize; ++i) permuted_[j * kSize + i] = solved[i];
    for (auto e = offsets_[j]; e < offsets_[j + 1]; ++e) {
      double* below = &permuted_[index(rows_[e]) * kSize];
      for (std::size_t i = 0; i < kSize; ++i)
        for (std::size_t k = 0; k < kSize; ++k) below[i] -= below_[e][i * kSize + k] * solved[k];
    }
  }
  for (std::size_t j = order_.size(); j-- > 0;) {
    Vec solved = load(j);
    for (auto e = offsets_[j]; e < offsets_[j + 1]; ++e) {
      const double* later = &permuted_[index(rows_[e]) * kSize];
      for (std::size_t i = 0; i < kSize; ++i)
        for (std::size_t k = 0; k < kSize; ++k) solved[i] -= above_[e][i * kSize + k] * later[k];
    }
    for (std::size_t i = 0; i < kSize; ++i) permuted_[j * kSize + i] = solved[i];
  }
  for (std::size_t j = 0; j < order_.size(); ++j)
    for (std::size_t i = 0; i < kSize; ++i)
      values[index(order_[j]) * kSize + i] = permuted_[j * kSize + i];
}

template class BlockFactor<3>;
template class BlockFactor<6>;

}  // namespace viscontact::particles
