// `viscontact swimmer`: all stages with the shipped table, once with FreeFEM, and what it refuses.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/oracles/cylinder/sphere_in_cylinder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "tests/program/undisturbed.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/results/exit_code.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A file that is shipped with the program.
std::string shipped(const std::string& name) {
  return std::string(VISCONTACT_SOURCE_FOLDER) + "/data/" + name;
}

const std::string kThreeSpheres = shipped("cases/swimmer/three_spheres.toml");

class SwimmerCommand : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

  /// Runs a case in a folder that has the shipped table, so that FreeFEM is not needed.
  ProgramResult swim(const std::string& case_file, const std::string& folder,
                     const std::vector<std::string>& more = {}) const {
    fs::create_directories(folder);
    if (!fs::exists(folder + "/table.csv"))
      fs::copy_file(shipped("tables/three_spheres.csv"), folder + "/table.csv");
    std::vector<std::string> arguments = {"swimmer", case_file, "-o", folder};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_viscontact(arguments, {"VISCONTACT_FREEFEM=no-freefem-is-needed"});
  }
  /// The shipped case without its optimal stroke, whose search takes most of the time.
  static std::string without_optimal() {
    const auto text = read_file(kThreeSpheres);
    return text.substr(0, text.find("[optimal]"));
  }
  /// The shipped case with a change.
  std::string changed(const std::string& from, const std::string& to) const {
    return scratch_.file("case.toml", replaced(read_file(kThreeSpheres), from, to)).string();
  }

  TemporaryFolder scratch_;
};

TEST_F(SwimmerCommand, SwimsWithTheShippedTableAsThePublishedSwimmerDoesAndSweeps) {
  const auto result = swim(kThreeSpheres, path("out"), {"--json"});
  expect_done(result);
  EXPECT_THAT(result.errors, AllOf(HasSubstr("0.15980"), Names("report"), IsUpToDate("table.csv")));
  const auto json = nlohmann::json::parse(read_file(path("out/swimmer.json")));
  EXPECT_EQ(nlohmann::json::parse(result.output)["displacement"], json["displacement"]);
  // data/reference/swimmer.csv
  EXPECT_NEAR(json["displacement"].get<double>() / 0.1598053403882, 1, 1e-6);
  EXPECT_NEAR(json["energy"].get<double>() / 3701.388296679, 1, 1e-6);
  EXPECT_NEAR(json["energy_at_constant_power"].get<double>() / 3700.50439521, 1, 1e-6);
  EXPECT_GT(json["displacement_error_estimate"].get<double>(),
            std::abs(json["displacement"].get<double>() - 0.1598053403882));
  EXPECT_LT(json["displacement_error_estimate"].get<double>(), 1e-4 * 0.16);
  EXPECT_NEAR(json["optimal"]["displacement"].get<double>(), 0.2, 1e-9);
  // With exact matrices, 1579.561004 (tests/reduced_model/swimmer).
  EXPECT_NEAR(json["optimal"]["energy"].get<double>() / 1579.561004, 1, 1e-6);

  const auto rows =
      read_csv<8>(path("out/stroke.csv"),
                  {"time", "x1", "x2", "position", "force1", "force2", "force3", "power"}, 8);
  EXPECT_GE(rows.rows.size(), 400U);
  EXPECT_NEAR(*rows.rows.back().fields[3], json["displacement"].get<double>(), 1e-12);
  for (const auto& row : rows.rows)
    EXPECT_NEAR(*row.fields[4] + *row.fields[5] + *row.fields[6], 0, 1e-9) << row.line;

  const auto page = read_file(path("out/report.html"));
  EXPECT_THAT(page, AllOf(HasSubstr("<title>Three spheres</title>"), HasSubstr("plots/loops.svg"),
                          HasSubstr("0.159805"), HasSubstr("Lighthill")));
  for (const char* name : {"loops", "position", "power", "arms", "forces", "convergence"})
    EXPECT_THAT(read_file(path("out/plots/") + name + ".svg"), HasSubstr("</svg>")) << name;

  // A sweep over strokes takes the fit.
  const auto case_file = changed("[optimal]", "[optimal]\npolynomials = 8");
  const auto sweep = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"sweep", case_file, "-o", path("rows.csv")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_viscontact(arguments);
  };
  expect_done(sweep({"--fit", path("out/fit.json"), "--vary", "fluid.viscosity=1,2", "--plot",
                     path("rows.svg")}));
  const auto swept = read_csv<4>(
      path("rows.csv"), {"fluid.viscosity", "displacement", "energy", "optimal.energy"}, 4);
  ASSERT_EQ(swept.rows.size(), 2U);
  EXPECT_NEAR(*swept.rows[1].fields[1] / *swept.rows[0].fields[1], 1, 1e-12);
  EXPECT_NEAR(*swept.rows[1].fields[2] / *swept.rows[0].fields[2], 2, 1e-12);
  EXPECT_NEAR(*swept.rows[1].fields[3] / *swept.rows[0].fields[3], 2, 1e-9);
  EXPECT_THAT(read_file(path("rows.svg")), HasSubstr("</svg>"));
  expect_refusal(sweep({"--vary", "stroke.period=1,2"}), ErrorKind::kWrongUsage, Names("--fit"));
  expect_refusal(sweep({"--fit", path("out/fit.json"), "--vary", "swimmer.arms.to=11,12"}),
                 ErrorKind::kWrongUsage, Names("swimmer.arms.to"));

  // A case without an optimal stroke removes that of an earlier run.
  EXPECT_TRUE(fs::exists(path("out/optimal_stroke.csv")));
  expect_done(swim(scratch_.file("case.toml", without_optimal()).string(), path("out")));
  EXPECT_FALSE(fs::exists(path("out/optimal_stroke.csv")));
  EXPECT_FALSE(fs::exists(path("out/plots/convergence.svg")));
  EXPECT_FALSE(nlohmann::json::parse(read_file(path("out/swimmer.json"))).contains("optimal"));
}

