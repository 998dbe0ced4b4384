// Assembles the matrices of Newton's methods (unit_matrix.hpp).
#include "viscontact/particles/constraints/unit_matrix.hpp"

namespace viscontact::particles {

template <int D, bool kIsSymmetric>
UnitMatrix<D, kIsSymmetric>::UnitMatrix(const ConstraintProblem<D>& problem) : problem_(problem) {
  std::vector<typename BlockFactor<kMotion, kIsSymmetric>::Edge> edges;
  for (const auto& block : problem.blocks) {
    first_edge_.push_back(edges.size());
    const auto parts = problem.parts_of(block.row);
    for (std::size_t i = 0; i < parts.size(); ++i)
      for (std::size_t j = i + 1; j < parts.size(); ++j)
        edges.push_back({parts[i].unit, parts[j].unit});
  }
  factor_.analyse(problem.units.size(), edges);
}

template <int D, bool kIsSymmetric>
void UnitMatrix<D, kIsSymmetric>::set_to_masses() {
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

template <int D, bool kIsSymmetric>
void UnitMatrix<D, kIsSymmetric>::add_product(std::size_t b, std::size_t row, std::size_t other,
                                              double weight) {
  constexpr auto k = static_cast<std::size_t>(kMotion);
  const auto add = [&](auto& into, const Motion<D>& left, const Motion<D>& right) {
    for (std::size_t i = 0; i < k; ++i)
      for (std::size_t j = 0; j < k; ++j) into[i * k + j] += weight * left[i] * right[j];
  };
  const auto left = problem_.parts_of(row), right = problem_.parts_of(other);
  auto edge = first_edge_[b];
  for (std::size_t i = 0; i < left.size(); ++i) {
    add(factor_.diagonal(static_cast<std::size_t>(left[i].unit)), left[i].coefficients,
        right[i].coefficients);
    for (std::size_t j = i + 1; j < left.size(); ++j, ++edge) {
      if (!kIsSymmetric || factor_.is_below(edge, 0))
        add(factor_.off_diagonal(edge, 0), left[i].coefficients, right[j].coefficients);
      if (!kIsSymmetric || factor_.is_below(edge, 1))
        add(factor_.off_diagonal(edge, 1), left[j].coefficients, right[i].coefficients);
    }
  }
}

template class UnitMatrix<2>;
template class UnitMatrix<3>;
template class UnitMatrix<2, true>;
template class UnitMatrix<3, true>;

}  // namespace viscontact::particles
