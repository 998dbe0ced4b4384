// The table of geometries: what each is told, and the room it needs.
#include "viscontact/freefem_axi/geometry.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/common/failure.hpp"
#include "tests/freefem_axi/tabulations.hpp"
#include "tests/oracles/bispherical/bispherical.hpp"
#include "viscontact/freefem_axi/journal/freefem.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"

namespace viscontact::freefem_axi {
namespace {

using ::testing::ElementsAre;

const std::vector<const char*> kNames = {"plane", "free_surface", "sphere", "cavity",
                                         "rough_plane"};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<std::string> keys_of(const char* name) {
  std::vector<std::string> keys;
  for (const auto& parameter : find_geometry(name).parameters) keys.emplace_back(parameter.key);
  return keys;
}

TEST(Geometry, UnknownOneIsBadInputThatListsThoseThereAre) {
  EXPECT_THAT(failure(ErrorKind::kBadInput, [] { (void)find_geometry("torus"); }),
              Names("torus", "free_surface", "rough_plane"));
}

TEST(Geometry, HasAScriptOfItsOwnName) {
  const auto folder = default_freefem().script_folder;
  for (const auto* name : kNames) {
    EXPECT_EQ(find_geometry(name).name, name);
    EXPECT_EQ(find_geometry(name).script, std::string(name) + ".edp");
    EXPECT_TRUE(std::filesystem::exists(folder / find_geometry(name).script)) << name;
  }
}

TEST(Geometry, HasTheParametersOfTheCaseFile) {
  EXPECT_THAT(keys_of("plane"), ElementsAre());
  EXPECT_THAT(keys_of("free_surface"), ElementsAre());
  EXPECT_THAT(keys_of("sphere"), ElementsAre("radius", "velocity_ratio", "rotation_ratio"));
  EXPECT_THAT(keys_of("cavity"), ElementsAre("radius"));
  EXPECT_THAT(keys_of("rough_plane"), ElementsAre("amplitude", "wavelength"));
}

TEST(Geometry, SecondSphereIsAtRestUnlessTheCaseSaysOtherwiseAndNothingElseHasADefault) {
  for (const auto* name : kNames)
    for (const auto& parameter : find_geometry(name).parameters) {
      if (parameter.key.ends_with("_ratio")) {
        EXPECT_EQ(parameter.fallback, 0.0);
      } else {
        EXPECT_EQ(parameter.fallback, std::nullopt) << name << " " << parameter.key;
      }
    }
}

TEST(Geometry, LengthsArePositiveAndARatioOfVelocitiesIsAnything) {
  for (const auto* name : kNames)
    for (const auto& parameter : find_geometry(name).parameters) {
      const bool any = parameter.key.ends_with("_ratio");
      EXPECT_EQ(parameter.allowed.test(0), any) << name << " " << parameter.key;
      EXPECT_EQ(parameter.allowed.test(-1), any) << name << " " << parameter.key;
      EXPECT_TRUE(parameter.allowed.test(1e-300)) << name << " " << parameter.key;
    }
}

TEST(Geometry, AboveAFloorNeedsTheSphereAndTheGap) {
  const std::vector<double> ripples = {0.25, 0.5};
  for (const std::string name : {"plane", "free_surface", "rough_plane"}) {
    const auto room = find_geometry(name).required_space(2, 0.5, ripples);
    EXPECT_EQ(room.container_radius, name == "rough_plane" ? 4 : 2) << name;
    EXPECT_EQ(room.container_height, 4.5) << name;
    EXPECT_EQ(room.largest_gap, kInfinity) << name;
    EXPECT_TRUE(find_geometry(name).takes_container) << name;
  }
}

TEST(Geometry, PairOfSpheresNeedsTheLargerOneOnBothSidesOfTheMiddle) {
  const auto& sphere = find_geometry("sphere");
  for (const auto& [r, neighbour] : {std::pair(2., 3.), std::pair(3., 2.)}) {
    const std::vector<double> parameters = {neighbour, 0};
    const auto room = sphere.required_space(r, 0.5, parameters);
    EXPECT_EQ(room.container_radius, 3);
    EXPECT_EQ(room.container_height, 12.5);
    EXPECT_EQ(room.largest_gap, kInfinity);
  }
  EXPECT_TRUE(sphere.takes_container);
}

TEST(Geometry, CavityIsItsOwnContainerUpToConcentric) {
  const std::vector<double> radius = {5};
  EXPECT_FALSE(find_geometry("cavity").takes_container);
  EXPECT_EQ(find_geometry("cavity").required_space(2, 1, radius).largest_gap, 3);
  EXPECT_LE(find_geometry("cavity").required_space(5, 1, radius).largest_gap, 0);
}

Tabulation tabulation_of(const char* geometry, std::vector<double> parameters) {
  auto tabulation = unit_tabulation({0.5}, 20, 1e-3);
  tabulation.geometry = geometry;
  tabulation.geometry_parameters = std::move(parameters);
  return tabulation;
}

TEST(GeometryInWords, NamesEveryParameterWithItsValue) {
  EXPECT_EQ(geometry_in_words(tabulation_of("plane", {})), "plane");
  EXPECT_EQ(geometry_in_words(tabulation_of("sphere", {2, -0.5, 0})),
            "sphere, radius 2, velocity_ratio -0.5");
  EXPECT_EQ(geometry_in_words(tabulation_of("rough_plane", {0.01, 0.05})),
            "rough_plane, amplitude 0.01, wavelength 0.05");
}

TEST(ContainerInWords, IsACylinderUnboundedOrNone) {
  auto tabulation = tabulation_of("plane", {});
  EXPECT_EQ(container_in_words(tabulation), "closed cylinder, radius 20, height 40");
  tabulation.container.reset();
  EXPECT_EQ(container_in_words(tabulation), "unbounded");
  EXPECT_EQ(container_in_words(tabulation_of("cavity", {5})), "none");
}

TEST(TabulationHash, ChangesWithEveryParameterOfEveryGeometry) {
  std::vector<Tabulation> all = {
      tabulation_of("plane", {}),
      tabulation_of("free_surface", {}),
      tabulation_of("sphere", {2, 0, 0}),
      tabulation_of("sphere", {2.0000000000000004, 0, 0}),
      tabulation_of("sphere", {2, 1e-300, 0}),
      tabulation_of("sphere", {2, -1, 0}),
      tabulation_of("cavity", {2}),
      tabulation_of("cavity", {3}),
      tabulation_of("rough_plane", {0.01, 0.05}),
      tabulation_of("rough_plane", {0.05, 0.01}),
      tabulation_of("rough_plane", {0.02, 0.05}),
      tabulation_of("rough_plane", {0.01, 0.06}),
  };
  for (std::size_t i = 0; i < 6; ++i) {
    auto unbounded = all[i];
    unbounded.container.reset();
    all.push_back(unbounded);
  }
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_NE(tabulation_hash(all[i]), tabulation_hash(all[j])) << i << " and " << j;
}

TEST(TabulationHash, OfACavityDoesNotDependOnAContainerThatItHasNot) {
  auto without = tabulation_of("cavity", {5});
  without.container.reset();
  EXPECT_EQ(tabulation_hash(without), tabulation_hash(tabulation_of("cavity", {5})));
}

struct Leading {
  const char* geometry;
  std::vector<double> parameters;
  double factor;  ///< k over 6 pi mu r^2
};

class LeadingCoefficient : public ::testing::TestWithParam<Leading> {};

TEST_P(LeadingCoefficient, IsThatOfLubricationTheory) {
  const auto& [geometry, parameters, factor] = GetParam();
  auto tabulation = tabulation_of(geometry, parameters);
  const double plane =
      6 * std::numbers::pi * tabulation.viscosity * tabulation.radius * tabulation.radius;
  EXPECT_DOUBLE_EQ(leading_coefficient(tabulation).value(), factor * plane);
}

INSTANTIATE_TEST_SUITE_P(
    Of, LeadingCoefficient,
    ::testing::Values(Leading{"plane", {}, 1}, Leading{"free_surface", {}, 0.25},
                      Leading{"sphere", {1, 0, 0}, 0.25},   // r_eff = 1/2
                      Leading{"sphere", {1, -1, 0}, 0.5},   // approach at twice the velocity
                      Leading{"sphere", {3, 0}, 9.0 / 16},  // r_eff = 3/4
                      Leading{"cavity", {5}, 25.0 / 16}),   // r_eff = 5/4
    [](const auto& test) {
      return test.param.geometry + std::string("Number") + std::to_string(test.index);
    });

TEST(LeadingCoefficientInTheory, IsThatOfTheExactDragAtASmallGap) {
  // R q/k - 1 is of the order of q ln q: some 1e-5 at q = 1e-6.
  constexpr double kGap = 1e-6;
  const auto share = [](const char* geometry, const std::vector<double>& parameters, double exact) {
    const auto tabulation = tabulation_of(geometry, parameters);
    const double stokes = 6 * std::numbers::pi * tabulation.viscosity * tabulation.radius;
    return stokes * exact * kGap * tabulation.radius / leading_coefficient(tabulation).value();
  };
  EXPECT_NEAR(share("plane", {}, bispherical_plane_factor(kGap)), 1, 1e-4);
  EXPECT_NEAR(share("free_surface", {}, free_surface_drag_factor(kGap)), 1, 1e-4);
  EXPECT_NEAR(share("sphere", {3, -0.5}, two_sphere_drag_factor(kGap, 3, -0.5)), 1, 1e-4);
  EXPECT_NEAR(share("cavity", {5}, cavity_drag_factor(kGap, 5)), 1, 1e-4);
}

TEST(RoughPlane, HasNoLeadingCoefficientThatIsKnown) {
  EXPECT_FALSE(leading_coefficient(tabulation_of("rough_plane", {0.01, 0.05})).has_value());
}

TEST(FleeingNeighbour, HasNoLeadingCoefficient) {
  for (const double velocity_ratio : {1.0, 1.5})
    EXPECT_FALSE(leading_coefficient(tabulation_of("sphere", {1, velocity_ratio, 0})).has_value());
}

TEST(Neighbour, HasAVelocityOnlyIfItIsASphere) {
  auto tabulation = unit_tabulation({0.1}, 5, 1e-3);
  EXPECT_EQ(neighbour_ratio(tabulation, lubrication::MotionKind::kApproach), 0);
  tabulation.geometry = "sphere";
  tabulation.geometry_parameters = {1, -0.5, 2};
  EXPECT_EQ(neighbour_ratio(tabulation, lubrication::MotionKind::kApproach), -0.5);
  EXPECT_EQ(neighbour_ratio(tabulation, lubrication::MotionKind::kSlide), -0.5);
  EXPECT_EQ(neighbour_ratio(tabulation, lubrication::MotionKind::kRoll), 2);
  EXPECT_EQ(neighbour_ratio(tabulation, lubrication::MotionKind::kSpin), 2);
}

}  // namespace
}  // namespace viscontact::freefem_axi
