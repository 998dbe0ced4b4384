// Only a registry names its models, geometries and bases: no other source of the program quotes one
// of these names. The sources of the models themselves are in the folder of their registry.
#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/common/files/file.hpp"
#include "viscontact/freefem_axi/geometry.hpp"
#include "viscontact/lubrication/terms.hpp"
#include "viscontact/reduced_model/models/models.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::UnorderedElementsAre;

std::vector<std::string> registered_names() {
  std::vector<std::string> names;
  for (const auto& model : reduced_model::all_models()) names.emplace_back(model.name);
  for (const auto& geometry : freefem_axi::all_geometries()) names.emplace_back(geometry.name);
  for (const auto& basis : lubrication::all_bases()) names.emplace_back(basis.name);
  return names;
}

/// The .cpp and .hpp files of the program that belong to no registry, relative to the source
/// folder.
std::vector<std::string> sources_outside_registries() {
  const fs::path root = VISCONTACT_SOURCE_FOLDER;
  std::vector<std::string> sources;
  for (const auto& part : fs::directory_iterator(root)) {
    const auto name = part.path().filename();
    if (!fs::exists(part.path() / "CMakeLists.txt") || name == "tests" || name == "bench") continue;
    for (const auto& file : fs::recursive_directory_iterator(part)) {
      const auto extension = file.path().extension();
      const auto source = file.path().lexically_relative(root).string();
      if ((extension == ".cpp" || extension == ".hpp") &&
          !source.starts_with("reduced_model/models/") && source != "freefem_axi/geometry.cpp" &&
          source != "lubrication/terms.cpp")
        sources.push_back(source);
    }
  }
  return sources;
}

TEST(Registries, AreTheOnlySourcesWithTheirNames) {
  const auto names = registered_names();
  const auto sources = sources_outside_registries();
  EXPECT_GT(sources.size(), 100U);
  std::vector<std::pair<std::string, std::string>> found;
  for (const auto& source : sources) {
    const auto text = read_file(fs::path(VISCONTACT_SOURCE_FOLDER) / source);
    for (const auto& name : names)
      if (text.find("\"" + name + "\"") != std::string::npos) found.emplace_back(source, name);
  }
  using Found = std::pair<std::string, std::string>;
  // These texts are other things of the same name.
  EXPECT_THAT(
      found,
      UnorderedElementsAre(
          // sections of a case, and its key sweep.reference
          Found("case_file/case_file.cpp", "sphere"), Found("case_file/case_file.cpp", "reference"),
          Found("sweep/sphere_study.cpp", "sphere"),
          // sections of a case of particles
          Found("particle_runs/case/particles_case.cpp", "viscous_contact"),
          Found("particle_runs/case/particles_case.cpp", "plane"),
          Found("particle_runs/case/membrane_checks.cpp", "viscous_contact"),
          Found("particle_runs/case/membrane_checks.cpp", "plane"),
          Found("particle_runs/case/fluid_start_checks.cpp", "viscous_contact"),
          // obstacles in words
          Found("particle_runs/case/start_checks.cpp", "plane"),
          Found("particle_runs/case/fluid_start_checks.cpp", "plane"),
          Found("particles/steps/step_report.cpp", "plane"),
          Found("contact_dynamics/given_motions.cpp", "plane"),
          // a key in the head of a file of a sweep
          Found("sweep/sphere_study.cpp", "reference"),
          // a part of the boundary, which FreeFEM's scripts print
          Found("freefem_axi/row_picture.cpp", "sphere"),
          // the body in words
          Found("particle_runs/picture/particles_page.cpp", "sphere"),
          // a folder of results
          Found("particle_runs/run/particles_pages.cpp", "viscous_contact"),
          // what a legend numbers
          Found("swimmer/job/swimmer_page.cpp", "sphere"),
          // bases of pairs, two of which are named bases
          Found("motions/pair_fit.cpp", "asymptotic"),
          Found("motions/pair_fit.cpp", "asymptotic_extended"),
          // the geometry of a fit, which says what the neighbour is
          Found("motions/fitted_pairs.cpp", "plane"),
          // a shape of particles
          Found("particles/shapes/disc.cpp", "sphere"),
          // words for the geometry in the head of a table
          Found("lubrication/second_wall.cpp", "plane"),
          Found("lubrication/second_wall.cpp", "cavity"),
          Found("lubrication/second_wall.cpp", "sphere"),
          Found("lubrication/second_wall.cpp", "free_surface"),
          Found("lubrication/second_wall.cpp", "rough_plane"),
          // a model of the rolling sphere, and a section of its case
          Found("rolling/roll_with_viscous_contact.cpp", "viscous_contact"),
          Found("rolling/job/rolling_page.cpp", "viscous_contact"),
          Found("rolling/case/rolling_study.cpp", "viscous_contact"),
          Found("rolling/case/rolling_case.cpp", "sphere"),
          // what the texts of Python's help() quote
          Found("python/spheres.cpp", "viscous_contact"), Found("python/fits.cpp", "lecture"),
          Found("python/fits.cpp", "asymptotic"), Found("python/fits.cpp", "asymptotic_extended")));
}

}  // namespace
}  // namespace viscontact
