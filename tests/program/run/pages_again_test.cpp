// `viscontact report DIR` makes the pages of every kind of folder again from its other files. Also
// colours, and places of texts, in the pictures of a swimmer and of a rolling sphere.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "tests/common/regular_expressions.hpp"
#include "tests/program/particles/particles_command.hpp"
#include "tests/program/sample_files.hpp"
#include "tests/program/undisturbed.hpp"
#include "viscontact/common/text/number.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kData = VISCONTACT_SOURCE_FOLDER "/data/";

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

/// No two curves of a page have the same colour, and each has the same one in all pictures. Returns
/// the colours by the names of the curves.
std::map<std::string, std::set<std::string>> colours_of(const std::string& page,
                                                        std::size_t curves) {
  std::map<std::string, std::set<std::string>> colours, names;
  for (const auto& match :
       matches_in(read_file(page), "\"legend\":\"([^\"]+)\",\"colour\":\"([^\"]+)\"")) {
    colours[match[1]].insert(match[2]);
    names[match[2]].insert(match[1]);
  }
  EXPECT_EQ(colours.size(), curves) << page;
  for (const auto& [name, its] : colours) EXPECT_EQ(its.size(), 1U) << name;
  for (const auto& [colour, its] : names) EXPECT_EQ(its.size(), 1U) << colour;
  return colours;
}

class PagesAgain : public ParticlesCommand {
 protected:
  /// The pages and pictures of out(), by their names.
  std::map<std::string, std::string> pages() const {
    std::map<std::string, std::string> texts;
    for (const auto& [name, text] : files_below(out()))
      if (const auto kind = fs::path(name).extension(); kind == ".html" || kind == ".svg")
        texts[fs::path(name).lexically_relative(out())] = rest_of(name);
    return texts;
  }
  ProgramResult report() const { return run_viscontact({"report", path("out")}); }

  /// Expects that `report` makes so many pages and pictures again, and changes no other file.
  void expect_same_again(std::size_t count) const {
    const auto made = pages();
    EXPECT_EQ(made.size(), count);
    for (const auto& [name, text] : made) fs::remove(out() / name);
    const auto others = files_below(out());
    expect_done(report());
    EXPECT_EQ(pages(), made);
    for (const auto& [name, text] : others) EXPECT_EQ(files_below(out()).at(name), text) << name;
  }
};

TEST_F(PagesAgain, OfARollingSphere) {
  expect_done(run_viscontact({"rolling", kData + "cases/rolling/incline.toml", "-o", path("out")}));
  expect_same_again(6);
  for (const std::string name : {"gap", "velocity", "friction"})
    expect_room_around("time", path("out/plots/" + name + ".svg"));
  colours_of(path("out/report.html"), 3);
}

// A PDF beside each picture, which a later report without --plots does not leave behind.
TEST_F(PagesAgain, WithPdfFiles) {
  const auto pdfs = [&] {
    std::set<std::string> stems;
    for (const auto& [name, text] : files_below(out()))
      if (text.starts_with("%PDF-")) stems.insert(fs::path(name).stem());
    return stems;
  };
  expect_done(run_viscontact(
      {"rolling", kData + "cases/rolling/incline.toml", "-o", path("out"), "--plots", "pdf"}));
  std::set<std::string> pictures;
  for (const auto& [name, text] : pages())
    if (name.ends_with(".svg")) pictures.insert(fs::path(name).stem());
  EXPECT_GE(pictures.size(), 4U);
  EXPECT_EQ(pdfs(), pictures);
  EXPECT_THAT(read_file(path("out/plots/gap.pdf")), HasSubstr("\"command\""));  // its provenance
  expect_done(report());
  EXPECT_THAT(pdfs(), ::testing::IsEmpty());
}

TEST_F(PagesAgain, OfARollingSphereOfWhichAModelFailed) {
  const auto text =
      replaced(read_file(kData + "cases/rolling/incline.toml"), "../../fits", kData + "fits");
  put_case(replaced(text, "initial_gap = 0.5", "initial_gap = 2.0"));
  EXPECT_NE(run_viscontact({"rolling", path("case.toml"), "-o", path("out")}).exit_status, 0);
  EXPECT_THAT(read_file(out() / "report.html"), HasSubstr("failed: the sphere rises"));
  expect_same_again(6);
}

TEST_F(PagesAgain, OfASwimmer) {
  fs::create_directory(out());
  fs::copy_file(kData + "tables/three_spheres.csv", out() / "table.csv");
  const auto text = read_file(kData + "cases/swimmer/three_spheres.toml");
  put_case(replaced(replaced(text, "period = 1.0", "period = 3.0"), "[optimal]",
                    "[optimal]\npolynomials = 8"));
  expect_done(run_viscontact({"swimmer", path("case.toml"), "-o", path("out")}));
  expect_same_again(7);
  expect_room_around("arm x1", path("out/plots/loops.svg"));
  expect_room_around("time / period", path("out/plots/position.svg"));
  expect_room_around("time", path("out/plots/arms.svg"));
  expect_room_around("polynomials for each arm", path("out/plots/convergence.svg"));
  auto colours = colours_of(path("out/report.html"), 2 + 2 + 3 + 2);
  EXPECT_EQ(*colours["stroke"].begin(), "#56B4E9");
  EXPECT_EQ(*colours["optimal stroke"].begin(), "#D55E00");
  // gnuplot writes the same two colours so.
  EXPECT_THAT(read_file(path("out/plots/loops.svg")),
              AllOf(HasSubstr("rgb( 86, 180, 233)"), HasSubstr("rgb(213,  94,   0)")));
  put_text(out() / "swimmer.json", replaced(read_file(out() / "swimmer.json"), "efficiency", "e"));
  expect_refusal(report(), ErrorKind::kBadInput, Names("swimmer.json", "'efficiency'"));
}

