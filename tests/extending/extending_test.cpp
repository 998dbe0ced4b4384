// docs/extending.md, applied and built (CMakeLists.txt here), does what its text says.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "tests/common/regular_expressions.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/docs/document.hpp"
#include "tests/oracles/bispherical/bispherical.hpp"
#include "tests/oracles/brenner.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/system/process.hpp"
#include "viscontact/lubrication/motion_table.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

struct Replacement {
  std::string key, value;
};

/// The lecture's case with other values of those keys, and with further sections.
void write_case(const fs::path& path, std::initializer_list<Replacement> replacements,
                const std::string& sections = "") {
  std::string text = read_file(VISCONTACT_SOURCE_FOLDER "/data/cases/lecture.toml");
  for (const auto& [key, value] : replacements) {
    const auto begin = text.find("\n" + key + " = ") + 1;
    ASSERT_NE(begin, 0U) << key;
    text.replace(begin, text.find('\n', begin) - begin, key + " = " + value);
  }
  put_text(path, text + sections);
}

void run_extended(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), VISCONTACT_EXTENDED);
  const auto result = run_process(arguments);
  ASSERT_EQ(result.exit_status, 0) << result.output;
}

constexpr double kAccuracy = 1e-4;

/// The table of a floor with that slip length in unbounded fluid, r = 1, at accuracy kAccuracy.
lubrication::MotionTable slip_table(const fs::path& folder, const std::string& slip_length,
                                    const std::string& gaps) {
  write_case(folder / "slip.toml",
             {{"gaps", gaps},
              {"relative_accuracy", "1e-4"},
              {"container", "\"unbounded\""},
              {"geometry", "{ kind = \"slip_plane\", slip_length = " + slip_length + " }"}});
  run_extended({"tabulate", (folder / "slip.toml").string(), "-o", (folder / "slip.csv").string()});
  return lubrication::read_force_table(folder / "slip.csv");
}

TEST(ExtendedGeometry, LittleSlipIsNone) {
  const TemporaryFolder folder;
  const auto table = slip_table(folder.path(), "1e-8", "[0.01]");
  EXPECT_NEAR(table.rows.at(0).force_factor / brenner_drag_factor(0.01), 1, kAccuracy);
}

TEST(ExtendedGeometry, MuchSlipIsAFreeSurface) {
  const TemporaryFolder folder;
  const auto table = slip_table(folder.path(), "1e8", "[1.0]");
  EXPECT_NEAR(table.rows.at(0).force_factor / free_surface_drag_factor(1), 1, kAccuracy);
}

// Vinogradova 1995, one surface with slip; f(1) = 0.62942. Both drags have further terms of order
// ln(1/q): 3e-4 of the first at q = 1e-4, and the ratio differs from f by less.
TEST(ExtendedGeometry, DragInAFilmAsThickAsTheSlipLengthIsThatOfLubricationTheory) {
  const TemporaryFolder folder;
  const auto table = slip_table(folder.path(), "1e-4", "[1e-4]");
  const double f = 0.25 + 3.0 / 8 * (1.25 * std::log(5.0) - 1);
  EXPECT_NEAR(f, 0.62942, 1e-5);
  EXPECT_NEAR(table.rows.at(0).force_factor / brenner_drag_factor(1e-4), f, 5e-4);
}

// The script of the page changes the boundary condition of the approach alone. All motions that the
// geometry has are computed, and those that it has not are refused before FreeFEM is asked.
TEST(ExtendedGeometry, HasTheMotionsThatItDeclaresAndNoOthers) {
  const TemporaryFolder folder;
  write_case(folder.path() / "slip.toml",
             {{"gaps", "[0.5]"},
              {"container", "\"unbounded\""},
              {"relative_accuracy", "1e-3"},
              {"geometry", "{ kind = \"slip_plane\", slip_length = 0.1 }"}});
  const auto tabulate = [&](const std::string& motion) {
    return run_process({VISCONTACT_EXTENDED, "tabulate", (folder.path() / "slip.toml").string(),
                        "--motion", motion, "-o", (folder.path() / (motion + ".csv")).string()});
  };
  const auto all = tabulate("all");
  EXPECT_EQ(all.exit_status, 0) << all.output;
  EXPECT_EQ(lubrication::read_force_table(folder.path() / "all.csv").rows.size(), 1U);
  for (const std::string motion : {"slide", "roll", "spin"}) {
    const auto refused = tabulate(motion);
    EXPECT_EQ(refused.exit_status, 3);
    EXPECT_THAT(refused.output, HasSubstr("--motion: is " + motion +
                                          "; beside a slip_plane a sphere has the motions "
                                          "approach"));
    EXPECT_FALSE(fs::exists(folder.path() / (motion + ".csv")));
  }
}

// The page's own commands, among them a table of slip length 1e-4, its fit, and what 1/q^2 says of
// it.
TEST(ExtendedBasis, FindsTheSlipLengthFromATableByThePagesCommands) {
  const ReadersFolder folder(VISCONTACT_EXTENDED);
  EXPECT_EQ(folder.run_page(VISCONTACT_SOURCE_FOLDER "/docs/extending.md"), 5);
  const std::string text = read_file(folder.path() / "out/slip.json");
  const auto coefficient = [&](const std::string& term) {
    const auto name = text.find("\"name\": \"" + term + "\"");
    const auto entry = text.rfind('{', name);
    const std::string key = "\"coefficient\": ";
    return std::stod(text.substr(text.find(key, entry) + key.size()));
  };
  EXPECT_NEAR(-coefficient("1/q^2") / coefficient("1/q"), 1e-4, 3e-6);
}

