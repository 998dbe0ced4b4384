// Loops that threads share: every index once, sums that do not depend on the threads, errors that
// come back.
#include "viscontact/common/system/thread_pool.hpp"

#include <gmock/gmock.h>

#include <new>
#include <vector>

namespace viscontact {
namespace {

constexpr std::size_t kCount = 5 * ThreadPool::kBlock + 7;

TEST(ThreadPool, DoesEveryIndexOnce) {
  for (const int threads : {1, 2, 5}) {
    ThreadPool pool(threads);
    std::vector<int> done(kCount, 0);
    for (int round = 1; round <= 3; ++round) {
      pool.for_blocks(kCount, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) ++done[k];
      });
      EXPECT_THAT(done, ::testing::Each(round)) << threads;
    }
  }
}

TEST(ThreadPool, AddsTheSameBitsWithAnyNumberOfThreads) {
  const auto sum = [](int threads) {
    ThreadPool pool(threads);
    return pool.sum_of_blocks<double>(kCount, [](std::size_t begin, std::size_t end) {
      double part = 0;
      for (std::size_t k = begin; k < end; ++k) part += 1 / static_cast<double>(k + 1);
      return part;
    });
  };
  const double alone = sum(1);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(sum(threads), alone) << threads;
}

TEST(ThreadPool, ThrowsWhatABlockThrewAndGoesOn) {
  for (const int threads : {1, 4}) {
    ThreadPool pool(threads);
    EXPECT_THROW(pool.for_blocks(kCount,
                                 [](std::size_t begin, std::size_t) {
                                   if (begin == 2 * ThreadPool::kBlock) throw std::bad_alloc();
                                 }),
                 std::bad_alloc);
    std::vector<int> done(kCount, 0);
    pool.for_blocks(kCount, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) ++done[k];
    });
    EXPECT_THAT(done, ::testing::Each(1));
  }
}

}  // namespace
}  // namespace viscontact
