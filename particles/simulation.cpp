#include "particles/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.hpp"
#include "particles/candidates.hpp"
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

/// Contacts of one step: all that may touch, and which of them the projection has.
template <int D>
struct Contacts {
  std::vector<Contact<D>> all;      // pairs, then walls, as in the state
  std::vector<std::size_t> chosen;  // in order
  std::vector<char> is_chosen;
};

template <int D>
Contact<D> contact_of(const Particles& p, const Film& film) {
  Contact<D> contact;
  contact.first = film.first;
  contact.second = film.second;
  contact.gamma = film.gamma;
  contact.impulse = film.impulse;
  const double* xi = &p.positions[static_cast<std::size_t>(film.first) * D];
  const double* xj = &p.positions[static_cast<std::size_t>(film.second) * D];
  double square = 0;
  for (std::size_t d = 0; d < D; ++d) {
    contact.normal[d] = xj[d] - xi[d];
    square += contact.normal[d] * contact.normal[d];
  }
  const double distance = std::sqrt(square);
  if (distance > 0)
    for (auto& x : contact.normal) x /= distance;
  else
    contact.normal[0] = 1;  // centres on each other: any direction leads apart
  contact.gap = distance - p.radii[static_cast<std::size_t>(film.first)] -
                p.radii[static_cast<std::size_t>(film.second)];
  return contact;
}

template <int D>
Contact<D> contact_of(const Particles& p, const Film& film, const PlanePlace& plane) {
  Contact<D> contact;
  contact.first = -1;
  contact.second = film.second;
  contact.gamma = film.gamma;
  contact.impulse = film.impulse;
  for (std::size_t d = 0; d < D; ++d) contact.normal[d] = plane.normal[d];
  const auto k = static_cast<std::size_t>(film.second);
  contact.gap = gap(plane, p.position(k), p.radii[k]);
  return contact;
}

/// The linearised gap D + h G.v at displacements h v.
template <int D>
double gap_after(const Contact<D>& contact, std::span<const double> displacements) {
  const double* wj = &displacements[static_cast<std::size_t>(contact.second) * D];
  double sum = contact.gap;
  if (contact.first < 0) {
    for (std::size_t d = 0; d < D; ++d) sum += contact.normal[d] * wj[d];
  } else {
    const double* wi = &displacements[static_cast<std::size_t>(contact.first) * D];
    for (std::size_t d = 0; d < D; ++d) sum += contact.normal[d] * (wj[d] - wi[d]);
  }
  return sum;
}

/// The particles that may touch a plane in this step, its place that of the step's end. The reaches bound how far they go: list_holds.
void find_walls(State& state, const std::vector<PlanePlace>& planes) {
  const auto& p = state.particles;
  std::vector<Film> walls;
  auto old = state.walls.begin();
  for (std::size_t w = 0; w < planes.size(); ++w) {
    const auto plane = -1 - static_cast<std::int32_t>(w);
    for (std::size_t k = 0; k < p.count(); ++k) {
      const auto particle = static_cast<std::int32_t>(k);
      const bool known = old != state.walls.end() && old->first == plane && old->second == particle;
      if ((known && old->gamma < 0) ||
          gap(planes[w], p.position(k), p.radii[k]) < 2 * state.reaches[k])
        walls.push_back(known ? *old : Film{plane, particle, 0, 0});
      if (known) ++old;
    }
  }
  state.walls = std::move(walls);
}

template <int D>
Contacts<D> find_contacts(const State& state, const std::vector<PlanePlace>& planes, Team& team) {
  Contacts<D> contacts;
  const std::size_t pairs = state.pairs.size();
  contacts.all.resize(pairs + state.walls.size());
  contacts.is_chosen.assign(contacts.all.size(), 0);
  team.for_blocks(pairs, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c)
      contacts.all[c] = contact_of<D>(state.particles, state.pairs[c]);
  });
  for (std::size_t c = 0; c < state.walls.size(); ++c)
    contacts.all[pairs + c] =
        contact_of<D>(state.particles, state.walls[c],
                      planes[static_cast<std::size_t>(-1 - state.walls[c].first)]);
  return contacts;
}

/// Adds the contacts whose gap the displacements bring below -tolerance. Returns how many there were.
template <int D>
std::size_t choose(Contacts<D>& contacts, std::span<const double> displacements, double tolerance,
                   double& smallest_gap) {
  std::size_t added = 0;
  for (std::size_t c = 0; c < contacts.all.size(); ++c) {
    if (contacts.is_chosen[c] != 0) continue;
    const double after = gap_after(contacts.all[c], displacements);
    if (after < -tolerance) {
      contacts.is_chosen[c] = 1;
      ++added;
    } else {
      smallest_gap = std::min(smallest_gap, after);
    }
  }
  return added;
}

