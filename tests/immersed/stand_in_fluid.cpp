#include "tests/immersed/stand_in_fluid.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <sstream>
#include <utility>

#include "tests/particles/systems.hpp"
#include "viscontact/common/error.hpp"

namespace viscontact::particles {
namespace {

/// The mean flow and its rotation where the particles are; 0 but in a sheared cell.
Eigen::VectorXd mean_flow(const Particles& p) {
  const auto components = motion_components(p.dimension);
  Eigen::VectorXd flow = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(p.count() * components));
  if (!p.cell.is_sheared()) return flow;
  for (std::size_t k = 0; k < p.count(); ++k) {
    const Vector u = mean_velocity(p.cell, p.position(k));
    const auto i = static_cast<Eigen::Index>(components * k);
    flow[i] = u[0];
    flow[i + 1] = u[1];
    flow[i + 2] = (p.cell.gradient[2] - p.cell.gradient[1]) / 2;
  }
  return flow;
}

}  // namespace

Vector mean_velocity(const PeriodicCell& cell, const Vector& x) {
  const auto& g = cell.gradient;
  const double dx = x[0] - cell.from[0] - cell.lengths[0] / 2;
  const double dy = x[1] - cell.from[1] - cell.lengths[1] / 2;
  return {g[0] * dx + g[1] * dy, g[2] * dx + g[3] * dy, 0};
}

void StandInFluid::count() {
  if (placements + solutions == fails_at) throw Error(ErrorKind::kExternalProgram, "it fails");
}

void StandInFluid::place(const FluidParticles& bodies) {
  count();
  ++placements;
  const auto& p = *bodies.particles;
  components_ = motion_components(p.dimension);
  drag_ = resistance_(p);
  flow_ = mean_flow(p);
  matrix_ = drag_;
  for (std::size_t i = 0; i < bodies.inertia.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    matrix_(k, k) += bodies.inertia[i];
  }
  momentum_ = Eigen::VectorXd::Zero(drag_.rows());
  const auto& step = bodies.flow_step;
  for (std::size_t i = 0; step.order > 0 && i < step.masses.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double m = step.masses[i] / step.length, r = step.length / step.before;
    matrix_(k, k) += m * (step.order == 1 ? 1 : (1 + 2 * r) / (1 + r));
    momentum_[k] =
        m * (step.order == 1 ? kept_[i] : (1 + r) * kept_[i] - r * r / (1 + r) * kept_before_[i]);
  }
  is_driven_.assign(p.count() * components_, 0);
  given_ = Eigen::VectorXd::Zero(drag_.rows());
  for (const auto& [k, motion] : bodies.driven)
    for (std::size_t d = 0; d < components_; ++d) {
      const auto i = index_of(k) * components_ + d;
      is_driven_[i] = 1;
      given_[static_cast<Eigen::Index>(i)] = motion[d];
    }
  factorise();
}

SecondMesh StandInFluid::vary_mesh() {
  matrix_ += (drag_of_second_mesh - 1) * drag_;
  drag_ *= drag_of_second_mesh;
  factorise();
  return second_mesh;
}

void StandInFluid::factorise() {
  Eigen::MatrixXd free = matrix_;
  for (std::size_t i = 0; i < is_driven_.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (is_driven_[i] == 0) continue;
    free.row(k).setZero();
    free.col(k).setZero();
    free(k, k) = 1;
  }
  inverse_ = free.llt().solve(Eigen::MatrixXd::Identity(free.rows(), free.cols()));
}

std::vector<double> StandInFluid::velocities(std::span<const double> forces, bool driving) {
  count();
  ++solutions;
  const Eigen::Map<const Eigen::VectorXd> given_forces(forces.data(),
                                                       static_cast<Eigen::Index>(forces.size()));
  Eigen::VectorXd right = given_forces;
  if (driving) right += drag_ * flow_ - matrix_ * given_ + momentum_;
  for (std::size_t i = 0; i < is_driven_.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (is_driven_[i] != 0) right[k] = driving ? given_[k] : 0;
  }
  const Eigen::VectorXd v = inverse_ * right;
  if (driving) last_ = v;
  return {v.data(), v.data() + v.size()};
}

void StandInFluid::keep_flow(bool /*at_rest*/, std::span<const double> motions) {
  kept_before_ = std::move(kept_);
  kept_.assign(motions.begin(), motions.end());
}

std::string StandInFluid::saved_flow() {
  std::string text;
  for (const auto* velocities : {&kept_, &kept_before_}) {
    for (const double u : *velocities) text += fmt::format("{} ", u);
    text += ";";
  }
  return text;
}

void StandInFluid::load_flow(const std::string& flow) {
  std::istringstream text(flow);
  for (auto* velocities : {&kept_, &kept_before_}) {
    velocities->clear();
    for (double u = 0; text >> u;) velocities->push_back(u);
    text.clear();
    text.ignore(1);
  }
}

FlowQuantities StandInFluid::quantities() {
  const Eigen::VectorXd force = drag_ * (last_ - flow_);
  FlowQuantities quantities{force.dot(last_ - flow_), 0, {}};
  for (const double f : force) quantities.fluid_forces.push_back(-f);
  return quantities;
}

Resistance constant_drag(double drag) {
  return [drag](const Particles& p) -> Eigen::MatrixXd {
    const auto size = static_cast<Eigen::Index>(p.count() * motion_components(p.dimension));
    return drag * Eigen::MatrixXd::Identity(size, size);
  };
}

FluidSimulation InFluid::simulation(Resistance resistance) {
  auto solver = std::make_unique<StandInFluid>(std::move(resistance));
  fluid = solver.get();
  return {setting, state, std::move(solver)};
}

InFluid in_fluid(int dimension, double width, double h, double threshold_gap) {
  InFluid system{{}, no_particles(dimension)};
  system.setting.time_step = h;
  system.setting.fluid.emplace();
  system.setting.fluid->viscosity = 1;
  system.setting.fluid->threshold_gap = threshold_gap;
  if (dimension == 1)
    system.setting.domain = CylinderDomain{width / 2, width};
  else
    system.setting.domain = BoxDomain{{0, 0}, {width, width}};
  return system;
}

void add_disc(InFluid& system, const Vector& at, double mass, const Vector& velocity) {
  add_particle(system.state, at, 0.1, mass, velocity);
  auto& p = system.state.particles;
  p.angles.push_back(0);
  p.angular_velocities.push_back(0);
  p.inertias.push_back(round_shape(2, 0.1).inertia(mass));
}

void add_pushed(InFluid& system, const Vector& position, double radius, double mass,
                const Vector& force) {
  const auto k = static_cast<std::int32_t>(system.state.particles.count());
  add_particle(system.state, position, radius, mass);
  system.setting.forces[k] = constant(force);
}

StepReport run(FluidSimulation& simulation, double end) {
  StepReport sum;
  while (simulation.state().time < end * (1 - 1e-12)) {
    const auto report = simulation.step(end);
    sum.residual = std::max(sum.residual, report.residual);
    sum.impulse_residual = std::max(sum.impulse_residual, report.impulse_residual);
    sum.iterations += report.iterations;
    sum.converged = sum.converged && report.converged;
    sum.contacts = std::max(sum.contacts, report.contacts);
  }
  return sum;
}

}  // namespace viscontact::particles
