#include "viscontact/common/files/file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"

namespace viscontact {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

TEST(ReadFile, GivesEveryByte) {
  const TemporaryFolder folder;
  std::string bytes;
  for (int i = 0; i < 300'000; ++i)
    bytes += static_cast<char>(i % 256);  // several buffers, NUL and CR LF among them
  EXPECT_EQ(read_file(folder.file("bytes", bytes)), bytes);
  EXPECT_EQ(read_file(folder.file("empty", "")), "");
}

TEST(ReadFile, NamesAMissingFile) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "missing.csv";
  EXPECT_THAT(bad_input([&] { read_file(path); }), IsAt(path.string()));
}

TEST(ReadFile, NamesAFolderInPlaceOfAFile) {
  const TemporaryFolder folder;
  EXPECT_THAT(bad_input([&] { read_file(folder.path()); }), IsAt(folder.path().string()));
}

TEST(WriteFile, WritesWhatReadFileReads) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "table.csv";
  const std::string content("a,b\n1,2\n\0\xff", 10);
  write_file(path, content);
  EXPECT_EQ(read_file(path), content);
  EXPECT_THAT(folder.names(), ElementsAre("table.csv"));
}

TEST(WriteFile, ReplacesALongerFile) {
  const TemporaryFolder folder;
  const auto path = folder.file("fit.json", "an older and longer text");
  write_file(path, "new");
  EXPECT_EQ(read_file(path), "new");
  EXPECT_THAT(folder.names(), ElementsAre("fit.json"));
}

TEST(WriteFile, MakesMissingFolders) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "out" / "lecture" / "fit.json";
  write_file(path, "x");
  EXPECT_EQ(read_file(path), "x");
}

TEST(WriteFile, LeavesAFolderInTheWayAsItIs) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "fit.json";
  std::filesystem::create_directory(path);
  EXPECT_THAT(bad_input([&] { write_file(path, "x"); }), IsAt(path.string()));
  EXPECT_TRUE(std::filesystem::is_directory(path));
  EXPECT_THAT(folder.names(), ElementsAre("fit.json"));
}

// These tests may run as root, whom permissions do not stop; a path below a file stops root too.
TEST(WriteFile, RefusesAPathBelowAFileAndLeavesTheFile) {
  const TemporaryFolder folder;
  const auto file = folder.file("file", "old");
  EXPECT_THAT(bad_input([&] { write_file(file / "fit.json", "x"); }), IsAt(file.string()));
  EXPECT_THAT(bad_input([&] { write_file(file / "deep" / "fit.json", "x"); }),
              IsAt((file / "deep").string()));
  EXPECT_EQ(read_file(file), "old");
  EXPECT_THAT(folder.names(), ElementsAre("file"));
}

TEST(WriteFile, RefusesANameThatNoFileSystemTakes) {
  const TemporaryFolder folder;
  const auto path = folder.path() / std::string(300, 'x');  // 255 bytes is the limit of a name
  EXPECT_THAT(bad_input([&] { write_file(path, "x"); }), IsAt(path.string()));
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(WriteFile, LeavesTheOldFileWhenTheNewOneCannotBeWrittenBesideIt) {
  const TemporaryFolder folder;
  // The old name just fits; the longer one of the new file beside it does not.
  const std::string name(250, 'x');
  const auto path = folder.file(name, "old");
  EXPECT_THAT(bad_input([&] { write_file(path, "new"); }), IsAt(path.string()));
  EXPECT_EQ(read_file(path), "old");
  EXPECT_THAT(folder.names(), ElementsAre(name));
}

TEST(WriteFile, NeverPutsAFileInPlaceOfADevice) {
  // Root could replace /dev/stdout, which is a link, or /dev/null; here a link of our own stands
  // for them.
  const TemporaryFolder folder;
  const auto path = folder.path() / "link_to_device";
  std::filesystem::create_symlink("/dev/null", path);
  try {
    write_file(path, "x");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);  // to refuse is as good as to write there
  }
  EXPECT_TRUE(std::filesystem::is_character_file(path));
  EXPECT_THAT(folder.names(), ElementsAre("link_to_device"));
}

TEST(WriteFile, LeavesALinkALinkAndReplacesWhatItPointsTo) {
  const TemporaryFolder folder;
  const auto target = folder.file("target", "old");
  const auto link = folder.path() / "link";
  std::filesystem::create_symlink("target", link);
  write_file(link, "new");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_FALSE(std::filesystem::is_symlink(target));
  EXPECT_EQ(read_file(target), "new");
  EXPECT_THAT(folder.names(), UnorderedElementsAre("link", "target"));
}

TEST(WriteFile, RefusesALinkToItself) {
  const TemporaryFolder folder;
  const auto link = folder.path() / "link";
  std::filesystem::create_symlink("link", link);
  EXPECT_THAT(bad_input([&] { write_file(link, "x"); }), IsAt(link.string()));
  EXPECT_TRUE(std::filesystem::is_symlink(link));
}

