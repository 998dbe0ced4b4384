// Steps of membranes and rigid discs in a Stokes flow, docs/physics.md (8.6). A step depends on the
// setting and the state only, so that a run from a restart file gives the same bits.
#include "viscontact/immersed/membrane_simulation.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <functional>
#include <utility>

#include "viscontact/immersed/contacts/closed_contacts.hpp"
#include "viscontact/immersed/contacts/fluid_contacts.hpp"
#include "viscontact/membranes/membrane_motion.hpp"
#include "viscontact/membranes/membrane_shape.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/neighbours/neighbour_list.hpp"
#include "viscontact/particles/steps/step_times.hpp"

namespace viscontact::particles {
namespace {

[[noreturn]] void refuse_added_forces() {
  throw Error(ErrorKind::kWrongUsage,
              "membranes in a fluid take no forces of the caller; give forces in the case");
}

constexpr std::size_t kComponents = 3;  // of a particle: x, y and turn

}  // namespace

/// The simulation itself. It is declared here so that the header needs no Eigen.
class MembraneSimulation::Implementation {
 public:
  Implementation(Setting setting, State state, std::unique_ptr<FluidSolver> solver);
  StepReport step(double end);
  /// The flow around the particles of a state, under the forces of the step that led to it.
  FlowField flow_at(const State& state);
  const State& state() const { return state_; }
  const State& before_step() const { return before_step_; }
  const FluidSolver& solver() const { return *solver_; }

 private:
  // The Eigen vectors of this class hold places [L, rad], velocities [L/T, 1/T], or forces and
  // torques [M L/T^2, M L^2/T^2]: first x of all beads, then y of all beads, and then x, y and the
  // angle of each disc. The discs are the particles that are no beads. Places are relative to
  // origin_, so that lengths and areas of membranes far from the origin of the case are exact.
  Eigen::Index bead_components() const { return 2 * membranes_.beads(); }
  /// Places from `positions` [L] of all particles. If `near` is not null and the domain is
  /// periodic, each disc and the first bead of each membrane are taken at the image nearest to
  /// their place in `near`, and every other bead at its image nearest to the bead before it.
  Eigen::VectorXd places(std::span<const double> positions,
                         const Eigen::VectorXd* near = nullptr) const;
  // `numbers` are kComponents for each particle; the third number of a bead stays as it is.
  Eigen::VectorXd from_particles(std::span<const double> numbers) const;
  void to_particles(const Eigen::VectorXd& all, std::vector<double>& numbers) const;
  void to_particles(const Eigen::VectorXd& all, std::vector<double>& of_centres,
                    std::vector<double>& of_turns) const;
  /// Sets the positions and angles of all particles.
  void put_places(const Eigen::VectorXd& places, Particles& particles) const;
  // Means between the times `from` and `to` [T], or, if these are equal, values at this time.
  Eigen::VectorXd applied_forces(double from, double to) const;
  void place(const Eigen::VectorXd& places, double from, double to);
  /// The velocities without forces, and the mobility, with walls and driven discs at rest: [T/M]
  /// for centres, and one [1/L] more for each turn or torque.
  FluidAnswer ask(const Eigen::VectorXd& places, double from, double to);
  /// The part of `answer` for the beads, with the velocities that the `loads` on the discs cause.
  FluidAnswer answer_to_beads(const FluidAnswer& answer, const Eigen::VectorXd& loads) const;
  Eigen::VectorXd velocities_of_all(const FluidAnswer& answer, const MembraneMotion& motion,
                                    const Eigen::VectorXd& loads) const;
  /// Change of the places at the end of a step per force: a symmetric matrix [T^2/M], and one [1/L]
  /// more for each turn or torque. `time`, `motion` and `positions` are those of Membranes::step(),
  /// `loads` the forces in this step.
  Eigen::MatrixXd response(double time, const FluidAnswer& answer, const Eigen::VectorXd& loads,
                           const MembraneMotion& motion, const Eigen::VectorXd& positions) const;
  /// Places of the discs at the end of a step of length `h` [T] from the places `now`.
  Eigen::VectorXd moved_discs(const Eigen::VectorXd& now, const Eigen::VectorXd& from, double time,
                              const Eigen::VectorXd& velocities, double h) const;
  /// Solves the contacts of a step of length `h` [T] that ends at the time `next` [T]. `free` are
  /// the mean velocities without contacts. Enters iterations and residuals in `report`. Throws
  /// Error(kNotConverged) if an overlap of more than the mean radius would remain.
  StepContacts solve_contacts_of(const Eigen::VectorXd& free, double h, double next,
                                 const std::function<Eigen::MatrixXd()>& response,
                                 StepReport& report);
  void remember(StepContacts contacts, double h, StepReport& report);

