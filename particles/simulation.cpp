#include "particles/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.hpp"
#include "particles/candidates.hpp"
#include "particles/film_geometry.hpp"
#include "particles/neighbours.hpp"
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

/// The particles that may touch a plane in this step, its place that of the step's end. The reaches bound how far they go: list_holds.
void find_walls(State& state, std::span<const PlanePlace> planes) {
  const auto& p = state.particles;
  std::vector<Film> walls;
  auto old = state.walls.begin();
  for (std::size_t w = 0; w < planes.size(); ++w) {
    const auto plane = -1 - static_cast<std::int32_t>(w);
    const auto& place = planes[w];
    const auto known_until = [&](std::int32_t particle) {
      return old != state.walls.end() && old->first == plane && old->second == particle;
    };
    for (std::size_t k = 0; k < p.count(); ++k) {
      const auto particle = static_cast<std::int32_t>(k);
      const bool known = known_until(particle);
      if ((known && old->gamma < 0) || gap(place, p.position(k), p.radii[k]) < 2 * state.reaches[k])
        walls.push_back(known ? *old : Film{plane, particle});
      if (known) ++old;
    }
  }
  state.walls = std::move(walls);
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

/// Of each particle the longer of two displacements, into `longest`: reaches that only grow end the search for a list that holds.
template <int D>
void keep_longer(std::vector<double>& longest, const std::vector<double>& other) {
  const auto square = [](const double* a) {
    double sum = 0;
    for (std::size_t d = 0; d < D; ++d) sum += a[d] * a[d];
    return sum;
  };
  for (std::size_t k = 0; k < longest.size(); k += D)
    if (square(&other[k]) > square(&longest[k])) std::copy_n(&other[k], D, &longest[k]);
}

void check_displacement(const Particles& p, const std::vector<double>& displacements, std::size_t k,
                        double time) {
  // Squares of distances, and products of many, must be finite too.
  constexpr double kLargest = 1e120;
  const auto d = static_cast<std::size_t>(p.dimension);
  for (std::size_t i = k * d; i < k * d + d; ++i)
    if (!(std::abs(displacements[i]) < kLargest && std::abs(p.positions[i]) < kLargest))
      throw Error(ExitCode::kNotConverged,
                  fmt::format("particle {} is at {} and moves by {} in the step to time {}: beyond "
                              "what can be computed with; are its forces, the walls and the time "
                              "step as they should be?",
                              k, p.positions[i], displacements[i], time));
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
  auto& displacements = work_->displacements;
  auto& team = work_->team;
  for (std::size_t k = 0; k < state_.particles.count(); ++k)
    check_displacement(state_.particles, displacements, k, next);
  std::vector<PlanePlace> planes;
  for (const auto& plane : setting_.planes) planes.push_back(plane.at(next));

  if (!list_holds(state_, displacements, team)) make_list(state_, displacements, team);
  const auto project = [&] {
    find_walls(state_, planes);
    auto projected = StepProjection<D>(state_, planes, displacements, work_->mobilities, team)
                         .solve(setting_.solver, mean_radius_);
    for (const auto body : projected.bodies)
      check_displacement(state_.particles, displacements, static_cast<std::size_t>(body), next);
    return projected;
  };
  auto projected = project();
  for (auto longest = displacements; !list_holds(state_, displacements, team);) {
    // Impulses threw particles further than the list looked.
    keep_longer<D>(longest, displacements);
    make_list(state_, longest, team);
    move_freely<D>(h, next);
    projected = project();
  }
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

double largest_overlap(const Setting& setting, const State& state) {
  double smallest = 0;
  const auto& p = state.particles;
  Team team(1);
  for (const auto& pair : close_pairs(p.dimension, p.positions, p.radii, team)) {
    const Film film{pair.first, pair.second};
    smallest = std::min(smallest,
                        p.dimension == 2 ? contact_of<2>(p, film).gap : contact_of<3>(p, film).gap);
  }
  for (const auto& plane : setting.planes) {
    const auto place = plane.at(state.time);
    for (std::size_t k = 0; k < p.count(); ++k)
      smallest = std::min(smallest, gap(place, p.position(k), p.radii[k]));
  }
  return (0 - smallest) / mean_radius(p);  // 0, not -0
}

std::vector<ContactNow> contacts_of(const Setting& setting, const State& state) {
  std::vector<ContactNow> contacts;
  const auto& p = state.particles;
  std::vector<PlanePlace> planes;
  for (const auto& plane : setting.planes) planes.push_back(plane.at(state.time));
  const double touching = setting.solver.tolerance * mean_radius(p);
  for (const auto* films : {&state.pairs, &state.walls})
    for (const auto& film : *films) {
      const double gap = p.dimension == 2 ? contact_of<2>(p, film, planes).gap
                                          : contact_of<3>(p, film, planes).gap;
      if (film.gamma < 0 || gap <= touching)
        contacts.push_back({film.first, film.second, gap, film.gamma});
    }
  return contacts;
}

}  // namespace viscontact::particles
