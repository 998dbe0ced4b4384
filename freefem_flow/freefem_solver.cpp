// The commands of fluid solvers (freefem_solver.hpp).
#include "viscontact/freefem_flow/freefem_solver.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "viscontact/freefem/freefem_command.hpp"
#include "viscontact/freefem_flow/mesh_boundary.hpp"
#include "viscontact/freefem_flow/scaled_solver.hpp"

namespace viscontact::freefem_flow {
namespace {

std::string script_of(particles::FluidMesh mesh, int dimension) {
  const std::string bodies = dimension == 1 ? "spheres" : "discs";
  return bodies + (mesh == particles::FluidMesh::kFixed ? "_on_fixed_mesh.edp" : ".edp");
}

}  // namespace

SolverCommand solver_command(const particles::Fluid& fluid, int dimension) {
  const std::string silent =
      fmt::format("on a slow machine set {} to more seconds", freefem::kTimeLimit);
  if (!fluid.solver.empty()) {
    SolverCommand own;
    own.arguments = fluid.solver;
    own.remedy_if_missing = "the first word of the fluid's solver must be a program";
    own.remedy_if_silent = silent;
    return own;
  }
  const std::string script = script_of(fluid.mesh, dimension);
  const auto folder = freefem::find_script_folder("freefem_flow", script);
  auto command = freefem::make_command(freefem::executable_of_user(), folder, script, {});
  // MUMPS lets Scotch order systems of more than 5000 rows. Scotch takes random numbers, which go on
  // from one system to the next, and orders with several threads differently each time.
  command.environment.emplace_back("SCOTCH_PTHREAD_NUMBER=1");
  constexpr std::size_t kMostReproduced = 4000;
  return {std::move(command.arguments),
          std::move(command.environment),
          std::move(command.folder),
          std::string(freefem::kHowToInstall),
          "too little memory can make FreeFEM hang (ulimit -v); " + silent,
          kMostReproduced};
}

SolverLimits solver_limits(const StopToken& stop) {
  SolverLimits limits;
  limits.stop = stop;
  if (const auto limit = freefem::time_limit_of_user()) limits.answer = *limit;
  return limits;
}

std::unique_ptr<particles::FluidSolver> start_fluid_solver(const particles::Fluid& fluid,
                                                           const particles::Domain& domain,
                                                           std::span<const double> radii,
                                                           int dimension, const StopToken& stop) {
  const bool is_freefem = fluid.solver.empty();
  const SolverUnits units = is_freefem ? solver_units(fluid, domain, radii) : SolverUnits{};
  const auto own_fluid = in_units(fluid, units);
  const auto own_domain = in_units(domain, units);
  const auto make_boundary = [own_fluid, own_domain](const particles::FluidParticles& placed,
                                                     double coarsening) {
    return mesh_boundary(own_fluid, own_domain, placed, coarsening);
  };
  auto process = std::make_unique<FlowProcess>(own_fluid, own_domain, in_units(radii, units),
                                               dimension, solver_command(fluid, dimension),
                                               make_boundary, solver_limits(stop));
  if (!is_freefem) return process;
  return std::make_unique<ScaledSolver>(units, dimension, std::move(process));
}

}  // namespace viscontact::freefem_flow
