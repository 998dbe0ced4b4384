// The example of docs/fluid-solver.md: its answers are those of the solver, and its opening is what
// Viscontact sends.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "viscontact/common/files/file.hpp"
#include "viscontact/common/system/process.hpp"
#include "viscontact/freefem_flow/process/opening.hpp"

namespace viscontact::freefem_flow {
namespace {

/// The text in the block of code `number`, from 0, after the heading of the example.
std::string block(int number) {
  const std::string page = read_file(VISCONTACT_SOURCE_FOLDER "/docs/fluid-solver.md");
  const std::string start = "```text\n";
  auto at = page.find("## An example");
  for (int i = 0; i <= number; ++i) at = page.find(start, at) + start.size();
  return page.substr(at, page.find("```", at) - at);
}

TEST(ProtocolPage, ShowsWhatTheExampleAnswers) {
  const auto result =
      run_process({"python3", VISCONTACT_SOURCE_FOLDER "/examples/stokes_drag.py"}, {}, block(0));
  EXPECT_EQ(result.output, block(1));
  EXPECT_EQ(result.exit_status, 0);
}

TEST(ProtocolPage, ShowsTheOpening) {
  particles::Fluid fluid;
  fluid.viscosity = 1;
  const auto text =
      opening(fluid, particles::CylinderDomain{5, 10}, std::array{particles::Shape::sphere(1)}, 1);
  EXPECT_EQ(block(0).substr(0, text.size()), text);
}

}  // namespace
}  // namespace viscontact::freefem_flow
