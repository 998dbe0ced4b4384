// Interleaved bits of coordinates, and steps in that order.
#include "viscontact/suspensions/step/sphere_order.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "viscontact/common/index.hpp"

namespace viscontact::suspensions {
namespace {

constexpr int kBits =
    10;  // of a coordinate: a thousand layers are more than a billion spheres have

/// The bits with two zeros after each.
std::uint32_t spread(std::uint32_t bits) {
  bits = (bits | bits << 16) & 0x030000FF;
  bits = (bits | bits << 8) & 0x0300F00F;
  bits = (bits | bits << 4) & 0x030C30C3;
  return (bits | bits << 2) & 0x09249249;
}

template <class T>
std::vector<T> in_order(const std::vector<T>& values, std::span<const std::int32_t> order) {
  std::vector<T> result;
  if (values.empty()) return result;
  result.reserve(values.size());
  for (const auto k : order) result.push_back(values[index_of(k)]);
  for (std::size_t k = order.size(); k < values.size(); ++k) result.push_back(values[k]);
  return result;
}

template <class T>
void restore(std::vector<T>& values, std::span<const std::int32_t> order) {
  if (values.empty()) return;
  const auto sorted = values;
  for (std::size_t k = 0; k < order.size(); ++k) values[index_of(order[k])] = sorted[k];
}

template <class Pair>
void sort_pairs(std::vector<Pair>& pairs) {
  std::ranges::sort(pairs, {}, [](const Pair& pair) { return std::pair(pair.first, pair.second); });
}

}  // namespace

std::vector<std::int32_t> spatial_order(std::span<const double> positions) {
  const std::size_t count = positions.size() / 3;
  Vector low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], positions[3 * k + d]);
      high[d] = std::max(high[d], positions[3 * k + d]);
    }
  const double size = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  const double scale = size > 0 ? ((1 << kBits) - 1) / size : 0;
  std::vector<std::pair<std::uint32_t, std::int32_t>> keys(count);
  for (std::size_t k = 0; k < count; ++k) {
    std::uint32_t key = 0;
    for (std::size_t d = 0; d < 3; ++d)
      key |= spread(static_cast<std::uint32_t>(scale * (positions[3 * k + d] - low[d]))) << d;
    keys[k] = {key, static_cast<std::int32_t>(k)};
  }
  std::ranges::sort(keys);
  std::vector<std::int32_t> order(count);
  for (std::size_t k = 0; k < count; ++k) order[k] = keys[k].second;
  return order;
}

StepSolution solve_in_order(StepProblem problem, std::span<const std::int32_t> order) {
  std::vector<double> radii(problem.radii.begin(), problem.radii.end());
  radii = in_order(radii, order);
  problem.radii = radii;
  problem.motions = in_order(problem.motions, order);
  problem.loads = in_order(problem.loads, order);
  problem.inertia = in_order(problem.inertia, order);
  std::vector<std::int32_t> place(radii.size());
  std::iota(place.begin(), place.end(), 0);
  for (std::size_t k = 0; k < order.size(); ++k)
    place[index_of(order[k])] = static_cast<std::int32_t>(k);
  for (auto& pair : problem.pairs) {
    pair.first = place[index_of(pair.first)];
    pair.second = place[index_of(pair.second)];
    if (pair.first < pair.second) continue;
    std::swap(pair.first, pair.second);
    pair.apart = -1 * pair.apart;
  }
  sort_pairs(problem.pairs);
  // The friction is that on the second sphere.
  const auto renumber = [](std::vector<ContactMemory>& contacts,
                           std::span<const std::int32_t> numbers) {
    for (auto& contact : contacts) {
      contact.first = numbers[index_of(contact.first)];
      contact.second = numbers[index_of(contact.second)];
      if (contact.first < contact.second) continue;
      std::swap(contact.first, contact.second);
      contact.friction = -1 * contact.friction;
    }
    sort_pairs(contacts);
  };
  renumber(problem.memories, place);
  auto solution = SuspensionStep(std::move(problem)).solve();
  restore(solution.motions, order);
  restore(solution.changes, order);
  std::vector<std::int32_t> numbers(radii.size());
  for (std::size_t k = 0; k < place.size(); ++k)
    numbers[index_of(place[k])] = static_cast<std::int32_t>(k);
  renumber(solution.contacts, numbers);
  return solution;
}

}  // namespace viscontact::suspensions
