// What the sphere of a case approaches, and what contains both.
#include <gmock/gmock.h>

#include <ostream>
#include <string>

#include "tests/case_file/edited_case.hpp"

namespace viscontact::case_file {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr LectureKey kContainer = {"tabulation.container", "{ radius = 40.0, height = 80.0 }"};
constexpr LectureKey kGeometry = {"tabulation.geometry", "{ kind = \"plane\" }"};
constexpr const char* kContainerLine = "container = { radius = 40.0, height = 80.0 }";

/// The lecture's case with that geometry.
EditedCase with_geometry(const std::string& geometry) { return with_value(kGeometry, geometry); }

/// The same with another container; the line is the container's, two above that of the geometry.
EditedCase with_geometry_and_container(const std::string& geometry, const std::string& container) {
  auto edited = with_geometry(geometry);
  edited.text.replace(edited.text.find(kContainerLine), std::string(kContainerLine).size(),
                      container);
  edited.line -= 2;
  return edited;
}

freefem_axi::Tabulation tabulation_of(const EditedCase& edited) {
  return required_tabulation(read_text(edited.text));
}

TEST(Container, MayBeUnbounded) {
  const auto tabulation = tabulation_of(with_value(kContainer, "\"unbounded\""));
  EXPECT_FALSE(tabulation.container.has_value());
  EXPECT_EQ(freefem_axi::container_in_words(tabulation), "unbounded");
}

TEST(Container, IsUnboundedByThatWordAlone) {
  for (const auto* value : {"\"Unbounded\"", "\"unbound\"", "\"none\"", "\"\""})
    expect_refused(with_value(kContainer, value), kContainer.path);
}

TEST(Container, MustBeWiderThanTheSphere) {
  expect_refused(with_value(kContainer, "{ radius = 1.0, height = 80.0 }"),
                 "tabulation.container.radius");
}

TEST(Container, MustBeHigherThanTheSphereOverItsLargestGap) {
  expect_refused(with_value(kContainer, "{ radius = 40.0, height = 4.0 }"),
                 "tabulation.container.height");
}

TEST(Container, IsAtMostSoLargeThatFreeFemCanMeshIt) {
  expect_refused(with_value(kContainer, "{ radius = 1e6, height = 80.0 }"),
                 "tabulation.container.radius");
  expect_refused(with_value(kContainer, "{ radius = 40.0, height = 200001.0 }"),
                 "tabulation.container.height");
  EXPECT_NO_THROW(read_text(with_value(kContainer, "{ radius = 2e5, height = 2e5 }").text));
}

TEST(Container, MustHoldASecondSphereAndItsMirrorImage) {
  const std::string pair = "{ kind = \"sphere\", radius = 3.0 }";
  expect_refused(with_geometry_and_container(pair, "container = { radius = 3.0, height = 80.0 }"),
                 "tabulation.container.radius");
  // The largest gap is 2.
  expect_refused(with_geometry_and_container(pair, "container = { radius = 40.0, height = 14.0 }"),
                 "tabulation.container.height");
  EXPECT_NO_THROW(read_text(
      with_geometry_and_container(pair, "container = { radius = 3.1, height = 14.1 }").text));
}

TEST(Container, IsMissedByEveryGeometryButTheCavity) {
  for (const std::string geometry :
       {"{ kind = \"plane\" }", "{ kind = \"free_surface\" }",
        "{ kind = \"sphere\", radius = 2.0 }",
        "{ kind = \"rough_plane\", amplitude = 0.01, wavelength = 0.05 }"}) {
    SCOPED_TRACE(geometry);
    auto edited = with_geometry_and_container(geometry, "");
    edited.line -= 3;  // that of the header
    expect_refused(edited, kContainer.path);
  }
}

TEST(Geometry, IsThePlaneByDefault) {
  const auto tabulation = tabulation_of(with_text("geometry = { kind = \"plane\" }", ""));
  EXPECT_EQ(tabulation.geometry, "plane");
  EXPECT_THAT(tabulation.geometry_parameters, IsEmpty());
}

TEST(Geometry, MayBeAFreeSurface) {
  const auto tabulation = tabulation_of(with_geometry("{ kind = \"free_surface\" }"));
  EXPECT_EQ(tabulation.geometry, "free_surface");
  EXPECT_THAT(tabulation.geometry_parameters, IsEmpty());
}

TEST(Geometry, MayBeASecondSphereAtRestUnlessItIsSaid) {
  auto tabulation = tabulation_of(with_geometry("{ kind = \"sphere\", radius = 2.5 }"));
  EXPECT_EQ(tabulation.geometry, "sphere");
  EXPECT_THAT(tabulation.geometry_parameters, ElementsAre(2.5, 0, 0));
  tabulation =
      tabulation_of(with_geometry("{ velocity_ratio = -1, kind = \"sphere\", radius = 2 }"));
  EXPECT_THAT(tabulation.geometry_parameters, ElementsAre(2, -1, 0));
}

TEST(Geometry, MayBeARoughPlane) {
  const auto tabulation = tabulation_of(
      with_geometry("{ kind = \"rough_plane\", wavelength = 0.05, amplitude = 0.01 }"));
  EXPECT_THAT(tabulation.geometry_parameters, ElementsAre(0.01, 0.05));
}

TEST(Geometry, MayBeACavityWithoutAContainer) {
  const auto tabulation =
      tabulation_of(with_geometry_and_container("{ kind = \"cavity\", radius = 5.0 }", ""));
  EXPECT_THAT(tabulation.geometry_parameters, ElementsAre(5));
  EXPECT_FALSE(tabulation.container.has_value());
}

TEST(Cavity, IsItsOwnContainer) {
  for (const std::string container : {kContainerLine, "container = \"unbounded\""})
    expect_refused(with_geometry_and_container("{ kind = \"cavity\", radius = 5.0 }", container),
                   kContainer.path);
}

/// In the lecture's case the gaps stand four lines above the geometry.
EditedCase with_cavity(const std::string& radius) {
  auto edited = with_geometry_and_container("{ kind = \"cavity\", radius = " + radius + " }", "");
  edited.line -= 2;
  return edited;
}

TEST(Cavity, HasNoGapBeyondConcentric) {
  expect_refused(with_cavity("2.9"), "tabulation.gaps", "1.9");
}

TEST(Cavity, MayHaveTheConcentricGapUpToRounding) {
  EXPECT_NO_THROW(read_text(with_cavity("3.0").text));
  // 0.3 - 0.1 is 0.19999999999999998.
  auto text = with_cavity("0.3").text;
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("radius = 1.0", "radius = 0.1");
  replace("to = 2.0", "to = 0.2");
  EXPECT_NO_THROW(read_text(text));
}

TEST(Cavity, MustBeLargerThanTheSphere) {
  for (const auto* radius : {"1.0", "0.5"}) {
    auto edited = with_cavity(radius);
    edited.line += 4;  // the geometry's own
    expect_refused(edited, kGeometry.path);
  }
}

struct Refused {
  const char* name;
  const char* geometry;
  const char* path;
};

void PrintTo(const Refused& refused, std::ostream* stream) { *stream << refused.name; }

class RefusedGeometry : public ::testing::TestWithParam<Refused> {};

TEST_P(RefusedGeometry, IsRefusedByKeyWithItsLine) {
  expect_refused(with_geometry(GetParam().geometry), GetParam().path);
}

INSTANTIATE_TEST_SUITE_P(
    Each, RefusedGeometry,
    ::testing::Values(
        Refused{"NoKind", "{ radius = 2.0 }", "tabulation.geometry.kind"},
        Refused{"SphereWithoutRadius", "{ kind = \"sphere\" }", "tabulation.geometry.radius"},
        Refused{"SphereOfNoSize", "{ kind = \"sphere\", radius = 0 }",
                "tabulation.geometry.radius"},
        Refused{"SphereOfInfiniteSize", "{ kind = \"sphere\", radius = inf }",
                "tabulation.geometry.radius"},
        Refused{"VelocityRatioThatIsNone",
                "{ kind = \"sphere\", radius = 1, velocity_ratio = nan }",
                "tabulation.geometry.velocity_ratio"},
        Refused{"CavityWithoutRadius", "{ kind = \"cavity\" }", "tabulation.geometry.radius"},
        Refused{"NegativeCavity", "{ kind = \"cavity\", radius = -5 }",
                "tabulation.geometry.radius"},
        Refused{"RipplesWithoutAmplitude", "{ kind = \"rough_plane\", wavelength = 0.05 }",
                "tabulation.geometry.amplitude"},
        Refused{"RipplesWithoutWavelength", "{ kind = \"rough_plane\", amplitude = 0.05 }",
                "tabulation.geometry.wavelength"},
        Refused{"FlatRipples", "{ kind = \"rough_plane\", amplitude = 0, wavelength = 0.05 }",
                "tabulation.geometry.amplitude"},
        Refused{"RipplesAsText", "{ kind = \"rough_plane\", amplitude = \"0.1\", wavelength = 1 }",
                "tabulation.geometry.amplitude"},
        Refused{"PlaneWithARadius", "{ kind = \"plane\", radius = 2 }",
                "tabulation.geometry.radius"},
        Refused{"CavityThatMoves", "{ kind = \"cavity\", radius = 5, velocity_ratio = 1 }",
                "tabulation.geometry.velocity_ratio"}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace viscontact::case_file
