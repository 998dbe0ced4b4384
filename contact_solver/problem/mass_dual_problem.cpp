// The arrays of a MassDualProblem. All obstacles are one body, the last one, which does not move.
#include "viscontact/contact_solver/problem/mass_dual_problem.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace viscontact::contact_solver {

template <int D>
MassDualProblem<D>::MassDualProblem(std::span<const GapRow<D>> contacts,
                                    std::span<const double> displacements,
                                    std::span<const double> mobilities, ThreadPool& pool)
    : DualProblem(contacts.size()),
      rows_(contacts.size()),
      in_block_(contacts.size()),
      offsets_(mobilities.size() + 2, 0),
      inverse_mobilities_((mobilities.size() + 1) * D, 0.0),
      pool_(&pool) {
  assert(displacements.size() == mobilities.size() * D);
  const auto wall = static_cast<std::int32_t>(mobilities.size());
  for (std::size_t b = 0; b < mobilities.size(); ++b)
    for (std::size_t d = 0; d < D; ++d)
      inverse_mobilities_[b * D + d] = mobilities[b] > 0 ? 1 / mobilities[b] : 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto& contact = contacts[c];
    const bool has_two = contact.first >= 0;
    const auto i = index_of(has_two ? contact.first : wall), j = index_of(contact.second);
    const double of_first = has_two ? mobilities[i] : 0;
    const double root = std::sqrt(contact.bounds.w);
    rows_[c] = {
        static_cast<std::int32_t>(i), contact.second, contact.normal, 1 / root, of_first / root,
        mobilities[j] / root};
    double gradient = contact.gap;
    for (std::size_t d = 0; d < D; ++d)
      gradient +=
          contact.normal[d] * (displacements[j * D + d] - (has_two ? displacements[i * D + d] : 0));
    this->set(c, contact.bounds, gradient);
    if (has_two) ++offsets_[i + 1];
    ++offsets_[j + 1];
  }
  list_shares();
  number_bodies_of_blocks();
}

template <int D>
void MassDualProblem<D>::list_shares() {
  const auto wall = static_cast<std::int32_t>(bodies() - 1);
  for (std::size_t b = 0; b + 1 < offsets_.size(); ++b) offsets_[b + 1] += offsets_[b];
  shares_.resize(static_cast<std::size_t>(offsets_.back()));
  auto next = offsets_;
  const auto share = [&](std::int32_t body, std::size_t c, double factor) {
    auto& s = shares_[index_of(next[index_of(body)]++)];
    s.contact = static_cast<std::int32_t>(c);
    for (std::size_t d = 0; d < D; ++d) s.push[d] = factor * rows_[c].normal[d];
  };
  for (std::size_t c = 0; c < rows_.size(); ++c) {
    if (rows_[c].first != wall) share(rows_[c].first, c, -rows_[c].of_first);
    share(rows_[c].second, c, rows_[c].of_second);
  }
}

template <int D>
void MassDualProblem<D>::number_bodies_of_blocks() {
  const bool is_single = rows_.size() <= ThreadPool::kBlock;  // bodies then keep their numbers
  std::vector<std::int32_t> number(bodies());
  std::vector<std::size_t> numbered_in(bodies(), 0);
  for (std::size_t begin = 0, block = 1; begin < rows_.size();
       begin += ThreadPool::kBlock, ++block) {
    std::int32_t named = 0;
    const auto local = [&](std::int32_t body) {
      const auto b = index_of(body);
      if (is_single) return body;
      if (numbered_in[b] != block) {
        numbered_in[b] = block;
        number[b] = named++;
      }
      return number[b];
    };
    for (std::size_t c = begin; c < std::min(begin + ThreadPool::kBlock, rows_.size()); ++c)
      in_block_[c] = {local(rows_[c].first), local(rows_[c].second)};
    block_bodies_.push_back(is_single ? bodies() : index_of(named));
  }
}

template <int D>
double MassDualProblem<D>::combine(std::span<const double> y, double factor,
                                   std::span<double> into) const {
  assert(y.size() == displacement_count() && into.size() == y.size());
  return pool_->sum_of_blocks<double>(bodies(), [&](std::size_t begin, std::size_t end) {
    const auto first = static_cast<Eigen::Index>(begin * D);
    const auto size = static_cast<Eigen::Index>((end - begin) * D);
    // Eigen computes several partial sums, which is faster than a single sum, because each addition
    // to a single sum waits for the one before.
    const auto from = Eigen::Map<const Eigen::ArrayXd>(y.data() + first, size);
    const auto per_mobility =
        Eigen::Map<const Eigen::ArrayXd>(inverse_mobilities_.data() + first, size);
    auto sum = Eigen::Map<Eigen::ArrayXd>(into.data() + first, size);
    sum = from + factor * sum;
    return (sum.square() * per_mobility).sum();
  });
}

template class MassDualProblem<2>;
template class MassDualProblem<3>;

}  // namespace viscontact::contact_solver
