#include "tests/suspensions/many_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "tests/suspensions/spheres.hpp"
#include "viscontact/suspensions/cell/pair_search.hpp"
#include "viscontact/suspensions/cell/sheared_cell.hpp"

namespace viscontact::suspensions {

ManyPairs::ManyPairs(int side, particles::PairTerms pairs, bool has_slips)
    : system(system_of(side, pairs, pool)) {
  if (!has_slips) return;
  auto& resistance = system.resistance();
  Random random(5);
  for (std::size_t p = 0; p < resistance.pairs.size(); p += 3) {
    auto& pair = resistance.pairs[p];
    // The contact resists slips in all directions, and the row takes one of these away.
    const double stiffness = random.decades(0, 2), arm = 0.5 / pair.inverse_arm;
    pair.turn_first += stiffness * arm * arm;
    pair.turn_mixed += stiffness * arm * arm;
    pair.turn_second += stiffness * arm * arm;
    const Vector across = particles::cross(vector_of(lanes_of(pair.normal)), random.direction(3));
    resistance.slips.push_back({pair.normal, Packed(lanes_of((1 / norm(across)) * across)),
                                stiffness, arm, arm, pair.first, pair.second});
  }
}

PairSystem ManyPairs::system_of(int side, particles::PairTerms pairs, ThreadPool& pool) {
  constexpr double kSpacing = 2.09;
  Random random(4);
  const auto state = particles::disturbed_lattice(side, kSpacing, 0.04, random);
  PairLubrication lubrication;
  lubrication.viscosity = 1;
  lubrication.pairs = pairs;
  lubrication.regularisation = 1e-3;
  const double period = side * kSpacing;
  const ShearedCell cell{{}, {period, period, period}, 0.2};
  const auto& p = state.particles;
  const auto near = near_pairs(cell, p.positions, p.radii, lubrication.range);
  return {lubrication, p.radii, placed(near, p.radii, 1e-12), pool};
}

std::vector<Motion> random_motions(std::size_t count, Random& random) {
  std::vector<Motion> motions(count);
  for (auto& motion : motions)
    for (int d = 0; d < 3; ++d) {
      motion.along[d] = random.uniform(-1, 1);
      motion.turn[d] = random.uniform(-1, 1);
    }
  return motions;
}

double product(std::span<const Motion> a, std::span<const Motion> b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    sum += dot(a[k].along, b[k].along) + dot(a[k].turn, b[k].turn);
  return sum;
}

double largest_difference(std::span<const Motion> a, std::span<const Motion> b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (int d = 0; d < 3; ++d)
      largest = std::max({largest, std::abs(a[k].along[d] - b[k].along[d]),
                          std::abs(a[k].turn[d] - b[k].turn[d])});
  return largest;
}

bool have_same_bits(std::span<const Motion> a, std::span<const Motion> b) {
  return largest_difference(a, b) == 0;
}

}  // namespace viscontact::suspensions
