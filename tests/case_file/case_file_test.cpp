// Case files that are no case files, and files that are damaged.
#include "viscontact/case_file/case_file.hpp"

#include <gmock/gmock.h>

#include <ostream>
#include <string>

#include "tests/case_file/edited_case.hpp"
#include "tests/common/failure.hpp"

namespace viscontact::case_file {
namespace {

using ::testing::StartsWith;

TEST(CaseFile, KeepsItsTextAndItsPath) {
  const TemporaryFolder folder;
  const auto path = folder.file("mine.toml", lecture_text());
  const Case c = read_case(path);
  EXPECT_EQ(c.text, lecture_text());
  EXPECT_EQ(c.path, path);
}

TEST(CaseFile, MayHaveWindowsLineEnds) {
  std::string text;
  for (const char character : lecture_text())
    text += character == '\n' ? std::string("\r\n") : std::string(1, character);
  EXPECT_EQ(required_motion(read_text(text)).mass, 20);
}

TEST(CaseFile, IsRefusedWhenItIsEmpty) { expect_refused({"", 1}, "title"); }

TEST(CaseFile, IsRefusedWhenItIsAFolderOrMissing) {
  const TemporaryFolder folder;
  for (const auto& path : {folder.path(), folder.path() / "missing.toml"})
    EXPECT_THAT(bad_input([&] { read_case(path); }), IsAt(path.string()));
}

struct NotToml {
  const char* name;
  const char* text;
  int line;
};

/// For the messages of GoogleTest.
void PrintTo(const NotToml& file, std::ostream* stream) { *stream << file.name; }

class NotTomlFile : public ::testing::TestWithParam<NotToml> {};

TEST_P(NotTomlFile, IsRefusedWithTheLineWhereTomlEnds) {
  expect_refused({GetParam().text, GetParam().line}, "");
}

INSTANTIATE_TEST_SUITE_P(
    Like, NotTomlFile,
    ::testing::Values(
        NotToml{"ATable", "gap,reference_velocity,force\n1,-1,3\n", 1},
        NotToml{"Json", "{ \"basis\": \"lecture\" }\n", 1},
        NotToml{"AKeyWithoutAValue", "title = \"t\"\n[fluid]\nviscosity =\n", 3},
        NotToml{"AKeyTwice", "title = \"t\"\n[fluid]\nviscosity = 1\nviscosity = 2\n", 4},
        NotToml{"ATableTwice", "title = \"t\"\n[fluid]\nviscosity = 1\n[fluid]\n", 4},
        NotToml{"AnOpenList", "title = \"t\"\n[a]\nb = [1, 2\nc = 3\n", 4},
        NotToml{"ACommaForAPoint", "title = \"t\"\n[fluid]\nviscosity = 3,0\n", 3},
        NotToml{"ANumberTooLargeForADouble", "title = \"t\"\n[fluid]\nviscosity = 1e400\n", 3},
        NotToml{"NoUtf8", "title = \"\xff\xfe\"\n", 1}),
    [](const auto& parameter) { return parameter.param.name; });

/// Reads a damaged text: it is a case, or it is refused as bad input; anything else fails the test.
void expect_read_or_refused(const TemporaryFolder& folder, const std::string& text) {
  const auto path = folder.file("damaged.toml", text);
  try {
    read_case(path);
  } catch (const Error& error) {
    ASSERT_EQ(error.kind(), ErrorKind::kBadInput) << error.what();
    ASSERT_THAT(error.what(), StartsWith(path.string() + ":"));
  }
}

TEST(DamagedCaseFile, IsNeverMoreThanBadInputWhereverItIsCutOff) {
  const TemporaryFolder folder;
  const std::string text = lecture_text();
  for (std::size_t length = 0; length < text.size(); length += 3) {
    expect_read_or_refused(folder, text.substr(0, length));
    if (::testing::Test::HasFailure()) FAIL() << "cut off at " << length;
  }
}

TEST(DamagedCaseFile, IsNeverMoreThanBadInputWhateverByteIsWrong) {
  const TemporaryFolder folder;
  const std::string text = lecture_text();
  const std::string wrong("\0\"]=-9\n\x80", 8);
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string damaged = text;
    damaged[i] = wrong[i % wrong.size()];
    expect_read_or_refused(folder, damaged);
    if (::testing::Test::HasFailure()) FAIL() << "wrong byte at " << i;
  }
}

}  // namespace
}  // namespace viscontact::case_file
