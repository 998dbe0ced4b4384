// The commands of fluid solvers (freefem_solver.hpp).
#include "viscontact/freefem_flow/freefem_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <variant>

#include "viscontact/common/error.hpp"
#include "viscontact/freefem/freefem_command.hpp"
#include "viscontact/freefem_flow/mesh_boundary.hpp"
#include "viscontact/freefem_flow/scaled_solver.hpp"

namespace viscontact::freefem_flow {
namespace {

std::string script_of(particles::FluidMesh mesh, int dimension) {
  const std::string bodies = dimension == 1 ? "spheres" : "discs";
  return bodies + (mesh == particles::FluidMesh::kFixed ? "_on_fixed_mesh.edp" : ".edp");
}

/// The shortest edge of a mesh over the larger side of the box around it. FreeFEM refuses border
/// points that are closer than 1e-7 of that side. The mesh that is refined for an estimate of the
/// error has edges half as long, and chords are a little shorter than edge lengths.
constexpr double kShortestEdge = 2.2e-7;

/// The larger side of the box around the mesh of a domain; that of a cylinder is half a section.
double extent_of(const particles::Domain& domain) {
  if (const auto* disc = std::get_if<particles::DiscDomain>(&domain)) return 2 * disc->radius;
  if (const auto* box = std::get_if<particles::BoxDomain>(&domain))
    return std::max(box->to[0] - box->from[0], box->to[1] - box->from[1]);
  if (const auto* cylinder = std::get_if<particles::CylinderDomain>(&domain))
    return std::max(cylinder->radius, cylinder->height);
  return 0;  // refused when the solver starts
}

/// Throws Error(kBadInput) if FreeFEM would refuse the edges on the smallest particle. All lengths
/// are in the unit of the case.
void refuse_small_particles(const particles::Fluid& fluid, const particles::Domain& domain,
                            std::span<const double> radii) {
  if (radii.empty()) return;
  const double radius = std::ranges::min(radii), shortest = kShortestEdge * extent_of(domain);
  const double chord = 2 * std::sin(std::numbers::pi / fluid.edges_per_particle);
  if (radius * chord >= shortest) return;
  throw Error(
      ErrorKind::kBadInput,
      fmt::format("a particle of radius {} is too small for the domain: {} edges on it are "
                  "{:.2g} long, and FreeFEM makes no mesh with edges below {:.2g}, which is "
                  "{} of the length of the domain; with {} edges the radius must be at least "
                  "{:.3g}. Choose a smaller domain",
                  radius, fluid.edges_per_particle, radius * chord, shortest, kShortestEdge,
                  fluid.edges_per_particle, shortest / chord));
}

/// Throws Error(kNotConverged) if FreeFEM would refuse the edges in a gap.
void refuse_short_edges(const MeshBoundary& boundary, double size, double unit) {
  for (const auto& curve : boundary.curves)
    for (int i = curve.first; i < curve.first + curve.edges; ++i) {
      const auto &from = boundary.points[static_cast<std::size_t>(i)],
                 &to = boundary.points[static_cast<std::size_t>(i) + 1];
      const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
      if (length >= kShortestEdge * size) continue;
      throw Error(
          ErrorKind::kNotConverged,
          fmt::format("a gap is too narrow for the mesh: an edge in it at ({:.6g}, {:.6g}) is "
                      "{:.2g} long, and FreeFEM makes no mesh with edges below {:.2g}, which "
                      "is {} of the length of the domain; raise threshold_gap",
                      from[0] * unit, from[1] * unit, length * unit, kShortestEdge * size * unit,
                      kShortestEdge));
    }
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
  return {std::move(command.arguments), std::move(command.environment), std::move(command.folder),
          std::string(freefem::kHowToInstall),
          "too little memory can make FreeFEM hang (ulimit -v); " + silent, kMostReproduced,
          // Where lengths of edges differ by much, buildmesh writes "Warning LengthInterpole" on
          // standard output, and makes a good mesh.
          true};
}

SolverLimits solver_limits(const StopToken& stop) {
  SolverLimits limits;
  limits.stop = stop;
  if (const auto limit = freefem::time_limit_of_user()) limits.answer = limits.ready = *limit;
  return limits;
}

std::unique_ptr<particles::FluidSolver> start_fluid_solver(const particles::Fluid& fluid,
                                                           const particles::Domain& domain,
                                                           std::span<const double> radii,
                                                           int dimension, const StopToken& stop) {
  const bool is_freefem = fluid.solver.empty();
  if (is_freefem) refuse_small_particles(fluid, domain, radii);
  const SolverUnits units = is_freefem ? solver_units(fluid, domain, radii) : SolverUnits{};
  const auto own_fluid = in_units(fluid, units);
  const auto own_domain = in_units(domain, units);
  const auto make_boundary = [own_fluid, own_domain, is_freefem, unit = units.length](
                                 const particles::FluidParticles& placed, double coarsening) {
    auto boundary = mesh_boundary(own_fluid, own_domain, placed, coarsening);
    if (is_freefem) refuse_short_edges(boundary, extent_of(own_domain), unit);
    return boundary;
  };
  auto process = std::make_unique<FlowProcess>(own_fluid, own_domain, in_units(radii, units),
                                               dimension, solver_command(fluid, dimension),
                                               make_boundary, solver_limits(stop));
  if (!is_freefem) return process;
  return std::make_unique<ScaledSolver>(units, dimension, std::move(process));
}

}  // namespace viscontact::freefem_flow
