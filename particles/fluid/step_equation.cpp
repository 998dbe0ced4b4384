// Forces, inertia and given motions of a step (step_equation.hpp). Units are those of the case.
#include "viscontact/particles/fluid/step_equation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace viscontact::particles {
namespace {

std::vector<double> mean_forces(const Setting& setting, const Particles& p,
                                const MotionLayout& layout, double from, double to) {
  std::vector<double> forces(p.count() * layout.components);
  for (std::size_t k = 0; k < p.count(); ++k)
    for (std::size_t d = 0; d < layout.directions(); ++d)
      forces[k * layout.components + d] = p.masses[k] * setting.gravity[d];
  for (const auto& [particle, force] : setting.forces) {
    const Vector mean = force.mean(from, to);
    for (std::size_t d = 0; d < layout.directions(); ++d) forces[layout.at(particle, d)] += mean[d];
  }
  if (layout.components == 3)
    for (const auto& [particle, torque] : setting.torques)
      forces[layout.at(particle, 2)] += torque.mean(from, to)[2];
  return forces;
}

}  // namespace

StepEquation::StepEquation(const Setting& setting, const State& state, double h, double next)
    : setting_(setting),
      state_(state),
      h_(h),
      layout_{motion_components(state.particles.dimension)},
      forces_(mean_forces(setting, state.particles, layout_, state.time, next)),
      in_contact_(state.particles.count(), 0) {
  const auto& p = state.particles;
  for (const auto& [particle, motion] : setting.given_motions)
    driven_.emplace(particle, given_motion(motion, state.time, next));
  for (const auto* pairs : {&state.pairs, &state.walls})
    for (const auto& pair : *pairs) {
      if (pair.impulse == 0 && !(pair.gamma < 0)) continue;
      in_contact_[index_of(pair.second)] = 1;
      if (pair.first >= 0) in_contact_[index_of(pair.first)] = 1;
    }
  masses_.resize(forces_.size());
  for (std::size_t k = 0; k < p.count(); ++k) {
    for (std::size_t d = 0; d < layout_.directions(); ++d)
      masses_[k * layout_.components + d] = p.masses[k];
    // A disc whose moment of inertia is not given is uniform.
    if (layout_.components == 3)
      masses_[k * 3 + 2] =
          p.inertias.empty() ? p.masses[k] * p.radii[k] * p.radii[k] / 2 : p.inertias[k];
  }
  add_inertia();
}

/// Sets theta and the inertia of all components.
void StepEquation::add_inertia() {
  thetas_.assign(masses_.size(), 1);
  inertia_.assign(masses_.size(), 0);
  for (std::size_t i = 0; i < masses_.size(); ++i) {
    if (!(masses_[i] > 0)) continue;
    thetas_[i] = theta(i / layout_.components, i % layout_.components, masses_[i]);
    inertia_[i] = masses_[i] / (thetas_[i] * h_);
  }
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

double StepEquation::theta(std::size_t k, std::size_t component, double mass) const {
  if (in_contact_[k] != 0) return 1;
  const double r = state_.particles.radii[k], mu = setting_.fluid->viscosity;
  constexpr double kPi = std::numbers::pi;
  // Of a sphere; of a disc that turns; and of a disc that moves, which has no Stokes drag: the
  // factor of its torque stands for it.
  const double drag = layout_.components == 1 ? 6 * kPi * mu * r
                      : component == 2        ? 4 * kPi * mu * r * r
                                              : 4 * kPi * mu;
  const double z = h_ * std::max(drag, earlier_drag(k, component)) / mass;
  return std::isfinite(z) ? (1 + z) / (2 + z) : 1;
}

FluidParticles StepEquation::bodies() const {
  FluidParticles bodies{&state_.particles, state_.particles.angles, driven_, {}};
  if (std::ranges::any_of(inertia_, [](double x) { return x > 0; })) bodies.inertia = inertia_;
  return bodies;
}

double StepEquation::velocity(std::size_t k, std::size_t component) const {
  const auto& p = state_.particles;
  return component < layout_.directions() ? p.velocities[k * layout_.directions() + component]
                                          : p.angular_velocities[k];
}

std::vector<double> StepEquation::right_side() const {
  auto forces = forces_;
  for (std::size_t i = 0; i < forces.size(); ++i)
    if (inertia_[i] > 0)
      forces[i] += inertia_[i] * velocity(i / layout_.components, i % layout_.components);
  return forces;
}

std::vector<double> StepEquation::velocities_at_end(std::span<const double> motions,
                                                    std::span<const double> flow) const {
  std::vector<double> velocities(flow.begin(), flow.end());
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    const auto k = i / layout_.components;
    if (inertia_[i] == 0 || is_driven(static_cast<std::int32_t>(k))) continue;
    const double before = velocity(k, i % layout_.components);
    velocities[i] = thetas_[i] == 1 ? motions[i] : before + (motions[i] - before) / thetas_[i];
  }
  return velocities;
}

bool StepEquation::put_in_contact(std::span<const FluidContact> contacts) {
  const auto before = thetas_;
  for (const auto& contact : contacts) {
    if (contact.impulse == 0) continue;
    for (const auto k : {contact.first, contact.second})
      if (k >= 0 && !is_driven(k)) in_contact_[index_of(k)] = 1;
  }
  add_inertia();
  return thetas_ != before;
}

std::array<double, 3> StepEquation::given_motion(const GivenMotion& motion, double from,
                                                 double to) const {
  const Vector velocity = motion.velocity.mean(from, to);
  if (layout_.components == 1) return {velocity[0], 0, 0};
  return {velocity[0], velocity[1], motion.angular_velocity.mean(from, to)[2]};
}

bool StepEquation::drives_as_before(double earlier_step) const {
  const double before = std::max(0.0, state_.time - earlier_step);
  for (const auto& [particle, motion] : setting_.given_motions) {
    const auto earlier = given_motion(motion, before, state_.time);
    const auto& now = driven_.at(particle);
    // Means over two steps of the same length differ by rounding errors.
    constexpr double kSame = 1e-12;
    for (std::size_t d = 0; d < 3; ++d)
      if (std::abs(now[d] - earlier[d]) > kSame * (std::abs(now[d]) + std::abs(earlier[d])))
        return false;
  }
  return true;
}

}  // namespace viscontact::particles
