// Terms of the pairs, shares of the drag (9.8), and sums over the pairs.
#include "viscontact/suspensions/pair_system.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "viscontact/suspensions/pair_terms.hpp"

namespace viscontact::suspensions {
namespace {

using particles::PairTerms;  // which pairs, in the setting
using std::numbers::pi;

/// The weight of a pair in the shares of the drag; it falls to 0 at the range.
double weight_at(double gap_over_range) {
  const double x = std::clamp(gap_over_range, 0.0, 1.0);
  return (1 - x * x) * (1 - x * x);
}

}  // namespace

std::vector<PlacedPair> placed(std::span<const NearPair> pairs, std::span<const double> radii,
                               double least_gap) {
  std::vector<PlacedPair> result;
  result.reserve(pairs.size());
  for (const auto& pair : pairs) {
    const double distance = norm(pair.apart);
    const double gap = distance - radii[static_cast<std::size_t>(pair.first)] -
                       radii[static_cast<std::size_t>(pair.second)];
    result.push_back(
        {pair.first, pair.second, (1 / distance) * pair.apart, std::max(gap, least_gap)});
  }
  return result;
}

PairSystem::PairSystem(const PairLubrication& lubrication, std::span<const double> radii,
                       std::span<const PlacedPair> pairs)
    : lubrication_(lubrication) {
  const double mu = lubrication.viscosity;
  for (const double a : radii)
    resistance_.spheres.push_back(
        {lubrication.drag * 6 * pi * mu * a, lubrication.drag * 8 * pi * mu * a * a * a});
  resistance_.pairs.reserve(pairs.size());
  strains_.reserve(pairs.size());
  add_pairs(radii, pairs);
  if (lubrication.pairs != PairTerms::kTables) return;
  share_drag(radii, pairs);
  for (const double a : radii) sphere_stress_ += 20 * pi / 3 * mu * a * a * a;
}

void PairSystem::add_pairs(std::span<const double> radii, std::span<const PlacedPair> pairs) {
  for (const auto& pair : pairs) {
    const double radius1 = radii[static_cast<std::size_t>(pair.first)];
    const double radius2 = radii[static_cast<std::size_t>(pair.second)];
    const double gap = pair.gap;
    const Lanes normal = lanes_of(pair.normal);
    const auto& of = lubrication_;
    BalancedTerms terms;
    gaps_.push_back(gap);
    if (of.pairs == PairTerms::kNone || gap >= of.range * (radius1 + radius2) / 2) {
      terms.arm = radius1 + radius2;
      if (of.pairs == PairTerms::kTables)
        resistance_.drags.push_back({normal, {}, pair.first, pair.second});
    } else if (of.pairs == PairTerms::kNearContact) {
      terms = near_contact_terms(of.viscosity, radius1, radius2, gap, of.regularisation);
    } else {
      const auto full = table_terms(of.viscosity, radius1, radius2, gap, of.regularisation);
      terms = full.balanced;
      resistance_.drags.push_back({normal, full.drag, pair.first, pair.second});
    }
    resistance_.pairs.push_back({normal, terms.squeeze, terms.turn_first, terms.turn_mixed,
                                 terms.turn_second, terms.spin, 1 / terms.arm, pair.first,
                                 pair.second});
    strains_.push_back({terms.strain_squeeze, terms.strain_turn_first, terms.strain_turn_second,
                        terms.stress_axial, terms.stress_transverse, terms.stress_twofold,
                        radius1 + radius2});
  }
}

void PairSystem::share_drag(std::span<const double> radii, std::span<const PlacedPair> pairs) {
  std::vector<double> weights(pairs.size()), sums(radii.size(), 0.0), left(radii.size(), 1.0);
  const auto sphere = [](std::int32_t k) { return static_cast<std::size_t>(k); };
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto i = sphere(pairs[p].first), j = sphere(pairs[p].second);
    weights[p] = weight_at(2 * pairs[p].gap / (lubrication_.range * (radii[i] + radii[j])));
    sums[i] += weights[p];
    sums[j] += weights[p];
  }
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto i = sphere(pairs[p].first), j = sphere(pairs[p].second);
    const double most = std::max(sums[i], sums[j]);
    const double share = most > 0 ? weights[p] / most : 0;
    left[i] -= share;
    left[j] -= share;
    const double root = std::sqrt(lubrication_.drag * share);
    auto& drag = resistance_.drags[p].drag;
    drag.axial_strain *= root;
    for (const std::size_t s : {0U, 1U}) {
      drag.axial[s] *= root;
      drag.spin[s] *= root;
      for (auto& mode : drag.transverse) {
        mode.move[s] *= root;
        mode.turn[s] *= root;
      }
    }
    for (auto& mode : drag.transverse) mode.strain *= root;
  }
  for (std::size_t k = 0; k < radii.size(); ++k) {
    resistance_.spheres[k].move *= std::max(left[k], 0.0);
    resistance_.spheres[k].turn *= std::max(left[k], 0.0);
  }
}