  Setting setting_;
  State state_, before_step_;
  std::unique_ptr<FluidSolver> solver_;
  Membranes membranes_;
  Vector origin_;                    // distant_corner() of the domain [L]
  std::vector<std::int32_t> discs_;  // the particles that are no beads
  ThreadPool pool_;
  std::vector<Plane> obstacles_;
  std::vector<double> impulse_errors_;  // residual impulse of each contact of the step [M L/T]
};

MembraneSimulation::Implementation::Implementation(Setting setting, State state,
                                                   std::unique_ptr<FluidSolver> solver)
    : setting_(std::move(setting)),
      state_(std::move(state)),
      solver_(std::move(solver)),
      membranes_(setting_.fluid->membranes),
      origin_(distant_corner(setting_.domain)),
      pool_(1),
      obstacles_(obstacles_of(setting_)) {
  assert(solver_ != nullptr && !setting_.fluid->membranes.empty());
  auto& film = setting_.laws.film;
  film.shape = FilmShape::kDiscs;
  film.begins_at = setting_.fluid->threshold_gap;
  auto& p = state_.particles;
  state_.impact_impulses = {};  // a restart file of a run without a fluid may have impacts
  p.cell = cell_of(setting_);
  p.angles.resize(p.count());
  p.angular_velocities.resize(p.count());
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(p.count()); ++k)
    if (std::ranges::none_of(setting_.fluid->membranes,
                             [&](const Membrane& membrane) { return membrane.has(k); }))
      discs_.push_back(k);
  wrap_into_cell(state_);
  if (state_.steps > 0) {
    check_shapes(setting_.fluid->membranes, p);
    return;
  }
  const auto at = places(p.positions);
  const auto answer = ask(at, state_.time, state_.time);
  const auto loads = applied_forces(state_.time, state_.time);
  auto of_beads = answer_to_beads(answer, loads);
  of_beads.flow += of_beads.mobility * loads.head(bead_components());
  auto motion = membranes_.motion_at(at.head(bead_components()), of_beads);
  motion.forces += loads.head(bead_components());
  motion.flow_forces = motion.forces;
  to_particles(velocities_of_all(answer, motion, loads), state_.particles.velocities,
               state_.particles.angular_velocities);
  Eigen::VectorXd forces = loads;
  forces.head(bead_components()) = motion.forces;
  state_.earlier_forces.assign(kComponents * p.count(), 0);
  to_particles(forces, state_.earlier_forces);
}

Eigen::VectorXd MembraneSimulation::Implementation::places(std::span<const double> positions,
                                                           const Eigen::VectorXd* near) const {
  const auto& p = state_.particles;
  const auto beads = bead_components();
  Eigen::VectorXd places(beads + static_cast<Eigen::Index>(kComponents * discs_.size()));
  std::vector<double> relative(positions.begin(), positions.end());
  for (std::size_t i = 0; i < relative.size(); ++i) relative[i] -= origin_[i % 2];
  const Eigen::VectorXd near_beads = near != nullptr ? near->head(beads) : Eigen::VectorXd();
  places.head(beads) = membranes_.places(relative, p.cell, near != nullptr ? &near_beads : nullptr);
  auto i = beads;
  for (const auto disc : discs_) {
    for (std::size_t d = 0; d < 2; ++d, ++i) {
      places(i) = relative[2 * index_of(disc) + d];
      const double period = p.cell.lengths[d];
      if (near != nullptr && period > 0)
        places(i) -= period * std::round((places(i) - (*near)(i)) / period);
    }
    places(i++) = p.angles[index_of(disc)];
  }
  return places;
}

