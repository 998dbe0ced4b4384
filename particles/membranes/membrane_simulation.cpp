// Time stepping of membranes (membrane_simulation.hpp). Restarts must give the same bits, so a step
// may depend on nothing but the setting and the state.
#include "viscontact/particles/membranes/membrane_simulation.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <chrono>
#include <cmath>
#include <functional>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/fluid/fluid_contacts.hpp"
#include "viscontact/particles/membranes/membrane_motion.hpp"
#include "viscontact/particles/neighbours/neighbour_list.hpp"
#include "viscontact/particles/steps/step_residuals.hpp"
#include "viscontact/particles/steps/step_times.hpp"

namespace viscontact::particles {
namespace {

constexpr std::size_t kComponents = 3;  // of the motion of a particle in the plane

}  // namespace

/// Keeps Eigen out of the header.
class MembraneSimulation::Implementation {
 public:
  Implementation(Setting setting, State state, std::unique_ptr<FluidSolver> solver);
  StepReport step(double end);
  FlowField flow_at(const State& state);
  const State& state() const { return state_; }
  const State& before_step() const { return before_step_; }  ///< the state before the last step
  const FluidSolver& solver() const { return *solver_; }

 private:
  void check_shapes() const;
  void place(const Eigen::VectorXd& positions);
  FluidAnswer ask(const Eigen::VectorXd& positions);
  StepContacts solve_contacts_of(const Eigen::VectorXd& free, double h, double next,
                                 const std::function<Eigen::MatrixXd()>& response,
                                 StepReport& report);
  void remember(StepContacts contacts, double h, StepReport& report);