/// Stokes flow has no length of its own: displacements scale with the radius r, and energies with
/// mu r^3/T.
TEST_F(SwimmerCommand, NamedTableServesOtherRadiiAndViscosities) {
  const auto swum = [&](double radius, double viscosity) {
    const auto text = fmt::format(
        "[fluid]\nviscosity = {1}\n[swimmer]\nradii = [{0}, {0}, {0}]\ntable = \"{2}\"\n"
        "[stroke]\nellipse = {{ centre = {3}, semi_axes = {4}, phase = 1.5 }}\n"
        "[optimal]\ndisplacement = {5}\nthrough = {3}\npolynomials = 8\n",
        radius, viscosity, shipped("tables/three_spheres.csv"), 6 * radius, 2 * radius,
        0.2 * radius);
    expect_done(
        run_viscontact({"swimmer", scratch_.file("case.toml", text).string(), "-o", path("out")},
                       {"VISCONTACT_FREEFEM=no-freefem-is-needed"}));
    return nlohmann::json::parse(read_file(path("out/swimmer.json")));
  };
  const auto one = swum(1, 1);
  const double radius = 3e-5, viscosity = 7e-3;
  const auto other = swum(radius, viscosity);
  expect_done(run_viscontact({"report", path("out")}));
  // The fit loses some digits, and the search for the optimal stroke ends within its tolerance.
  for (const char* stroke : {"/displacement", "/optimal/displacement"}) {
    const auto parent = nlohmann::json::json_pointer(stroke).parent_pointer();
    const auto ratio = [&](const char* key) {
      return other[parent / key].get<double>() / one[parent / key].get<double>();
    };
    EXPECT_NEAR(ratio("displacement") / radius, 1, 1e-9);
    EXPECT_NEAR(ratio("energy") / (viscosity * std::pow(radius, 3)), 1, 1e-9);
    EXPECT_NEAR(ratio("efficiency"), 1, 1e-9);
  }
  EXPECT_THAT(run_viscontact({"tabulate", path("case.toml"), "-o", path("t.csv")}).errors,
              Names("swimmer.table"));
}

TEST_F(SwimmerCommand, SecondCallKeepsTableAndFitAndGivesTheSameResults) {
  const auto plain = scratch_.file("plain.toml", without_optimal()).string();
  expect_done(swim(plain, path("out")));
  const auto fit_time = fs::last_write_time(path("out/fit.json"));
  const auto stroke = rest_of(path("out/stroke.csv"));
  const auto again = swim(plain, path("out"));
  expect_done(again);
  EXPECT_THAT(again.errors, IsUpToDate("fit.json"));
  EXPECT_EQ(fs::last_write_time(path("out/fit.json")), fit_time);
  EXPECT_EQ(rest_of(path("out/stroke.csv")), stroke);
  const auto rerun =
      run_viscontact({"rerun", path("out/swimmer.json"), "-o", path("again"), "--dry-run"});
  expect_done(rerun);
  EXPECT_THAT(rerun.output, HasSubstr("swimmer " + plain));
}

