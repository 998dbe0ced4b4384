#include "particles/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.hpp"
#include "particles/block_results.hpp"
#include "particles/candidates.hpp"
#include "particles/step_projection.hpp"
#include "particles/team.hpp"

namespace viscontact::particles {

/// Arrays of a step that are kept for the next, for their memory only.
struct Simulation::Work {
  explicit Work(int threads) : team(threads) {}
  Team team;
  std::vector<double> displacements;  // h u*, later h v
  std::vector<double> mobilities;     // h/m
};

namespace {

/// The particles within `margin` of a plane, its place that of the step's end, and those that its films hold.
void find_walls(State& state, std::span<const PlanePlace> planes, double margin, Team& team) {
  const auto& p = state.particles;
  Joined<Film> walls;
  for (std::size_t w = 0; w < planes.size(); ++w) {
    const auto plane = -1 - static_cast<std::int32_t>(w);
    const auto& place = planes[w];
    walls += team.sum_of_blocks<Joined<Film>>(p.count(), [&](std::size_t begin, std::size_t end) {
      Joined<Film> films;
      // Planes are in falling order of their numbers.
      auto old = std::ranges::partition_point(state.walls, [&](const Film& film) {
        return film.first > plane ||
               (film.first == plane && film.second < static_cast<std::int32_t>(begin));
      });
      for (std::size_t k = begin; k < end; ++k) {
        const auto particle = static_cast<std::int32_t>(k);
        const bool known =
            old != state.walls.end() && old->first == plane && old->second == particle;
        if ((known && old->gamma < 0) || gap(place, p.position(k), p.radii[k]) < margin)
          films.values.push_back(known ? *old : Film{plane, particle});
        if (known) ++old;
      }
      return films;
    });
  }
  state.walls = std::move(walls.values);
}

/// gamma^{n+1} = gamma^n - h lambda, within [gamma_min, 0]. Returns how many films hold.
std::size_t remember(const Particles& p, const std::vector<Film*>& films, const ContactLaw& law) {
  const auto radius = [&](std::int32_t k) {
    return k < 0 ? std::numeric_limits<double>::infinity() : p.radii[static_cast<std::size_t>(k)];
  };
  std::size_t glued = 0;
  for (auto* film : films) {
    const double gamma = film->gamma - film->impulse;
    film->gamma = gamma < 0
                      ? std::max(gamma, law.lower_bound(radius(film->second), radius(film->first)))
                      : 0.0;
    if (film->gamma < 0) ++glued;
  }
  return glued;
}

/// The length of a particle's displacement. Throws if it, or where the particle is, is beyond `largest`.
double checked_length(const Particles& p, const std::vector<double>& displacements, std::size_t k,
                      double largest, double time) {
  const Vector x = p.position(k), w = point_of(displacements.data(), k, p.dimension);
  for (std::size_t d = 0; d < 3; ++d)
    if (!(std::abs(x[d]) <= largest && std::abs(w[d]) <= largest))
      throw Error(ExitCode::kNotConverged,
                  fmt::format("particle {} is at {} and moves by {} in the step to time {}: beyond "
                              "what can be computed with; are its forces, the walls and the time "
                              "step as they should be?",
                              k, x[d], w[d], time));
  return norm(w);
}

}  // namespace

Simulation::Simulation(Setting setting, State state, int threads)
    : setting_(std::move(setting)),
      state_(std::move(state)),
      mean_radius_(mean_radius(state_.particles)),
      work_(std::make_unique<Work>(threads)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

StepReport Simulation::step(double end) {
  return state_.particles.dimension == 2 ? step_of<2>(end) : step_of<3>(end);
}

template <int D>
void Simulation::move_freely(double h, double next) {
  const auto& p = state_.particles;
  auto& displacements = work_->displacements;
  auto& mobilities = work_->mobilities;
  displacements.resize(p.count() * D);
  mobilities.resize(p.count());
  work_->team.for_blocks(p.count(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      mobilities[k] = h / p.masses[k];
      for (std::size_t d = 0; d < D; ++d)
        displacements[k * D + d] = h * (p.velocities[k * D + d] + h * setting_.gravity[d]);
    }
  });
  for (const auto& [particle, force] : setting_.forces) {
    const auto k = static_cast<std::size_t>(particle);
    const Vector mean = force.mean(state_.time, next);
    for (std::size_t d = 0; d < D; ++d) displacements[k * D + d] += h * mobilities[k] * mean[d];
  }
}

template <int D>
void Simulation::move(double h) {
  auto& p = state_.particles;
  const auto& displacements = work_->displacements;
  work_->team.for_blocks(p.count(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin * D; k < end * D; ++k) {
      p.positions[k] += displacements[k];
      p.velocities[k] = displacements[k] / h;
    }
  });
}

