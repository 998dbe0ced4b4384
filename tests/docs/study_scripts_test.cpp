// The scripts of the studies with inertia of the fluid run with `--short`: each kind of run that
// they make, with a coarse mesh and few steps. The studies themselves take minutes each.
#include <gmock/gmock.h>

#include <algorithm>
#include <ostream>
#include <string>

#include "tests/docs/document.hpp"
#include "viscontact/common/system/process.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

struct Study {
  const char* script;
  int runs;  ///< that the script makes with --short

  friend void PrintTo(const Study& study, std::ostream* out) { *out << study.script; }
};

class StudyScript : public ::testing::TestWithParam<Study> {};

TEST_P(StudyScript, HasCasesThatRun) {
  const TemporaryFolder folder;
  const std::string script = GetParam().script;
  const auto result =
      run_process({VISCONTACT_SOURCE_FOLDER "/scripts/" + script, "--short"},
                  {"VISCONTACT=" VISCONTACT_EXECUTABLE, "OUT=" + folder.path().string()});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  EXPECT_THAT(result.output, ::testing::HasSubstr("the cases of the study are valid"));
  const auto finished = std::count_if(
      fs::directory_iterator(folder.path()), fs::directory_iterator(),
      [](const auto& entry) { return fs::exists(entry.path() / "run/final_particles.csv"); });
  EXPECT_EQ(finished, GetParam().runs);
}

INSTANTIATE_TEST_SUITE_P(Each, StudyScript,
                         ::testing::Values(Study{"inertia_study", 2}, Study{"convergence_study", 7},
                                           Study{"membrane_study", 2}, Study{"valve_study", 5}),
                         [](const auto& study) { return std::string(study.param.script); });

}  // namespace
}  // namespace viscontact