// Two equal spheres in a tube, so far apart that each has its drag alone, on one arm x =
// 8 + 2 cos(2 pi t): they move at half of its velocity and swim nowhere. Three spheres in unbounded
// fluid take FreeFEM a minute: tests/swimmer/tabulation/exact_matrices_test.cpp has their matrices.
TEST_F(SwimmerCommand, TabulatesFitsAndSwimsWithFreeFem) {
  const auto file = scratch_.file("two.toml", R"(title = "Two spheres"
[fluid]
viscosity = 1.0
[swimmer]
radii = [1.0, 1.0]
arms = { from = 6.0, to = 10.0, count = 3 }
container = { radius = 3.0 }
relative_accuracy = 1e-2
[stroke]
ellipse = { centre = 8.0, semi_axes = 2.0 }
)");
  const auto result = run_viscontact({"swimmer", file.string(), "-o", path("out"), "--jobs", "2"});
  expect_done(result);
  EXPECT_THAT(result.errors, Names("3 rows", "2 processes"));
  // The mean square of the velocity of the arm is 8 pi^2. A flow in a tube decays within a radius,
  // so that the drag is that in the middle of a closed cylinder.
  const double drag = 6 * std::numbers::pi * sphere_in_cylinder_drag_factor(3, 3, 8);
  const auto json = nlohmann::json::parse(read_file(path("out/swimmer.json")));
  EXPECT_NEAR(json["energy"].get<double>() / (drag * 4 * std::pow(std::numbers::pi, 2)), 1,
              1e-2);  // the accuracy that was asked
  EXPECT_NEAR(json["displacement"].get<double>(), 0, 1e-9);
}

TEST_F(SwimmerCommand, TabulateTakesTheCaseAndAnInterruptedTableIsContinued) {
  const freefem_axi::FakeFreeFem fake(
      scratch_.path(),
      "[ $gap1 = 10 ] && [ ! -e \"$folder/mended\" ] && { echo no luck; exit 4; }\n");
  const auto tabulate = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"tabulate", kThreeSpheres, "-o", path("table.csv")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_viscontact(arguments, {"VISCONTACT_FREEFEM=" + fake.executable()});
  };
  const auto dry = tabulate({"--dry-run"});
  expect_done(dry);
  EXPECT_THAT(dry.output, HasSubstr("78 rows, 0 of them finished"));
  const auto failed = tabulate({});
  EXPECT_EQ(failed.exit_status, results::exit_code_of(ErrorKind::kExternalProgram));
  EXPECT_THAT(failed.errors, Names("1 of 78"));
  EXPECT_FALSE(fs::exists(path("table.csv")));
  put_text(scratch_.path() / "mended", "");
  const auto continued = tabulate({});
  expect_done(continued);
  EXPECT_THAT(continued.errors, Names("77"));
  EXPECT_EQ(fake.answered().size(), 78U);
  EXPECT_THAT(read_file(path("table.csv")), HasSubstr("# rows: 144"));
  expect_refusal(tabulate({"--plot"}), ErrorKind::kWrongUsage, Names("[tabulation]"));
}

TEST_F(SwimmerCommand, OptimalStrokeThatLeavesTheTableIsRefusedAfterTableAndFitAreKept) {
  const auto far = changed("displacement = 0.2", "displacement = 20");
  expect_refusal(swim(far, path("out")), ErrorKind::kBadInput, Names("case.toml", "[optimal]"));
  EXPECT_TRUE(fs::exists(path("out/fit.json")));
}

TEST_F(SwimmerCommand, FilesOfTheUserAreNotReplaced) {
  fs::create_directories(path("out"));
  put_text(path("out/stroke.csv"), "mine\n");
  expect_refusal(swim(kThreeSpheres, path("out")), ErrorKind::kBadInput, Names("stroke.csv"));
  EXPECT_EQ(read_file(path("out/stroke.csv")), "mine\n");
  EXPECT_FALSE(fs::exists(path("out/fit.json")));
}

}  // namespace
}  // namespace viscontact
