// The commands of fluid solvers, and results of FreeFEM in the units of the case.
#include "viscontact/freefem_flow/freefem_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/freefem/freefem_command.hpp"
#include "viscontact/freefem_flow/boundary/edge_lengths.hpp"
#include "viscontact/freefem_flow/boundary/mesh_boundary.hpp"
#include "viscontact/freefem_flow/membranes/membrane_process.hpp"
#include "viscontact/freefem_flow/process/solver_units.hpp"
#include "viscontact/immersed/fluid/fluid_solver.hpp"
#include "viscontact/particles/setting/fluid.hpp"

namespace viscontact::freefem_flow {
namespace {

/// A fluid solver that changes arguments in the units of the case to SolverUnits, asks another
/// solver, and changes the results back.
class ScaledSolver : public particles::FluidSolver {
 public:
  ScaledSolver(const SolverUnits& units, int dimension,
               std::unique_ptr<particles::FluidSolver> solver);

  void place(const particles::FluidParticles& bodies) override;
  std::vector<double> velocities(std::span<const double> forces, bool driving) override;
  std::vector<double> mobility(std::size_t components) override;
  particles::FlowQuantities quantities() override;
  double vary_penalty() override { return solver_->vary_penalty(); }
  particles::SecondMesh vary_mesh() override { return solver_->vary_mesh(); }
  particles::FlowField flow() override;
  void keep_flow(bool at_rest, std::span<const double> motions) override;
  // The saved flow stays in the units of the solver, because a later run of the same case computes
  // the same units.
  std::string saved_flow() override { return solver_->saved_flow(); }
  void load_flow(const std::string& flow) override { solver_->load_flow(flow); }
  std::size_t unknowns() const override { return solver_->unknowns(); }
  double peak_memory_mebibytes() const override { return solver_->peak_memory_mebibytes(); }

 private:
  std::vector<double> scaled_forces(std::span<const double> forces) const;
  void unscale_velocities(std::vector<double>& velocities) const;

