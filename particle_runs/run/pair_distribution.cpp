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

/// The rate at which a flow stretches a line along `x`, x E x, without its magnitude. At rest it is
/// that of a shear along x.
double stretching(const std::array<Vector, 3>& gradient, const Vector& x) {
  if (gradient == std::array<Vector, 3>{}) return x[0] * x[1];
  return x[0] * dot(gradient[0], x) + x[1] * dot(gradient[1], x) + x[2] * dot(gradient[2], x);
}

/// The part of all directions along which a flow compresses.
double compressed_part(const std::array<Vector, 3>& g) {
  const bool is_plane =
      g[0][2] == 0 && g[1][2] == 0 && g[2][0] == 0 && g[2][1] == 0 && g[2][2] == 0;
  if (is_plane) return 0.5;
  // Directions that cover the sphere evenly, each turned by a golden section from the one before.
  constexpr int kDirections = 100000;
  int count = 0;
  for (int k = 0; k < kDirections; ++k) {
    const double z = (2 * k + 1.0) / kDirections - 1, r = std::sqrt(1 - z * z);
    const double angle = 2 * std::numbers::pi * std::numbers::phi * k;
    if (stretching(g, {r * std::cos(angle), r * std::sin(angle), z}) < 0) ++count;
  }
  return static_cast<double>(count) / kDirections;
}

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

/// The gradient, times a number > 0, in the step that ended at `time`.
Gradient gradient_before(const PairLubrication& pairs, double time) {
  constexpr double kBefore = 1 - 1e-9;  // far above rounding errors of times
  const auto flow = pairs.flow_at(kBefore * time);
  const double factor = flow.stress.value_or(1) * pairs.factor(kBefore * time, kBefore * time);
  auto gradient = flow.gradient;
  for (auto& row : gradient) row = (factor < 0 ? -1.0 : 1.0) * row;
  return gradient;
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
      if (is_near_cell(cell, x, reach)) add(k, x);
    }
  }
  return places;
}

}  // namespace

std::vector<PairDistributionRow> pair_distribution(const ParticlesCase& c,
                                                   const Playback& playback) {
  const double volume = measure(c.setting.domain);
  // Between walls spheres without order have another number of neighbours.
  if (std::ranges::min(periods_of(c.setting.domain)) == 0) return {};
  const std::vector<double> radii(playback.radii.begin(), playback.radii.end());
  if (!(volume > 0) || radii.size() < 2 || playback.frames.empty()) return {};
  const double largest = std::ranges::max(radii);
  double range = PairDistributionTuning::kMostRange;
  // Each pair must have one image in the range, and single precision leaves a margin.
  const auto frames = counted_frames(c, playback);
  const auto limit_by = [&](double period) {
    range = std::min(range, (1 - 1e-5) * period / (2 * largest) - 2);
  };
  for (const double period : periods_of(c.setting.domain)) limit_by(period);
  for (const auto f : frames)
    if (const auto& periods = playback.frames[f].periods)
      for (const double per_height : one_over_heights(*periods)) limit_by(1 / per_height);
  const auto bins = static_cast<std::size_t>(range / 2 * PairDistributionTuning::kBins);
  if (bins == 0) return {};

  std::vector<PairDistributionRow> rows(bins);
  std::vector<double> extents;
  for (const double radius : radii) extents.push_back((1 + range / 2) * radius);
  const double reach = 2 * std::ranges::max(extents);
  double compressed = 0;  // part of the directions
  ThreadPool pool(1);
  for (const auto f : frames) {
    const auto& frame = playback.frames[f];
    const auto gradient = gradient_before(*c.setting.lubrication, frame.time);
    compressed += compressed_part(gradient) / static_cast<double>(frames.size());
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
      const bool is_compressed = stretching(gradient, apart) < 0;
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
    row.compression /= compressed * expected;
    row.extension /= (1 - compressed) * expected;
  }
  return rows;
}

}  // namespace viscontact::particles