Eigen::VectorXd MembraneSimulation::Implementation::from_particles(
    std::span<const double> numbers) const {
  assert(numbers.size() == kComponents * state_.particles.count());
  const auto beads = bead_components();
  Eigen::VectorXd all(beads + static_cast<Eigen::Index>(kComponents * discs_.size()));
  all.head(beads) = membranes_.from_particles(numbers, kComponents);
  auto i = beads;
  for (const auto disc : discs_)
    for (std::size_t d = 0; d < kComponents; ++d)
      all(i++) = numbers[kComponents * index_of(disc) + d];
  return all;
}

void MembraneSimulation::Implementation::to_particles(const Eigen::VectorXd& all,
                                                      std::vector<double>& numbers) const {
  assert(numbers.size() == kComponents * state_.particles.count());
  membranes_.to_particles(all.head(bead_components()), kComponents, numbers);
  auto i = bead_components();
  for (const auto disc : discs_)
    for (std::size_t d = 0; d < kComponents; ++d)
      numbers[kComponents * index_of(disc) + d] = all(i++);
}

void MembraneSimulation::Implementation::to_particles(const Eigen::VectorXd& all,
                                                      std::vector<double>& of_centres,
                                                      std::vector<double>& of_turns) const {
  membranes_.to_particles(all.head(bead_components()), 2, of_centres);
  auto i = bead_components();
  for (const auto disc : discs_) {
    of_centres[2 * index_of(disc)] = all(i++);
    of_centres[2 * index_of(disc) + 1] = all(i++);
    of_turns[index_of(disc)] = all(i++);
  }
}

void MembraneSimulation::Implementation::put_places(const Eigen::VectorXd& places,
                                                    Particles& particles) const {
  to_particles(places, particles.positions, particles.angles);
  for (std::size_t i = 0; i < particles.positions.size(); ++i)
    if (origin_[i % 2] != 0) particles.positions[i] += origin_[i % 2];
}

Eigen::VectorXd MembraneSimulation::Implementation::applied_forces(double from, double to) const {
  std::vector<double> forces(kComponents * state_.particles.count());
  for (const auto& [particle, force] : setting_.forces) {
    const Vector value = to > from ? force.mean(from, to) : force.value(from);
    for (std::size_t d = 0; d < 2; ++d) forces[kComponents * index_of(particle) + d] = value[d];
  }
  return from_particles(forces);
}

void MembraneSimulation::Implementation::place(const Eigen::VectorXd& places, double from,
                                               double to) {
  auto placed = state_.particles;
  put_places(places, placed);
  FluidParticles bodies{.particles = &placed, .angles = placed.angles, .driven = {}, .inertia = {}};
  for (const auto& [particle, motion] : setting_.given_motions) {
    const auto at = [&](const PiecewiseConstant& of) {
      return to > from ? of.mean(from, to) : of.value(from);
    };
    const Vector velocity = at(motion.velocity);
    bodies.driven[particle] = {velocity[0], velocity[1], at(motion.angular_velocity)[2]};
  }
  solver_->place(bodies);
}

