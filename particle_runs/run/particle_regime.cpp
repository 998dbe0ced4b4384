#include "viscontact/particle_runs/run/particle_regime.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "viscontact/lubrication/regime.hpp"

namespace viscontact::particles {
namespace {

/// mu [M/(L T)] of the fluid, or else of the films; 0: the case has none, or [lubrication], with
/// which spheres have no inertia.
double viscosity_of(const ParticlesCase& c) {
  if (c.setting.fluid) return c.setting.fluid->viscosity;
  if (c.setting.lubrication) return 0;
  return c.setting.laws.film.viscosity.value_or(0);
}

bool has_inertia_of_fluid(const ParticlesCase& c) {
  return c.setting.fluid && c.setting.fluid->has_inertia();
}

/// Velocity [L/T] of the particle relative to the linear flow of the case.
Vector relative_velocity(const ParticlesCase& c, const State& state, std::size_t k) {
  const auto& particles = state.particles;
  const Vector v = particles.velocity(k);
  if (const auto& pairs = c.setting.lubrication) {
    const Vector x = particles.position(k);
    const auto gradient = pairs->flow_at(state.time - state.earlier_step / 2).gradient;
    Vector flow{};
    for (std::size_t i = 0; i < 3; ++i) flow[i] = state.shear.rate * dot(gradient[i], x);
    return v - flow;
  }
  if (!c.setting.fluid || particles.dimension != 2) return v;
  const auto* flow = std::get_if<LinearFlow>(&c.setting.fluid->boundary);
  if (flow == nullptr) return v;
  const auto& e = flow->gradient;
  const Vector x = particles.position(k);
  return v - Vector{e[0] * x[0] + e[1] * x[1], e[2] * x[0] + e[3] * x[1], 0};
}

}  // namespace

void ParticleRegime::add(const ParticlesCase& c, const State& state, bool contact) {
  const auto& particles = state.particles;
  has_contact = has_contact || contact;
  const auto obstacles = obstacles_of(c.setting);
  const auto solids_touch = [&](const Pair& pair) {
    return pair.gamma < 0 &&
           pair.gamma <= c.setting.laws.lowest_gamma(pair, state.memories.of(pair.memory),
                                                     radii_of(pair, particles, obstacles));
  };
  have_solids_touched =
      have_solids_touched || (contact && !c.setting.fluid && !c.setting.lubrication &&
                              (std::ranges::any_of(state.pairs, solids_touch) ||
                               std::ranges::any_of(state.walls, solids_touch)));
  const double mu = viscosity_of(c);
  const double density = has_inertia_of_fluid(c) ? c.setting.fluid->density : c.fluid_density;
  const bool per_length = c.setting.fluid && particles.dimension == 2;
  constexpr double kPlane = std::numeric_limits<double>::infinity();
  at_plane.resize(particles.count());
  for (std::size_t k = 0; k < particles.count(); ++k) {
    const double r = particles.radii[k], speed = norm(relative_velocity(c, state, k));
    const double momentum = particles.masses[k] * speed;
    if (mu > 0 && density > 0)
      reynolds = std::max(reynolds, lubrication::reynolds_number(density, r, speed, mu));
    // The mass of a sphere of this density is 4/3 r times that of a disc per length.
    const double mass = per_length ? particles.masses[k] * (4 * r / 3) : particles.masses[k];
    if (mu > 0) stokes = std::max(stokes, lubrication::stokes_number(mass, r, speed, mu));
    if (c.setting.fluid || c.setting.lubrication) continue;
    if (at_plane[k].radius != r) at_plane[k] = {r, c.setting.laws.film.lowest_gamma(r, kPlane)};
    const double lowest = at_plane[k].lowest_gamma;
    if (lowest < 0 && std::isfinite(lowest)) film = std::max(film, momentum / -lowest);
  }
}

std::string in_words(const ParticleRegime& regime) {
  if (regime.stokes < 0) return "";
  return fmt::format("largest Stokes number {:.3g}, Reynolds number {}", regime.stokes,
                     regime.reynolds >= 0
                         ? fmt::format("{:.3g}", regime.reynolds)
                         : "not known (it needs `fluid_density` in [viscous_contact])");
}

std::vector<std::string> warnings_of(const ParticlesCase& c, const ParticleRegime& regime) {
  std::vector<std::string> warnings;
  if (!has_inertia_of_fluid(c))
    if (const auto warning = lubrication::reynolds_warning(regime.reynolds))
      warnings.push_back(*warning);
  if (regime.have_solids_touched && regime.film > 0)
    if (const auto warning = lubrication::film_warning(
            regime.film, "a case of one sphere or a case with [fluid] resolves the drag"))
      warnings.push_back(*warning);
  return warnings;
}

}  // namespace viscontact::particles
