// Terms of the pairs, shares of the drag (9.8), and sums over the pairs.
#include "viscontact/suspensions/pairs/pair_system.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "viscontact/suspensions/pairs/pair_sizes.hpp"
#include "viscontact/suspensions/pairs/pair_terms.hpp"
#include "viscontact/suspensions/pairs/row_blocks.hpp"

namespace viscontact::suspensions {
namespace {

using particles::PairTerms;  // which pairs, in the setting
using std::numbers::pi;

/// The weight of a pair in the shares of the drag; it falls to 0 at the range.
double weight_at(double gap_over_range) {
  const double x = std::clamp(gap_over_range, 0.0, 1.0);
  return (1 - x * x) * (1 - x * x);
}

PairSystem::StrainTerms strain_terms_of(const BalancedTerms& terms) {
  return {terms.strain_squeeze, terms.strain_turn_first, terms.strain_turn_second,
          terms.stress_axial,   terms.stress_transverse, terms.stress_twofold};
}

}  // namespace

std::vector<PlacedPair> placed(std::span<const NearPair> pairs, std::span<const double> radii,
                               double least_gap) {
  std::vector<PlacedPair> result;
  result.reserve(pairs.size());
  for (const auto& pair : pairs) {
    const double distance = norm(pair.apart);
    const double gap = distance - sizes_of(radii[static_cast<std::size_t>(pair.first)],
                                           radii[static_cast<std::size_t>(pair.second)])
                                      .contact_distance;
    result.push_back(
        {pair.first, pair.second, (1 / distance) * pair.apart, std::max(gap, least_gap)});
  }
  return result;
}

PairSystem::PairSystem(const PairLubrication& lubrication, std::span<const double> radii,
                       std::span<const PlacedPair> pairs, ThreadPool& pool)
    : PairSystem(
          lubrication, radii, pairs.size(), [&](std::size_t p) { return pairs[p]; }, pool) {}

PairSystem::PairSystem(const PairLubrication& lubrication, std::span<const double> radii,
                       std::size_t pairs, const Places& places, ThreadPool& pool)
    : lubrication_(lubrication), pool_(&pool), radii_(radii.begin(), radii.end()) {
  for (const double a : radii_) {
    const bool is_plane = std::isinf(a);
    assert(is_plane || resistance_.fixed == 0);
    if (is_plane) ++resistance_.fixed;
  }
  resistance_.spheres.resize(radii_.size());
  resistance_.pairs.resize(pairs);
  if (lubrication.pairs == PairTerms::kTables) {
    resistance_.drags.resize(pairs);
    strains_.resize(pairs);
    for (std::size_t k = 0; k < resistance_.free_count(); ++k)
      sphere_stress_ += 20 * pi / 3 * lubrication.viscosity * radii_[k] * radii_[k] * radii_[k];
  }
  place(places);
  resistance_.blocks = RowBlocks(radii_.size(), resistance_.pairs, pool.threads());
}

void PairSystem::place(const Places& places) {
  const double drag = lubrication_.drag * pi * lubrication_.viscosity;
  for (std::size_t k = 0; k < resistance_.free_count(); ++k) {
    const double a = radii_[k];
    resistance_.spheres[k] = {6 * drag * a, 8 * drag * a * a * a};
  }
  resistance_.slips.clear();
  pool_->for_blocks(
      resistance_.pairs.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) add_pair(places(p), p);
      },
      kPairsInBlock);
  if (lubrication_.pairs == PairTerms::kTables) share_drag();
}

TableTerms PairSystem::terms_of(const PairRow& pair) const {
  const double radius1 = radii_[static_cast<std::size_t>(pair.first)];
  const double radius2 = radii_[static_cast<std::size_t>(pair.second)];
  const auto sizes = sizes_of(radius1, radius2);
  const double gap = pair.gap;
  const auto& of = lubrication_;
  TableTerms terms;
  const bool is_far = of.pairs == PairTerms::kNone || gap >= of.range * sizes.mean;
  if (is_far) {
    terms.balanced.arm = sizes.contact_distance;  // of a contact
  } else if (sizes.has_plane) {
    terms.balanced =
        of.pairs == PairTerms::kTables
            ? table_plane_terms(of.viscosity, radius1, gap, of.regularisation, of.fits.get())
            : near_contact_plane_terms(of.viscosity, radius1, gap, of.regularisation);
  } else if (of.pairs == PairTerms::kNearContact) {
    terms.balanced = near_contact_terms(of.viscosity, radius1, radius2, gap, of.regularisation);
  } else {
    terms = table_terms(of.viscosity, radius1, radius2, gap, of.regularisation, of.fits.get());
  }
  return terms;
}

void PairSystem::add_pair(const PlacedPair& pair, std::size_t p) {
  auto& row = resistance_.pairs[p];
  row.normal = Packed(lanes_of(pair.normal));
  row.gap = pair.gap;
  row.first = pair.first;
  row.second = pair.second;
  const auto [terms, drag] = terms_of(row);
  row.squeeze = terms.squeeze;
  row.turn_first = terms.turn_first;
  row.turn_mixed = terms.turn_mixed;
  row.turn_second = terms.turn_second;
  row.spin = terms.spin;
  row.inverse_arm = 1 / terms.arm;
  if (lubrication_.pairs != PairTerms::kTables) return;
  resistance_.drags[p] = {row.normal, drag, pair.first, pair.second};
  strains_[p] = strain_terms_of(terms);
}

PairSystem::StrainTerms PairSystem::strain_terms(std::size_t pair) const {
  return strains_.empty() ? strain_terms_of(terms_of(resistance_.pairs[pair]).balanced)
                          : strains_[pair];
}

