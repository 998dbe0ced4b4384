#include "viscontact/pipeline/compare_stage.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"

namespace viscontact::pipeline {
namespace {

TEST(CompareStage, EndsWhenAStopIsRequestedAndWritesNothing) {
  const TemporaryFolder folder;
  for (const char* name : {"one.csv", "two.csv"})
    (void)folder.file(name, "time,gap,velocity\n0,1,0\n1,1,0\n");
  const auto comparison = folder.path() / "comparison.json";
  const auto compare = [&](const StopToken& stop) {
    compare_stage(folder.path(), {}, "one", comparison, {}, true, stop);
  };
  const std::atomic<bool> flag = true;
  failure(ErrorKind::kInterrupted, [&] { compare(StopToken(flag)); });
  EXPECT_FALSE(std::filesystem::exists(comparison));
  compare({});
  EXPECT_TRUE(std::filesystem::exists(comparison));
}

}  // namespace
}  // namespace viscontact::pipeline
