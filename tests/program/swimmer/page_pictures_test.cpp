// The pictures of the pages of a swimmer and of a rolling sphere: colours, and places of texts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "tests/common/regular_expressions.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/program/program.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/number.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const std::string kData = std::string(VISCONTACT_SOURCE_FOLDER) + "/data/";

/// Makes the page of the shipped swimmer in the folder swimmer/ and that of the sphere on an
/// incline in incline/. The shipped tables are taken, so that FreeFEM is not needed.
class PagePictures : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(path("swimmer"));
    fs::copy_file(kData + "tables/three_spheres.csv", path("swimmer/table.csv"));
    for (const auto& arguments :
         {std::vector<std::string>{"swimmer", kData + "cases/swimmer/three_spheres.toml", "-o",
                                   path("swimmer")},
          {"rolling", kData + "cases/rolling/incline.toml", "-o", path("incline")}})
      expect_done(run_viscontact(arguments, {"VISCONTACT_FREEFEM=no-freefem-is-needed"}));
  }
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

 private:
  TemporaryFolder scratch_;
};

/// A text of a picture, and the height of its baseline, downwards [pixels].
struct PlacedText {
  std::string text;
  double y;
};

std::vector<PlacedText> texts_of(const std::string& svg) {
  std::vector<PlacedText> texts;
  for (const auto& match :
       matches_in(svg, "translate\\([0-9.]+,([0-9.]+)\\)[^>]*>\\s*<text>\\s*([^<]*)</text>"))
    texts.push_back({match[2], parse_number(match[1]).value()});
  return texts;
}

/// The name of the horizontal axis must not touch the numbers above it, nor the legend below it.
void expect_room_around(const std::string& name, const std::string& picture) {
  SCOPED_TRACE(picture);
  const auto texts = texts_of(read_file(picture));
  bool found = false;
  for (const auto& label : texts) {
    if (label.text != name) continue;
    found = true;
    double above = 0, below = 1e9;
    for (const auto& other : texts) {
      if (other.y < label.y && parse_number(other.text)) above = std::max(above, other.y);
      if (other.y > label.y) below = std::min(below, other.y);
    }
    // The letters are 14 pixels high. Of a line 19 pixels below, the tops stay 2 pixels away from
    // the strokes that letters like g have below the baseline.
    EXPECT_GE(label.y - above, 19);
    EXPECT_GE(below - label.y, 19);
  }
  EXPECT_TRUE(found);
}

TEST_F(PagePictures, LeaveRoomAroundTheNameOfTheAxisAndTellCurvesByTheirColours) {
  expect_room_around("arm x1", path("swimmer/plots/loops.svg"));
  expect_room_around("time / period", path("swimmer/plots/position.svg"));
  expect_room_around("time", path("swimmer/plots/arms.svg"));
  expect_room_around("polynomials for each arm", path("swimmer/plots/convergence.svg"));
  for (const char* name : {"gap", "velocity", "friction"})
    expect_room_around("time", path("incline/plots/" + std::string(name) + ".svg"));
  // No two curves have the same colour, and each has the same one in all pictures.
  for (const auto& [page, curves] :
       std::map<std::string, std::size_t>{{"swimmer", 2 + 2 + 3 + 2}, {"incline", 3}}) {
    std::map<std::string, std::set<std::string>> colours, names;
    for (const auto& match : matches_in(read_file(path(page + "/report.html")),
                                        "\"legend\":\"([^\"]+)\",\"colour\":\"([^\"]+)\"")) {
      colours[match[1]].insert(match[2]);
      names[match[2]].insert(match[1]);
    }
    EXPECT_EQ(colours.size(), curves) << page;
    for (const auto& [name, its] : colours) EXPECT_EQ(its.size(), 1U) << name;
    for (const auto& [colour, its] : names) EXPECT_EQ(its.size(), 1U) << colour;
    if (page != "swimmer") continue;
    EXPECT_EQ(*colours["stroke"].begin(), "#56B4E9");
    EXPECT_EQ(*colours["optimal stroke"].begin(), "#D55E00");
  }
  // gnuplot writes the same two colours so.
  const auto loops = read_file(path("swimmer/plots/loops.svg"));
  EXPECT_THAT(loops, HasSubstr("rgb( 86, 180, 233)"));
  EXPECT_THAT(loops, HasSubstr("rgb(213,  94,   0)"));
}

}  // namespace
}  // namespace viscontact
