// The scripts themselves refuse arguments that FreeFEM would ignore, misread or abort on, and
// lengths that leave no fluid.
#include <gmock/gmock.h>

#include <algorithm>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/journal/freefem.hpp"

namespace viscontact::freefem_axi {
namespace {

using ::testing::HasSubstr;

using Arguments = std::vector<std::string>;

/// A script of a geometry, with arguments that it accepts.
struct Script {
  std::string file;
  Arguments arguments;

  Script with(const std::string& flag, const std::string& value) const {
    auto changed = *this;
    const auto at = std::ranges::find(changed.arguments, flag);
    if (at == changed.arguments.end()) throw std::logic_error("no such flag: " + flag);
    *(at + 1) = value;
    return changed;
  }
  Script without(const std::string& flag) const {
    auto changed = *this;
    const auto at = std::ranges::find(changed.arguments, flag);
    if (at == changed.arguments.end()) throw std::logic_error("no such flag: " + flag);
    changed.arguments.erase(at, at + 2);
    return changed;
  }
  Script with_more(const Arguments& more) const {
    auto changed = *this;
    changed.arguments.insert(changed.arguments.end(), more.begin(), more.end());
    return changed;
  }
};

Script script(const std::string& file, const Arguments& own) {
  return Script{file,
                {"-radius", "1", "-gap", "0.5", "-viscosity", "1", "-velocity", "-1", "-accuracy",
                 "1e-2", "-cells", "2", "-levels", "3", "-attempts", "1"}}
      .with_more(own);
}
const Arguments kCylinder = {"-containerRadius", "5", "-containerHeight", "10"};
const Script kPlane = script("plane.edp", kCylinder);
const Script kFreeSurface = script("free_surface.edp", kCylinder);
const Script kSphere =
    script("sphere.edp", kCylinder)
        .with_more({"-neighbourRadius", "2", "-velocityRatio", "0", "-rotationRatio", "0"});
const Script kCavity = script("cavity.edp", {"-cavityRadius", "2"});
const Script kRoughPlane =
    script("rough_plane.edp", kCylinder).with_more({"-amplitude", "0.02", "-wavelength", "0.5"});

struct Refusal {
  std::string name;
  Script script;
  std::string said;  ///< part of the line
};

// What GoogleTest shows of the parameters.
std::ostream& operator<<(std::ostream& out, const Script& script) { return out << script.file; }
std::ostream& operator<<(std::ostream& out, const Refusal& refusal) { return out << refusal.name; }

class ScriptArguments : public ::testing::TestWithParam<Refusal> {};

TEST_P(ScriptArguments, AreRefusedWithExitCode2AndALineThatSaysWhich) {
  const auto result =
      run_freefem(default_freefem(), GetParam().script.file, GetParam().script.arguments);
  EXPECT_EQ(result.exit_status, 2) << result.output;
  EXPECT_THAT(line_after(result.output, "viscontact-error"), HasSubstr(GetParam().said))
      << result.output;
  EXPECT_EQ(line_after(result.output, "viscontact-result"), "");
}

INSTANTIATE_TEST_SUITE_P(
    Each, ScriptArguments,
    ::testing::Values(
        Refusal{"UnknownFlag", kPlane.with_more({"-gapp", "1"}), "-gapp"},
        Refusal{"MissingFlag", kPlane.without("-viscosity"), "-viscosity is missing"},
        Refusal{"FlagWithoutValue", kPlane.with_more({"-cells"}), "-cells"},
        Refusal{"FlagGivenTwice", kPlane.with_more({"-gap", "0.5"}), "-gap is given twice"},
        Refusal{"TrailingLetter", kPlane.with("-gap", "1e-3x"), "'1e-3x' is not a number"},
        Refusal{"TwoNumbersInOne", kPlane.with("-gap", "1-2"), "'1-2' is not a number"},
        Refusal{"ExponentWithoutDigits", kPlane.with("-gap", "1e"), "'1e' is not a number"},
        Refusal{"TwoPoints", kPlane.with("-gap", "5.5.5"), "'5.5.5' is not a number"},
        Refusal{"NoDigit", kPlane.with("-gap", "."), "'.' is not a number"},
        Refusal{"EmptyValue", kPlane.with("-gap", ""), "-gap"},
        Refusal{"NotANumber", kPlane.with("-gap", "nan"), "'nan' is not a number"},
        Refusal{"Infinite", kPlane.with("-viscosity", "1e400"), "-viscosity"},
        Refusal{"NegativeGap", kPlane.with("-gap", "-0.1"), "-gap must be positive"},
        Refusal{"ZeroVelocity", kPlane.with("-velocity", "0"), "-velocity must not be zero"},
        Refusal{"ZeroAccuracy", kPlane.with("-accuracy", "0"), "-accuracy must be positive"},
        Refusal{"OneLayerInTheFilm", kPlane.with("-cells", "1"), "-cells must be at least 2"},
        Refusal{"TwoLevelsHaveNoErrorEstimate", kPlane.with("-levels", "2"),
                "-levels must be at least 3"},
        Refusal{"LessThanOneAttempt", kPlane.with("-attempts", "0.5"),
                "-attempts must be at least 1"},
        Refusal{"PictureNeitherYesNorNo", kPlane.with_more({"-picture", "2"}),
                "-picture must be 0 or 1"},
        Refusal{"OptionalFlagGivenTwice", kPlane.with_more({"-picture", "1", "-picture", "1"}),
                "-picture is given twice"},
        Refusal{"SphereWiderThanTheContainer", kPlane.with("-radius", "6"), "-containerRadius"},
        Refusal{"SphereTallerThanTheContainer", kPlane.with("-containerHeight", "2.5"),
                "-containerHeight"},
        Refusal{"HeightWithoutARadius", kPlane.with("-containerRadius", "0"),
                "-containerHeight must be 0"},
        Refusal{"NegativeContainerRadius", kPlane.with("-containerRadius", "-5"),
                "-containerRadius"},
        Refusal{"FlagOfAnotherGeometry", kPlane.with_more({"-cavityRadius", "5"}),
                "unknown argument '-cavityRadius'"},
        Refusal{"FreeSurfaceWithoutContainer", kFreeSurface.without("-containerRadius"),
                "-containerRadius is missing"},
        Refusal{"NegativeNeighbour", kSphere.with("-neighbourRadius", "-2"),
                "-neighbourRadius must be positive"},
        Refusal{"NeighbourAsWideAsTheContainer", kSphere.with("-neighbourRadius", "5"),
                "do not fit"},
        Refusal{"PairHigherThanHalfTheContainer", kSphere.with("-containerHeight", "8.5"),
                "do not fit"},
        Refusal{"NoVelocityRatio", kSphere.without("-velocityRatio"), "-velocityRatio is missing"},
        Refusal{"NoRotationRatio", kSphere.without("-rotationRatio"), "-rotationRatio is missing"},
        Refusal{"ContainerAroundACavity", kCavity.with_more(kCylinder), "-containerRadius"},
        Refusal{"PastTheCavitysCentre", kCavity.with("-gap", "1.0001"), "-gap must be at most"},
        Refusal{"CavityAsSmallAsTheSphere", kCavity.with("-cavityRadius", "1"),
                "-gap must be at most"},
        Refusal{"NoRipples", kRoughPlane.with("-amplitude", "0"), "-amplitude must be positive"},
        Refusal{"NegativeWavelength", kRoughPlane.with("-wavelength", "-1"),
                "-wavelength must be positive"}),
    [](const auto& test) { return test.param.name; });

class CompleteScriptArguments : public ::testing::TestWithParam<Script> {};

TEST_P(CompleteScriptArguments, AreAccepted) {
  const auto result = run_freefem(default_freefem(), GetParam().file, GetParam().arguments);
  EXPECT_EQ(result.exit_status, 0) << result.output;
  EXPECT_NE(line_after(result.output, "viscontact-result"), "");
}

INSTANTIATE_TEST_SUITE_P(Of, CompleteScriptArguments,
                         ::testing::Values(kPlane, kFreeSurface, kSphere, kCavity, kRoughPlane),
                         [](const auto& test) {
                           return test.param.file.substr(0, test.param.file.find('.'));
                         });

}  // namespace
}  // namespace viscontact::freefem_axi
