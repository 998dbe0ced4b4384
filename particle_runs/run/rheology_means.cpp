// Means of blocks.
#include "viscontact/particle_runs/run/rheology_means.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "viscontact/particle_runs/io/rheology_file.hpp"

namespace viscontact::particles {

void RheologyMeans::add(const Rheology& rheology, double begin, double end, double from,
                        double end_of_case) {
  const auto numbers = numbers_to_average(rheology);
  if (!std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); })) return;
  blocks.resize(kBlocks);
  const double length = end_of_case - from;
  const double first = std::max(begin, from);
  const double duration = length > 0 ? end - first : 1;
  if (!(duration > 0)) return;
  const double place = length > 0 ? ((first + end) / 2 - from) / length : 0;
  auto& block = blocks[std::min(kBlocks - 1, static_cast<std::size_t>(place * kBlocks))];
  block.means.resize(numbers.size());
  block.duration += duration;
  // This form of the mean has no rounding error if all values are equal (Welford 1962).
  for (std::size_t k = 0; k < numbers.size(); ++k)
    block.means[k] += (numbers[k] - block.means[k]) * (duration / block.duration);
}

std::size_t RheologyMeans::filled_blocks() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(blocks, [](const Block& block) { return block.duration > 0; }));
}

std::optional<double> RheologyMeans::mean(std::size_t k) const {
  assert(k < kRheologyMeans.size());
  double mean = 0, duration = 0;
  for (const auto& block : blocks) {
    if (!(block.duration > 0)) continue;
    duration += block.duration;
    mean += (block.means[k] - mean) * (block.duration / duration);
  }
  return duration > 0 ? std::optional(mean) : std::nullopt;
}

std::optional<double> RheologyMeans::standard_error(std::size_t k) const {
  assert(k < kRheologyMeans.size());
  const auto n = static_cast<double>(filled_blocks());
  if (n < 2) return {};
  double mean = 0, squares = 0;
  for (const auto& block : blocks)
    if (block.duration > 0) mean += block.means[k] / n;
  for (const auto& block : blocks)
    if (block.duration > 0) squares += (block.means[k] - mean) * (block.means[k] - mean);
  return std::sqrt(squares / (n - 1) / n);
}

std::string mean_name(std::size_t k) { return "mean_" + std::string(kRheologyMeans[k]); }

std::string standard_error_name(std::size_t k) { return mean_name(k) + "_error"; }

}  // namespace viscontact::particles