  Setting setting_;
  State state_, before_step_;
  std::unique_ptr<FluidSolver> solver_;
  Membranes membranes_;
  ThreadPool pool_;
  std::vector<Plane> obstacles_;
  std::vector<double> impulse_errors_;  // of the contacts of the step
};

MembraneSimulation::Implementation::Implementation(Setting setting, State state,
                                                   std::unique_ptr<FluidSolver> solver)
    : setting_(std::move(setting)),
      state_(std::move(state)),
      solver_(std::move(solver)),
      membranes_(setting_.fluid->membranes),
      pool_(1),
      obstacles_(obstacles_of(setting_)) {
  auto& film = setting_.laws.film;
  film.shape = FilmShape::kDiscs;
  film.begins_at = setting_.fluid->threshold_gap;
  auto& p = state_.particles;
  p.cell = cell_of(setting_);
  p.angles.resize(p.count());
  p.angular_velocities.resize(p.count());
  wrap_into_cell(state_);
  if (state_.steps > 0) {
    check_shapes();
    return;
  }
  const auto positions = membranes_.places(p.positions, p.cell);
  const auto motion = membranes_.motion_at(positions, ask(positions));
  membranes_.to_particles(motion.velocities, 2, p.velocities);
  state_.earlier_forces.assign(kComponents * p.count(), 0);
  membranes_.to_particles(motion.forces, kComponents, state_.earlier_forces);
}

/// Throws Error(kBadInput) if the membranes of a state from a file have other perimeters or areas
/// than the case. Those of a run are kept to rounding errors.
void MembraneSimulation::Implementation::check_shapes() const {
  constexpr double kKept = 1e-6;
  const auto& p = state_.particles;
  const auto& membranes = setting_.fluid->membranes;
  for (std::size_t m = 0; m < membranes.size(); ++m) {
    const auto& asked = membranes[m];
    const auto found = measure(asked, p.cell, p.positions, p.velocities);
    if (std::abs(found.perimeter - asked.perimeter) <= kKept * asked.perimeter &&
        std::abs(found.area - asked.area) <= kKept * asked.area)
      continue;
    throw Error(ErrorKind::kBadInput,
                fmt::format("membrane {} of the restart file has the perimeter {:.7g} and the area "
                            "{:.7g}, that of the case {:.7g} and {:.7g}; both must be the same",
                            m, found.perimeter, found.area, asked.perimeter, asked.area));
  }
}

void MembraneSimulation::Implementation::place(const Eigen::VectorXd& positions) {
  auto placed = state_.particles;
  membranes_.to_particles(positions, 2, placed.positions);
  solver_->place({.particles = &placed, .angles = placed.angles, .driven = {}, .inertia = {}});
}

/// The answer of the fluid with the beads at these positions.
FluidAnswer MembraneSimulation::Implementation::ask(const Eigen::VectorXd& positions) {
  place(positions);
  const auto n = positions.size();
  const auto size = kComponents * static_cast<std::size_t>(n) / 2;
  FluidAnswer answer;
  answer.flow =
      membranes_.from_particles(solver_->velocities(std::vector<double>(size), true), kComponents);
  const auto rows = solver_->mobility(size);
  Eigen::MatrixXd as_solved(n, n);
  // The forces on one bead after the other, without torques.
  for (std::size_t c = 0; c < 2; ++c)
    for (Eigen::Index k = 0; k < n / 2; ++k) {
      const auto row = (kComponents * static_cast<std::size_t>(k) + c) * size;
      const std::span<const double> numbers(rows.data() + row, size);
      as_solved.col(static_cast<Eigen::Index>(c) * (n / 2) + k) =
          membranes_.from_particles(numbers, kComponents);
    }
  // Rounding errors of the solutions are not symmetric.
  answer.mobility = (as_solved + as_solved.transpose()) / 2;
  return answer;
}

/// Solves the contacts of beads of different membranes, and of beads and walls, in a step of length
/// h that ends at `next`, in which beads have the velocities `free` without contact. `response()`
/// gives how displacements change per load on the beads.
StepContacts MembraneSimulation::Implementation::solve_contacts_of(
    const Eigen::VectorXd& free, double h, double next,
    const std::function<Eigen::MatrixXd()>& response, StepReport& report) {
  const auto size = kComponents * state_.particles.count();
  std::vector<double> velocities(size);
  membranes_.to_particles(free, kComponents, velocities);
  Eigen::MatrixXd matrix;
  const Mobility mobility = [&](std::span<const double> loads) {
    if (matrix.size() == 0) matrix = response() / h;
    std::vector<double> moved(size);
    membranes_.to_particles(matrix * membranes_.from_particles(loads, kComponents), kComponents,
                            moved);
    return moved;
  };
  const auto is_left_out = [&](const Pair& pair) {
    return pair.first >= 0 && setting_.fluid->are_of_one_membrane(pair.first, pair.second);
  };
  constexpr double kErrorOfAnswers = 1e-9;
  const double radius = mean_radius(state_.particles);
  const ContactConditions conditions{velocities,      h,      MotionLayout{kComponents},
                                     setting_.solver, radius, kErrorOfAnswers};
  auto contacts = solve_contacts(state_, *setting_.fluid, {}, positions_of(obstacles_, next),
                                 is_left_out, mobility, conditions, pool_);
  const auto residuals = measure_residuals(contacts.contacts, contacts.velocities, conditions);
  refuse_deep_overlap(residuals, state_.particles, setting_, radius, report.time, [] {
    return "is the time step too long for the flow, or do walls leave the membranes too little "
           "room?";
  });
  report.iterations = contacts.iterations;
  report.converged = contacts.is_solved;
  report_residuals(residuals, radius, report);
  impulse_errors_ = residuals.impulse_errors;
  return contacts;
}

/// Takes the impulses of contacts over into the memory of the pairs.
void MembraneSimulation::Implementation::remember(StepContacts contacts, double h,
                                                  StepReport& report) {
  state_.pairs = std::move(contacts.pairs);
  state_.walls = std::move(contacts.walls);
  std::size_t c = 0;
  for (auto* pairs : {&state_.pairs, &state_.walls})
    for (auto& pair : *pairs) {
      const auto& contact = contacts.contacts[c];
      pair.impulse = contact.impulse;
      if (contact.w > 0) {
        ++report.contacts;
        setting_.laws.remember(pair, state_.memories, radii_of(pair, state_.particles, obstacles_),
                               impulse_errors_[c], h);
      }
      if (pair.gamma < 0) ++report.glued;
      ++c;
    }
  state_.memories.keep_only(state_.pairs, state_.walls);
}

StepReport MembraneSimulation::Implementation::step(double end) {
  const auto interval = StepGrid(setting_.time_step).next(state_, end);
  if (!interval) return {.time = state_.time, .parts = 1};
  const auto began = std::chrono::steady_clock::now();
  const double h = interval->h;
  const auto& cell = state_.particles.cell;
  const auto now = membranes_.places(state_.particles.positions, cell);
  Eigen::VectorXd at = now, from = now;
  double time = h;
  if (!state_.earlier_positions.empty()) {
    const auto before = membranes_.places(state_.earlier_positions, cell, &now);
    const double r = h / state_.earlier_step, weight = (1 + 2 * r) / (1 + r);
    at = (1 + r) * now - r * before;
    from = ((1 + r) * now - r * r / (1 + r) * before) / weight;
    time = h / weight;
  }
  const auto answer = ask(at);
  const Eigen::VectorXd no_loads = Eigen::VectorXd::Zero(now.size());
  Eigen::VectorXd positions = at;
  auto motion = membranes_.step(from, time, answer, no_loads, positions);
  StepReport report{.time = interval->end, .parts = 1};
  auto contacts = solve_contacts_of(
      (positions - now) / h, h, interval->end,
      [&] { return membranes_.response(time, answer, motion, positions); }, report);
  const auto loads = membranes_.from_particles(contacts.loads, kComponents);
  if (loads.squaredNorm() > 0) motion = membranes_.step(from, time, answer, loads, positions);
  auto forces = state_.earlier_forces;
  membranes_.to_particles(motion.flow_forces, kComponents, forces);
  solver_->velocities(forces, true);
  membranes_.to_particles(motion.forces, kComponents, forces);
  const auto quantities = solver_->quantities();
  report.fluid.dissipation = quantities.dissipation;
  report.fluid.apparent_viscosity = quantities.apparent_viscosity;

  before_step_ = state_;
  remember(std::move(contacts), h, report);
  state_.earlier_positions = state_.particles.positions;
  state_.earlier_forces = std::move(forces);
  state_.earlier_step = h;
  membranes_.to_particles(positions, 2, state_.particles.positions);
  membranes_.to_particles(motion.velocities, 2, state_.particles.velocities);
  state_.time = interval->end;
  wrap_into_cell(state_);
  StepGrid::count(state_, *interval);
  report.fluid.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return report;
}

FlowField MembraneSimulation::Implementation::flow_at(const State& state) {
  place(membranes_.places(state.particles.positions, state.particles.cell));
  solver_->velocities(state.earlier_forces, true);
  return solver_->flow();
}

MembraneSimulation::MembraneSimulation(Setting setting, State state,
                                       std::unique_ptr<FluidSolver> solver)
    : implementation_(std::make_unique<Implementation>(std::move(setting), std::move(state),
                                                       std::move(solver))) {}

MembraneSimulation::~MembraneSimulation() = default;

StepReport MembraneSimulation::step(double end) { return implementation_->step(end); }

const State& MembraneSimulation::state() const { return implementation_->state(); }

FlowField MembraneSimulation::flow() {
  return implementation_->flow_at(implementation_->before_step());
}

FlowField MembraneSimulation::flow_at_present() {
  return implementation_->flow_at(implementation_->state());
}

std::vector<double> MembraneSimulation::fluid_forces() const {
  auto forces = state().earlier_forces;
  for (auto& force : forces) force = -force;
  return forces;
}

std::size_t MembraneSimulation::unknowns() const { return implementation_->solver().unknowns(); }

double MembraneSimulation::solver_peak_memory_mebibytes() const {
  return implementation_->solver().peak_memory_mebibytes();
}

}  // namespace viscontact::particles