FluidAnswer MembraneSimulation::Implementation::ask(const Eigen::VectorXd& places, double from,
                                                    double to) {
  place(places, from, to);
  const auto n = places.size();
  const auto size = kComponents * state_.particles.count();
  FluidAnswer answer;
  answer.flow = from_particles(solver_->velocities(std::vector<double>(size), true));
  const auto rows = solver_->mobility(size);
  // The numbers of rows in the solver, in the order of the arrays of this class.
  std::vector<double> numbers(size);
  for (std::size_t i = 0; i < size; ++i) numbers[i] = static_cast<double>(i);
  const auto order = from_particles(numbers);
  Eigen::MatrixXd as_solved(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    as_solved.col(i) =
        from_particles({rows.data() + static_cast<std::size_t>(order(i)) * size, size});
  // Symmetric but for rounding errors.
  answer.mobility = (as_solved + as_solved.transpose()) / 2;
  return answer;
}

FluidAnswer MembraneSimulation::Implementation::answer_to_beads(
    const FluidAnswer& answer, const Eigen::VectorXd& loads) const {
  const auto b = bead_components(), d = answer.flow.size() - b;
  return {answer.flow.head(b) + answer.mobility.topRightCorner(b, d) * loads.tail(d),
          answer.mobility.topLeftCorner(b, b)};
}

Eigen::VectorXd MembraneSimulation::Implementation::velocities_of_all(
    const FluidAnswer& answer, const MembraneMotion& motion, const Eigen::VectorXd& loads) const {
  const auto b = bead_components(), d = answer.flow.size() - b;
  Eigen::VectorXd velocities(b + d);
  velocities << motion.velocities, answer.flow.tail(d) +
                                       answer.mobility.bottomLeftCorner(d, b) * motion.flow_forces +
                                       answer.mobility.bottomRightCorner(d, d) * loads.tail(d);
  return velocities;
}

Eigen::MatrixXd MembraneSimulation::Implementation::response(
    double time, const FluidAnswer& answer, const Eigen::VectorXd& loads,
    const MembraneMotion& motion, const Eigen::VectorXd& positions) const {
  const auto b = bead_components(), n = answer.flow.size();
  const Eigen::MatrixXd moves = time * answer.mobility;
  const FluidAnswer of_beads{answer.flow.head(b), answer.mobility.topLeftCorner(b, b)};
  const auto changes =
      membranes_.response(time, of_beads, loads.head(b), motion, positions, moves.topRows(b));
  Eigen::MatrixXd response(n, n);
  response.topRows(b) = changes.positions;
  response.bottomRows(n - b) =
      moves.bottomRows(n - b) + moves.bottomLeftCorner(n - b, b) * changes.forces;
  // The mean removes rounding errors.
  return (response + response.transpose()) / 2;
}

Eigen::VectorXd MembraneSimulation::Implementation::moved_discs(const Eigen::VectorXd& now,
                                                                const Eigen::VectorXd& from,
                                                                double time,
                                                                const Eigen::VectorXd& velocities,
                                                                double h) const {
  // Free discs move by the backward difference of second order, driven ones by their mean
  // velocities. Angles are integrated by the trapezoidal rule.
  const auto b = bead_components();
  Eigen::VectorXd moved = (from + time * velocities).tail(now.size() - b);
  for (std::size_t j = 0; j < discs_.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(kComponents * j);
    const bool is_driven = setting_.given_motions.contains(discs_[j]);
    if (is_driven) moved.segment(i, 2) = now.segment(b + i, 2) + h * velocities.segment(b + i, 2);
    const double before = is_driven ? velocities(b + i + 2)
                                    : state_.particles.angular_velocities[index_of(discs_[j])];
    moved(i + 2) = now(b + i + 2) + h * (before + velocities(b + i + 2)) / 2;
  }
  return moved;
}

StepContacts MembraneSimulation::Implementation::solve_contacts_of(
    const Eigen::VectorXd& free, double h, double next,
    const std::function<Eigen::MatrixXd()>& response, StepReport& report) {
  const auto size = kComponents * state_.particles.count();
  std::vector<double> velocities(size);
  to_particles(free, velocities);
  Eigen::MatrixXd matrix;
  const Mobility mobility = [&](std::span<const double> loads) {
    if (matrix.size() == 0) matrix = response() / h;
    std::vector<double> moved(size);
    to_particles(matrix * from_particles(loads), moved);
    return moved;
  };
  const auto is_left_out = [&](const Pair& pair) {
    const auto is_driven = [&](std::int32_t k) {
      return k < 0 || setting_.given_motions.contains(k);
    };
    return (is_driven(pair.first) && is_driven(pair.second)) ||
           (pair.first >= 0 && setting_.fluid->are_of_one_membrane(pair.first, pair.second));
  };
  // kError in error_of_answers(), where its reason is given.
  constexpr double kErrorOfAnswers = 1e-9;
  const double radius = mean_radius(state_.particles);
  const ContactConditions conditions{velocities,      h,      MotionLayout{kComponents},
                                     setting_.solver, radius, kErrorOfAnswers};
  auto contacts = solve_contacts(state_, *setting_.fluid, {}, positions_of(obstacles_, next),
                                 is_left_out, mobility, conditions, pool_);
  auto residuals = measure_residuals(contacts.contacts, contacts.velocities, conditions);
  take_errors_of_impulses(contacts, 0, contacts.velocities, conditions, residuals);
  refuse_deep_overlap(residuals, state_.particles, setting_, radius, report.time, [] {
    return "is the time step too long for the flow, or do walls leave the membranes too little "
           "room?";
  });
  report.iterations = contacts.iterations;
  report.solver_stages = text_of(contacts.stages);
  report.converged = contacts.is_solved;
  report_residuals(residuals, radius, report);
  impulse_errors_ = residuals.impulse_errors;
  return contacts;
}

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
  if (!interval) return {.time = state_.time};
  const auto began = std::chrono::steady_clock::now();
  const double h = interval->h;
  const auto now = places(state_.particles.positions);
  Eigen::VectorXd at = now, from = now;
  double time = h;
  // The fluid solver is asked at the places `at`, which are extrapolated to the end of the step.
  // The places at the end are `from` + `time` times the velocities there, the backward difference
  // of second order; the first step is of first order. r is the ratio of this step to the one
  // before.
  if (!state_.earlier_positions.empty()) {
    const auto before = places(state_.earlier_positions, &now);
    const double r = h / state_.earlier_step, weight = (1 + 2 * r) / (1 + r);
    at = (1 + r) * now - r * before;
    from = ((1 + r) * now - r * r / (1 + r) * before) / weight;
    time = h / weight;
  }
  const auto beads = bead_components();
  const auto answer = ask(at, state_.time, interval->end);
  Eigen::VectorXd loads = applied_forces(state_.time, interval->end);
  Eigen::VectorXd positions = at.head(beads), reached = now, velocities;
  MembraneMotion motion;
  const auto move = [&] {
    motion = membranes_.step(from.head(beads), time, answer_to_beads(answer, loads),
                             loads.head(beads), positions);
    velocities = velocities_of_all(answer, motion, loads);
    reached << positions, moved_discs(now, from, time, velocities, h);
  };
  move();
  StepReport report{.time = interval->end, .parts = 1};
  auto contacts =
      solve_contacts_of((reached - now) / h, h, interval->end,
                        [&] { return response(time, answer, loads, motion, positions); }, report);
  const auto of_contacts = from_particles(contacts.loads);
  if (of_contacts.squaredNorm() > 0) {
    loads += of_contacts;
    move();
  }
  auto forces = state_.earlier_forces;
  Eigen::VectorXd of_all = loads;
  of_all.head(beads) = motion.flow_forces;
  to_particles(of_all, forces);
  solver_->velocities(forces, true);
  of_all.head(beads) = motion.forces;
  to_particles(of_all, forces);
  const auto quantities = solver_->quantities();
  report.fluid.dissipation = quantities.dissipation;
  report.fluid.apparent_viscosity = quantities.apparent_viscosity;
  // The force that drives a disc is minus the force of the fluid on it.
  for (const auto& [particle, motion_of_disc] : setting_.given_motions)
    for (std::size_t d = 0; d < kComponents && !quantities.fluid_forces.empty(); ++d) {
      const auto i = kComponents * index_of(particle) + d;
      forces[i] = -quantities.fluid_forces[i];
    }

  before_step_ = state_;
  remember(std::move(contacts), h, report);
  state_.earlier_positions = state_.particles.positions;
  state_.earlier_forces = std::move(forces);
  state_.earlier_step = h;
  put_places(reached, state_.particles);
  to_particles(velocities, state_.particles.velocities, state_.particles.angular_velocities);
  state_.time = interval->end;
  wrap_into_cell(state_);
  StepGrid::count(state_, *interval);
  report.fluid.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return report;
}

FlowField MembraneSimulation::Implementation::flow_at(const State& state) {
  place(places(state.particles.positions), state.time, state.time);
  solver_->velocities(state.earlier_forces, true);
  return solver_->flow();
}

MembraneSimulation::MembraneSimulation(Setting setting, State state,
                                       std::unique_ptr<FluidSolver> solver)
    : implementation_(std::make_unique<Implementation>(std::move(setting), std::move(state),
                                                       std::move(solver))) {}

MembraneSimulation::~MembraneSimulation() = default;

StepReport MembraneSimulation::step(double end) { return implementation_->step(end); }

std::span<double> MembraneSimulation::added_forces() { refuse_added_forces(); }
std::span<double> MembraneSimulation::added_torques() { refuse_added_forces(); }

const State& MembraneSimulation::state() const { return implementation_->state(); }

FlowField MembraneSimulation::flow() {
  assert(implementation_->before_step().particles.count() > 0);
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
