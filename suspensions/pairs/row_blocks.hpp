// Rows of pairs of spheres by blocks of spheres, which threads share.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/contact_solver/methods/fastest_instructions.hpp"

namespace viscontact::suspensions {

struct BlockTuning {
  // Spheres in a block of a loop over spheres. Fewer blocks than threads leave threads without
  // work; a loop of smaller blocks is shorter than it takes to start it.
  static constexpr std::size_t kSpheres = 512;
  // The most in a block of a loop over rows, in which rows between two blocks are computed twice:
  // a quarter of them in blocks of 1024 neighbours. So many spheres and their rows are in a cache.
  static constexpr std::size_t kMostSpheres = 4096;
  // Blocks of a loop over rows for each thread, because threads are not equally fast.
  static constexpr std::size_t kForThread = 4;
  // So many rows or spheres earlier memory is taken to a cache. Without this the iterations with
  // 100 000 spheres take a sixth more time.
  static constexpr std::size_t kAhead = 8;
};
/// Pairs in a block of a loop.
inline constexpr std::size_t kPairsInBlock = 4096;

/// Takes the memory of `value` to a cache.
template <class T>
void prefetch(const T& value) {
  for (std::size_t byte = 0; byte < sizeof value; byte += 64)
    __builtin_prefetch(reinterpret_cast<const char*>(&value) + byte);
}

/// Rows, in order of their first spheres, by blocks of spheres. A row between two blocks belongs to
/// both, so that no two threads add to a sphere. Each sphere is added to in the order of the rows,
/// so that sums do not depend on the blocks, which depend on the number of threads.
class RowBlocks {
 public:
  RowBlocks() = default;
  /// The second sphere of a row follows the first one. `threads` will share the blocks.
  template <class Row>
  RowBlocks(std::size_t spheres, const std::vector<Row>& rows, std::size_t threads = 1)
      : spheres_(spheres),
        threads_(threads),
        size_(size_for(spheres, threads)),
        begin_{0},
        incoming_begin_((spheres + size_ - 1) / size_ + 1, 0) {
    const auto block_of = [&](std::int32_t sphere) {
      return static_cast<std::size_t>(sphere) / size_;
    };
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const auto first = block_of(rows[r].first), second = block_of(rows[r].second);
      while (begin_.size() <= first) begin_.push_back(static_cast<std::uint32_t>(r));
      if (second != first) ++incoming_begin_[second + 1];
    }
    begin_.resize(incoming_begin_.size(), static_cast<std::uint32_t>(rows.size()));
    for (std::size_t b = 1; b < incoming_begin_.size(); ++b)
      incoming_begin_[b] += incoming_begin_[b - 1];
    incoming_.resize(incoming_begin_.back());
    auto next = incoming_begin_;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const auto second = block_of(rows[r].second);
      if (second != block_of(rows[r].first))
        incoming_[next[second]++] = static_cast<std::uint32_t>(r);
    }
  }

  /// Calls add(r, to_first, to_second) for each row r of the block that begins with sphere `begin`,
  /// so that what is added to a sphere is added in the order of the rows, and some rows earlier
  /// fetch(k) for a sphere k of the row that is perhaps not in a cache.
  template <class Row, class Add, class Fetch>
  void for_rows(const std::vector<Row>& rows, std::size_t begin, const Add& add,
                const Fetch& fetch) const {
    constexpr std::size_t kAhead = BlockTuning::kAhead;
    const std::size_t b = begin / size_;
    if (b + 1 >= begin_.size()) return;
    // Both loops ask for both spheres, so that the compiler rounds alike in both.
    const auto is_here = [&](std::int32_t sphere) {
      return static_cast<std::size_t>(sphere) - begin < size_;
    };
    for (std::size_t c = incoming_begin_[b]; c < incoming_begin_[b + 1]; ++c) {
      if (c + 2 * kAhead < incoming_.size()) {
        prefetch(rows[incoming_[c + 2 * kAhead]]);
        fetch(static_cast<std::size_t>(rows[incoming_[c + kAhead]].first));
      }
      const auto& row = rows[incoming_[c]];
      add(std::size_t{incoming_[c]}, is_here(row.first), is_here(row.second));
    }
    for (std::size_t r = begin_[b]; r < begin_[b + 1]; ++r) {
      if (r + kAhead < rows.size()) fetch(static_cast<std::size_t>(rows[r + kAhead].second));
      add(r, is_here(rows[r].first), is_here(rows[r].second));
    }
  }
  std::size_t size() const { return size_; }  ///< spheres in a block, a multiple of kSpheres
  std::size_t spheres() const { return spheres_; }
  std::size_t threads() const { return threads_; }

 private:
  static std::size_t size_for(std::size_t spheres, std::size_t threads) {
    if (threads == 1) return BlockTuning::kMostSpheres;
    const std::size_t step = threads * BlockTuning::kForThread * BlockTuning::kSpheres;
    return std::clamp((spheres + step - 1) / step * BlockTuning::kSpheres, BlockTuning::kSpheres,
                      BlockTuning::kMostSpheres);
  }

  std::size_t spheres_ = 0, threads_ = 1;
  std::size_t size_ = BlockTuning::kSpheres;
  std::vector<std::uint32_t> begin_{0}, incoming_begin_{0};
  std::vector<std::uint32_t> incoming_;  // rows whose second sphere is in a later block
};

/// Calls add(r, to_first, to_second) for each row r by several threads, no two of which add to the
/// same sphere.
template <class Row, class Add>
void add_by_blocks(const RowBlocks& blocks, const std::vector<Row>& rows, ThreadPool& pool,
                   const Add& add) {
  pool.for_blocks(
      blocks.spheres(),
      [&](std::size_t begin, std::size_t) {
        contact_solver::by_fastest_instructions([&] {
          blocks.for_rows(rows, begin, add, [](std::size_t) {});
          return 0;
        });
      },
      blocks.size());
}

}  // namespace viscontact::suspensions
