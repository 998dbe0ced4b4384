// Forces, inertia and given motions of a step in a fluid, docs/physics.md (6.5).
#include "viscontact/immersed/step_equation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>
#include <variant>

#include "viscontact/immersed/contacts/fluid_contacts.hpp"
#include "viscontact/particles/state/rigid_bodies.hpp"

namespace viscontact::particles {
namespace {

/// Free choices of the equation of a step.
struct StepEquationTuning {
  // If drag and acceleration nearly cancel, their sum is nearly 0, and the share of the
  // acceleration means nothing, although the links of the particle may exert large forces that
  // cancel each other. The bound keeps the powers of such links finite. It changes only reported
  // powers.
  static constexpr double kLargestShare = 10;
  // Means over two steps of the same length differ by rounding errors.
  static constexpr double kSame = 1e-12;
};

/// Mass [M] or moment of inertia [M L^2] of each component. The mass of a rigid body is divided
/// among its members, and evenly what its moment of inertia exceeds that of these masses.
std::vector<double> masses_of(const Particles& p, const MotionLayout& layout) {
  std::vector<double> masses(p.count() * layout.components);
  for (std::size_t k = 0; k < p.count(); ++k) {
    for (std::size_t d = 0; d < layout.directions(); ++d)
      masses[k * layout.components + d] = p.masses[k];
    // A particle whose moment of inertia is not given is homogeneous.
    if (layout.components == 3)
      masses[k * 3 + 2] = p.inertias.empty() ? p.shape(k).inertia(p.masses[k]) : p.inertias[k];
  }
  for (const auto& body : p.bodies.bodies) {
    const auto shares = member_masses(body, p);
    double rest = body.inertia[8];
    for (std::size_t m = 0; m < shares.size(); ++m)
      rest -= shares[m] * dot(body.offsets[m], body.offsets[m]);
    for (std::size_t m = 0; m < shares.size(); ++m) {
      masses[layout.at(body.members[m], 0)] = masses[layout.at(body.members[m], 1)] = shares[m];
      masses[layout.at(body.members[m], 2)] =
          std::max(rest, 0.0) / static_cast<double>(shares.size());
    }
  }
  return masses;
}

/// The mean forces and torques between the times `from` and `to` [T]: weight minus buoyancy, and
/// those of the case and of the caller.
std::vector<double> mean_forces(const Setting& setting, const Particles& p,
                                std::span<const double> masses, const MotionLayout& layout,
                                double from, double to) {
  std::vector<double> forces(p.count() * layout.components);
  for (std::size_t k = 0; k < p.count(); ++k) {
    // Mass of the fluid that the particle displaces, whose weight is the buoyancy. In Stokes flow
    // the density is 0.
    const double displaced = setting.fluid->density * setting.fluid->size_of(p.shape(k), k);
    for (std::size_t d = 0; d < layout.directions(); ++d)
      forces[k * layout.components + d] =
          (masses[k * layout.components] - displaced) * setting.gravity[d];
  }
  for (const auto& [particle, force] : setting.forces) {
    const Vector mean = force.mean(from, to);
    for (std::size_t d = 0; d < layout.directions(); ++d) forces[layout.at(particle, d)] += mean[d];
  }
  if (layout.components == 3)
    for (const auto& [particle, torque] : setting.torques)
      forces[layout.at(particle, 2)] += torque.mean(from, to)[2];
  for (std::size_t k = 0; k < p.count(); ++k) {
    if (setting.given_motions.contains(static_cast<std::int32_t>(k))) continue;
    const Vector force = added_force(setting, k, p.dimension);
    for (std::size_t d = 0; d < layout.directions(); ++d)
      forces[k * layout.components + d] += force[d];
    if (layout.components == 3) forces[k * 3 + 2] += added_torque(setting, k, p.dimension)[2];
  }
  return forces;
}

/// True if the rate of an arm's length jumps at a time >= `from` and < `to` [T].
bool has_kink(const Arm& arm, double from, double to) {
  const auto* length = std::get_if<PiecewiseLinearLength>(&arm.length);
  if (length == nullptr) return false;
  const auto& points = length->points;
  const std::size_t n = points.size();
  // Rate of the length [L/T] in the interval that begins at point i. After the last point it is 0,
  // or, if the length is periodic, that until the first point of the next period.
  const auto rate_after = [&](std::size_t i) {
    if (i + 1 < n) return (points[i + 1][1] - points[i][1]) / (points[i + 1][0] - points[i][0]);
    if (!(length->period > 0)) return 0.0;
    return (points[0][1] - points[i][1]) / (points[0][0] + length->period - points[i][0]);
  };
  // Times of steps and of points differ by rounding errors.
  const double tiny = 1e-9 * (to - from);
  for (std::size_t i = 0; i < n; ++i) {
    const double before = i == 0 && !(length->period > 0) ? 0 : rate_after(i == 0 ? n - 1 : i - 1);
    const double after = rate_after(i);
    // Rates of points on one line differ by rounding errors.
    if (std::abs(after - before) <= 1e-9 * (std::abs(after) + std::abs(before))) continue;
    double time = points[i][0] + tiny;
    if (length->period > 0) time += length->period * std::ceil((from - time) / length->period);
    if (time >= from && time < to) return true;
  }
  return false;
}

}  // namespace

StepEquation::Window StepEquation::window(const Setting& setting, const State& state, double h,
                                          double next) {
  const double now = state.time;
  if (!setting.fluid->has_inertia() || state.steps == 0) return {now, now, next};
  const double from = now - state.earlier_step / 2;
  // t^n is the time after n steps. The velocity at t^1 is found from a difference of first order,
  // later velocities from differences of second order. The sum of the differences over all steps
  // contains the change of the velocity in the first step with the weight 3/2. The forces of the
  // first step are therefore means over the first 3/2 steps, from t^0 on, so that the forces of all
  // steps together have the whole impulse.
  return {state.steps == 1 ? now - state.earlier_step : from, from, now + h / 2};
}

StepEquation::StepEquation(const Setting& setting, const State& state, double h, double next)
    : setting_(setting),
      state_(state),
      h_(h),
      layout_{motion_components(state.particles.dimension)},
      masses_(masses_of(state.particles, layout_)),
      next_(next),
      window_(window(setting, state, h, next)),
      forces_(mean_forces(setting, state.particles, masses_, layout_, window_.from_of_forces,
                          window_.to)),
      in_contact_(state.particles.count(), 0) {
  assert(h > 0 && next > state.time);
  for (const auto& [particle, motion] : setting.given_motions)
    driven_.emplace(particle, given_motion(motion, window_.from, window_.to));
  for (const auto* pairs : {&state.pairs, &state.walls})
    for (const auto& pair : *pairs) {
      if (pair.impulse == 0 && !(pair.gamma < 0)) continue;
      in_contact_[index_of(pair.second)] = 1;
      if (pair.first >= 0) in_contact_[index_of(pair.first)] = 1;
    }
  // A hinge that rests at a stop is in contact. The tolerance is that of gaps, because steps keep
  // stops as exactly as gaps.
  const double touching = setting.solver.tolerance * mean_radius(state.particles);
  for (const auto& stop : contacts_of_stops(setting.links, state.particles))
    if (stop.gap <= touching) in_contact_[index_of(stop.second)] = 1;
  find_companions();
  spread_contact();
  add_inertia();
}

void StepEquation::add_inertia() {
  thetas_.assign(masses_.size(), 1);
  inertia_.assign(masses_.size(), 0);
  link_times_.clear();
  if (setting_.fluid->has_inertia()) return;
  for (std::size_t i = 0; i < masses_.size(); ++i) {
    if (!(masses_[i] > 0)) continue;
    thetas_[i] = theta(i / layout_.components, i % layout_.components, masses_[i]);
  }
  for (const auto& body : state_.particles.bodies.bodies) {
    const double theta = theta_of_body(body);
    for (const auto member : body.members)
      for (std::size_t d = 0; d < layout_.components; ++d) thetas_[layout_.at(member, d)] = theta;
  }
  for (std::size_t i = 0; i < masses_.size(); ++i)
    if (masses_[i] > 0) inertia_[i] = masses_[i] / (thetas_[i] * h_);
  for (std::size_t k = 0; k < state_.particles.count(); ++k) {
    const auto i = k * layout_.components;
    if (!(masses_[i] > 0) || is_driven(static_cast<std::int32_t>(k))) continue;
    link_times_.resize(state_.particles.count(), -1);
    const double theta = thetas_[i];
    // The angular momentum is kept if links act at the time (1 - theta) h of the step; with drag
    // the step is of second order if they act at h/2. The time is the mean of both with the weights
    // 2 (1 - theta), which is 1 without drag, and 2 theta - 1 (docs/physics.md (6.7)).
    const bool may_jump = in_contact_[k] != 0 || !(state_.earlier_step > 0);
    link_times_[k] = may_jump ? 0 : (0.5 - (2 * theta - 1) * (1 - theta)) * h_;
  }
}

void StepEquation::find_companions() {
  const auto& p = state_.particles;
  // Particles that move with each other form sets. set[k] is a particle of the set of k, and
  // set_of() follows these numbers to the particle whose number names the set.
  std::vector<std::int32_t> set(p.count());
  std::iota(set.begin(), set.end(), 0);
  const auto set_of = [&](std::int32_t k) {
    while (set[index_of(k)] != k) k = set[index_of(k)] = set[index_of(set[index_of(k)])];
    return k;
  };
  const auto unite = [&](std::int32_t first, std::int32_t second, bool jumps) {
    for (const auto& [one, other] : {std::pair(first, second), std::pair(second, first)})
      if (jumps || (is_driven(other) && has_jump(other))) in_contact_[index_of(one)] = 1;
    if (!is_driven(first) && !is_driven(second)) set[index_of(set_of(first))] = set_of(second);
  };
  for (const auto& body : p.bodies.bodies)
    for (const auto member : body.members) unite(body.members.front(), member, false);
  // If the rate of an arm's length jumps, the velocities of its ends jump as in a contact.
  for (const auto& arm : setting_.links.arms)
    unite(arm.first, arm.second,
          has_kink(arm, state_.time - state_.earlier_step, state_.time + h_));
  for (const auto& spring : setting_.links.springs) {
    // The ends of a spring whose oscillation the step cannot resolve, h^2 stiffness > mass, count
    // as moving with each other.
    const auto mass_of = [&](std::int32_t k) {
      const auto body = p.bodies.body_of(k);
      if (is_driven(k)) return std::numeric_limits<double>::infinity();
      return body < 0 ? p.masses[index_of(k)] : p.bodies.bodies[index_of(body)].mass;
    };
    const double mass = std::min(mass_of(spring.first), mass_of(spring.second));
    if (h_ * h_ * spring.stiffness > mass) unite(spring.first, spring.second, false);
  }
  std::map<std::int32_t, std::vector<std::int32_t>> sets;
  for (std::size_t k = 0; k < p.count(); ++k)
    sets[set_of(static_cast<std::int32_t>(k))].push_back(static_cast<std::int32_t>(k));
  for (auto& [name, particles] : sets)
    if (particles.size() > 1) companions_.push_back(std::move(particles));
}

void StepEquation::spread_contact() {
  for (const auto& particles : companions_)
    if (std::ranges::any_of(particles,
                            [&](std::int32_t k) { return in_contact_[index_of(k)] != 0; }))
      for (const auto k : particles) in_contact_[index_of(k)] = 1;
}

double StepEquation::earlier_drag(std::size_t k, std::size_t component) const {
  const auto &u = state_.earlier_velocities, &f = state_.earlier_forces;
  if (u.size() != masses_.size() || f.size() != masses_.size())
    return std::numeric_limits<double>::infinity();
  const bool turns = component == layout_.directions();
  const std::size_t first = k * layout_.components + (turns ? component : 0);
  double force = 0, speed = 0;
  for (std::size_t i = first; i < first + (turns ? 1 : layout_.directions()); ++i) {
    force += f[i] * f[i];
    speed += u[i] * u[i];
  }
  return speed > 0 ? std::sqrt(force / speed) : 0;
}

double StepEquation::theta_of_body(const RigidBody& body) const {
  // The rate of damping c/m [1/T] is estimated as the power of the drag in the step before over
  // twice the kinetic energy. The quotient lies between the rates of the least and of the most
  // damped motion of the body, and does not depend on the forces between its members.
  if (!(body.mass > 0) || in_contact_[index_of(body.members.front())] != 0) return 1;
  const auto &u = state_.earlier_velocities, &f = state_.earlier_forces;
  if (u.size() != masses_.size() || f.size() != masses_.size()) return 1;
  double power = 0, energy = 0;
  for (const auto member : body.members)
    for (std::size_t d = 0; d < layout_.components; ++d) {
      const auto i = layout_.at(member, d);
      power += f[i] * u[i];
      energy += masses_[i] * u[i] * u[i];
    }
  constexpr double kPi = std::numbers::pi;
  const double slowest = 4 * kPi * setting_.fluid->viscosity / body.mass;
  const double z = h_ * std::max(slowest, energy > 0 ? std::abs(power) / energy : 0);
  return std::isfinite(z) ? (1 + z) / (2 + z) : 1;
}

double StepEquation::stokes_drag(std::size_t k, std::size_t component) const {
  const double r = state_.particles.radii[k], mu = setting_.fluid->viscosity;
  constexpr double kPi = std::numbers::pi;
  // A disc that translates in an unbounded fluid has no drag in proportion to its velocity (Stokes'
  // paradox); 4 pi mu, of the right dimension, is taken in its place.
  if (layout_.components == 1) return 6 * kPi * mu * r;
  return component == 2 ? 4 * kPi * mu * r * r : 4 * kPi * mu;
}

double StepEquation::theta(std::size_t k, std::size_t component, double mass) const {
  if (in_contact_[k] != 0) return 1;
  const double z = h_ * std::max(stokes_drag(k, component), earlier_drag(k, component)) / mass;
  return std::isfinite(z) ? (1 + z) / (2 + z) : 1;
}

FluidParticles StepEquation::bodies() const {
  FluidParticles bodies{&state_.particles, state_.particles.angles, driven_, {}, flow_step()};
  if (std::ranges::any_of(inertia_, [](double x) { return x > 0; })) bodies.inertia = inertia_;
  return bodies;
}

FlowStep StepEquation::flow_step() const {
  if (!setting_.fluid->has_inertia()) return {};
  // The first step computes the velocity at its end, where the second step computes it again.
  constexpr std::int64_t kFirstOfOrder2 = 2;
  const bool is_first = !(state_.earlier_step > 0);
  const double length = is_first ? h_ : state_.earlier_step;
  const double before = state_.step_before > 0 ? state_.step_before : length;
  const int order = state_.steps >= kFirstOfOrder2 && !is_any_in_contact() &&
                            length <= kLargestRatioOfSteps * before
                        ? 2
                        : 1;
  return {order,        length,     before, is_first ? state_.time + h_ : state_.time,
          window_.from, window_.to, masses_};
}

double StepEquation::share_of_change() const {
  const bool is_first = !(state_.earlier_step > 0);
  if (is_first) return -0.5;
  return h_ <= kLargestRatioOfSteps * state_.earlier_step ? h_ / (2 * state_.earlier_step) : 0;
}

std::array<double, 3> StepEquation::given_in_step(std::int32_t driven) const {
  return given_motion(setting_.given_motions.at(driven), state_.time, next_);
}

std::vector<double> StepEquation::inertia_of_projection() const {
  if (!setting_.fluid->has_inertia()) return inertia_;
  auto inertia = masses_;
  for (auto& mass : inertia) mass /= h_;
  return inertia;
}

bool StepEquation::is_any_in_contact() const {
  return std::ranges::any_of(in_contact_, [](char c) { return c != 0; });
}

double StepEquation::velocity(std::size_t k, std::size_t component) const {
  const auto& p = state_.particles;
  return component < layout_.directions() ? p.velocities[k * layout_.directions() + component]
                                          : p.angular_velocities[k];
}

std::vector<double> StepEquation::velocities() const {
  std::vector<double> velocities(masses_.size());
  for (std::size_t i = 0; i < velocities.size(); ++i)
    velocities[i] = velocity(i / layout_.components, i % layout_.components);
  for (const auto& [k, motion] : driven_)
    for (std::size_t c = 0; c < layout_.components; ++c) velocities[layout_.at(k, c)] = motion[c];
  return velocities;
}

std::vector<double> StepEquation::right_side() const {
  auto forces = forces_;
  for (std::size_t i = 0; i < forces.size(); ++i)
    if (inertia_[i] > 0)
      forces[i] += inertia_[i] * velocity(i / layout_.components, i % layout_.components);
  for (const auto& body : state_.particles.bodies.bodies) {
    const auto first = body.members.front();
    if (link_times_.empty() || !(link_times_[index_of(first)] > 0)) continue;
    const Vector turn = h_ / 2 * body.angular_velocity;
    for (std::size_t m = 0; m < body.members.size(); ++m) {
      const Vector further = displacement_at({}, turn, present_offset(body, m, 2), 2);
      const Vector force{forces_[layout_.at(body.members[m], 0)],
                         forces_[layout_.at(body.members[m], 1)], 0};
      forces[layout_.at(first, 2)] += cross(further, force)[2];
    }
  }
  return forces;
}

std::vector<double> StepEquation::velocities_at_end(std::span<const double> motions,
                                                    std::span<const double> flow) const {
  assert(motions.size() == masses_.size() && flow.size() == masses_.size());
  std::vector<double> velocities(flow.begin(), flow.end());
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    const auto k = i / layout_.components;
    if (inertia_[i] == 0 || is_driven(static_cast<std::int32_t>(k))) continue;
    const double before = velocity(k, i % layout_.components);
    velocities[i] = thetas_[i] == 1 ? motions[i] : before + (motions[i] - before) / thetas_[i];
  }
  return velocities;
}

