// Particles in a fluid that FreeFEM solves: one placement and its answers. Lengths, masses and
// times are in one unit each; the viscosity is 1 unless a test says otherwise.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "viscontact/freefem_flow/freefem_solver.hpp"
#include "viscontact/immersed/fluid/fluid_solver.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/setting/fluid.hpp"

namespace viscontact::freefem_flow {

/// A disc, or a sphere on the axis, whose z is `y`.
struct Body {
  double x = 0, y = 0;
  double radius = 1;
};

inline particles::Fluid fluid_with(
    int edges, particles::RigidConstraint constraint = particles::RigidConstraint::kPenalty) {
  particles::Fluid fluid;
  fluid.viscosity = 1;
  fluid.edges_per_particle = edges;
  fluid.constraint = constraint;
  return fluid;
}

inline particles::Particles particles_of(const std::vector<Body>& bodies, int dimension) {
  particles::Particles particles;
  particles.dimension = dimension;
  for (const auto& body : bodies) {
    if (dimension == 2) particles.positions.push_back(body.x);
    particles.positions.push_back(body.y);
    particles.radii.push_back(body.radius);
  }
  return particles;
}

/// Particles at given places, and the process that solves the fluid around them.
class PlacedFlow {
 public:
  using Driven = std::map<std::int32_t, std::array<double, 3>>;

  PlacedFlow(const particles::Fluid& fluid, const particles::Domain& domain,
             const std::vector<Body>& bodies, Driven driven = {}, std::vector<double> inertia = {})
      : dimension_(std::holds_alternative<particles::CylinderDomain>(domain) ? 1 : 2),
        particles_(particles_of(bodies, dimension_)),
        angles_(dimension_ == 2 ? bodies.size() : 0),
        driven_(std::move(driven)),
        inertia_(std::move(inertia)),
        fluid_(fluid),
        solver_(start_fluid_solver(fluid, domain, shapes_of(particles_), dimension_)) {
    place();
  }

  void place() { solver_->place({&particles_, angles_, driven_, inertia_}); }
  particles::FluidSolver& solver() { return *solver_; }
  particles::Particles& particles() { return particles_; }

  /// Velocities under these forces, while walls and driven bodies move.
  std::vector<double> velocities(const std::vector<double>& forces) {
    return solver_->velocities(forces, true);
  }
  std::vector<double> velocities() { return velocities(no_forces()); }
  /// Velocities and forces with estimates of their errors. Afterwards place() must be called before
  /// any other question.
  particles::FlowEstimate estimate(const std::vector<double>& forces) {
    return particles::estimate_flow(*solver_, forces, particles_, fluid_);
  }
  std::vector<double> no_forces() const {
    return std::vector<double>(particles_.count() * particles::motion_components(dimension_));
  }

 private:
  int dimension_;
  particles::Particles particles_;
  std::vector<double> angles_;
  Driven driven_;
  std::vector<double> inertia_;
  particles::Fluid fluid_;
  std::unique_ptr<particles::FluidSolver> solver_;
};

}  // namespace viscontact::freefem_flow