  SolverUnits units_;
  std::size_t components_;  // of the motion of one particle
  // The solver's units of these components, of the forces and torques on a particle, and of a
  // power.
  std::array<double, 3> velocity_units_{}, force_units_{};
  double power_unit_ = 1;
  std::unique_ptr<particles::FluidSolver> solver_;
};

ScaledSolver::ScaledSolver(const SolverUnits& units, int dimension,
                           std::unique_ptr<particles::FluidSolver> solver)
    : units_(units),
      components_(particles::motion_components(dimension)),
      solver_(std::move(solver)) {
  assert(solver_ != nullptr);
  // In the plane forces and powers are per unit length of the third dimension.
  const double length = units.length, force = units.viscosity * length;
  if (components_ == 3) {
    velocity_units_ = {length, length, 1};
    force_units_ = {force, force, force * length};
    power_unit_ = force * length;
  } else {
    velocity_units_ = {length, 0, 0};
    force_units_ = {force * length, 0, 0};
    power_unit_ = force * length * length;
  }
}

void ScaledSolver::place(const particles::FluidParticles& bodies) {
  assert(bodies.particles != nullptr);
  particles::Particles scaled;
  scaled.dimension = bodies.particles->dimension;
  scaled.positions = places_in_units(bodies.particles->positions, scaled.dimension, units_);
  scaled.radii = in_units(bodies.particles->radii, units_);
  scaled.shapes = in_units(bodies.particles->shapes, units_);
  scaled.ids = bodies.particles->ids;
  // Lengths in `bodies` stay in the unit of the case, because the mesh asks only which particles
  // are of one body.
  scaled.bodies = bodies.particles->bodies;
  std::vector<double> inertia(bodies.inertia.begin(), bodies.inertia.end());
  for (std::size_t i = 0; i < inertia.size(); ++i)
    inertia[i] *= velocity_units_[i % components_] / force_units_[i % components_];
  auto driven = bodies.driven;
  for (auto& [particle, motion] : driven)
    for (std::size_t c = 0; c < components_; ++c) motion[c] /= velocity_units_[c];
  auto flow_step = bodies.flow_step;  // its times keep their unit
  std::vector<double> masses(flow_step.masses.begin(), flow_step.masses.end());
  for (std::size_t i = 0; i < masses.size(); ++i)
    masses[i] *= velocity_units_[i % components_] / force_units_[i % components_];
  flow_step.masses = masses;
  solver_->place({&scaled, bodies.angles, std::move(driven), inertia, flow_step});
}

std::vector<double> ScaledSolver::scaled_forces(std::span<const double> forces) const {
  std::vector<double> scaled(forces.begin(), forces.end());
  for (std::size_t i = 0; i < scaled.size(); ++i) scaled[i] /= force_units_[i % components_];
  return scaled;
}

void ScaledSolver::unscale_velocities(std::vector<double>& velocities) const {
  for (std::size_t i = 0; i < velocities.size(); ++i)
    velocities[i] *= velocity_units_[i % components_];
}

std::vector<double> ScaledSolver::velocities(std::span<const double> forces, bool driving) {
  auto velocities = solver_->velocities(scaled_forces(forces), driving);
  unscale_velocities(velocities);
  return velocities;
}

std::vector<double> ScaledSolver::mobility(std::size_t components) {
  assert(components % components_ == 0);
  auto matrix = solver_->mobility(components);
  for (std::size_t i = 0; i < components; ++i)
    for (std::size_t j = 0; j < components; ++j)
      matrix[i * components + j] *=
          velocity_units_[j % components_] / force_units_[i % components_];
  return matrix;
}

particles::FlowQuantities ScaledSolver::quantities() {
  auto quantities = solver_->quantities();
  quantities.dissipation *= power_unit_;
  quantities.kinetic_energy *= power_unit_;
  for (auto& [flow, pressure] : quantities.probes) {
    flow *= units_.length * units_.length;
    pressure *= units_.viscosity;
  }
  for (std::size_t i = 0; i < quantities.fluid_forces.size(); ++i)
    quantities.fluid_forces[i] *= force_units_[i % components_];
  return quantities;
}

void ScaledSolver::keep_flow(bool at_rest, std::span<const double> motions) {
  std::vector<double> scaled(motions.begin(), motions.end());
  for (std::size_t i = 0; i < scaled.size(); ++i) scaled[i] /= velocity_units_[i % components_];
  solver_->keep_flow(at_rest, scaled);
}

particles::FlowField ScaledSolver::flow() {
  auto field = solver_->flow();
  for (auto* lengths : {&field.x, &field.y, &field.velocity_x, &field.velocity_y})
    for (auto& value : *lengths) value *= units_.length;
  // A sum with 0 would change the sign of -0, which files show.
  for (std::size_t d = 0; d < units_.origin.size(); ++d)
    if (units_.origin[d] != 0)
      for (auto& x : d == 0 ? field.x : field.y) x += units_.origin[d];
  for (auto& pressure : field.pressure) pressure *= units_.viscosity;
  return field;
}

std::string script_of(particles::FluidMesh mesh, int dimension) {
  const std::string bodies = dimension == 1 ? "spheres" : "discs";
  return bodies + (mesh == particles::FluidMesh::kFixed ? "_on_fixed_mesh.edp" : ".edp");
}

/// The shortest edge of a mesh over the larger side of the rectangle around it. FreeFEM refuses
/// points of the boundary that are closer than 1e-7 of that side. The mesh for the estimate of the
/// error has edges half as long, and straight edges are a little shorter than the arcs that they
/// replace.
constexpr double kShortestEdge = 2.2e-7;

/// The larger side [L] of the rectangle around a mesh; that of a cylinder is half of its section.
double extent_of(const particles::Domain& domain) {
  if (const auto* disc = std::get_if<particles::DiscDomain>(&domain)) return 2 * disc->radius;
  if (const auto* box = std::get_if<particles::BoxDomain>(&domain))
    return std::max(box->to[0] - box->from[0], box->to[1] - box->from[1]);
  if (const auto* cylinder = std::get_if<particles::CylinderDomain>(&domain))
    return std::max(cylinder->radius, cylinder->height);
  return 0;  // no domain: the solver refuses it when it starts
}

/// Throws Error(kBadInput) if FreeFEM would refuse the edges on the smallest particle.
void refuse_small_particles(const particles::Fluid& fluid, const particles::Domain& domain,
                            std::span<const double> radii) {
  if (radii.empty()) return;
  const double radius = std::ranges::min(radii), shortest = kShortestEdge * extent_of(domain);
  const double chord = 2 * std::sin(std::numbers::pi / fluid.edges_per_particle);
  if (radius * chord >= shortest) return;
  throw Error(
      ErrorKind::kBadInput,
      "a particle of radius {} is too small for the domain: {} edges on it are {:.2g} long, and "
      "FreeFEM makes no mesh with edges below {:.2g}, which is {} of the length of the domain; "
      "with {} edges the radius must be at least {:.3g}. Choose a smaller domain",
      radius, fluid.edges_per_particle, radius * chord, shortest, kShortestEdge,
      fluid.edges_per_particle, shortest / chord);
}

/// The same for edges on a membrane (membrane_process.hpp).
void refuse_small_membranes(const particles::Fluid& fluid, const particles::Domain& domain) {
  const double shortest = kShortestEdge * extent_of(domain);
  for (const auto& membrane : fluid.membranes) {
    const int edges = std::max(fluid.edges_per_particle, (2 * membrane.count() + 2) / 3);
    if (membrane.perimeter >= edges * shortest) continue;
    throw Error(
        ErrorKind::kBadInput,
        "a membrane of perimeter {} is too small for the domain: {} edges on it are {:.2g} long, "
        "and FreeFEM makes no mesh with edges below {:.2g}, which is {} of the length of the "
        "domain; the perimeter must be at least {:.3g}. Choose a smaller domain",
        membrane.perimeter, edges, membrane.perimeter / edges, shortest, kShortestEdge,
        edges * shortest);
  }
}

/// Throws Error(kNotConverged) if FreeFEM would refuse an edge of `boundary`, which is in `units`
/// around a domain of the extent `size` in these units.
void refuse_short_edges(const MeshBoundary& boundary, double size, const SolverUnits& units) {
  for (const auto& curve : boundary.curves)
    for (int i = curve.first; i < curve.first + curve.edges; ++i) {
      const auto &from = boundary.points[static_cast<std::size_t>(i)],
                 &to = boundary.points[static_cast<std::size_t>(i) + 1];
      const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
      if (length >= kShortestEdge * size) continue;
      const auto place = units.in_case(from);
      throw Error(ErrorKind::kNotConverged,
                  "a gap is too narrow for the mesh: an edge in it at ({:.6g}, {:.6g}) is {:.2g} "
                  "long, and FreeFEM makes no mesh with edges below {:.2g}, which is {} of the "
                  "length of the domain; raise threshold_gap",
                  place[0], place[1], length * units.length, kShortestEdge * size * units.length,
                  kShortestEdge);
    }
}

std::string if_silent() {
  return fmt::format("on a slow machine set {} to more seconds", freefem::kTimeLimit);
}

SolverCommand freefem_command(const std::string& script) {
  const auto folder = freefem::find_script_folder("freefem_flow", script);
  auto command = freefem::make_command(freefem::executable_of_user(), folder, script, {});
  // FreeFEM's linear solver MUMPS leaves the order of systems of more than 5000 rows to the library
  // Scotch. With several threads Scotch's order differs each time; with one it depends on the
  // systems before, because all share one sequence of random numbers. After a system of at most
  // kMostReproduced unknowns, which is safely below 5000, later answers have the same bits.
  command.environment.emplace_back("SCOTCH_PTHREAD_NUMBER=1");
  // A smaller value is allowed, but then FreeFEM is started again more often.
  constexpr std::size_t kMostReproduced = 4000;
  return {std::move(command.arguments), std::move(command.environment), std::move(command.folder),
          std::string(freefem::kHowToInstall),
          "too little memory can make FreeFEM hang (ulimit -v); " + if_silent(), kMostReproduced,
          // FreeFEM's buildmesh may write "Warning LengthInterpole" to standard output if lengths
          // of edges differ much. The mesh is good nevertheless.
          true};
}

}  // namespace

SolverCommand solver_command(const particles::Fluid& fluid, int dimension) {
  if (!fluid.solver.empty()) {
    SolverCommand own;
    own.arguments = fluid.solver;
    own.remedy_if_missing = "the first word of the fluid's solver must be a program";
    own.remedy_if_silent = if_silent();
    return own;
  }
  return freefem_command(script_of(fluid.mesh, dimension));
}

SolverLimits solver_limits(const StopToken& stop) {
  SolverLimits limits;
  limits.stop = stop;
  if (const auto limit = freefem::time_limit_of_user()) limits.answer = limits.ready = *limit;
  return limits;
}

std::unique_ptr<particles::FluidSolver> start_fluid_solver(const particles::Fluid& fluid,
                                                           const particles::Domain& domain,
                                                           std::span<const particles::Shape> shapes,
                                                           int dimension, const StopToken& stop) {
  std::vector<double> radii;
  for (const auto& shape : shapes) radii.push_back(shape.bounding_radius());
  if (!fluid.membranes.empty()) {
    refuse_small_membranes(fluid, domain);
    std::vector<double> sizes;
    for (const auto& membrane : fluid.membranes)
      sizes.push_back(std::sqrt(membrane.area / std::numbers::pi));
    const auto units = solver_units(fluid, domain, sizes);
    auto process = start_membrane_solver(in_units(fluid, units), in_units(domain, units),
                                         in_units(radii, units), units,
                                         freefem_command("membranes.edp"), solver_limits(stop));
    return std::make_unique<ScaledSolver>(units, dimension, std::move(process));
  }
  const bool is_freefem = fluid.solver.empty();
  if (is_freefem) refuse_small_particles(fluid, domain, radii);
  const SolverUnits units = is_freefem ? solver_units(fluid, domain, radii) : SolverUnits{};
  const auto own_fluid = in_units(fluid, units);
  const auto own_domain = in_units(domain, units);
  const auto make_boundary = [own_fluid, own_domain, is_freefem, units](
                                 const particles::FluidParticles& placed, double coarsening) {
    auto boundary = mesh_boundary(own_fluid, own_domain, placed, coarsening);
    if (is_freefem) refuse_short_edges(boundary, extent_of(own_domain), units);
    return boundary;
  };
  auto process = std::make_unique<FlowProcess>(own_fluid, own_domain, in_units(shapes, units),
                                               dimension, solver_command(fluid, dimension),
                                               make_boundary, solver_limits(stop));
  if (!is_freefem) return process;
  return std::make_unique<ScaledSolver>(units, dimension, std::move(process));
}

}  // namespace viscontact::freefem_flow