template <int D>
SolverMethod<D> method_of(const SolverSettings& settings) {
  for (const auto& row : kSolverMethods)
    if (row.name == settings.method) {
      if constexpr (D == 2)
        return row.discs;
      else
        return row.spheres;
    }
  throw Error(ExitCode::kBadInput, fmt::format("there is no method '{}'", settings.method));
}

/// What the projection of a step found.
struct Projected {
  int iterations = 0;
  double violation = 0;     // over all contacts [L]
  double smallest_gap = 0;  // linearised [L], at most 0
};

/// Displacements h u* become h v, and the impulses of the chosen contacts are those of the projection.
template <int D>
Projected project(Contacts<D>& contacts, std::vector<double>& displacements,
                  std::span<const double> mobilities, const SolverSettings& settings,
                  double mean_radius, Team& team) {
  Projected result;
  const auto method = method_of<D>(settings);
  const double tolerance = settings.tolerance * mean_radius;
  for (std::size_t c = 0; c < contacts.all.size(); ++c)
    contacts.is_chosen[c] = contacts.all[c].gamma < 0 || contacts.all[c].impulse != 0;
  double smallest_gap = 0;
  choose(contacts, displacements, 0, smallest_gap);
  const std::vector<double> free = displacements;
  // First roughly: what other contacts the impulses of these close is then known before much is spent.
  constexpr double kRough = 1e-3;
  bool rough = settings.tolerance < kRough;
  for (;;) {
    std::vector<std::size_t> chosen;
    std::vector<Contact<D>> now;
    for (std::size_t c = 0; c < contacts.all.size(); ++c)
      if (contacts.is_chosen[c] != 0) {
        chosen.push_back(c);
        now.push_back(contacts.all[c]);
      }
    ContactGraph<D> graph(now, free, mobilities, team);
    const auto solved = method(graph, rough ? kRough * mean_radius : tolerance,
                               settings.max_iterations - result.iterations);
    result.iterations += solved.iterations;
    result.violation = solved.violation;
    std::vector<double> impulses(now.size()), moved(displacements.size() + D);
    graph.impulses(impulses);
    graph.to_bodies(graph.z, moved);
    for (std::size_t c = 0; c < chosen.size(); ++c) contacts.all[chosen[c]].impulse = impulses[c];
    for (std::size_t k = 0; k < displacements.size(); ++k) displacements[k] = free[k] + moved[k];
    smallest_gap = 0;
    const auto added = choose(contacts, displacements, tolerance, smallest_gap);
    const bool spent = result.iterations >= settings.max_iterations;
    if (spent || (added == 0 && !rough)) {
      contacts.chosen = std::move(chosen);
      break;
    }
    if (added == 0) rough = false;
  }
  // Over all contacts: those that there were no iterations left for are violated too.
  for (const auto& contact : contacts.all) {
    const double after = gap_after(contact, displacements);
    result.smallest_gap = std::min(result.smallest_gap, after);
    if (contact.impulse == 0 && contact.gamma == 0)
      result.violation = std::max(result.violation, -after);
  }
  return result;
}

