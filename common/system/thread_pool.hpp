// Threads that share loops over fixed blocks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace viscontact {

/// Threads that compute loops over indices from 0. A loop is divided into blocks whose bounds
/// depend on the length of the loop alone. Each block is computed by one thread, and the results of
/// the blocks are added in their order. The result therefore has the same bits for any number of
/// threads. oneTBB 2021.8 is not used, because ThreadSanitizer cannot check it; for a loop of 2, 4
/// and 16 blocks on two idle cores it takes 21, 40 and 156 us, and this class 21, 45 and 159 us.
class ThreadPool {
 public:
  /// `threads` is the number of threads with the calling one; less than 1 counts as 1. If the
  /// system refuses to start so many, fewer are used. Between loops the threads look for the next
  /// loop for about 1 ms, then sleep. `body` must not start another loop.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;
  std::size_t threads() const;  ///< with the calling one

  /// Indices in a block. Another number changes sums in their last digits. In the loops of the
  /// solver of a particle step (docs/particles.md) a block is about 0.1 ms of work; for less work,
  /// waking a thread costs more time than the thread saves.
  static constexpr std::size_t kBlock = 16384;

  /// Calls body(begin, end) for each block of [0, count), on all threads of the pool, in any order.
  /// If a call throws, the first exception is thrown again when all calls have ended; a pool of one
  /// thread throws at once and leaves out the remaining blocks. A loop of more work for each index
  /// may have smaller blocks of `size` indices.
  template <class Body>
  void for_blocks(std::size_t count, const Body& body, std::size_t size = kBlock) {
    const std::size_t blocks = (count + size - 1) / size;
    if (blocks <= 1) {
      if (count > 0) body(std::size_t{0}, count);
      return;
    }
    run(blocks, [&body, count, size](std::size_t block) {
      body(block * size, std::min(block * size + size, count));
    });
  }

  /// Adds the values that body(begin, end) returns for each block with += in the order of the
  /// blocks. Returns Result{} if count is 0. Throws the errors of for_blocks().
  template <class Result, class Body>
  Result sum_of_blocks(std::size_t count, const Body& body, std::size_t size = kBlock) {
    if (count <= size) return count > 0 ? body(std::size_t{0}, count) : Result{};
    std::vector<Result> parts((count + size - 1) / size);
    for_blocks(
        count, [&](std::size_t begin, std::size_t end) { parts[begin / size] = body(begin, end); },
        size);
    Result sum{};
    for (const auto& part : parts) sum += part;
    return sum;
  }

 private:
  // Calls body(0) to body(blocks - 1), each once, and returns when all calls have ended.
  void run(std::size_t blocks, const std::function<void(std::size_t)>& body);

  struct Workers;
  std::unique_ptr<Workers> workers_;  // null for one thread
};

/// A Result of sum_of_blocks(): the largest value of all blocks; minus infinity if there are none.
/// A NaN has no effect.
struct MaximumOfBlocks {
  double value = -std::numeric_limits<double>::infinity();
  MaximumOfBlocks& operator+=(const MaximumOfBlocks& other) {
    value = std::max(value, other.value);
    return *this;
  }
};

/// A Result of sum_of_blocks(): the lists of all blocks, in the order of the blocks.
template <class T>
struct ConcatenatedBlocks {
  std::vector<T> values;
  ConcatenatedBlocks& operator+=(const ConcatenatedBlocks& other) {
    values.insert(values.end(), other.values.begin(), other.values.end());
    return *this;
  }
};

}  // namespace viscontact
