// The worker threads of a ThreadPool. Which thread computes a block depends on chance.
#include "viscontact/common/system/thread_pool.hpp"

#include <atomic>
#include <cassert>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

namespace viscontact {
namespace {

/// In the solver of a particle step (the projection, docs/particles.md) loops follow each other
/// within microseconds. A thread therefore looks 2000 times for what it waits for, which takes
/// about 1 ms, before it sleeps. At first it does so without a call of the system: waking takes
/// longer than many of the loops.
template <class Condition>
void look_until(const Condition& is_true) {
  constexpr int kQuickLooks = 300, kLooks = 2000;
  for (int look = 0; look < kLooks && !is_true(); ++look) {
    if (look >= kQuickLooks) std::this_thread::yield();
#ifdef __x86_64__
    else
      __builtin_ia32_pause();
#endif
  }
}

}  // namespace

/// What the threads share. run() sets `body` and `parts` before it raises `round`, and a worker
/// reads them only after it has seen the new `round`.
struct ThreadPool::Workers {
  const std::function<void(std::size_t)>* body = nullptr;
  // Each thread begins with a part of the blocks of its own, because it has the data of the same
  // blocks of earlier loops in its caches, and then helps others.
  struct alignas(64) Part {
    std::atomic<std::size_t> next{0};  // next block to be computed
    std::size_t end = 0;
  };
  std::vector<Part> parts;
  std::atomic<unsigned> round{0};  // number of the loop; its change wakes the workers
  std::atomic<int> busy{0};        // number of workers that have not finished this loop
  bool stop = false;               // true ends the workers; read after `round` has changed
  std::vector<std::thread> threads;

  std::mutex failing;
  std::exception_ptr failure;  // the first exception in a loop

  /// Exceptions of `body` are stored, not thrown.
  void work(std::size_t thread) {
    for (std::size_t k = 0; k < parts.size(); ++k) {
      auto& part = parts[(thread + k) % parts.size()];
      for (std::size_t block = part.next.fetch_add(1); block < part.end;
           block = part.next.fetch_add(1)) {
        try {
          (*body)(block);
        } catch (...) {
          const std::lock_guard lock(failing);
          if (!failure) failure = std::current_exception();
        }
      }
    }
  }

  void serve(std::size_t thread) {
    for (unsigned seen = 0;;) {
      look_until([&] { return round.load() != seen; });
      round.wait(seen);
      seen = round.load();
      if (stop) return;
      work(thread);
      if (busy.fetch_sub(1) == 1) busy.notify_one();
    }
  }
};

ThreadPool::ThreadPool(int threads) {
  if (threads <= 1) return;
  workers_ = std::make_unique<Workers>();
  workers_->threads.reserve(static_cast<std::size_t>(threads));
  workers_->parts = std::vector<Workers::Part>(static_cast<std::size_t>(threads));
  try {
    for (int i = 1; i < threads; ++i)
      workers_->threads.emplace_back(
          [workers = workers_.get(), i] { workers->serve(static_cast<std::size_t>(i)); });
  } catch (const std::system_error&) {
    // The system cannot start more threads. Those that exist do the work, with the same result.
  }
}

ThreadPool::~ThreadPool() {
  if (!workers_) return;
  assert(workers_->busy.load() == 0);
  workers_->stop = true;
  workers_->round.fetch_add(1);
  workers_->round.notify_all();
  for (auto& thread : workers_->threads) thread.join();
}

std::size_t ThreadPool::threads() const { return workers_ ? workers_->parts.size() : 1; }

void ThreadPool::run(std::size_t blocks, const std::function<void(std::size_t)>& body) {
  if (!workers_) {
    for (std::size_t block = 0; block < blocks; ++block) body(block);
    return;
  }
  auto& w = *workers_;
  assert(w.busy.load() == 0);
  w.body = &body;
  for (std::size_t k = 0; k < w.parts.size(); ++k) {
    w.parts[k].next.store(blocks * k / w.parts.size());
    w.parts[k].end = blocks * (k + 1) / w.parts.size();
  }
  w.busy.store(static_cast<int>(w.threads.size()));
  w.round.fetch_add(1);
  w.round.notify_all();
  w.work(0);
  look_until([&] { return w.busy.load() == 0; });
  for (int busy = w.busy.load(); busy != 0; busy = w.busy.load()) w.busy.wait(busy);
  if (w.failure) std::rethrow_exception(std::exchange(w.failure, nullptr));
}

}  // namespace viscontact
