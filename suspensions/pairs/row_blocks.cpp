// Loads that a block adds to spheres of other blocks are kept until all blocks are done.
#include "viscontact/suspensions/pairs/row_blocks.hpp"

#include <algorithm>
#include <cassert>

#include "viscontact/contact_solver/methods/fastest_instructions.hpp"

namespace viscontact::suspensions {

using contact_solver::by_fastest_instructions;

void Resistance::multiply(std::span<const Motion> motions, std::span<Motion> loads) const {
  by_fastest_instructions([&] {
    multiply_in_place(*this, motions, loads);
    return 0;
  });
}

template <class Row>
void RowBlocks::divide(const std::vector<Row>& rows, Rows& blocks) {
  blocks.begin.assign(1, 0);
  blocks.kept.assign(1, static_cast<std::uint32_t>(keepers_.size()));
  std::size_t r = 0;
  for (std::size_t b = 0; b < blocks_; ++b) {
    const auto end = static_cast<std::int32_t>((b + 1) * kSpheresInBlock);
    for (; r < rows.size() && (rows[r].first < end || b + 1 == blocks_); ++r)
      if (rows[r].second >= end ||
          rows[r].second < end - static_cast<std::int32_t>(kSpheresInBlock))
        keepers_.push_back(rows[r].second);
    blocks.begin.push_back(static_cast<std::uint32_t>(r));
    blocks.kept.push_back(static_cast<std::uint32_t>(keepers_.size()));
  }
}

void RowBlocks::set(const Resistance& resistance) {
  [[maybe_unused]] const auto is_earlier = [](const auto& a, const auto& b) {
    return a.first < b.first;
  };
  assert(std::ranges::is_sorted(resistance.pairs, is_earlier));
  assert(std::ranges::is_sorted(resistance.drags, is_earlier));
  count_ = resistance.count();
  blocks_ = (count_ + kSpheresInBlock - 1) / kSpheresInBlock;
  keepers_.clear();
  divide(resistance.pairs, pairs_);
  divide(resistance.drags, drags_);
  divide(resistance.slips, slips_);
  kept_.resize(keepers_.size());
  incoming_begin_.assign(blocks_ + 1, 0);
  const auto block_of = [](std::int32_t sphere) {
    return static_cast<std::size_t>(sphere) / kSpheresInBlock;
  };
  for (const auto sphere : keepers_) ++incoming_begin_[block_of(sphere) + 1];
  for (std::size_t b = 0; b < blocks_; ++b) incoming_begin_[b + 1] += incoming_begin_[b];
  incoming_.resize(keepers_.size());
  auto next = incoming_begin_;
  for (std::size_t c = 0; c < keepers_.size(); ++c)
    incoming_[next[block_of(keepers_[c])]++] = {static_cast<std::uint32_t>(c), keepers_[c]};
}

double RowBlocks::multiply(const Resistance& resistance, std::span<const Motion> x,
                           std::span<Motion> y, ThreadPool& pool) {
  assert(resistance.count() == count_ && x.size() == count_ && y.size() == count_);
  pool.for_blocks(
      count_,
      [&](std::size_t begin, std::size_t end) {
        by_fastest_instructions([&] {
          for (std::size_t k = begin; k < end; ++k) {
            y[k].along = resistance.spheres[k].move * x[k].along;
            y[k].turn = resistance.spheres[k].turn * x[k].turn;
          }
          const std::size_t b = begin / kSpheresInBlock;
          const auto add_rows = [&](const auto& rows, const Rows& blocks) {
            std::size_t kept = blocks.kept[b];
            for (std::size_t r = blocks.begin[b]; r < blocks.begin[b + 1]; ++r) {
              const auto& row = rows[r];
              const auto i = static_cast<std::size_t>(row.first),
                         j = static_cast<std::size_t>(row.second);
              const auto loads = loads_of(row, x[i], x[j]);
              add(loads.first, y[i]);
              if (j - begin < end - begin)
                add(loads.second, y[j]);
              else
                kept_[kept++] = loads.second;
            }
          };
          add_rows(resistance.pairs, pairs_);
          add_rows(resistance.drags, drags_);
          add_rows(resistance.slips, slips_);
          return 0;
        });
      },
      kSpheresInBlock);
  const double power = pool.sum_of_blocks<double>(
      count_,
      [&](std::size_t begin, std::size_t end) {
        return by_fastest_instructions([&] {
          const std::size_t b = begin / kSpheresInBlock;
          for (std::size_t c = incoming_begin_[b]; c < incoming_begin_[b + 1]; ++c)
            add(kept_[incoming_[c].kept], y[static_cast<std::size_t>(incoming_[c].sphere)]);
          for (std::size_t k = std::max(begin, resistance.free_count()); k < end; ++k) y[k] = {};
          Lanes sum{};
          for (std::size_t k = begin; k < end; ++k)
            sum += x[k].along * y[k].along + x[k].turn * y[k].turn;
          return sum[0] + sum[1] + sum[2];
        });
      },
      kSpheresInBlock);
  if (resistance.rate.loads.empty()) return power;
  return by_fastest_instructions([&] {
    add_loads(resistance.rate, x, y);
    Lanes sum{};
    for (std::size_t k = 0; k < count_; ++k) sum += x[k].along * y[k].along + x[k].turn * y[k].turn;
    return sum[0] + sum[1] + sum[2];
  });
}

}  // namespace viscontact::suspensions
