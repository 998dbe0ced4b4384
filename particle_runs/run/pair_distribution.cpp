// Counts of pairs in bins of the distance.
#include "viscontact/particle_runs/run/pair_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/neighbours/close_pairs.hpp"

namespace viscontact::particles {
namespace {

struct PairDistributionTuning {
  // Number of bins in a unit of the distance.
  static constexpr std::size_t kBins = 50;
  // Largest gap, in mean radii, of which pairs are counted, also if the box is large. At a volume
  // fraction of 0.5 a sphere has 60 neighbours so near, and the next ones tell little.
  static constexpr double kMostRange = 3;
  // Frames and spheres times frames that are counted at most, which takes some seconds.
  static constexpr std::size_t kMostFrames = 100, kMostSpheres = 2000000;
};

/// The sum over all pairs i < j of (r_i + r_j)^3.
double sum_of_cubes(const std::vector<double>& radii) {
  double n = 0, r1 = 0, r2 = 0, r3 = 0;
  for (const double r : radii) {
    n += 1;
    r1 += r;
    r2 += r * r;
    r3 += r * r * r;
  }
  return (2 * n * r3 + 6 * r1 * r2 - 8 * r3) / 2;
}

std::vector<std::size_t> counted_frames(const ParticlesCase& c, const Playback& playback) {
  using Tuning = PairDistributionTuning;
  std::vector<std::size_t> frames;
  for (std::size_t f = 0; f < playback.frames.size(); ++f)
    if (playback.frames[f].time >= c.average_from) frames.push_back(f);
  // The start has the arrangement of the case, not that of the flow.
  if (frames.size() > 1 && playback.frames[frames.front()].time == 0) frames.erase(frames.begin());
  if (frames.empty()) frames.push_back(playback.frames.size() - 1);
  const auto most =
      std::clamp<std::size_t>(Tuning::kMostSpheres / playback.radii.size(), 1, Tuning::kMostFrames);
  if (frames.size() <= most) return frames;
  std::vector<std::size_t> some;
  for (std::size_t k = 1; k <= most; ++k) some.push_back(frames[k * frames.size() / most - 1]);
  return some;
}

/// The centres of the spheres, followed by those of their images near the cell.
struct Places {
  std::vector<double> positions;       // [L]
  std::vector<std::size_t> particles;  // of each place
};

/// Images that are further than `reach` [L] from the cell are left out.
Places places_of(const Playback& playback, const Frame& frame, double reach) {
  const auto cell = cell_at(playback, frame);
  Places places;
  const auto add = [&](std::size_t k, const Vector& x) {
    places.positions.insert(places.positions.end(), x.begin(), x.end());
    places.particles.push_back(k);
  };
  for (std::size_t k = 0; k < playback.radii.size(); ++k) add(k, position(playback, frame, k));
  for (std::int32_t image = -kLargestImage; image <= kLargestImage; ++image) {
    if (image == 0) continue;
    const Vector shift = shift_of(cell, image);
    for (std::size_t k = 0; k < playback.radii.size(); ++k) {
      const Vector x = position(playback, frame, k) + shift;
      bool is_near = true;
      for (std::size_t d = 0; d < 3; ++d)
        is_near =
            is_near && x[d] > cell.from[d] - reach && x[d] < cell.from[d] + cell.lengths[d] + reach;
      if (is_near) add(k, x);
    }
  }
  return places;
}

}  // namespace

std::vector<PairDistributionRow> pair_distribution(const ParticlesCase& c,
                                                   const Playback& playback) {
  const double volume = measure(c.setting.domain);
  const std::vector<double> radii(playback.radii.begin(), playback.radii.end());
  if (!(volume > 0) || radii.size() < 2 || playback.frames.empty()) return {};
  const double largest = std::ranges::max(radii);
  double range = PairDistributionTuning::kMostRange;
  // Each pair must have one image in the range, and single precision leaves a margin.
  for (const double period : periods_of(c.setting.domain))
    range = std::min(range, (1 - 1e-5) * period / (2 * largest) - 2);
  const auto bins = static_cast<std::size_t>(range / 2 * PairDistributionTuning::kBins);
  if (bins == 0) return {};

  const double sign =
      c.setting.lubrication->gradient[0][1] < 0 || c.setting.lubrication->stress.value_or(0) < 0
          ? -1
          : 1;
  std::vector<PairDistributionRow> rows(bins);
  const auto frames = counted_frames(c, playback);
  std::vector<double> extents;
  for (const double radius : radii) extents.push_back((1 + range / 2) * radius);
  const double reach = 2 * std::ranges::max(extents);
  ThreadPool pool(1);
  for (const auto f : frames) {
    const auto& frame = playback.frames[f];
    const auto places = places_of(playback, frame, reach);
    std::vector<double> extents_of_places;
    for (const auto k : places.particles) extents_of_places.push_back(extents[k]);
    for (const auto& [first, second, image] :
         close_pairs(3, places.positions, extents_of_places, pool)) {
      // A pair with an image is found twice; the pair with i < j is kept.
      const auto i = index_of(first), j = places.particles[index_of(second)];
      if (i >= radii.size() || i >= j) continue;
      const Vector apart = point_of(places.positions.data(), index_of(second), 3) -
                           point_of(places.positions.data(), i, 3);
      const double beyond = std::max(0.0, norm(apart) / (radii[i] + radii[j]) - 1);
      const auto bin = static_cast<std::size_t>(beyond * PairDistributionTuning::kBins);
      if (bin >= bins) continue;
      rows[bin].all += 1;
      const bool is_compressed = sign * apart[0] * apart[1] < 0;
      (is_compressed ? rows[bin].compression : rows[bin].extension) += 1;
    }
  }
  const double per_pairs =
      4 * std::numbers::pi / 3 * sum_of_cubes(radii) / volume * static_cast<double>(frames.size());
  for (std::size_t bin = 0; bin < bins; ++bin) {
    constexpr double kBins = PairDistributionTuning::kBins;
    const double low = 1 + static_cast<double>(bin) / kBins;
    const double high = 1 + static_cast<double>(bin + 1) / kBins;
    const double expected = per_pairs * (high * high * high - low * low * low);
    auto& row = rows[bin];
    row.distance = 1 + static_cast<double>(2 * bin + 1) / (2 * kBins);
    row.all /= expected;
    row.compression /= expected / 2;
    row.extension /= expected / 2;
  }
  return rows;
}

}  // namespace viscontact::particles