std::vector<double> StepEquation::velocities_of_work(std::span<const double> flow,
                                                     std::span<const double> at_end,
                                                     std::span<const double> drag) const {
  assert(flow.size() == masses_.size() && at_end.size() == flow.size());
  std::vector<double> velocities(flow.begin(), flow.end());
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    const auto k = i / layout_.components;
    if (inertia_[i] == 0 || is_driven(static_cast<std::int32_t>(k))) continue;
    const double before = velocity(k, i % layout_.components);
    const double accelerating = masses_[i] / h_ * (at_end[i] - before);
    const double all = accelerating + drag[i];
    const double share = all != 0
                             ? std::clamp(accelerating / all, -StepEquationTuning::kLargestShare,
                                          StepEquationTuning::kLargestShare)
                             : 0;
    velocities[i] += share * ((before + at_end[i]) / 2 - flow[i]);
  }
  return velocities;
}

std::vector<double> StepEquation::mobility_of_step() const {
  std::vector<double> mobility(masses_.size());
  for (std::size_t i = 0; i < mobility.size(); ++i) {
    const auto k = i / layout_.components;
    if (is_driven(static_cast<std::int32_t>(k))) continue;
    mobility[i] = masses_[i] > 0 ? h_ / masses_[i] : 1 / stokes_drag(k, i % layout_.components);
  }
  return mobility;
}

