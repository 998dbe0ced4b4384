// tabulate --plot: the pictures of a row, the VTK file, and what FreeFEM writes for them.
#include <gmock/gmock.h>

#include <set>
#include <string>
#include <vector>

#include "tests/common/temporary_folder.hpp"
#include "tests/common/well_formed_xml.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/vtk/flow_vtk.hpp"

namespace viscontact {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Cheap: a small container, a loose accuracy; the first gap has a film.
std::string case_text() {
  auto text = lecture_case_text();
  text = replaced(text, "gaps = { from = 1e-3, to = 2.0, count = 40, spacing = \"log\" }",
                  "gaps = [0.01, 1.0]");
  text = replaced(text, "container = { radius = 40.0, height = 80.0 }",
                  "container = { radius = 5.0, height = 10.0 }");
  return replaced(text, "relative_accuracy = 1e-5", "relative_accuracy = 1e-2");
}

class Plot : public ::testing::Test {
 protected:
  Plot() { put_text(path("case.toml"), case_text()); }
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }
  ProgramResult tabulate(const std::vector<std::string>& plot) const {
    std::vector<std::string> arguments = {"tabulate", path("case.toml"), "-o", path("table.csv")};
    arguments.insert(arguments.end(), plot.begin(), plot.end());
    return run_viscontact(arguments);
  }
  std::set<std::string> pictures() const {
    std::set<std::string> names;
    for (const auto& [file, text] : files_below(path("table.plots")))
      names.insert(std::filesystem::path(file).filename());
    return names;
  }

  TemporaryFolder scratch_;
};

TEST_F(Plot, WritesPicturesOfTheAskedGapsAndDoesNotTabulateAgain) {
  // The table is not FreeFEM's, to save time: only pictures are computed.
  const freefem_axi::FakeFreeFem fake(scratch_.path());
  expect_done(run_viscontact({"tabulate", path("case.toml"), "-o", path("table.csv")},
                             {"VISCONTACT_FREEFEM=" + fake.executable()}));
  expect_done(tabulate({"--plot", "1"}));
  const std::set<std::string> of_wide_gap = {"gap_1.vtu", "gap_1_film.svg", "gap_1_flow.svg",
                                             "gap_1_mesh.svg"};
  EXPECT_EQ(pictures(), of_wide_gap);
  const auto table = read_file(path("table.csv"));
  // Without gaps: those of both ends and of the middle.
  const auto result = tabulate({"--plot"});
  expect_done(result);
  EXPECT_THAT(result.errors, IsUpToDate(""));
  EXPECT_EQ(result.output, "");
  EXPECT_EQ(read_file(path("table.csv")), table);
  auto of_both = of_wide_gap;
  of_both.insert({"gap_0.01.vtu", "gap_0.01_film.svg", "gap_0.01_flow.svg", "gap_0.01_mesh.svg"});
  EXPECT_EQ(pictures(), of_both);
  for (const auto* name : {"gap_0.01.vtu", "gap_1.vtu"})
    EXPECT_FALSE(read_flow(path("table.plots/" + std::string(name))).triangles.empty());

  constexpr std::size_t kMegabyte = 1'000'000;
  for (const auto* name : {"film", "flow", "mesh"}) {
    const auto svg = read_file(path("table.plots/gap_0.01_" + std::string(name) + ".svg"));
    expect_well_formed(svg);
    EXPECT_LT(svg.size(), kMegabyte);
    EXPECT_THAT(svg, AllOf(HasSubstr("gap 0.01"), HasSubstr("plane"), HasSubstr("velocity -1"),
                           HasSubstr("distance from the axis"), Not(HasSubstr("warning"))));
  }
  for (const auto* name : {"film", "flow"})
    EXPECT_THAT(read_file(path("table.plots/gap_0.01_" + std::string(name) + ".svg")),
                AllOf(HasSubstr("streamlines"), HasSubstr("pressure (unit: viscosity"),
                      HasSubstr("data:image/png;base64,")));
  EXPECT_THAT(read_file(path("table.plots/gap_0.01_flow.svg")), HasSubstr("logarithmic beyond"));
  EXPECT_THAT(read_file(path("table.plots/gap_0.01_film.svg")), HasSubstr("heights stretched"));
  EXPECT_THAT(read_file(path("table.plots/gap_0.01_mesh.svg")),
              AllOf(HasSubstr("finest mesh"), HasSubstr("coarsest mesh")));
}

TEST_F(Plot, IsOfTheFlowOfTheMotion) {
  auto text = replaced(case_text(), "container = { radius = 5.0, height = 10.0 }",
                       "container = { radius = 5.0, height = 10.0 }\nmotion = \"slide\"");
  put_text(path("case.toml"), replaced(text, "gaps = [0.01, 1.0]", "gaps = [1.0]"));
  expect_done(tabulate({"--plot", "1"}));
  EXPECT_FALSE(read_flow(path("table.plots/gap_1.vtu")).triangles.empty());
  EXPECT_THAT(read_file(path("table.plots/gap_1_flow.svg")),
              HasSubstr("speed in the plane of motion"));
}

TEST_F(Plot, GapThatIsNotThereIsRefusedBeforeAnyWork) {
  const auto before = files_below(scratch_.path());
  expect_refusal(tabulate({"--plot", "1,0.02"}), ErrorKind::kBadInput, Names("0.02", "0.01"));
  expect_refusal(tabulate({"--plot", "1,x"}), ErrorKind::kWrongUsage, Names("'x'"));
  EXPECT_EQ(files_below(scratch_.path()), before);
}

}  // namespace
}  // namespace viscontact