template <int D>
Projected Simulation::project(double h, double next) {
  auto& displacements = work_->displacements;
  auto& team = work_->team;
  const auto planes = places_of(setting_.planes, next);
  const double largest = farthest(setting_.solver.tolerance, mean_radius_);
  const auto length_of = [&](std::size_t k) {
    return checked_length(state_.particles, displacements, k, largest, next);
  };
  const auto longest_of = [&](std::size_t begin, std::size_t end) {
    Largest longest;
    for (std::size_t k = begin; k < end; ++k) longest.value = std::max(longest.value, length_of(k));
    return longest;
  };
  // Who is further from a plane than anybody goes does not meet it.
  const double longest = team.sum_of_blocks<Largest>(state_.particles.count(), longest_of).value;
  double margin = std::max(2 * longest, mean_radius_ / 4);
  if (!list_holds(state_, displacements, team)) {
    state_.reaches.clear();
    make_list(state_, displacements, team);
  }
  for (;;) {
    find_walls(state_, planes, margin, team);
    auto projected = StepProjection<D>(state_, planes, displacements, work_->mobilities, team)
                         .solve(setting_.solver, mean_radius_);
    double gone = 0;
    for (const auto body : projected.bodies)
      gone = std::max(gone, length_of(static_cast<std::size_t>(body)));
    if (gone <= margin && list_holds(state_, displacements, team)) return projected;
    // Impulses threw particles further than was looked. Reaches and margin only grow, which ends this.
    margin = std::max(margin, 2 * gone);
    make_list(state_, displacements, team);
    move_freely<D>(h, next);
  }
}

template <int D>
StepReport Simulation::step_of(double end) {
  double h = setting_.time_step;
  const double tiny = 1e-6 * h;
  if (!(end > state_.time + tiny)) return {.time = state_.time};
  double next = state_.grid_time + static_cast<double>(state_.steps + 1 - state_.grid_step) * h;
  const bool cut = next > end + tiny;
  if (cut) {
    next = end;
    h = end - state_.time;
  }
  move_freely<D>(h, next);
  const auto projected = project<D>(h, next);
  StepReport report;
  report.glued = remember(state_.particles, projected.films, setting_.law);
  move<D>(h);
  state_.time = next;
  ++state_.steps;
  if (cut) {
    state_.grid_time = next;
    state_.grid_step = state_.steps;
  }
  report.time = next;
  report.contacts = projected.films.size();
  report.iterations = projected.iterations;
  report.residual = projected.violation / mean_radius_;
  report.converged = report.residual <= setting_.solver.tolerance;
  report.largest_overlap = (0 - projected.smallest_gap) / mean_radius_;
  return report;
}

double farthest(double tolerance, double mean_radius) {
  // Squares of distances must be finite, and positions finer than the gaps that are asked for.
  constexpr double kFinite = 1e120;
  return std::min(kFinite, tolerance * mean_radius / std::numeric_limits<double>::epsilon());
}

}  // namespace viscontact::particles