std::vector<double> StepEquation::largest_mobility() const {
  auto mobility = mobility_of_step();
  for (std::size_t i = 0; i < mobility.size(); ++i)
    mobility[i] =
        std::min(mobility[i], 1 / stokes_drag(i / layout_.components, i % layout_.components));
  return mobility;
}

bool StepEquation::put_in_contact(std::span<const Contact<2>> contacts) {
  const auto before = thetas_;
  const bool was_any = is_any_in_contact();
  for (const auto& contact : contacts) {
    if (contact.impulse == 0) continue;
    for (const auto k : {contact.first, contact.second})
      if (k >= 0 && !is_driven(k)) in_contact_[index_of(k)] = 1;
  }
  spread_contact();
  add_inertia();
  return thetas_ != before || (setting_.fluid->has_inertia() && !was_any && is_any_in_contact());
}

std::array<double, 3> StepEquation::given_motion(const GivenMotion& motion, double from,
                                                 double to) const {
  const Vector velocity = motion.velocity.mean(from, to);
  if (layout_.components == 1) return {velocity[0], 0, 0};
  return {velocity[0], velocity[1], motion.angular_velocity.mean(from, to)[2]};
}

bool StepEquation::has_jump(std::int32_t driven) const {
  // In the first step theta = 1 in any case.
  if (!(state_.earlier_step > 0)) return false;
  const double before = std::max(0.0, state_.time - state_.earlier_step);
  const auto earlier = given_motion(setting_.given_motions.at(driven), before, state_.time);
  const auto& now = driven_.at(driven);
  for (std::size_t d = 0; d < 3; ++d)
    if (std::abs(now[d] - earlier[d]) >
        StepEquationTuning::kSame * (std::abs(now[d]) + std::abs(earlier[d])))
      return true;
  return false;
}

bool StepEquation::drives_as_before() const {
  for (const auto& arm : setting_.links.arms)
    if (has_kink(arm, state_.time - state_.earlier_step, state_.time + h_)) return false;
  return std::ranges::none_of(setting_.given_motions,
                              [&](const auto& given) { return has_jump(given.first); });
}

}  // namespace viscontact::particles
