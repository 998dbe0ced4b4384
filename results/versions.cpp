// Takes the versions of libraries from their headers, and asks FreeFEM for its version. The names
// are keys in the provenance of files, so a change must keep them.
#include "viscontact/results/versions.hpp"

#include <ceres/version.h>
#include <fmt/format.h>
#include <sundials/sundials_config.h>

#include <Eigen/Core>

#include "viscontact/common/error.hpp"
#include "viscontact/freefem_axi/freefem.hpp"

namespace viscontact::results {

std::map<std::string, std::string> library_versions() {
  return {{"Viscontact", VISCONTACT_VERSION},
          {"Ceres", CERES_VERSION_STRING},
          {"SUNDIALS", SUNDIALS_VERSION},
          {"Eigen",
           fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)}};
}

std::string freefem_version_or_not_found(const StopToken& stop) {
  try {
    return freefem_axi::freefem_version(freefem_axi::default_freefem(stop));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kExternalProgram) throw;
    return "not found";
  }
}

}  // namespace viscontact::results
