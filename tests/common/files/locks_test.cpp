#include "viscontact/common/files/locks.hpp"

#include <gmock/gmock.h>

#include <optional>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;

TEST(LockedFolder, IsHeldByOneAtATime) {
  const TemporaryFolder scratch;
  std::optional<LockedFolder> first(std::in_place, scratch.path(), "is held");
  EXPECT_THAT(bad_input([&] { const LockedFolder second(scratch.path(), "is held"); }),
              AllOf(IsAt(scratch.path().string()), Names("is held")));
  first.reset();
  EXPECT_NO_THROW(const LockedFolder third(scratch.path(), "is held"));
  EXPECT_TRUE(fs::exists(scratch.path()));  // it was there before
}

TEST(LockedFolder, ThatWasMadeIsGoneIfNothingWasPutThere) {
  const TemporaryFolder scratch;
  const auto path = scratch.path() / "new";
  {
    const LockedFolder folder(path, "is held");
    EXPECT_TRUE(fs::is_directory(path));
  }
  EXPECT_FALSE(fs::exists(path));
  {
    const LockedFolder folder(path, "is held");
    write_file(path / "result", "text");
  }
  EXPECT_TRUE(fs::exists(path / "result"));
}

TEST(LockedFolder, InPlaceOfWhichIsAFileIsRefused) {
  const TemporaryFolder scratch;
  const auto path = scratch.file("file", "text");
  EXPECT_THAT(bad_input([&] { const LockedFolder folder(path, "is held"); }), IsAt(path.string()));
}

TEST(RemoveFile, TakesAFileAwayAndMindsNoneThatIsNotThere) {
  const TemporaryFolder scratch;
  const auto path = scratch.file("file", "text");
  remove_file(path);
  EXPECT_FALSE(fs::exists(path));
  EXPECT_NO_THROW(remove_file(path));
  // A folder with something in it stays.
  fs::create_directories(scratch.path() / "full" / "inner");
  EXPECT_THAT(bad_input([&] { remove_file(scratch.path() / "full"); }), IsAt("full"));
}

}  // namespace
}  // namespace viscontact