TEST(CheckOutputFile, AcceptsWhatCanBeWrittenAndMakesNothing) {
  const TemporaryFolder folder;
  EXPECT_EQ(check_output_file(folder.path() / "new"), folder.path() / "new");
  EXPECT_EQ(check_output_file(folder.path() / "missing" / "new"),
            folder.path() / "missing" / "new");
  EXPECT_EQ(check_output_file("new"), "new");
  EXPECT_THAT(folder.names(), IsEmpty());
  EXPECT_EQ(check_output_file(folder.file("old", "old")), folder.path() / "old");
}

TEST(CheckOutputFile, RefusesAFolderAndADevice) {
  const TemporaryFolder folder;
  EXPECT_THAT(bad_input([&] { check_output_file(folder.path()); }), IsAt(folder.path().string()));
  EXPECT_THAT(bad_input([] { check_output_file("/dev/null"); }), IsAt("/dev/null"));
}

TEST(CheckOutputFile, RefusesALinkToAPipe) {
  // As /dev/stdout of a command whose output another one reads.
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  for (const int end : ends) {
    const auto file = fmt::format("/proc/self/fd/{}", end);
    EXPECT_THAT(bad_input([&] { (void)check_output_file(file); }), IsAt(file));
    ::close(end);
  }
}

TEST(WriteFile, TakesAwayWhatAKilledProcessLeftAndNothingElse) {
  const TemporaryFolder folder;
  const pid_t killed = ::fork();
  ASSERT_GE(killed, 0);
  if (killed == 0) ::_exit(0);
  ASSERT_EQ(::waitpid(killed, nullptr, 0), killed);
  const auto left = folder.file(fmt::format("out.csv.viscontact-{}.tmp", killed), "ti");
  const std::vector<std::filesystem::path> others = {
      folder.file(fmt::format("out.csv.viscontact-{}.tmp", ::getppid()),
                  "of a process that is there"),
      folder.file(fmt::format("other.csv.viscontact-{}.tmp", killed), "another file's"),
      folder.file("out.csv.tmp", "a user's"), folder.file("out.csv.viscontact-7a.tmp", "a user's"),
      folder.file("out.csv.20261121.tmp", "a user's")};
  write_file(folder.path() / "out.csv", "time\n");
  EXPECT_FALSE(std::filesystem::exists(left));
  for (const auto& other : others) EXPECT_TRUE(std::filesystem::exists(other)) << other;
  // All that killed processes have left in the folder, of which there is one file.
  remove_unfinished(folder.path());
  EXPECT_EQ(folder.names().size(), others.size());
  EXPECT_FALSE(std::filesystem::exists(others[1]));
}

TEST(WriteFileBy, PutsWhatAnotherWritesInPlaceInOneStep) {
  const TemporaryFolder folder;
  const auto path = folder.file("frames.h5", "old");
  const auto put = [](const std::filesystem::path& beside, std::string_view text) {
    std::ofstream(beside) << text;
  };
  write_file_by(path, [&](const auto& beside) {
    put(beside, "new");
    EXPECT_EQ(beside.parent_path(), path.parent_path());
    EXPECT_EQ(read_file(path), "old");  // until all is written
  });
  EXPECT_EQ(read_file(path), "new");
  // An error of any kind, and a writer that makes no file, leave the old file and nothing else.
  EXPECT_THROW(write_file_by(path,
                             [&](const auto& beside) {
                               put(beside, "half");
                               throw std::runtime_error("no more");
                             }),
               std::runtime_error);
  EXPECT_THAT(bad_input([&] { write_file_by(path, [](const auto&) {}); }), IsAt(path.string()));
  EXPECT_EQ(read_file(path), "new");
  EXPECT_THAT(folder.names(), ElementsAre("frames.h5"));
}

TEST(WriteUnflushed, ReplacesAFileThatIsFlushedLater) {
  const TemporaryFolder folder;
  const auto path = folder.file("frame", "old");
  write_unflushed(path, "new");
  EXPECT_EQ(read_file(path), "new");
  EXPECT_THAT(folder.names(), ElementsAre("frame"));
  EXPECT_NO_THROW(flush_files(std::vector{path}));
  EXPECT_THAT(bad_input([&] { flush_files(std::vector{folder.path() / "none"}); }), IsAt("none"));
}

TEST(ReadFile, RefusesADeviceWhichMayHaveNoEnd) {
  EXPECT_THAT(bad_input([] { (void)read_file("/dev/zero"); }), IsAt("/dev/zero"));
}

TEST(MakeFolder, MakesParentsAndIsContentWithAFolderThatIsThere) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a" / "b";
  make_folder(path);
  make_folder(path);
  EXPECT_TRUE(std::filesystem::is_directory(path));
}

TEST(MakeFolder, NamesAFileInTheWay) {
  const TemporaryFolder folder;
  const auto file = folder.file("file", "old");
  EXPECT_THAT(bad_input([&] { make_folder(file); }), IsAt(file.string()));
  EXPECT_THAT(bad_input([&] { make_folder(file / "below"); }), IsAt((file / "below").string()));
  EXPECT_EQ(read_file(file), "old");
}

}  // namespace
}  // namespace viscontact
