// Products with the resistance.
#include "viscontact/suspensions/pairs/resistance.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "viscontact/contact_solver/methods/fastest_instructions.hpp"

namespace viscontact::suspensions {

using contact_solver::by_fastest_instructions;

void Resistance::multiply(std::span<const Motion> motions, std::span<Motion> loads) const {
  by_fastest_instructions([&] {
    multiply_in_place(*this, motions, loads);
    return 0;
  });
}

ResistanceProduct::ResistanceProduct(const Resistance& resistance, ThreadPool& pool)
    : resistance_(&resistance), pool_(&pool) {
  [[maybe_unused]] const auto is_earlier = [](const auto& a, const auto& b) {
    return a.first < b.first;
  };
  assert(std::ranges::is_sorted(resistance.pairs, is_earlier));
  assert(std::ranges::is_sorted(resistance.slips, is_earlier));
  if (!resistance.slips.empty())
    slips_ = RowBlocks(resistance.blocks.spheres(), resistance.slips, resistance.blocks.threads());
}

double ResistanceProduct::multiply(std::span<const Motion> x, std::span<Motion> y) const {
  const auto& resistance = *resistance_;
  const std::size_t count = resistance.count(), size = resistance.blocks.size();
  assert(x.size() == count && y.size() == count);
  // Of fixed numbers of spheres, because the blocks are not the same for any number of threads.
  constexpr std::size_t kSpheres = BlockTuning::kSpheres;
  std::vector<double> powers((count + kSpheres - 1) / kSpheres);
  pool_->for_blocks(
      count,
      [&](std::size_t begin, std::size_t end) {
        by_fastest_instructions([&] {
          for (std::size_t k = begin; k < end; ++k) {
            y[k].along = resistance.spheres[k].move * x[k].along;
            y[k].turn = resistance.spheres[k].turn * x[k].turn;
          }
          const auto add_rows = [&](const auto& rows, const RowBlocks& blocks) {
            blocks.for_rows(
                rows, begin,
                [&](std::size_t r, bool to_first, bool to_second) {
                  const auto& row = rows[r];
                  const auto i = static_cast<std::size_t>(row.first),
                             j = static_cast<std::size_t>(row.second);
                  const auto loads = loads_of(row, x[i], x[j]);
                  if (to_first) add(loads.first, y[i]);
                  if (to_second) add(loads.second, y[j]);
                },
                [&](std::size_t k) { prefetch(x[k]); });
          };
          add_rows(resistance.pairs, resistance.blocks);
          if (!resistance.drags.empty()) add_rows(resistance.drags, resistance.blocks);
          if (!resistance.slips.empty()) add_rows(resistance.slips, slips_);
          for (std::size_t k = std::max(begin, resistance.free_count()); k < end; ++k) y[k] = {};
          for (std::size_t from = begin; from < end; from += kSpheres) {
            Lanes sum{};
            for (std::size_t k = from; k < std::min(from + kSpheres, end); ++k)
              sum += x[k].along * y[k].along + x[k].turn * y[k].turn;
            powers[from / kSpheres] = sum[0] + sum[1] + sum[2];
          }
          return 0;
        });
      },
      size);
  if (resistance.rate.loads.empty()) return std::accumulate(powers.begin(), powers.end(), 0.0);
  return by_fastest_instructions([&] {
    add_loads(resistance.rate, x, y);
    Lanes sum{};
    for (std::size_t k = 0; k < count; ++k) sum += x[k].along * y[k].along + x[k].turn * y[k].turn;
    return sum[0] + sum[1] + sum[2];
  });
}

}  // namespace viscontact::suspensions