void PairSystem::subtract_strain_loads(const SymmetricTensor& strain,
                                       std::span<Motion> loads) const {
  const auto sphere = [&](std::int32_t k) -> Motion& { return loads[static_cast<std::size_t>(k)]; };
  for (std::size_t p = 0; p < resistance_.pairs.size(); ++p) {
    const auto& pair = resistance_.pairs[p];
    const auto& row = strains_[p];
    const Lanes n = pair.normal, en = lanes_of(strain.times(vector_of(n)));
    const Lanes about = cross(n, en);
    const Lanes along = (row.squeeze * dot(n, en)) * n +
                        (pair.inverse_arm * (row.turn_first + row.turn_second)) * cross(n, about);
    auto &first = sphere(pair.first), &second = sphere(pair.second);
    first.along += along;
    first.turn -= row.turn_first * about;
    second.along -= along;
    second.turn -= row.turn_second * about;
  }
  for (const auto& row : resistance_.drags) {
    const Lanes n = row.normal, en = lanes_of(strain.times(vector_of(n)));
    const double axial = row.drag.axial_strain * dot(n, en);
    const Lanes across = en - dot(n, en) * n;
    for (const std::size_t s : {0U, 1U}) {
      auto& load = sphere(s == 0 ? row.first : row.second);
      load.along -= (row.drag.axial[s] * axial) * n;
      for (const auto& mode : row.drag.transverse) {
        load.along -= (mode.move[s] * mode.strain) * across;
        load.turn += (mode.turn[s] * mode.strain) * cross(n, across);
      }
    }
  }
}

SymmetricTensor PairSystem::stresslets(std::span<const Motion> motions,
                                       const SymmetricTensor& strain) const {
  SymmetricTensor sum;
  sum.add(sphere_stress_, strain);
  // Adds A (nn - 1/3) + trace/3 and the symmetric part of n tau.
  const auto add = [&](const Lanes& normal, double axial, double trace, const Lanes& tau) {
    const Vector n = vector_of(normal);
    sum.add_dyad(axial, n, n);
    sum.add_isotropic((trace - axial) / 3);
    sum.add_dyad(1, n, vector_of(tau));
  };
  const auto motion = [&](std::int32_t k) { return motions[static_cast<std::size_t>(k)]; };
  for (std::size_t p = 0; p < resistance_.pairs.size(); ++p) {
    const auto& pair = resistance_.pairs[p];
    const auto& row = strains_[p];
    const Lanes n = pair.normal, en = lanes_of(strain.times(vector_of(n)));
    const Motion first = motion(pair.first), second = motion(pair.second);
    const Lanes d = second.along - first.along, rotation = pair.inverse_arm * cross(n, d);
    const double squeezed = dot(n, d), strained = dot(n, en);
    const Lanes across = en - strained * n;
    const Lanes tau =
        cross(row.turn_first * (first.turn - rotation) + row.turn_second * (second.turn - rotation),
              n) +
        row.stress_transverse * across;
    // The moment of the squeezing force about both centres has the trace of the force times the
    // radii, near contact exactly.
    const double force = pair.squeeze * squeezed + row.squeeze * strained;
    add(n, row.squeeze * squeezed + row.stress_axial * strained, row.radii * force, tau);
    if (row.stress_twofold != 0) {
      // P E P + nEn P/2 with P = 1 - nn.
      const Vector m = vector_of(n);
      sum.add(row.stress_twofold, strain);
      sum.add_dyad(-2 * row.stress_twofold, m, vector_of(en));
      sum.add_dyad(row.stress_twofold * strained / 2, m, m);
      sum.add_isotropic(row.stress_twofold * strained / 2);
    }
  }
  for (const auto& row : resistance_.drags) {
    const Lanes n = row.normal, en = lanes_of(strain.times(vector_of(n)));
    const Lanes across = en - dot(n, en) * n;
    double axial = row.drag.axial_strain * dot(n, en);
    Lanes tau{};
    for (const std::size_t s : {0U, 1U})
      axial += row.drag.axial[s] * dot(n, motion(s == 0 ? row.first : row.second).along);
    for (const auto& mode : row.drag.transverse) {
      Lanes value = mode.strain * across;
      for (const std::size_t s : {0U, 1U}) {
        const Motion& of = motion(s == 0 ? row.first : row.second);
        value +=
            mode.move[s] * (of.along - dot(n, of.along) * n) + mode.turn[s] * cross(n, of.turn);
      }
      tau += mode.strain * value;
    }
    add(n, row.drag.axial_strain * axial, 0, tau);
  }
  return sum;
}

}  // namespace viscontact::suspensions