TEST_F(PagesAgain, OfParticles) {
  // The last frame is after the last multiple of `every`.
  put_case(replaced(kCase, "every = 0.5", "every = 0.7"));
  expect_done(run(out("case.toml"), out()));
  expect_same_again(2);
  put_text(out() / "run.json", "{}\n");  // the pages do not need it
  expect_done(report());
  put_text(out() / "particles.svg", "<svg>mine</svg>\n");
  expect_refusal(report(), ErrorKind::kBadInput, Names("particles.svg"));
}

TEST_F(PagesAgain, OfParticlesInAFluid) {
  auto text = read_file(kData + "cases/fluid/one_disc.toml");
  text = replaced_matches(text, "\\[output\\]\nevery = [^\n]*\n", "");
  text = replaced_matches(text, "end_time = [^\n]*\n", "end_time = 0.25\n");
  expect_done(run(put_case(text), out()));
  EXPECT_THAT(read_file(out() / "particles.html"), HasSubstr("id=\"flow-speed\""));
  expect_same_again(2);
}

// The page says what the case says, so that it would not belong to the frames of another case.
TEST_F(PagesAgain, NotOfACaseThatHasChanged) {
  expect_done(run(put_case(kCase), out()));
  put_case(replaced(kCase, "Three discs", "Other discs"));
  expect_refusal(report(), ErrorKind::kBadInput, Names("particles.pvd", path("case.toml")));
  fs::remove(path("case.toml"));
  expect_refusal(report(), ErrorKind::kBadInput, Names("case.toml"));
}

// A project that is moved, with its cases and results at the same places in it.
TEST_F(PagesAgain, InAFolderThatWasMovedWithItsCase) {
  put_case(kCase);
  const std::string enter = "cd '" + folder_.path().string() + "';";
  expect_done(run_viscontact({"particles", "case.toml", "-o", "out"}, {}, enter));
  const auto made = pages();
  fs::create_directory(path("moved"));
  for (const char* name : {"case.toml", "discs.csv", "out"})
    fs::rename(out(name), out("moved") / name);
  for (const auto& [name, text] : made) fs::remove(out("moved") / "out" / name);
  expect_done(run_viscontact({"report", path("moved/out")}));
  for (const auto& [name, text] : made) EXPECT_EQ(rest_of(out("moved") / "out" / name), text);
}

TEST_F(PagesAgain, InAMovedFolderWhoseCaseNamesAFileElsewhere) {
  fs::create_directory(path("old"));
  put_text(path("old/case.toml"),
           replaced(read_file(kData + "cases/rolling/incline.toml"), "../../fits", kData + "fits"));
  // The case is named by its whole path, too.
  const std::string enter = "cd '" + path("old") + "';";
  expect_done(run_viscontact({"rolling", path("old/case.toml"), "-o", "out"}, {}, enter));
  const auto made = rest_of(path("old/out/report.html"));
  fs::rename(path("old"), path("new"));
  for (const auto& enter_new : {std::string(), "cd '" + path("new") + "';"}) {
    fs::remove(path("new/out/report.html"));
    expect_done(
        run_viscontact({"report", enter_new.empty() ? path("new/out") : "out"}, {}, enter_new));
    EXPECT_EQ(rest_of(path("new/out/report.html")), made);
  }
}

TEST_F(PagesAgain, NotOfAFolderInWhichNothingWasRun) {
  fs::create_directory(out());
  // A folder with a case of the user's own, of any kind.
  fs::create_directory(path("project"));
  put_text(path("project/case.toml"), read_file(kData + "cases/rolling/incline.toml"));
  for (const auto& folder : {path("out"), path("none"), path("project")})
    expect_refusal(run_viscontact({"report", folder}), ErrorKind::kBadInput, Names(folder));
}

/// Expects that the command changes no file of `folder` if it is given again at another time.
void expect_left_alone(const std::vector<std::string>& command, const fs::path& folder) {
  expect_done(run_viscontact(command, {"SOURCE_DATE_EPOCH=1000000000"}));
  const auto before = files_below(folder);
  const auto again = run_viscontact(command, {"SOURCE_DATE_EPOCH=1000000001"});
  expect_done(again);
  EXPECT_THAT(again.errors, IsUpToDate(folder.string()));
  EXPECT_TRUE(files_below(folder) == before);
}

TEST_F(PagesAgain, NotOfARollingSphereOrASwimmerThatIsUpToDate) {
  const auto text =
      replaced(read_file(kData + "cases/rolling/incline.toml"), "../../fits", kData + "fits");
  put_case(text);
  const std::vector<std::string> rolling = {"rolling", path("case.toml"), "-o", path("out")};
  expect_left_alone(rolling, out());
  // A picture that is lost is drawn again, and a case that has changed is run again.
  fs::remove(out() / "plots/gap.svg");
  expect_done(run_viscontact(rolling));
  EXPECT_TRUE(fs::exists(out() / "plots/gap.svg"));
  put_case("# the same numbers\n" + text);
  expect_done(run_viscontact(rolling));
  expect_done(report());
  // Without an optimal stroke, whose search takes most of the time.
  const auto swimmer = read_file(kData + "cases/swimmer/lecture.toml");
  put_text(path("swimmer.toml"), replaced(swimmer.substr(0, swimmer.find("[optimal]")),
                                          "../../tables", kData + "tables"));
  expect_left_alone({"swimmer", path("swimmer.toml"), "-o", path("swimmer")}, out("swimmer"));
}

}  // namespace
}  // namespace viscontact
