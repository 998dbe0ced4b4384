// Time stepping of membranes (membrane_simulation.hpp). Restarts must give the same bits, so a step
// may depend on nothing but the setting and the state.
#include "viscontact/particles/membranes/membrane_simulation.hpp"

#include <chrono>
#include <cmath>
#include <utility>

#include "viscontact/particles/membranes/membrane_motion.hpp"
#include "viscontact/particles/steps/step_times.hpp"

namespace viscontact::particles {
namespace {

constexpr std::size_t kComponents = 3;  // of the motion of a particle in the plane

}  // namespace

MembraneSimulation::MembraneSimulation(Setting setting, State state,
                                       std::unique_ptr<FluidSolver> solver)
    : setting_(std::move(setting)),
      state_(std::move(state)),
      solver_(std::move(solver)),
      membranes_(std::make_unique<Membranes>(setting_.fluid->membranes)) {
  auto& p = state_.particles;
  p.cell = cell_of(setting_);
  p.angles.resize(p.count());
  p.angular_velocities.resize(p.count());
  if (state_.steps > 0) return;
  const auto positions = membranes_->from_particles(p.positions, 2);
  const auto motion = membranes_->motion_at(positions, ask(p.positions));
  membranes_->to_particles(motion.velocities, 2, p.velocities);
  state_.earlier_forces.assign(kComponents * p.count(), 0);
  membranes_->to_particles(motion.forces, kComponents, state_.earlier_forces);
}

MembraneSimulation::~MembraneSimulation() = default;

void MembraneSimulation::place(const std::vector<double>& positions) {
  auto placed = state_.particles;
  placed.positions = positions;
  solver_->place({.particles = &placed, .angles = placed.angles, .driven = {}, .inertia = {}});
}

/// The answer of the fluid with the beads at these positions.
FluidAnswer MembraneSimulation::ask(const std::vector<double>& positions) {
  place(positions);
  const auto size = kComponents * positions.size() / 2;
  FluidAnswer answer;
  answer.flow =
      membranes_->from_particles(solver_->velocities(std::vector<double>(size), true), kComponents);
  const auto rows = solver_->mobility(size);
  const auto n = 2 * membranes_->beads();
  Eigen::MatrixXd as_solved(n, n);
  // The forces on one bead after the other, without torques.
  for (std::size_t c = 0; c < 2; ++c)
    for (Eigen::Index k = 0; k < n / 2; ++k) {
      const auto row = (kComponents * static_cast<std::size_t>(k) + c) * size;
      const std::span<const double> numbers(rows.data() + row, size);
      as_solved.col(static_cast<Eigen::Index>(c) * (n / 2) + k) =
          membranes_->from_particles(numbers, kComponents);
    }
  // Rounding errors of the solutions are not symmetric.
  answer.mobility = (as_solved + as_solved.transpose()) / 2;
  return answer;
}

StepReport MembraneSimulation::step(double end) {
  const auto interval = StepGrid(setting_.time_step).next(state_, end);
  if (!interval) return {.time = state_.time, .parts = 1};
  const auto began = std::chrono::steady_clock::now();
  const double h = interval->h;
  const auto now = membranes_->from_particles(state_.particles.positions, 2);
  Eigen::VectorXd at = now, from = now;
  double time = h;
  if (!state_.earlier_positions.empty()) {
    const auto before = membranes_->from_particles(state_.earlier_positions, 2);
    const double r = h / state_.earlier_step, weight = (1 + 2 * r) / (1 + r);
    at = (1 + r) * now - r * before;
    from = ((1 + r) * now - r * r / (1 + r) * before) / weight;
    time = h / weight;
  }
  auto next = state_;
  auto& p = next.particles;
  membranes_->to_particles(at, 2, p.positions);
  const auto answer = ask(p.positions);
  Eigen::VectorXd positions = at;
  const auto motion = membranes_->step(from, time, answer, positions);
  membranes_->to_particles(positions, 2, p.positions);
  membranes_->to_particles(motion.velocities, 2, p.velocities);
  membranes_->to_particles(motion.forces, kComponents, next.earlier_forces);
  next.earlier_positions = state_.particles.positions;
  next.earlier_step = h;
  next.time = interval->end;
  StepGrid::count(next, *interval);
  StepReport report{.time = interval->end, .parts = 1};
  solver_->velocities(next.earlier_forces, true);
  const auto quantities = solver_->quantities();
  report.fluid.dissipation = quantities.dissipation;
  report.fluid.apparent_viscosity = quantities.apparent_viscosity;
  before_step_ = std::exchange(state_, std::move(next));
  wrap();
  report.fluid.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return report;
}

/// Brings membranes whose first bead has left the periods of the domain back into them.
void MembraneSimulation::wrap() {
  auto& p = state_.particles;
  for (const auto& membrane : setting_.fluid->membranes)
    for (std::size_t d = 0; d < 2; ++d) {
      const double period = p.cell.lengths[d];
      if (!(period > 0)) continue;
      const auto first = 2 * static_cast<std::size_t>(membrane.first) + d;
      const double shift = period * std::floor((p.positions[first] - p.cell.from[d]) / period);
      if (shift == 0) continue;
      for (std::size_t k = 0; k < static_cast<std::size_t>(membrane.beads); ++k) {
        p.positions[first + 2 * k] -= shift;
        state_.earlier_positions[first + 2 * k] -= shift;
      }
    }
}

FlowField MembraneSimulation::flow_at(const State& state) {
  place(state.particles.positions);
  solver_->velocities(state.earlier_forces, true);
  return solver_->flow();
}

std::vector<double> MembraneSimulation::fluid_forces() const {
  auto forces = state_.earlier_forces;
  for (auto& force : forces) force = -force;
  return forces;
}

}  // namespace viscontact::particles
