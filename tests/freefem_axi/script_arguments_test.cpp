// plane.edp itself refuses arguments that FreeFEM would ignore, misread or abort on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "freefem_axi/freefem.hpp"

namespace viscontact {
namespace {

using ::testing::HasSubstr;

using Arguments = std::vector<std::string>;

/// All of the script's arguments, with the value of one flag replaced.
Arguments with(const std::string& flag, const std::string& value) {
  Arguments all = {"-radius",
                   "1",
                   "-gap",
                   "0.5",
                   "-viscosity",
                   "1",
                   "-velocity",
                   "-1",
                   "-containerRadius",
                   "5",
                   "-containerHeight",
                   "10",
                   "-accuracy",
                   "1e-2",
                   "-cells",
                   "2",
                   "-levels",
                   "2"};
  for (std::size_t i = 0; i < all.size(); i += 2)
    if (all[i] == flag) all[i + 1] = value;
  return all;
}

Arguments without(const std::string& flag) {
  Arguments kept;
  const auto all = with("", "");
  for (std::size_t i = 0; i < all.size(); i += 2)
    if (all[i] != flag) kept.insert(kept.end(), {all[i], all[i + 1]});
  return kept;
}

Arguments with_more(const Arguments& more) {
  auto all = with("", "");
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

struct Refusal {
  std::string name;
  Arguments arguments;
  std::string said;  ///< part of the line
};

// What GoogleTest shows of the parameter.
std::ostream& operator<<(std::ostream& out, const Refusal& refusal) { return out << refusal.name; }

class ScriptArguments : public ::testing::TestWithParam<Refusal> {};

TEST_P(ScriptArguments, AreRefusedWithExitCode2AndALineThatSaysWhich) {
  const auto result = run_freefem(default_freefem(), "plane.edp", GetParam().arguments);
  EXPECT_EQ(result.exit_status, 2) << result.output;
  EXPECT_THAT(line_after(result.output, "viscontact-error"), HasSubstr(GetParam().said))
      << result.output;
  EXPECT_EQ(line_after(result.output, "viscontact-result"), "");
}

INSTANTIATE_TEST_SUITE_P(
    Each, ScriptArguments,
    ::testing::Values(
        Refusal{"UnknownFlag", with_more({"-gapp", "1"}), "-gapp"},
        Refusal{"MissingFlag", without("-viscosity"), "-viscosity is missing"},
        Refusal{"FlagWithoutValue", with_more({"-cells"}), "-cells"},
        Refusal{"FlagGivenTwice", with_more({"-gap", "0.5"}), "-gap is given twice"},
        Refusal{"TrailingLetter", with("-gap", "1e-3x"), "'1e-3x' is not a number"},
        Refusal{"TwoNumbersInOne", with("-gap", "1-2"), "'1-2' is not a number"},
        Refusal{"ExponentWithoutDigits", with("-gap", "1e"), "'1e' is not a number"},
        Refusal{"TwoPoints", with("-gap", "5.5.5"), "'5.5.5' is not a number"},
        Refusal{"NoDigit", with("-gap", "."), "'.' is not a number"},
        Refusal{"EmptyValue", with("-gap", ""), "-gap"},
        Refusal{"NotANumber", with("-gap", "nan"), "'nan' is not a number"},
        Refusal{"Infinite", with("-viscosity", "1e400"), "-viscosity"},
        Refusal{"NegativeGap", with("-gap", "-0.1"), "-gap must be positive"},
        Refusal{"ZeroVelocity", with("-velocity", "0"), "-velocity must not be zero"},
        Refusal{"SphereWiderThanTheContainer", with("-radius", "6"), "-containerRadius"},
        Refusal{"SphereTallerThanTheContainer", with("-containerHeight", "2.5"),
                "-containerHeight"},
        Refusal{"OneLevelHasNoErrorEstimate", with("-levels", "1"), "-levels must be at least 2"}),
    [](const auto& test) { return test.param.name; });

TEST(CompleteScriptArguments, AreAccepted) {
  const auto result = run_freefem(default_freefem(), "plane.edp", with("", ""));
  EXPECT_EQ(result.exit_status, 0) << result.output;
  EXPECT_NE(line_after(result.output, "viscontact-result"), "");
}

}  // namespace
}  // namespace viscontact
