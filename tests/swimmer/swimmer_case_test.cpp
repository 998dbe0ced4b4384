// The case of a swimmer: what is read and what is refused.
#include "viscontact/swimmer/case/swimmer_case.hpp"

#include <gmock/gmock.h>

#include <numbers>
#include <ostream>
#include <string>

#include "tests/case_file/edited_case.hpp"
#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"

namespace viscontact::swimmer {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;

const std::string kCase =
    std::string(VISCONTACT_SOURCE_FOLDER) + "/data/cases/swimmer/three_spheres.toml";

class SwimmerCaseFile : public ::testing::Test {
 protected:
  /// The shipped case with one text replaced by another one.
  SwimmerCase changed(const std::string& from, const std::string& to) const {
    return read_swimmer_case(folder_.file("case.toml", case_file::text_with(kCase, from, to)));
  }
  TemporaryFolder folder_;
};

TEST_F(SwimmerCaseFile, ShippedOneHasTheArmsAndStrokesThatItSays) {
  const auto c = read_swimmer_case(kCase);
  EXPECT_EQ(case_file::kind_of_case(kCase), case_file::CaseKind::kSwimmer);
  EXPECT_EQ(c.title, "Three spheres");
  EXPECT_EQ(c.spheres.viscosity, 1);
  EXPECT_THAT(c.spheres.radii, ElementsAre(1, 1, 1));
  EXPECT_FALSE(c.spheres.tube);
  ASSERT_EQ(c.gaps.size(), 2U);
  ASSERT_EQ(c.gaps[0].size(), 12U);
  EXPECT_DOUBLE_EQ(c.gaps[0].front(), 2.2 - 2);
  EXPECT_EQ(c.gaps[0].back(), 10);
  EXPECT_EQ(c.gaps[0], c.gaps[1]);
  ASSERT_TRUE(c.stroke && c.optimal);
  EXPECT_EQ(c.stroke->legs.size(), 4U);
  EXPECT_EQ(c.stroke->period, 1);
  EXPECT_EQ(c.optimal->displacement, 0.2);
  EXPECT_EQ(c.optimal_period, 1);
}

TEST_F(SwimmerCaseFile, ShippedOneOfTheLectureHasSpheresOfFiftyMicrometres) {
  const auto c =
      read_swimmer_case(std::string(VISCONTACT_SOURCE_FOLDER) + "/data/cases/swimmer/lecture.toml");
  EXPECT_EQ(c.spheres.viscosity, 1e-3);
  EXPECT_THAT(c.spheres.radii, ElementsAre(5e-5, 5e-5, 5e-5));
  EXPECT_NEAR(c.gaps[0].front(), 1e-5, 1e-19);
  EXPECT_NEAR(c.gaps[0].back(), 5e-4, 1e-18);
  ASSERT_TRUE(c.stroke && c.optimal);
  EXPECT_EQ(c.optimal->displacement, 1e-5);
}

TEST_F(SwimmerCaseFile, OneArmHasAnEllipseWithoutAPhase) {
  const auto c = read_swimmer_case(folder_.file("two.toml", R"([fluid]
viscosity = 1.0
[swimmer]
radii = [1.0, 2.0]
arms = { from = 3.1, to = 6.0, count = 4 }
relative_accuracy = 1e-4
[stroke]
ellipse = { centre = 4.0, semi_axes = 0.5 }
)"));
  EXPECT_NEAR(c.stroke->legs.front().state(0).arms[0], 4.5, 1e-15);
}

TEST_F(SwimmerCaseFile, MayHaveAnEllipseATubeAndAGridForEachArm) {
  const auto c = changed("corners = [[6.0, 6.0], [10.0, 6.0], [10.0, 10.0], [6.0, 10.0]]",
                         "ellipse = { centre = [6.0, 7.0], semi_axes = [1.0, 2.0], phase = 1.5 }");
  const auto start = c.stroke->legs.front().state(0);
  EXPECT_DOUBLE_EQ(start.arms[0], 7);
  EXPECT_DOUBLE_EQ(start.arms[1], 7 + 2 * std::cos(1.5));
  const auto tube = changed("relative_accuracy", "container = { radius = 3.0 }\nrelative_accuracy");
  EXPECT_EQ(tube.spheres.tube->radius, 3);
  EXPECT_FALSE(tube.spheres.tube->height);
  const auto grids = changed("arms = { from = 2.2, to = 12.0, count = 12 }",
                             "arms = [{ from = 2.2, to = 12.0, count = 12 }, "
                             "{ from = 3.0, to = 11.0, count = 5 }]");
  EXPECT_EQ(grids.gaps[1].size(), 5U);
  EXPECT_EQ(grids.gaps[1].front(), 1);
}

TEST_F(SwimmerCaseFile, StrokeMayBeAFileOfArmsOverTime) {
  folder_.file("loop.csv", "time,x1,x2\n0,6,6\n1,8,6\n3,8,8\n4,6,6\n");
  const auto c = changed(
      "corners = [[6.0, 6.0], [10.0, 6.0], [10.0, 10.0], [6.0, 10.0]]   # (x1, x2), "
      "straight legs of equal times\nperiod = 1.0",
      "file = \"loop.csv\"");
  EXPECT_EQ(c.stroke->period, 4);
  EXPECT_EQ(c.optimal_period, 4);
  EXPECT_DOUBLE_EQ(c.stroke->legs[1].state(2).arms[1], 7);
  EXPECT_EQ(c.stroke_files.size(), 1U);
}

TEST_F(SwimmerCaseFile, TemplateChangesNumbersOfTheStroke) {
  const case_file::CaseTemplate<SwimmerCase> of_case(kCase);
  const auto c = of_case.with(std::vector<std::pair<std::string, double>>{
      {"stroke.period", 3}, {"optimal.displacement", 0.1}});
  EXPECT_EQ(c.stroke->period, 3);
  EXPECT_EQ(c.optimal->displacement, 0.1);
}

/// A change of the shipped case that must be refused, with the line and the key of the error.
struct Refusal {
  const char* from;
  const char* to;
  int line;
  const char* key;
};
std::ostream& operator<<(std::ostream& out, const Refusal& refusal) { return out << refusal.to; }

class RefusedSwimmer : public SwimmerCaseFile, public ::testing::WithParamInterface<Refusal> {};

TEST_P(RefusedSwimmer, HasAnErrorWithLineAndKey) {
  const auto& [from, to, line, key] = GetParam();
  EXPECT_THAT(bad_input([&] { (void)changed(from, to); }),
              IsAt("case.toml:" + std::to_string(line), key));
}

INSTANTIATE_TEST_SUITE_P(
    Keys, RefusedSwimmer,
    ::testing::Values(
        Refusal{"viscosity = 1.0", "viscosity = 0", 6, "fluid.viscosity"},
        Refusal{"radii = [1.0, 1.0, 1.0]", "radii = [1.0]", 9, "swimmer.radii"},
        Refusal{"radii = [1.0, 1.0, 1.0]", "radii = [1.0, 1.0, 1000.0]", 9, "swimmer.radii"},
        Refusal{"from = 2.2", "from = 2.0", 10, "swimmer.arms.from"},
        Refusal{"from = 2.2", "from = 2.0000001", 10, "swimmer.arms.from"},
        Refusal{"to = 12.0", "to = 2.1", 10, "swimmer.arms.to"},
        Refusal{"count = 12", "count = 2", 10, "swimmer.arms.count"},
        Refusal{"count = 12 }", "count = 12, spacing = \"log\" }", 10, "swimmer.arms.spacing"},
        Refusal{"1e-5 ", "1.5 ", 11, "swimmer.relative_accuracy"},
        Refusal{"relative_accuracy", "container = { radius = 0.5 }\nrelative_accuracy", 11,
                "swimmer.container.radius"},
        Refusal{"relative_accuracy",
                "container = { radius = 3.0, height = 20.0 }\nrelative_accuracy", 11,
                "swimmer.container.height"},
        Refusal{"[10.0, 6.0]", "[13.0, 6.0]", 14, "stroke.corners"},
        Refusal{"[10.0, 6.0]", "[1.5, 6.0]", 14, "stroke.corners"},
        Refusal{"[10.0, 6.0]", "[10.0]", 14, "stroke.corners"},
        Refusal{"[10.0, 6.0]", "[6.0, 6.0]", 14, "stroke.corners"},
        Refusal{", [10.0, 6.0], [10.0, 10.0], [6.0, 10.0]", "", 14, "stroke.corners"},
        Refusal{"period = 1.0", "period = -1.0", 15, "stroke.period"},
        Refusal{"period = 1.0", "file = \"loop.csv\"", 14, "stroke.corners"},
        Refusal{"displacement = 0.2", "displacement = 0.0", 18, "optimal.displacement"},
        Refusal{"through = [6.0, 6.0]", "through = [6.0, 16.0]", 19, "optimal.through"},
        Refusal{"through = [6.0, 6.0]", "through = [6.0]", 19, "optimal.through"},
        Refusal{"through = [6.0, 6.0]", "through = [6.0, 6.0]\npolynomials = 73", 20,
                "optimal.polynomials"},
        Refusal{"relative_accuracy", "table = \"t.csv\"\nrelative_accuracy", 10, "swimmer.arms"},
        Refusal{"title", "titel = 3\ntitle", 3, "titel"}));

TEST_F(SwimmerCaseFile, NamesATableThatIsScaledToItsSpheres) {
  const auto with = [&](const std::string& keys) {
    return read_swimmer_case(
        folder_.file("scaled.toml", "[fluid]\nviscosity = 0.5\n[swimmer]\ntable = \"" +
                                        std::string(VISCONTACT_SOURCE_FOLDER) +
                                        "/data/tables/three_spheres.csv\"\n" + keys));
  };
  const auto c = with("radii = [0.25, 0.25, 0.25]\n");
  EXPECT_EQ(c.gaps[0].back(), 2.5);
  EXPECT_EQ(c.table.viscosity, 0.5);
  const auto refusal = [&](const std::string& keys) {
    return bad_input([&] { (void)with(keys); });
  };
  EXPECT_THAT(refusal("radii = [1.0, 1.0, 2.0]\n"), IsAt("three_spheres.csv"));
  EXPECT_THAT(refusal("radii = [1.0, 1.0]\n"),
              AllOf(IsAt("scaled.toml:4", "swimmer.table"), Names("3")));
  EXPECT_THAT(refusal("radii = [1.0, 1.0, 1.0]\ncontainer = { radius = 3.0 }\n"),
              IsAt("scaled.toml:4", "swimmer.table"));
}

TEST_F(SwimmerCaseFile, FileOfAStrokeIsRefusedWithItsLine) {
  const auto refused = [&](const std::string& rows) {
    folder_.file("loop.csv", "time,x1,x2\n" + rows);
    return bad_input([&] {
      (void)changed(
          "corners = [[6.0, 6.0], [10.0, 6.0], [10.0, 10.0], [6.0, 10.0]]   # (x1, x2), "
          "straight legs of equal times\nperiod = 1.0",
          "file = \"loop.csv\"");
    });
  };
  EXPECT_THAT(refused("0,6,6\n1,8,6\n3,8,8\n4,6,6.5\n"), IsAt("loop.csv"));
  EXPECT_THAT(refused("0,6,6\n1,8,6\n1,8,8\n4,6,6\n"), IsAt("loop.csv:4", "time"));
  EXPECT_THAT(refused("0,6,6\n1,18,6\n2,8,8\n4,6,6\n"), IsAt("loop.csv:3"));
  EXPECT_THAT(refused("0,6,6\n1,6,6\n"), IsAt("loop.csv"));
  EXPECT_THAT(refused("0,6\n"), IsAt("loop.csv:2"));
}

TEST_F(SwimmerCaseFile, OfTwoSpheresHasNoOptimalStroke) {
  EXPECT_THAT(bad_input([&] { (void)changed("radii = [1.0, 1.0, 1.0]", "radii = [1.0, 1.0]"); }),
              IsAt("case.toml:14", "stroke.corners"));
  const auto text =
      "[fluid]\nviscosity = 1\n[swimmer]\nradii = [1, 1]\narms = { from = 3, to = 9, "
      "count = 5 }\nrelative_accuracy = 1e-3\n[optimal]\ndisplacement = 1\nthrough = [5]\n";
  EXPECT_THAT(bad_input([&] { (void)read_swimmer_case(folder_.file("two.toml", text)); }),
              IsAt("two.toml:8", "optimal.displacement"));
}

}  // namespace
}  // namespace viscontact::swimmer
