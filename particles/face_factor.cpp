#include "particles/face_factor.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <utility>
#include <vector>

namespace viscontact::particles {

template <int D>
struct FaceFactor<D>::Factor {
  std::vector<std::int32_t> number;  // of a contact among those factorised, or -1
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> cholesky;
  Eigen::VectorXd values;
};

template <int D>
FaceFactor<D>::FaceFactor() = default;
template <int D>
FaceFactor<D>::~FaceFactor() = default;

template <int D>
bool FaceFactor<D>::is_worth(std::size_t contacts) {
  constexpr std::size_t kMost = 200000;
  return D == 2 && contacts <= kMost;
}

template <int D>
bool FaceFactor<D>::is_there() const {
  return factor_ != nullptr;
}

template <int D>
void FaceFactor<D>::factorise(const ContactGraph<D>& graph) {
  // Redundant contacts make W singular; this bounds how far a direction goes along what they can do to each other.
  constexpr double kEpsilon = 1e-10;
  auto factor = std::make_unique<Factor>();
  auto& number = factor->number;
  number.assign(graph.count(), -1);
  std::vector<std::size_t> free;
  for (std::size_t c = 0; c < graph.count(); ++c)
    if (graph.is_free(c)) {
      number[c] = static_cast<std::int32_t>(free.size());
      free.push_back(c);
    }
  const auto count = static_cast<Eigen::Index>(free.size());
  Eigen::SparseMatrix<double> w(count, count);  // its lower triangle
  std::vector<std::pair<std::int32_t, double>> column;
  for (Eigen::Index j = 0; j < count; ++j) {
    const auto c = free[static_cast<std::size_t>(j)];
    column.clear();
    graph.visit_neighbours(c, [&](std::size_t other, double entry) {
      if (number[other] > j) column.emplace_back(number[other], entry);
    });
    std::ranges::sort(column);
    w.startVec(j);
    w.insertBack(j, j) = 1 + kEpsilon;
    for (std::size_t k = 0; k < column.size(); ++k) {
      const auto [i, entry] = column[k];
      // Two contacts may have both of their particles in common.
      if (k > 0 && column[k - 1].first == i)
        w.coeffRef(i, j) += entry;
      else
        w.insertBack(i, j) = entry;
    }
  }
  w.finalize();
  factor->cholesky.compute(w);
  factor->values.resize(count);
  if (factor->cholesky.info() == Eigen::Success) factor_ = std::move(factor);
}

template <int D>
double FaceFactor<D>::solve(const ContactGraph<D>& graph, std::span<const double> gradient,
                            std::span<double> solved) {
  auto& [number, cholesky, values] = *factor_;
  const auto number_of = [&](std::size_t c) { return c < number.size() ? number[c] : -1; };
  for (std::size_t c = 0; c < number.size(); ++c)
    if (number[c] >= 0) values[number[c]] = graph.is_free(c) ? gradient[c] : 0.0;
  values = cholesky.solve(values);
  double product = 0;
  for (std::size_t c = 0; c < graph.count(); ++c) {
    const auto n = number_of(c);
    solved[c] = !graph.is_free(c) ? 0.0 : n >= 0 ? values[n] : gradient[c];
    product += solved[c] * gradient[c];
  }
  return product;
}

template class FaceFactor<2>;
template class FaceFactor<3>;

}  // namespace viscontact::particles
