// The files of tables of motions: what is written is read back, and what is wrong is refused.
#include "viscontact/lubrication/motion_table.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <ostream>
#include <random>
#include <string>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/fitting/samples.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"

namespace viscontact::lubrication {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A finite double > 0 of any magnitude.
double random_positive(std::mt19937_64& random) {
  for (;;) {
    const double value = std::abs(std::bit_cast<double>(random()));
    if (std::isfinite(value) && value > 0) return value;
  }
}

TEST(TableOfTheApproach, RoundTripsToTheBit) {
  std::mt19937_64 random(1961);
  MotionTable table;
  table.viscosity = random_positive(random);
  table.radius = random_positive(random);
  table.geometry = "sphere, radius 2, velocity_ratio: 0";
  table.container = "cylinder, radius 40, height: 80";
  table.case_hash = sha256("case");
  table.versions = {{"FreeFEM", "4.11"}, {"viscontact", "0.1.0"}};
  table.tabulated_motions = {MotionKind::kApproach, MotionKind::kSpin};
  table.failed_rows = {{"gap 0.1, velocity -1", "no solution: 100 unknowns"},
                       {"gap 0.1, velocity 2", "it had not ended after 1800 s"}};
  for (int i = 0; i < 300; ++i) {
    MotionRow row;
    row.gap = random_positive(random);
    // Their product must not underflow to 0: a force opposed to its velocity is asked for.
    row.reference_velocity =
        (i % 2 == 0 ? -1 : 1) * std::ldexp(random_positive(random) > 1 ? 1.1 : 0.7, i - 150);
    row.force = -row.reference_velocity * std::ldexp(1.0 / (i + 3), 300 - i);
    row.force_factor = random_positive(random);
    row.relative_error_estimate = random_positive(random);
    row.degrees_of_freedom = i * 12345;
    row.seconds = random_positive(random);
    row.observed_order = 4 - random_positive(random);
    table.rows.push_back(row);
  }
  const TemporaryFolder folder;
  const auto path = folder.file("table.csv", write_motion_table(table));
  const auto back = read_force_table(path);
  EXPECT_EQ(back.viscosity, table.viscosity);
  EXPECT_EQ(back.radius, table.radius);
  EXPECT_EQ(back.geometry, table.geometry);
  EXPECT_EQ(back.container, table.container);
  EXPECT_EQ(back.case_hash, table.case_hash);
  EXPECT_EQ(back.versions, table.versions);
  EXPECT_EQ(back.tabulated_motions, table.tabulated_motions);
  EXPECT_EQ(back.failed_rows, table.failed_rows);
  ASSERT_EQ(back.rows.size(), table.rows.size());
  for (std::size_t i = 0; i < back.rows.size(); ++i) {
    EXPECT_EQ(back.rows[i].gap, table.rows[i].gap);
    EXPECT_EQ(back.rows[i].reference_velocity, table.rows[i].reference_velocity);
    EXPECT_EQ(back.rows[i].force, table.rows[i].force);
    EXPECT_EQ(back.rows[i].force_factor, table.rows[i].force_factor);
    EXPECT_EQ(back.rows[i].relative_error_estimate, table.rows[i].relative_error_estimate);
    EXPECT_EQ(back.rows[i].degrees_of_freedom, table.rows[i].degrees_of_freedom);
    EXPECT_EQ(back.rows[i].seconds, table.rows[i].seconds);
    EXPECT_EQ(back.rows[i].observed_order, table.rows[i].observed_order);
  }
  EXPECT_EQ(write_motion_table(back), read_file(path));
}

TEST(TableOfTheApproach, HasTheColumnsOfTheInterface) {
  EXPECT_THAT(write_motion_table(fitting::exact_drag_table({0.5}, {-1}, 3, 1)),
              HasSubstr("\ngap,reference_velocity,force,drag_factor,relative_error_estimate,"
                        "degrees_of_freedom,seconds,observed_order\n0.5,-1,"));
}

TEST(TableOfTheApproach, SaysInItsHeadWhatTheSphereApproachesAndInWhat) {
  auto table = fitting::exact_drag_table({0.5}, {-1}, 3, 1);
  table.geometry = "cavity, radius 5";
  table.container = "none";
  const auto text = write_motion_table(table);
  EXPECT_THAT(text, HasSubstr("# geometry: cavity, radius 5\n"));
  EXPECT_THAT(text, HasSubstr("# container: none\n"));
}

constexpr const char* kHead = "# viscosity: 3\n# radius: 2\n";

TEST(TableOfTheApproach, OfAUserNeedsGapVelocityAndForceOnly) {
  const TemporaryFolder folder;
  const auto table = read_force_table(
      folder.file("own.csv", std::string(kHead) + "force,gap,reference_velocity\n1000,0.5,-1\n"));
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(table.rows[0].gap, 0.5);
  EXPECT_EQ(table.rows[0].reference_velocity, -1);
  EXPECT_EQ(table.rows[0].force, 1000);
  EXPECT_DOUBLE_EQ(table.rows[0].force_factor, 1000 / (6 * std::numbers::pi * 3 * 2));
  EXPECT_EQ(table.rows[0].relative_error_estimate, 0);
}

TEST(TableOfTheApproach, MayHaveAForceAlongTheVelocityWhereTheNeighbourMovesOnly) {
  const TemporaryFolder folder;
  const std::string rows = "gap,reference_velocity,force\n0.5,-1,-1000\n";
  const auto moving =
      read_force_table(folder.file("moving.csv", kHead + ("# neighbour_moves: yes\n" + rows)));
  EXPECT_EQ(moving.rows[0].force, -1000);
  EXPECT_TRUE(moving.neighbour_moves);
  EXPECT_THAT(write_motion_table(moving), HasSubstr("# neighbour_moves: yes\n"));
  for (const auto* line :
       {"# geometry: sphere, radius 1, velocity_ratio 0\n", "# geometry: plane\n"}) {
    const auto path = folder.file("resting.csv", kHead + (line + rows));
    EXPECT_THAT(bad_input([&] { read_force_table(path); }), IsAt("resting.csv:5", "force")) << line;
  }
}

struct WrongTable {
  const char* what;
  std::string text;
  int line;  ///< 0: of the file as a whole
  const char* key = "";
};

void PrintTo(const WrongTable& table, std::ostream* stream) {
  *stream << table.what;
}  // for GoogleTest's messages

class Wrong : public ::testing::TestWithParam<WrongTable> {};

TEST_P(Wrong, TableIsRefusedWithFileAndLine) {
  const TemporaryFolder folder;
  const auto path = folder.file("table.csv", GetParam().text);
  EXPECT_THAT(bad_input([&] { read_force_table(path); }),
              IsAt(fmt::format("{}:{}", path.string(), GetParam().line), GetParam().key));
}

const std::string kColumnsLine = "gap,reference_velocity,force\n";
const std::string kGoodHead = kHead + kColumnsLine;  // three lines

INSTANTIATE_TEST_SUITE_P(
    TableOfTheApproach, Wrong,
    ::testing::Values(
        WrongTable{"Empty", "", 0, "viscosity"}, WrongTable{"HeadAlone", kHead, 0},
        WrongTable{"NoRows", kGoodHead, 0},
        WrongTable{"NoViscosity", "# radius: 1\n" + kColumnsLine + "1,-1,1\n", 0, "viscosity"},
        WrongTable{"NoRadius", "# viscosity: 1\n" + kColumnsLine + "1,-1,1\n", 0, "radius"},
        WrongTable{"ViscosityZero", "# viscosity: 0\n# radius: 1\n" + kColumnsLine + "1,-1,1\n", 0,
                   "viscosity"},
        WrongTable{"RadiusNegative", "# viscosity: 1\n# radius: -1\n" + kColumnsLine + "1,-1,1\n",
                   0, "radius"},
        WrongTable{"ViscosityTwice",
                   "# viscosity: 3\n# radius: 1\n# viscosity: 6\n" + kColumnsLine + "1,-1,1\n", 0,
                   "viscosity"},
        WrongTable{"LeadingCoefficientNegative",
                   "# leading_coefficient: -5\n" + kGoodHead + "1,-1,1\n", 0,
                   "leading_coefficient"},
        WrongTable{"ViscosityNoNumber",
                   "# viscosity: nan\n# radius: 1\n" + kColumnsLine + "1,-1,1\n", 0, "viscosity"},
        WrongTable{"NoForceColumn", kHead + std::string("gap,reference_velocity\n1,-1\n"), 0,
                   "force"},
        WrongTable{"GapZero", kGoodHead + "1,-1,1\n0,-1,1\n", 5, "gap"},
        WrongTable{"GapNegative", kGoodHead + "-0.5,-1,1\n", 4, "gap"},
        WrongTable{"GapEmpty", kGoodHead + ",-1,1\n", 4, "gap"},
        WrongTable{"VelocityZero", kGoodHead + "1,0,1\n", 4, "reference_velocity"},
        WrongTable{"ForceAlongVelocity", kGoodHead + "1,-1,-1\n", 4, "force"},
        WrongTable{"ForceZero", kGoodHead + "1,-1,0\n", 4, "force"},
        WrongTable{"ForceNan", kGoodHead + "1,-1,1\n1,-1,1\n1,-1,nan\n", 6, "force"},
        WrongTable{"ForceOverflows", kGoodHead + "1,-1,1e400\n", 4, "force"},
        WrongTable{"ShortRow", kGoodHead + "1,-1\n", 4},
        WrongTable{"LongRow", kGoodHead + "1,-1,1,1\n", 4},
        WrongTable{
            "NegativeErrorEstimate",
            kHead +
                std::string("gap,reference_velocity,force,relative_error_estimate\n1,-1,1,-1e-5\n"),
            4, "relative_error_estimate"},
        WrongTable{"Truncated", "# rows: 2\n" + kGoodHead + "1,-1,1\n", 0}),
    [](const auto& tested) { return tested.param.what; });

TEST(TableOfTheApproach, CutAnywhereIsRefused) {
  const TemporaryFolder folder;
  const auto text = write_motion_table(fitting::exact_drag_table({0.25, 0.75}, {-1}, 3, 1));
  for (std::size_t length = 0; length < text.size(); ++length)
    EXPECT_THAT(
        bad_input([&] { read_force_table(folder.file("cut.csv", text.substr(0, length))); }),
        IsAt("cut.csv"))
        << "cut to " << length << " of " << text.size() << " bytes";
}

TEST(TableOfTheApproach, InPlaceOfWhichIsAFolderOrNothingIsNamed) {
  const TemporaryFolder folder;
  EXPECT_THAT(bad_input([&] { read_force_table(folder.path()); }), IsAt(folder.path().string()));
  const auto missing = folder.path() / "none.csv";
  EXPECT_THAT(bad_input([&] { read_force_table(missing); }), IsAt(missing.string()));
}

MotionTable table_of_a_pair() {
  MotionTable table;
  table.motion = MotionKind::kRoll;
  table.viscosity = 0.3;
  table.radius = 2;
  table.geometry = "sphere, radius 1, velocity_ratio 0";
  table.container = "unbounded";
  table.leading_force_factor = 1. / 3;
  table.leading_torque_factor = -0.2;
  table.case_hash = "abc";
  table.versions["FreeFEM"] = "4.9";
  table.tabulated_motions = {MotionKind::kApproach, MotionKind::kRoll};
  table.failed_rows = {{"gap 0.15", "no solution: 100 unknowns"}};
  MotionRow row;
  row.gap = 0.1;
  row.reference_velocity = -3;
  constexpr double kFromFactor = std::numeric_limits<double>::quiet_NaN();
  static_cast<Action&>(row) = {kFromFactor, kFromFactor, -0.1, 2. / 3, 1e-7, 2e-7};
  row.neighbour = Action{kFromFactor, kFromFactor, 0.01, -0.02, 3e-7, 4e-7};
  row.degrees_of_freedom = 1234;
  row.seconds = 1.5;
  row.observed_order = 3.9;
  table.rows = {row, row};
  table.rows[1].gap = 0.2;
  return table;
}

class MotionTableFile : public ::testing::Test {
 protected:
  MotionTable read(const std::string& text) const {
    return read_motion_table(folder_.file("table.csv", text));
  }
  /// The text of a small table with one text replaced by another one.
  static std::string changed(const std::string& from, const std::string& to) {
    std::string text =
        "# motion: slide\n# viscosity: 1\n# radius: 1\ngap,reference_velocity,force,torque\n"
        "0.1,1,-40,2\n";
    return text.replace(text.find(from), from.size(), to);
  }
  TemporaryFolder folder_;
};

TEST_F(MotionTableFile, IsReadAsItWasWritten) {
  const auto table = table_of_a_pair();
  const auto text = write_motion_table(table);
  const auto again = read(text);
  EXPECT_EQ(write_motion_table(again), text);
  EXPECT_EQ(again.motion, MotionKind::kRoll);
  ASSERT_EQ(again.rows.size(), 2U);
  EXPECT_EQ(again.rows[1].gap, 0.2);
  EXPECT_EQ(again.rows[0].torque_factor, 2. / 3);
  EXPECT_EQ(again.rows[0].neighbour->torque_error_estimate, 4e-7);
  EXPECT_EQ(again.leading_force_factor, 1. / 3);
  EXPECT_EQ(again.tabulated_motions, table.tabulated_motions);
  EXPECT_EQ(again.failed_rows, table.failed_rows);
  // torque = -8 pi mu r^3 w0 * factor
  EXPECT_THAT(text, HasSubstr(fmt::format(",{},", 8 * std::numbers::pi * 0.3 * 8 * 3 * (2. / 3))));
}

TEST_F(MotionTableFile, OfOthersNeedsFourColumns) {
  const auto table = read(changed("", ""));
  EXPECT_NEAR(table.rows[0].force_factor, 40 / (6 * std::numbers::pi), 1e-15);
  EXPECT_NEAR(table.rows[0].torque_factor, -2 / (8 * std::numbers::pi), 1e-16);
  EXPECT_FALSE(table.rows[0].neighbour);
}

/// A row whose loads are all different, with every column that the motion has.
MotionTable table_with_strains(MotionKind motion, bool in_container) {
  auto table = table_of_a_pair();
  table.motion = motion;
  table.neighbour_leading_stresslet_factor = 0.3;
  constexpr double kFromFactor = std::numeric_limits<double>::quiet_NaN();
  for (auto& row : table.rows) {
    static_cast<Action&>(row) = {kFromFactor,
                                 kFromFactor,
                                 0.1,
                                 2. / 3,
                                 1e-7,
                                 2e-7,
                                 kFromFactor,
                                 0.7,
                                 3e-7,
                                 kFromFactor,
                                 in_container ? 0 : 0.9,
                                 4e-7};
    row.has_stresslets = true;
    row.has_traces = is_axial(motion) && !in_container;
    row.largest_error_estimate = 5e-7;
    if (motion == MotionKind::kSpin) row.stresslet = row.stresslet_factor = 0;
  }
  return table;
}

TEST_F(MotionTableFile, WithStressletsIsReadAsItWasWritten) {
  for (const auto& [name, motion] : all_motions())
    for (const bool in_container : {false, true}) {
      SCOPED_TRACE(name);
      const auto table = table_with_strains(motion, in_container);
      const auto text = write_motion_table(table);
      const auto again = read(text);
      EXPECT_EQ(write_motion_table(again), text);
      EXPECT_EQ(again.neighbour_leading_stresslet_factor, 0.3);
      const auto& row = again.rows.at(1);
      EXPECT_TRUE(row.has_stresslets);
      EXPECT_EQ(row.has_traces, is_axial(motion) && !in_container);
      EXPECT_EQ(largest_estimate(row), 5e-7);
      ASSERT_TRUE(row.neighbour);
      if (motion == MotionKind::kSpin) continue;
      EXPECT_EQ(row.stresslet_factor, 0.7);
      // +(20/3) pi mu r^2 u0 factor, r^3 for angular velocities and rates.
      const bool moves = motion == MotionKind::kApproach || motion == MotionKind::kSlide;
      EXPECT_NEAR(row.stresslet, 20. / 3 * std::numbers::pi * 0.3 * (moves ? 4 : 8) * -3 * 0.7,
                  1e-12);
    }
}

TEST_F(MotionTableFile, OfAStrainNeedsItsLoadsAlone) {
  const auto twofold = read(
      "# motion: twofold_strain\n# viscosity: 1\n# radius: 1\n"
      "gap,reference_velocity,stresslet\n0.1,-2,-44\n");
  EXPECT_NEAR(twofold.rows[0].stresslet_factor, 22 / (20. / 3 * std::numbers::pi), 1e-15);
  EXPECT_FALSE(twofold.rows[0].neighbour);
  const std::string axial =
      "# motion: axial_strain\n# viscosity: 1\n# radius: 1\n"
      "gap,reference_velocity,force,stresslet\n0.1,1,-3,";
  EXPECT_EQ(read(axial + "22\n").rows[0].force, -3);
  EXPECT_THAT(bad_input([&] { (void)read(axial + "-22\n"); }), IsAt("table.csv:5", "stresslet"));
}

/// Tables of earlier versions have neither stresslets nor, in the approach, a neighbour.
TEST_F(MotionTableFile, OfAnEarlierVersionHasNoStresslets) {
  const auto spin =
      "# motion: spin\n# viscosity: 1\n# radius: 1\ngap,reference_velocity,force,torque\n"
      "0.1,1,0,-2\n";
  for (const auto& text : {changed("slide", "approach"), changed("", ""), std::string(spin)}) {
    const auto row = read(text).rows.at(0);
    EXPECT_FALSE(row.has_stresslets || row.has_traces || row.neighbour);
  }
}

TEST_F(MotionTableFile, IsRefusedWithLineAndValue) {
  const auto failure = [&](const std::string& from, const std::string& to) {
    return bad_input([&] { (void)read(changed(from, to)); });
  };
  EXPECT_THAT(failure("slide", "glide"), AllOf(IsAt("table.csv"), Names("# motion", "glide")));
  EXPECT_THAT(failure("# motion: slide\n", "# viscontact: motion table\n"),
              IsAt("table.csv", "motion"));
  EXPECT_THAT(failure("-40", "40"), IsAt("table.csv:5", "force"));
  EXPECT_THAT(failure(",torque", ",moment"), IsAt("table.csv", "torque"));
}

TEST_F(MotionTableFile, IsToldFromATableOfTheApproach) {
  EXPECT_TRUE(is_motion_table(folder_.file("slide.csv", changed("", ""))));
  const auto approach = folder_.file("approach.csv", changed("slide", "approach"));
  EXPECT_FALSE(is_motion_table(approach));
  EXPECT_EQ(read_force_table(approach).motion, MotionKind::kApproach);
  const auto slide = folder_.file("table.csv", changed("", ""));
  EXPECT_THAT(bad_input([&] { (void)read_force_table(slide); }), IsAt(slide.string(), "motion"));
}

TEST(ShippedTables, AreWrittenAsTheyWereRead) {
  int tables = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(
           std::string(VISCONTACT_SOURCE_FOLDER) + "/data/tables")) {
    if (entry.path().extension() != ".csv" || entry.path().stem() == "three_spheres") continue;
    SCOPED_TRACE(entry.path().string());
    const auto text = read_file(entry.path());
    // The first line is the provenance, which the command adds.
    EXPECT_EQ(write_motion_table(read_motion_table(entry.path())),
              text.substr(text.find('\n') + 1));
    ++tables;
  }
  EXPECT_EQ(tables, 38);
}

}  // namespace
}  // namespace viscontact::lubrication
