// Threads that share loops over fixed blocks. A change must keep the results independent of the
// number of threads, bit for bit.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace viscontact {

/// A loop is divided into blocks whose bounds depend on its length alone. Each block is computed by
/// one thread, and the results of the blocks are added in their order. The result therefore has the
/// same bits for any number of threads.
class ThreadPool {
 public:
  /// `threads` >= 1, including the calling thread; fewer are used if the system refuses to start
  /// more. The threads sleep between loops.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// Entries in a block: about 0.1 ms of work in the loops of a projection. For less work it costs
  /// more to wake a thread than the thread saves.
  static constexpr std::size_t kBlock = 16384;

  /// Calls body(begin, end) for each block of [0, count). If a body throws, the exception is thrown
  /// again when no body runs any more.
  template <class Body>
  void for_blocks(std::size_t count, const Body& body) {
    const std::size_t blocks = (count + kBlock - 1) / kBlock;
    if (blocks <= 1) {
      if (count > 0) body(std::size_t{0}, count);
      return;
    }
    const Job<Body> job{&body, count};
    run(blocks, &Job<Body>::call, &job);
  }

  /// Adds, by += in the order of the blocks, what body(begin, end) returns for each block. Returns
  /// Result{} if count is 0.
  template <class Result, class Body>
  Result sum_of_blocks(std::size_t count, const Body& body) {
    if (count <= kBlock) return count > 0 ? body(std::size_t{0}, count) : Result{};
    std::vector<Result> parts((count + kBlock - 1) / kBlock);
    for_blocks(count, [&](std::size_t begin, std::size_t end) {
      parts[begin / kBlock] = body(begin, end);
    });
    Result sum{};
    for (const auto& part : parts) sum += part;
    return sum;
  }

 private:
  template <class Body>
  struct Job {
    const Body* body;
    std::size_t count;
    static void call(const void* self, std::size_t block) {
      const auto& job = *static_cast<const Job*>(self);
      const std::size_t begin = block * kBlock;
      (*job.body)(begin, begin + kBlock < job.count ? begin + kBlock : job.count);
    }
  };
  void run(std::size_t blocks, void (*call)(const void*, std::size_t), const void* job);

  struct Workers;
  std::unique_ptr<Workers> workers_;  // null for one thread
};

}  // namespace viscontact
