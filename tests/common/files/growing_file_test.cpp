// A file of lines that grows, is cut back to an earlier end, and does not fit on the disk. A limit
// on the size of files stands for the disk: the kernel then refuses to write beyond it (EFBIG).
#include "viscontact/common/files/growing_file.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>
#include <string>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

class GrowingTable : public ::testing::Test {
 protected:
  GrowingFile file() const { return {path_, "# head\nn\n", "end\n"}; }
  std::string text() const { return read_file(path_); }
  /// Writes `lines` to a new file and returns its end.
  FileEnd written(const std::string& lines) const {
    auto growing = file();
    growing.append(lines);
    growing.sync();
    return growing.end();
  }

  TemporaryFolder scratch_;
  std::filesystem::path path_ = scratch_.path() / "table.csv";
};

TEST_F(GrowingTable, HasItsHeadItsLinesAndItsFoot) {
  auto growing = file();
  EXPECT_FALSE(std::filesystem::exists(path_));
  growing.sync();
  EXPECT_EQ(text(), "# head\nn\nend\n");
  growing.append("1\n2\n");
  growing.append("");
  growing.append("3\n");
  EXPECT_EQ(growing.end().bytes, 15U);
  EXPECT_EQ(growing.end().last_line, "3");
  growing.sync();
  growing.sync();
  EXPECT_EQ(text(), "# head\nn\n1\n2\n3\nend\n");
}

TEST_F(GrowingTable, WithoutAHeadIsMadeBySyncBeforeItsFirstLine) {
  GrowingFile growing(path_, "", "end\n");
  growing.sync();
  EXPECT_EQ(text(), "end\n");
  growing.append("1\n");
  growing.sync();
  EXPECT_EQ(text(), "1\nend\n");
}

TEST_F(GrowingTable, DoesNotKeepManyLinesInMemory) {
  auto growing = file();
  std::string lines;
  for (int n = 0; n < 100000; ++n) {
    growing.append(std::to_string(n) + "\n");
    lines += std::to_string(n) + "\n";
  }
  EXPECT_GT(std::filesystem::file_size(path_), lines.size() - 100000);
  growing.sync();
  EXPECT_EQ(text(), "# head\nn\n" + lines + "end\n");
}

TEST_F(GrowingTable, ContinuesFromAnEarlierEnd) {
  const auto end = written("1\n22\n");
  EXPECT_EQ(end.last_line, "22");
  // A process that is killed while it writes leaves a line without its end, and no foot.
  put_text(path_, "# head\nn\n1\n22\n3\n4");
  auto growing = file();
  growing.resume(end);
  EXPECT_EQ(text(), "# head\nn\n1\n22\nend\n");
  growing.append("333\n");
  growing.sync();
  EXPECT_EQ(text(), "# head\nn\n1\n22\n333\nend\n");
  EXPECT_EQ(growing.end().bytes, end.bytes + 4);
}

TEST_F(GrowingTable, IsRefusedIfItsEndIsNotThere) {
  const auto end = written("1\n22\n");
  EXPECT_NO_THROW(file().check(end));
  const auto refused = [&](const std::string& text) {
    put_text(path_, text);
    EXPECT_THAT(bad_input([&] { file().check(end); }), IsAt("table.csv"));
    EXPECT_THAT(bad_input([&] { file().resume(end); }), IsAt("table.csv"));
    EXPECT_EQ(read_file(path_), text);  // it is not cut
  };
  refused("# head\nn\n1\n22");
  refused("# head\nn\n1.0\n22.0\nend\n");
  refused("");
  EXPECT_THAT(bad_input([&] { file().check(FileEnd{}); }), IsAt("table.csv"));
  std::filesystem::remove(path_);
  EXPECT_THAT(bad_input([&] { file().check(end); }), IsAt("table.csv"));
}

/// While it lives, no file of this process can become longer.
class LimitOfFiles {
 public:
  explicit LimitOfFiles(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    EXPECT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  }
  LimitOfFiles(const LimitOfFiles&) = delete;
  LimitOfFiles& operator=(const LimitOfFiles&) = delete;
  ~LimitOfFiles() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST_F(GrowingTable, ThatDoesNotFitEndsWithAWholeLineAndGoesOnIfThereIsRoomAgain) {
  ASSERT_NE(std::signal(SIGXFSZ, SIG_IGN), SIG_ERR);
  auto growing = file();
  growing.append("1\n");
  growing.sync();
  growing.append("22222\n33333\n");
  std::string left;
  {
    const LimitOfFiles limit(20);
    EXPECT_THAT(bad_input([&] { growing.sync(); }), IsAt("table.csv"));
    left = text();
  }
  EXPECT_EQ(left, "# head\nn\n1\nend\n");
  growing.sync();
  EXPECT_EQ(text(), "# head\nn\n1\n22222\n33333\nend\n");
}

TEST_F(GrowingTable, OfWhichNotEvenTheHeadFitsIsNotThere) {
  ASSERT_NE(std::signal(SIGXFSZ, SIG_IGN), SIG_ERR);
  auto growing = file();
  {
    const LimitOfFiles limit(10);
    EXPECT_THAT(bad_input([&] { growing.sync(); }), IsAt("table.csv"));
  }
  EXPECT_TRUE(std::filesystem::is_empty(scratch_.path()));
}

}  // namespace
}  // namespace viscontact