PairSystem::StrainTerms PairSystem::strain_loads(std::size_t pair) const {
  auto terms = strain_terms(pair);
  if (!has_squeezes_) terms.squeeze = terms.stress_axial = 0;
  return terms;
}

void PairSystem::share_drag() {
  const auto& pairs = resistance_.pairs;
  std::vector<double> weights(pairs.size()), sums(radii_.size(), 0.0), left(radii_.size(), 1.0);
  const auto sphere = [](std::int32_t k) { return static_cast<std::size_t>(k); };
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto i = sphere(pairs[p].first), j = sphere(pairs[p].second);
    if (std::isinf(radii_[j])) continue;  // beside a plane the drag is that of the sphere alone
    weights[p] = weight_at(2 * pairs[p].gap / (lubrication_.range * (radii_[i] + radii_[j])));
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
  for (std::size_t k = 0; k < radii_.size(); ++k) {
    resistance_.spheres[k].move *= std::max(left[k], 0.0);
    resistance_.spheres[k].turn *= std::max(left[k], 0.0);
  }
}

void PairSystem::subtract_strain_loads(const SymmetricTensor& strain,
                                       std::span<Motion> loads) const {
  const auto sphere = [&](std::int32_t k) -> Motion& { return loads[static_cast<std::size_t>(k)]; };
  const auto& pairs = resistance_.pairs;
  add_by_blocks(resistance_.blocks, pairs, *pool_,
                [&](std::size_t p, bool to_first, bool to_second) {
                  const auto& pair = pairs[p];
                  const auto row = strain_loads(p);
                  const Lanes n = pair.normal, en = lanes_of(strain.times(vector_of(n)));
                  const Lanes about = cross(n, en);
                  const Lanes along =
                      (row.squeeze * dot(n, en)) * n +
                      (pair.inverse_arm * (row.turn_first + row.turn_second)) * cross(n, about);
                  if (to_first) {
                    auto& first = sphere(pair.first);
                    first.along += along;
                    first.turn -= row.turn_first * about;
                  }
                  if (to_second) {
                    auto& second = sphere(pair.second);
                    second.along -= along;
                    second.turn -= row.turn_second * about;
                  }
                });
  const auto& drags = resistance_.drags;
  if (!drags.empty())
    add_by_blocks(resistance_.blocks, drags, *pool_,
                  [&](std::size_t p, bool to_first, bool to_second) {
                    const auto& row = drags[p];
                    const Lanes n = row.normal, en = lanes_of(strain.times(vector_of(n)));
                    const double axial = row.drag.axial_strain * dot(n, en);
                    const Lanes across = en - dot(n, en) * n;
                    for (const std::size_t s : {0U, 1U}) {
                      if (!(s == 0 ? to_first : to_second)) continue;
                      auto& load = sphere(s == 0 ? row.first : row.second);
                      load.along -= (row.drag.axial[s] * axial) * n;
                      for (const auto& mode : row.drag.transverse) {
                        load.along -= (mode.move[s] * mode.strain) * across;
                        load.turn += (mode.turn[s] * mode.strain) * cross(n, across);
                      }
                    }
                  });
  for (auto& load : loads.subspan(resistance_.free_count())) load = {};
}

SymmetricTensor PairSystem::stresslets(std::span<const Motion> motions,
                                       const SymmetricTensor& strain) const {
  // Adds A (nn - 1/3) + trace/3 and the symmetric part of n tau.
  const auto add = [&](SymmetricTensor& sum, const Lanes& normal, double axial, double trace,
                       const Lanes& tau) {
    const Vector n = vector_of(normal);
    sum.add_dyad(axial, n, n);
    sum.add_isotropic((trace - axial) / 3);
    sum.add_dyad(1, n, vector_of(tau));
  };
  const auto motion = [&](std::int32_t k) { return motions[static_cast<std::size_t>(k)]; };
  const auto add_pair = [&](SymmetricTensor& sum, std::size_t p) {
    const auto& pair = resistance_.pairs[p];
    const auto row = strain_loads(p);
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
    const double force = has_squeezes_ ? pair.squeeze * squeezed + row.squeeze * strained : 0;
    add(sum, n, row.squeeze * squeezed + row.stress_axial * strained,
        sizes(p).contact_distance * force, tau);
    if (row.stress_twofold != 0) {
      // P E P + nEn P/2 with P = 1 - nn.
      const Vector m = vector_of(n);
      sum.add(row.stress_twofold, strain);
      sum.add_dyad(-2 * row.stress_twofold, m, vector_of(en));
      sum.add_dyad(row.stress_twofold * strained / 2, m, m);
      sum.add_isotropic(row.stress_twofold * strained / 2);
    }
  };
  const auto add_drag = [&](SymmetricTensor& sum, const DragRow& row) {
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
    add(sum, n, row.drag.axial_strain * axial, 0, tau);
  };
  struct Sum {
    SymmetricTensor stress;
    Sum& operator+=(const Sum& other) {
      stress.add(1, other.stress);
      return *this;
    }
  };
  const auto pairs = pool_->sum_of_blocks<Sum>(
      resistance_.pairs.size(),
      [&](std::size_t begin, std::size_t end) {
        Sum part;
        for (std::size_t p = begin; p < end; ++p) add_pair(part.stress, p);
        if (resistance_.drags.empty()) return part;
        for (std::size_t p = begin; p < end; ++p) add_drag(part.stress, resistance_.drags[p]);
        return part;
      },
      kPairsInBlock);
  SymmetricTensor sum = pairs.stress;
  sum.add(sphere_stress_, strain);
  return sum;
}

}  // namespace viscontact::suspensions
