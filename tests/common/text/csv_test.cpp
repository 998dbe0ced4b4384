#include "viscontact/common/text/csv.hpp"

#include <gmock/gmock.h>

#include <array>
#include <string>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"

namespace viscontact {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Pair;

const std::array<std::string, 3> kNames = {"time", "gap", "gamma"};

class Csv : public ::testing::Test {
 protected:
  /// What is read from a file of this text; gamma may be absent.
  CsvFile<3> read(const std::string& text) const {
    return read_csv(folder_.file("file.csv", text), kNames, 2);
  }

  /// The Error with which a file of this text is refused.
  Error refusal(const std::string& text) const {
    const auto error = bad_input([&] { read(text); });
    EXPECT_THAT(error, IsAt((folder_.path() / "file.csv").string()));
    return error;
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(Csv, NamesUtf16) {
  // "time,gap" with a byte order mark, as some editors save it, and without.
  const std::string plain = "time,gap\n0,1\n";
  std::string wide;
  for (const char c : plain) wide += std::string(1, c) + '\0';
  EXPECT_THAT(refusal("\xFF\xFE" + wide), Names("UTF-16"));
  EXPECT_THAT(refusal(wide), Names("UTF-16"));
}

TEST_F(Csv, GivesCommentsNumbersAndLines) {
  const auto csv = read(
      "# viscosity: 3\n# container: 40 x 80: closed\n# no comment of ours\ntime,gap,gamma\n0,1,\n# "
      "between\n0.5,1e-3,-2\n");
  EXPECT_THAT(csv.comments,
              ElementsAre(Pair("container", "40 x 80: closed"), Pair("viscosity", "3")));
  ASSERT_EQ(csv.rows.size(), 2U);
  EXPECT_THAT(csv.rows[0].fields, ElementsAre(0.0, 1.0, std::nullopt));
  EXPECT_THAT(csv.rows[1].fields, ElementsAre(0.5, 1e-3, -2.0));
  EXPECT_EQ(csv.rows[0].line, 5);
  EXPECT_EQ(csv.rows[1].line, 7);
}

TEST_F(Csv, FindsColumnsByNameInAnyOrderAmongOthers) {
  const auto csv = read("gamma,note,gap,time\n-1,7,2,3\n");
  ASSERT_EQ(csv.rows.size(), 1U);
  EXPECT_THAT(csv.rows[0].fields, ElementsAre(3.0, 2.0, -1.0));
}

TEST_F(Csv, ReadsAnAbsentOptionalColumnAsEmpty) {
  const auto csv = read("time,gap\n1,2\n");
  ASSERT_EQ(csv.rows.size(), 1U);
  EXPECT_THAT(csv.rows[0].fields, ElementsAre(1.0, 2.0, std::nullopt));
}

TEST_F(Csv, TakesWindowsLineEnds) {
  const auto csv = read("# viscosity: 3\r\n# rows: 1\r\ntime,gap,gamma\r\n1,2,-3\r\n");
  EXPECT_THAT(csv.comments, ElementsAre(Pair("rows", "1"), Pair("viscosity", "3")));
  ASSERT_EQ(csv.rows.size(), 1U);
  EXPECT_THAT(csv.rows[0].fields, ElementsAre(1.0, 2.0, -3.0));
}

TEST_F(Csv, HasTheNamesAndTheLineOfItsHeader) {
  const auto header = csv_header("\xEF\xBB\xBF# a comment\n\n x,\t\"y\" ,,z\r\n1,2,3,4\n");
  EXPECT_EQ(header.names, (std::vector<std::string>{"x", "\"y\"", "", "z"}));
  EXPECT_EQ(header.line, 3);
  EXPECT_TRUE(csv_header("# a comment").names.empty());
}

TEST_F(Csv, TakesAByteOrderMark) {
  const auto csv = read("\xEF\xBB\xBF# viscosity: 3\ntime,gap\n1,2\n");
  EXPECT_THAT(csv.comments, ElementsAre(Pair("viscosity", "3")));
  ASSERT_EQ(csv.rows.size(), 1U);
  EXPECT_THAT(csv.rows[0].fields, ElementsAre(1.0, 2.0, std::nullopt));
}

TEST_F(Csv, TakesALastLineWithoutItsEndWhereNoCountIsPromised) {
  EXPECT_EQ(read("time,gap\n1,2\n3,4").rows.size(), 2U);
}

TEST_F(Csv, TakesBlankLinesAtTheEndForNoRows) {
  // As editors leave them, and as spreadsheets do for cells that were cleared.
  for (const std::string end :
       {"\n", "\n\n\n", "\r\n\r\n", "  \n\t\n", " ", ",\n,\n", "\n \t,\r\n"}) {
    const auto csv = read("# rows: 2\ntime,gap\n1,2\n3,4\n" + end);
    ASSERT_EQ(csv.rows.size(), 2U) << end;
    EXPECT_EQ(csv.rows[1].line, 4);
  }
  // An empty field at the end of the last row is no blank line.
  EXPECT_THAT(read("time,gap,gamma\n1,2,\n\n").rows[0].fields, ElementsAre(1.0, 2.0, std::nullopt));
}

TEST_F(Csv, RefusesABlankLineBetweenRows) {
  EXPECT_THAT(refusal("time,gap\n1,2\n\n3,4\n\n"), IsAt("file.csv:3"));
}

TEST_F(Csv, DropsBlanksAroundFields) {
  const auto csv = read(" time , gap\n 1\t, 2 \n");
  ASSERT_EQ(csv.rows.size(), 1U);
  EXPECT_THAT(csv.rows[0].fields, ElementsAre(1.0, 2.0, std::nullopt));
}

TEST_F(Csv, RefusesAMissingColumn) {
  EXPECT_THAT(refusal("time,gamma\n1,2\n"),
              ::testing::AllOf(IsAt("file.csv", "gap"), Names("time,gamma")));
  EXPECT_THAT(refusal("\"time\",\"gap\"\n1,2\n"),
              ::testing::AllOf(IsAt("file.csv", "time"), Names("\"time\",\"gap\"")));
}

TEST_F(Csv, TakesNoNoticeOfTheCommasThatASpreadsheetPutsBehindAComment) {
  const auto csv = read("# rows: 1,,\n# title: a, b,,\ntime,gap\n1,2\n");
  EXPECT_EQ(csv.comments.at("rows"), "1");
  EXPECT_EQ(csv.comments.at("title"), "a, b");
}

TEST_F(Csv, KnowsTheCommentsThatContradictEachOther) {
  const auto csv = read("# rows: 1\n# rows: 1\n# note: a\n# note: b\ntime,gap\n1,2\n");
  EXPECT_THAT(csv.contradictions, ElementsAre("note"));
  EXPECT_EQ(csv.comments.at("note"), "b");
}

TEST_F(Csv, RefusesAColumnThatIsTwiceThere) {
  EXPECT_THAT(refusal("time,gap,time\n1,2,3\n"), IsAt("file.csv", "time"));
}

TEST_F(Csv, RefusesAnEmptyFile) {
  EXPECT_THAT(refusal(""), IsAt("file.csv"));
  EXPECT_THAT(refusal("# viscosity: 3\n"), IsAt("file.csv"));
}

TEST_F(Csv, RefusesAShortRow) {
  EXPECT_THAT(refusal("# x: y\ntime,gap\n1,2\n3\n"), IsAt("file.csv:4"));
}

TEST_F(Csv, RefusesALongRow) { EXPECT_THAT(refusal("time,gap\n1,2,3\n"), IsAt("file.csv:2")); }

TEST_F(Csv, RefusesALineBeyondAllReason) {
  const std::size_t limit = std::size_t{1} << 24;  // of the library
  EXPECT_THAT(refusal("time,gap\n1," + std::string(limit, '1') + "\n"), IsAt("file.csv:2"));
}

TEST_F(Csv, CutsALongFieldInItsMessage) {
  const auto error = refusal("time,gap\n1," + std::string(10'000, 'x') + "\n");
  EXPECT_LT(std::string(error.what()).size(), 400U) << "an error is one or two lines";
  EXPECT_THAT(error, IsAt("file.csv:2", "gap"));
}

TEST_F(Csv, RefusesWhatIsNoFiniteNumber) {
  for (const std::string text :
       {"nan", "NaN", "inf", "-inf", "1e400", "1e-400", "1.5x", "one", "\"1\""})
    EXPECT_THAT(refusal("time,gap\n0,1\n0," + text + "\n"), IsAt("file.csv:3", "gap"));
}

TEST_F(Csv, ShowsNoControlCharactersInItsMessage) {
  EXPECT_THAT(refusal("time,gap\n0,\x1b[31m\x7f\u00e9\n"), Says("'?[31m?\u00e9'"));
}

TEST_F(Csv, RefusesFewerOrMoreRowsThanPromised) {
  EXPECT_THAT(refusal("# rows: 3\ntime,gap\n1,2\n3,4\n"), IsAt("file.csv"));
  EXPECT_THAT(refusal("# rows: 1\ntime,gap\n1,2\n3,4\n"), IsAt("file.csv"));
  EXPECT_EQ(read("# rows: 2\ntime,gap\n1,2\n3,4\n").rows.size(), 2U);
}

TEST_F(Csv, CutAnywhereIsRefusedWhereACountIsPromised) {
  const std::string text = "# rows: 2\ntime,gap,gamma\n0.25,1.5,-1.25\n0.5,1.75,-12.5\n";
  ASSERT_EQ(read(text).rows.size(), 2U);
  for (std::size_t length = 0; length < text.size(); ++length) {
    // A cut inside the last number leaves a row that looks whole; only its missing line end tells.
    SCOPED_TRACE("cut to '" + text.substr(0, length) + "'");
    refusal(text.substr(0, length));
  }
}

TEST_F(Csv, RefusesABinaryFile) {
  EXPECT_THAT(refusal(std::string("\x7f"
                                  "ELF\0\1\2\n\3\4",
                                  10)),
              IsAt("file.csv", "time"));
}

TEST_F(Csv, NamesTheEmptyFieldThatMustBeThere) {
  const auto csv = read("time,gap\n1,\n");
  EXPECT_THAT(bad_input([&] { required_field(csv.rows[0], kNames, 1, "f.csv"); }),
              IsAt("f.csv:2", "gap"));
  EXPECT_EQ(required_field(csv.rows[0], kNames, 0, "f.csv"), 1.0);
}

TEST(CsvComment, IsReadAsANumberOrNamedInTheError) {
  const CsvComments comments = {{"viscosity", "3.5"}, {"radius", "wide"}};
  EXPECT_EQ(csv_comment_number(comments, "viscosity", "f.csv"), 3.5);
  EXPECT_THAT(bad_input([&] { csv_comment_number(comments, "radius", "f.csv"); }),
              IsAt("f.csv", "radius"));
  EXPECT_THAT(bad_input([&] { csv_comment_number(comments, "mass", "f.csv"); }),
              IsAt("f.csv", "mass"));
}

TEST(CsvComment, RoundTrips) {
  const CsvComments comments = {
      {"container", "radius 40, height: 80"}, {"empty", ""}, {"version of FreeFEM", "4.11"}};
  EXPECT_EQ(read_csv_comments(write_csv_comments(comments)), comments);
}

TEST(CsvFile, ThatIsMissingIsNamed) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "none.csv";
  EXPECT_THAT(bad_input([&] { read_csv(path, kNames, 1); }), IsAt(path.string()));
}

}  // namespace
}  // namespace viscontact
