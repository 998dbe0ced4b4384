// Compares a flow with that with another penalty and that on another mesh, in this order, because
// vary_penalty() and vary_mesh() replace the problem that the solver had before.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <variant>

#include "viscontact/immersed/fluid/fluid_solver.hpp"

namespace viscontact::particles {
namespace {

/// The results of one flow; `further` is the argument of estimate_flow().
struct Results {
  std::vector<double> velocities;
  FlowQuantities quantities;
  std::vector<double> further;
};

std::vector<double> difference(std::span<const double> of, std::span<const double> from) {
  assert(of.size() == from.size());
  std::vector<double> result(of.begin(), of.end());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] -= from[i];
  return result;
}

/// For each number the length of the vector (velocity or force) to which it belongs, and for an
/// angular velocity or torque its absolute value.
std::vector<double> lengths(std::span<const double> of, std::size_t components) {
  std::vector<double> result;
  for (const double x : of) result.push_back(std::abs(x));
  for (std::size_t i = 0; components == 3 && i < of.size(); i += 3)
    result[i] = result[i + 1] = std::hypot(of[i], of[i + 1]);
  return result;
}

/// The largest of the lengths(). `power` is 1 for velocities, so that angular velocities are
/// multiplied by the radius of the particle, and -1 for forces, so that torques are divided by it.
double largest(std::span<const double> of, const Particles& particles, int power) {
  assert(of.size() == particles.count() * motion_components(particles.dimension));
  const auto components = motion_components(particles.dimension);
  const auto all = lengths(of, components);
  double result = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool turns = components == 3 && i % components == 2;
    result =
        std::max(result, all[i] * (turns ? std::pow(particles.radii[i / components], power) : 1));
  }
  return result;
}

/// Magnitudes of `changes` of forces and torques. In the plane the two components of a force get
/// the larger one of its change and the change of the torque divided by the radius, and the torque
/// gets this times the radius. A force whose change is small by chance then gets no error that is
/// too small.
std::vector<double> of_loads(std::span<const double> changes, const Particles& particles) {
  auto result = lengths(changes, motion_components(particles.dimension));
  if (particles.dimension == 1) return result;
  for (std::size_t k = 0; k < particles.count(); ++k) {
    const double radius = particles.radii[k];
    const double load = std::max(result[3 * k], result[3 * k + 2] / radius);
    result[3 * k] = result[3 * k + 1] = load;
    result[3 * k + 2] = load * radius;
  }
  return result;
}

/// The largest entry of the gradient of a linear flow times the largest radius [L/T]; 0 without
/// either.
double speed_of_flow(const Fluid& fluid, const Particles& particles) {
  const auto* flow = std::get_if<LinearFlow>(&fluid.boundary);
  if (flow == nullptr || particles.radii.empty()) return 0;
  double rate = 0;
  for (const double g : flow->gradient) rate = std::max(rate, std::abs(g));
  return rate * std::ranges::max(particles.radii);
}

/// Errors relative to `scale`; 0 if it is 0. `by_mesh` is the largest change of a result by the
/// other mesh, `by_penalty` that by the other penalty times the factor of vary_penalty().
RelativeErrors relative(double by_mesh, double by_penalty, const SecondMesh& mesh, double scale) {
  if (!(scale > 0)) return {0, 0, 0};
  return {(mesh.error * by_mesh + by_penalty) / scale,
          (mesh.error_of_one_mesh * by_mesh + by_penalty) / scale, by_penalty / scale};
}

}  // namespace

FlowEstimate estimate_flow(FluidSolver& solver, std::span<const double> forces,
                           const Particles& particles, const Fluid& fluid,
                           const std::function<std::vector<double>()>& further) {
  assert(forces.size() == particles.count() * motion_components(particles.dimension));
  const auto ask = [&] {
    Results results;
    results.velocities = solver.velocities(forces, true);
    results.quantities = solver.quantities();
    if (further) results.further = further();
    return results;
  };
  const Results placed = ask();
  const double penalty_factor = solver.vary_penalty();
  const Results softer = penalty_factor > 0 ? ask() : placed;
  const SecondMesh mesh = solver.vary_mesh();
  const bool has_second = mesh.extrapolation > 0 || mesh.error > 0 || mesh.error_of_one_mesh > 0;
  const Results second = has_second ? ask() : placed;

  const auto best = [&](std::vector<double> of, std::span<const double> changes) {
    for (std::size_t i = 0; i < of.size(); ++i) of[i] += mesh.extrapolation * changes[i];
    return of;
  };
  FlowEstimate estimate;
  {
    const auto by_mesh = difference(second.velocities, placed.velocities);
    const auto by_penalty = difference(softer.velocities, placed.velocities);
    estimate.velocities = best(placed.velocities, by_mesh);
    estimate.of_velocities = relative(
        largest(by_mesh, particles, 1), penalty_factor * largest(by_penalty, particles, 1), mesh,
        std::max(largest(estimate.velocities, particles, 1), speed_of_flow(fluid, particles)));
  }
  {
    auto& quantities = estimate.quantities = placed.quantities;
    quantities.dissipation +=
        mesh.extrapolation * (second.quantities.dissipation - placed.quantities.dissipation);
    quantities.apparent_viscosity += mesh.extrapolation * (second.quantities.apparent_viscosity -
                                                           placed.quantities.apparent_viscosity);
    const auto& from = placed.quantities.fluid_forces;
    const auto by_mesh = difference(second.quantities.fluid_forces, from);
    const auto by_penalty = difference(softer.quantities.fluid_forces, from);
    quantities.fluid_forces = best(from, by_mesh);
    estimate.of_forces = relative(largest(by_mesh, particles, -1),
                                  penalty_factor * largest(by_penalty, particles, -1), mesh,
                                  largest(quantities.fluid_forces, particles, -1));
    estimate.force_errors = of_loads(by_mesh, particles);
    const auto penalty_errors = of_loads(by_penalty, particles);
    for (std::size_t i = 0; i < penalty_errors.size(); ++i)
      estimate.force_errors[i] =
          mesh.error * estimate.force_errors[i] + penalty_factor * penalty_errors[i];
  }
  for (std::size_t i = 0; i < placed.further.size(); ++i)
    estimate.further_errors.push_back(
        mesh.error_of_one_mesh * std::abs(second.further[i] - placed.further[i]) +
        penalty_factor * std::abs(softer.further[i] - placed.further[i]));
  return estimate;
}

}  // namespace viscontact::particles
