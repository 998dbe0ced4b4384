// Products with the resistance R by several threads, in the same order for any number of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/contact_solver/methods/fastest_instructions.hpp"
#include "viscontact/suspensions/pairs/resistance.hpp"

namespace viscontact::suspensions {

/// Spheres in a block of a loop. Fewer blocks than threads leave threads without work; a loop of
/// smaller blocks is shorter than it takes to start it.
inline constexpr std::size_t kSpheresInBlock = 1024;
/// Pairs in a block of a loop.
inline constexpr std::size_t kPairsInBlock = 4096;

/// Calls add(r, to_first, to_second) for each row r, in order of their first spheres, by blocks of
/// spheres, so that no two threads add to a sphere: at first for all first spheres, and for second
/// ones in the block of their first one, then for the others.
template <class Row, class Add>
void add_by_blocks(std::size_t spheres, const std::vector<Row>& rows, ThreadPool& pool,
                   const Add& add) {
  const std::size_t blocks = (spheres + kSpheresInBlock - 1) / kSpheresInBlock;
  using contact_solver::by_fastest_instructions;
  if (blocks <= 1) {
    by_fastest_instructions([&] {
      for (std::size_t r = 0; r < rows.size(); ++r) add(r, true, true);
      return 0;
    });
    return;
  }
  std::vector<std::vector<std::uint32_t>> others(blocks);
  pool.for_blocks(
      spheres,
      [&](std::size_t begin, std::size_t end) {
        const auto from = std::ranges::lower_bound(rows, static_cast<std::int32_t>(begin), {},
                                                   [](const Row& row) { return row.first; });
        auto& other = others[begin / kSpheresInBlock];
        const auto to = std::ranges::lower_bound(from, rows.end(), static_cast<std::int32_t>(end),
                                                 {}, [](const Row& row) { return row.first; });
        const auto first = static_cast<std::size_t>(from - rows.begin()),
                   last = static_cast<std::size_t>(to - rows.begin());
        const auto is_here = [&](std::size_t r) {
          return static_cast<std::size_t>(rows[r].second) - begin < end - begin;
        };
        by_fastest_instructions([&] {
          for (std::size_t r = first; r < last; ++r) add(r, true, is_here(r));
          return 0;
        });
        for (std::size_t r = first; r < last; ++r)
          if (!is_here(r)) other.push_back(static_cast<std::uint32_t>(r));
      },
      kSpheresInBlock);
  by_fastest_instructions([&] {
    for (const auto& other : others)
      for (const auto r : other) add(r, false, true);
    return 0;
  });
}

/// Divides the rows of R into blocks by their first spheres. A block adds loads to its own spheres
/// alone; those of other spheres are kept and added when all blocks are done. This needs few
/// numbers if the numbers of near spheres are near, too.
class RowBlocks {
 public:
  /// The rows must be in order of their first spheres.
  void set(const Resistance& resistance);
  /// loads = R motions. Returns motions.(loads).
  double multiply(const Resistance& resistance, std::span<const Motion> motions,
                  std::span<Motion> loads, ThreadPool& pool);

 private:
  struct Incoming {
    std::uint32_t kept = 0;
    std::int32_t sphere = 0;
  };
  struct Rows {
    std::vector<std::uint32_t> begin, kept;  // of each block, the first row and kept load
  };
  template <class Row>
  void divide(const std::vector<Row>& rows, Rows& blocks);

  std::size_t count_ = 0, blocks_ = 0;
  Rows pairs_, drags_, slips_;
  std::vector<Motion> kept_;
  std::vector<std::int32_t> keepers_;  // the spheres of the kept loads
  std::vector<std::uint32_t> incoming_begin_;
  std::vector<Incoming> incoming_;
};

}  // namespace viscontact::suspensions
