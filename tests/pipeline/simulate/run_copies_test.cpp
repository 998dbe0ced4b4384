#include <gmock/gmock.h>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/pipeline/simulate/run_inputs.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::pipeline {
namespace {

class RunCopies : public ::testing::Test {
 protected:
  RunCopies() {
    case_.text = "a case\n";
    case_.force_files = {scratch_.file("force.csv", "t,f\n")};
    std::filesystem::create_directory(run_.path);
  }
  TemporaryFolder scratch_;
  results::RunFolder run_{scratch_.path() / "run"};
  case_file::Case case_;
};

TEST_F(RunCopies, AreThoseOfCaseForcesAndFit) {
  EXPECT_FALSE(holds_a_run(run_));
  write_copies(run_, case_, "a fit\n");
  EXPECT_EQ(read_file(run_.path / "case.toml"), "a case\n");
  EXPECT_EQ(read_file(run_.path / "force.csv"), "t,f\n");
  EXPECT_EQ(read_file(run_.path / "fit.json"), "a fit\n");
  EXPECT_TRUE(holds_a_run(run_));  // it was interrupted before its first trajectory
}

TEST_F(RunCopies, NeverTakeThePlaceOfAUsersFile) {
  put_text(run_.case_file(), case_.text);
  EXPECT_NO_THROW(check_case_copies(run_, case_));  // it is the same
  put_text(run_.beside_case("force.csv"), "the user's\n");
  EXPECT_THAT(bad_input([&] { check_case_copies(run_, case_); }), IsAt("force.csv"));
  put_text(run_.case_file(), "the user's\n");
  EXPECT_THAT(bad_input([&] { check_case_copies(run_, case_); }), IsAt("case.toml"));
  put_text(run_.fit(), "the user's\n");
  EXPECT_THAT(bad_input([&] { check_fit_copy(run_, "a fit\n"); }), IsAt("fit.json"));
}

TEST_F(RunCopies, TakeThePlaceOfThoseOfAnEarlierRun) {
  write_copies(run_, case_, "a fit\n");
  case_.text = "another case\n";
  EXPECT_NO_THROW(check_case_copies(run_, case_));
  EXPECT_NO_THROW(check_fit_copy(run_, "another fit\n"));

  // Trajectories of the user do not make a folder that of a run.
  put_text(run_.trajectory("mine"), "time,gap\n");
  EXPECT_FALSE(holds_a_run(run_));
  results::write_output(run_.trajectory("inertial"), TextKind::kHashComment, "time,gap\n", {});
  EXPECT_TRUE(holds_a_run(run_));
}

}  // namespace
}  // namespace viscontact::pipeline