/// gamma^{n+1} = gamma^n - h lambda, within [gamma_min, 0].
template <int D>
std::size_t remember(State& state, const Contacts<D>& contacts, const ContactLaw& law) {
  std::size_t glued = 0;
  for (std::size_t c = 0; c < contacts.all.size(); ++c) {
    const bool pair = c < state.pairs.size();
    auto& film = pair ? state.pairs[c] : state.walls[c - state.pairs.size()];
    film.impulse = contacts.all[c].impulse;
    if (film.impulse == 0) continue;
    const double gamma = film.gamma - film.impulse;
    const auto radius = [&](std::int32_t k) {
      return k < 0 ? std::numeric_limits<double>::infinity()
                   : state.particles.radii[static_cast<std::size_t>(k)];
    };
    film.gamma =
        gamma < 0 ? std::max(gamma, law.lower_bound(radius(film.second), radius(film.first))) : 0;
    if (film.gamma < 0) ++glued;
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

void check_finite(const Particles& p, double time) {
  // Squares of distances must be finite too.
  constexpr double kLargest = 1e150;
  const auto d = static_cast<std::size_t>(p.dimension);
  for (std::size_t k = 0; k < p.positions.size(); ++k)
    if (!(std::abs(p.positions[k]) < kLargest && std::abs(p.velocities[k]) < kLargest))
      throw Error(
          ExitCode::kNotConverged,
          fmt::format("particle {} is at {} with velocity {} at time {}: beyond what can be "
                      "computed with; are its forces and the time step as they should be?",
                      k / d, p.positions[k], p.velocities[k], time));
}

}  // namespace

Simulation::Simulation(Setting setting, State state, int threads)
    : setting_(std::move(setting)),
      state_(std::move(state)),
      work_(std::make_unique<Work>(threads)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

StepReport Simulation::step(double end) {
  return state_.particles.dimension == 2 ? step_of<2>(end) : step_of<3>(end);
}

template <int D>
StepReport Simulation::step_of(double end) {
  auto& p = state_.particles;
  double h = setting_.time_step;
  double next = state_.grid_time + static_cast<double>(state_.steps + 1 - state_.grid_step) * h;
  const bool cut = next > end + 1e-6 * h;
  if (cut) {
    next = end;
    h = end - state_.time;
  }
  auto& displacements = work_->displacements;
  auto& mobilities = work_->mobilities;
  displacements.resize(p.count() * D);
  mobilities.resize(p.count());
  for (std::size_t k = 0; k < p.count(); ++k) {
    mobilities[k] = h / p.masses[k];
    for (std::size_t d = 0; d < D; ++d)
      displacements[k * D + d] = h * (p.velocities[k * D + d] + h * setting_.gravity[d]);
  }
  for (const auto& [particle, force] : setting_.forces) {
    const auto k = static_cast<std::size_t>(particle);
    const Vector mean = force.mean(state_.time, next);
    for (std::size_t d = 0; d < D; ++d) displacements[k * D + d] += h * mobilities[k] * mean[d];
  }
  std::vector<PlanePlace> planes;
  for (const auto& plane : setting_.planes) planes.push_back(plane.at(next));
  const double scale = mean_radius(p);

  const std::vector<double> free = displacements;
  std::vector<double> longest = displacements;
  Contacts<D> contacts;
  Projected projected;
  if (!list_holds(state_, displacements, work_->team))
    make_list(state_, displacements, work_->team);
  for (;;) {
    find_walls(state_, planes);
    contacts = find_contacts<D>(state_, planes, work_->team);
    projected = project(contacts, displacements, mobilities, setting_.solver, scale, work_->team);
    if (list_holds(state_, displacements, work_->team)) break;
    // Impulses threw particles further than the list looked.
    keep_longer<D>(longest, displacements);
    make_list(state_, longest, work_->team);
    displacements = free;
  }
  StepReport report;
  report.glued = remember(state_, contacts, setting_.law);
  for (std::size_t k = 0; k < displacements.size(); ++k) {
    p.positions[k] += displacements[k];
    p.velocities[k] = displacements[k] / h;
  }
  state_.time = next;
  ++state_.steps;
  if (cut) {
    state_.grid_time = next;
    state_.grid_step = state_.steps;
  }
  check_finite(p, next);
  report.time = next;
  report.contacts = contacts.chosen.size();
  report.iterations = projected.iterations;
  report.residual = projected.violation / scale;
  report.converged = report.residual <= setting_.solver.tolerance;
  report.largest_overlap = -projected.smallest_gap / scale;
  return report;
}

double largest_overlap(const Setting& setting, const State& state) {
  double smallest = 0;
  const auto& p = state.particles;
  for (const auto& film : state.pairs)
    smallest = std::min(smallest,
                        p.dimension == 2 ? contact_of<2>(p, film).gap : contact_of<3>(p, film).gap);
  for (const auto& plane : setting.planes) {
    const auto place = plane.at(state.time);
    for (std::size_t k = 0; k < p.count(); ++k)
      smallest = std::min(smallest, gap(place, p.position(k), p.radii[k]));
  }
  return -smallest / mean_radius(p);
}

std::vector<ContactNow> contacts_of(const Setting& setting, const State& state) {
  std::vector<ContactNow> contacts;
  const auto& p = state.particles;
  const double touching = setting.solver.tolerance * mean_radius(p);
  const auto add = [&](const Film& film, double gap) {
    if (film.gamma < 0 || gap <= touching)
      contacts.push_back({film.first, film.second, gap, film.gamma});
  };
  for (const auto& film : state.pairs)
    add(film, p.dimension == 2 ? contact_of<2>(p, film).gap : contact_of<3>(p, film).gap);
  std::vector<PlanePlace> planes;
  for (const auto& plane : setting.planes) planes.push_back(plane.at(state.time));
  for (const auto& film : state.walls) {
    const auto k = static_cast<std::size_t>(film.second);
    add(film, gap(planes[static_cast<std::size_t>(-1 - film.first)], p.position(k), p.radii[k]));
  }
  return contacts;
}

}  // namespace viscontact::particles
