// The shipped cases of a fluid with inertia (data/cases/flow) run with FreeFEM, coarser and shorter,
// and give the published numbers that docs/fluid.md compares with. The full cases are commands of
// that page.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "tests/program/particles/particles_command.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const fs::path kCases = VISCONTACT_SOURCE_FOLDER "/data/cases/flow";

class FlowCase : public ParticlesCommand {
 protected:
  /// The text of a shipped case with other values of keys.
  static std::string with(const std::string& name,
                          const std::vector<std::pair<std::string, std::string>>& values) {
    auto text = read_file(kCases / (name + ".toml"));
    for (const auto& [key, value] : values) {
      const auto changed =
          replaced_matches(text, "\n" + key + " = [^\n]*\n", "\n" + key + " = " + value + "\n");
      EXPECT_NE(changed, text) << key;
      text = changed;
    }
    return text;
  }
  void compute(const std::string& text) { expect_done(run(put_case(text), out())); }
  /// All values of a column of a table of results.
  std::vector<double> column(const std::string& file, const std::string& name) const {
    const auto lines = matches_in(content(out() / file), "([^\n]+)\n", 1);
    const auto header =
        std::ranges::find_if(lines, [](const std::string& line) { return !line.starts_with("#"); });
    const auto names = matches_in(*header + ",", "([^,]*),", 1);
    const auto place = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    std::vector<double> values;
    for (auto line = header + 1; line != lines.end(); ++line)
      values.push_back(std::stod(matches_in(*line + ",", "([^,]*),", 1).at(place)));
    return values;
  }
};

TEST_F(FlowCase, EachHasATest) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(kCases)) names.insert(entry.path().stem());
  EXPECT_EQ(names, (std::set<std::string>{"couette_migration", "cylinder_steady", "cylinder_vortices",
                                          "falling_disc", "landing_sphere",
                                          "poiseuille_migration", "two_discs"}));
}

// DFG 2D-1 with 24 edges in place of 64: the drag is 1.1e-3 off, which is the error of the mesh.
TEST_F(FlowCase, ASteadyFlowDragsACylinder) {
  compute(with("cylinder_steady", {{"edges_per_particle", "24"}, {"end_time", "2.0"}}));
  EXPECT_NEAR(500 * column("steps.csv", "given_force_x").back(), 5.5795, 0.02);
}

// The speed of the disc at t = 0.3 is 5.4521 with half the step and twice the edges.
TEST_F(FlowCase, ADiscFalls) {
  compute(with("falling_disc", {{"time_step", "0.02"},
                                {"end_time", "0.3"},
                                {"constraint", "\"rigid\"\nedges_per_particle = 12"}}));
  EXPECT_NEAR(column("motion.csv", "vy").back(), -5.4521, 0.01 * 5.4521);
}

}  // namespace
}  // namespace viscontact