// A geometry, a term with a basis, a model with a parameter, a shape, and a contact law with a
// memory: each
// is its own files and few lines elsewhere.
TEST(Extending, ChangesNoOtherFiles) {
  EXPECT_EQ(read_file(fs::path(VISCONTACT_EXTENDED).parent_path() / "source/changed_files"),
            "freefem_axi/geometry.cpp\n"
            "freefem_axi/scripts/axisymmetric_stokes.idp\n"
            "freefem_axi/scripts/slip_plane.edp\n"
            "lubrication/terms.cpp\n"
            "particle_runs/case/particles_case.cpp\n"
            "particle_runs/io/contact_columns.cpp\n"
            "particles/CMakeLists.txt\n"
            "particles/contact/ageing_law.hpp\n"
            "particles/contact/contact_laws.hpp\n"
            "particles/shapes/rounded_square.cpp\n"
            "particles/shapes/shape_rule.hpp\n"
            "particles/state/pair_memory.hpp\n"
            "reduced_model/CMakeLists.txt\n"
            "reduced_model/models/models.cpp\n"
            "reduced_model/models/reference_log.cpp\n"
            "reduced_model/models/reference_log.hpp\n");
}

/// The command that runs the model in the lecture's case with the exact drag and these sections.
std::vector<std::string> simulate_log(const fs::path& folder, const std::string& time_step,
                                      const std::string& sections) {
  const auto file = folder / "case.toml";
  write_case(file, {{"time_step", time_step}},  // the first one: [reference]
             sections);
  put_text(file, replaced_matches(read_file(file), "basis = [^\n]*\nweights = [^\n]*",
                                  "exact = \"plane\""));
  return {"simulate", file.string(), "-o", (folder / "run").string(), "--models", "reference_log"};
}

/// The smallest gap that it finds.
double smallest_gap(const std::string& time_step, const std::string& sections = "") {
  const TemporaryFolder folder;
  run_extended(simulate_log(folder.path(), time_step, sections));
  const auto trajectory =
      reduced_model::read_trajectory(folder.path() / "run/trajectories/reference_log.csv");
  return std::ranges::min(trajectory.rows, {}, &reduced_model::TrajectoryRow::gap).gap;
}

constexpr double kExactSmallestGap = 2.97084661e-3;  // docs/theory.md

TEST(ExtendedModel, ReachesTheExactSmallestGap) {
  EXPECT_NEAR(smallest_gap("1e-3") / kExactSmallestGap, 1, 1e-6);
}

TEST(ExtendedModel, HasTheOrderThatTheCaseAsksForAndTheSecondOrderOtherwise) {
  const auto error = [](const char* time_step, const std::string& order = "") {
    const auto section = order.empty() ? "" : "\n[reference_log]\norder = " + order + "\n";
    return smallest_gap(time_step, section) - kExactSmallestGap;
  };
  EXPECT_NEAR(error("0.002", "1") / error("0.001", "1"), 2, 0.05);
  const double fine = error("0.01");
  // The next term of the error is of order h relative to it.
  EXPECT_NEAR(error("0.02") / fine, 4, 0.1);
  EXPECT_EQ(error("0.01", "2"), fine);
}

TEST(ExtendedModel, RefusesAnotherOrderAndAnUnknownKey) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& key) {
    auto command = simulate_log(folder.path(), "1e-3", "\n[reference_log]\n" + key + "\n");
    command.insert(command.begin(), VISCONTACT_EXTENDED);
    const auto result = run_process(command);
    EXPECT_EQ(result.exit_status, 3);
    return result.output;
  };
  EXPECT_THAT(refused("order = 3"),
              HasSubstr("reference_log.order is 3; it must be a number equal to 1 or 2"));
  EXPECT_THAT(refused("method = 1"), HasSubstr("the known keys are: order"));
}

// A sweep varies the parameter although the case has no section for it.
TEST(ExtendedModel, HasAParameterThatASweepVaries) {
  const TemporaryFolder folder;
  write_case(folder.path() / "case.toml", {});
  const auto sweep = [&](const std::string& models) {
    return run_process({VISCONTACT_EXTENDED, "sweep", (folder.path() / "case.toml").string(),
                        "--fit", VISCONTACT_SOURCE_FOLDER "/data/fits/lecture.json", "-o",
                        (folder.path() / "sweep.csv").string(), "--vary", "reference_log.order=1,2",
                        "--models", models, "--reference", "inertial"});
  };
  EXPECT_THAT(sweep("inertial").output, HasSubstr("none of the models that are run depends on it"));
  const auto done = sweep("inertial,reference_log_brenner");
  EXPECT_EQ(done.exit_status, 0) << done.output;
}

TEST(ExtendedModel, StaysAboveThePlaneWhereExplicitEulerGoesThrough) {
  EXPECT_GT(smallest_gap("0.5"), 0);
}

}  // namespace
}  // namespace viscontact
