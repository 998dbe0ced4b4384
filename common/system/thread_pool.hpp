// Threads that share loops over fixed blocks, so that a result does not depend on how many they are.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace viscontact {

/// Work is cut into blocks whose bounds depend on its size alone; each block is done by one thread, and what the blocks
/// return is added in their order: the same bits for any number of threads.
class ThreadPool {
 public:
  /// `threads` >= 1, the caller's included; fewer if the system gives no more. Workers sleep between loops.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// About a tenth of a millisecond of work in the loops of a projection: below, waking a thread costs more than it brings.
  static constexpr std::size_t kBlock = 16384;

  /// body(begin, end) for each block of [0, count). Throws what a body threw, once all have ended.
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

  /// The sum, by +=, in order of the blocks, of what body(begin, end) returns for each; Result{} for none.
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
  std::unique_ptr<Workers> workers_;  // none for one thread
};

}  // namespace viscontact
