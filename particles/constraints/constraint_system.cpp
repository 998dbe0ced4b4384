// Makes and solves the problem for the impulses of the contacts, rigid bodies and links of a time
// step, and finds constraints that contradict each other (constraint_system.hpp, which has the
// shapes and ranges). Lengths [L], masses [M] and times [T] are in any consistent units. Nothing is
// thrown; residual() tells whether a step is solved. projection/ uses it. A change must keep that
// hinges and arms hold after finite turns, and the order of the link forces, which restart files
// store. A unit is a particle, or a rigid body of several.
#include "viscontact/particles/constraints/constraint_system.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "viscontact/particles/constraints/block_factor.hpp"

namespace viscontact::particles {
namespace {

/// Most iterations of a solution with given loads. Such solutions take 100 to 200 iterations, and
/// some of them 1000.
constexpr int kMostOfGivenLoads = 3000;

/// The coefficients by which the motion of one unit enters a link's equation.
template <int D>
Motion<D> row_of(const LinkPart& part) {
  if (!part.is_turn) return displacement_row<D>(part.direction, part.arm);
  Motion<D> row{};
  row.back() = part.direction[2];  // the turn about z
  return row;
}

/// ConstraintSystem::least_violations() of the blocks of a problem; angles in [rad].
template <int D>
std::vector<double> least_violations_of(const ConstraintProblem<D>& problem) {
  // Proximal steps: each minimises the sum of v^2/(kEpsilon w) plus the square of the change of the
  // motions in the norm of M/h, masses over the step's length, which keeps the matrix regular. A
  // step multiplies errors by about kEpsilon if the rows determine the motions well. The number of
  // steps is a free choice.
  constexpr double kEpsilon = 1e-6;
  constexpr int kSteps = 30;
  const auto w = row_mobilities(problem);
  UnitMatrix<D> matrix(problem, true);
  auto y = motions<D>(problem, std::vector<double>(problem.rows.size(), 0.0));
  std::vector<double> violations(problem.blocks.size());
  for (int n = 0;; ++n) {
    matrix.set_to_masses();
    std::vector<Motion<D>> missing(y.size(), Motion<D>{});
    for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
      const auto& block = problem.blocks[b];
      violations[b] = 0;
      if (!block.is_contact && block.compliance > 0) continue;
      for (std::size_t r = block.row; r < block.row + (block.is_contact ? 1 : block.rows); ++r) {
        const double value = problem.rows[r].offset + problem.product(r, y);
        if (block.is_contact && value >= 0) continue;
        violations[b] = std::max(violations[b], std::abs(value));
        const double weight = 1 / (kEpsilon * w[r]);
        matrix.add_product(b, r, r, weight);
        problem.add_impulse(r, -weight * value, missing);
      }
    }
    if (n == kSteps || !matrix.factorise()) break;
    const auto change = matrix.solution_of(missing);
    for (std::size_t u = 0; u < y.size(); ++u)
      for (std::size_t k = 0; k < y[u].size(); ++k) y[u][k] += change[u][k];
  }
  return violations;
}

}  // namespace

template <int D>
ConstraintSystem<D>::ConstraintSystem(const ConstraintStep& step, const Particles& particles,
                                      std::span<double> displacements,
                                      std::span<const double> mobilities)
    : step_(step),
      particles_(particles),
      displacements_(displacements),
      mobilities_(mobilities),
      mean_radius_(mean_radius(particles)),
      is_convex_(step.laws.friction && step.laws.friction->method == FrictionMethod::kConvex),
      times_{step.end - step.begin, step.kick, step.end, step.is_first},
      free_turns_(step.turns.begin(), step.turns.end()),
      free_bodies_(step.bodies.begin(), step.bodies.end()),
      links_(link_equations(*step.links, particles, times_)),
      link_residuals_(links_.size(), 0.0),
      link_forces_(step.link_forces.begin(), step.link_forces.end()),
      unit_of_particle_(particles.count(), -1),
      unit_of_body_(particles.bodies.count(), -1),
      offsets_(particles.bodies.empty() ? 0 : particles.count()) {
  for (auto& stop : stop_equations(*step.links, particles)) {
    links_.push_back(std::move(stop));
    link_residuals_.push_back(0);
  }
  for (const auto& body : particles.bodies.bodies)
    for (std::size_t m = 0; m < body.members.size(); ++m)
      offsets_[index_of(body.members[m])] = present_offset(body, m, D);
}

template <int D>
void ConstraintSystem<D>::join_linked(ContactSystem<D>& system) const {
  for (const auto& link : links_)
    for (const auto& part : link.parts()) {
      system.connect(link.parts().front().particle, part.particle);
      if (!link.is_spring()) system.hold(part.particle);
    }
}

template <int D>
bool ConstraintSystem<D>::is_held_apart(const Pair& pair) const {
  for (const auto& arm : step_.links->arms) {
    if (std::minmax(arm.first, arm.second) != std::minmax(pair.first, pair.second)) continue;
    const auto i = index_of(pair.first), j = index_of(pair.second);
    // A case may give lengths that are shorter by the rounding errors of its numbers.
    constexpr double kShorter = 1e-6;
    const double touching = (1 - kShorter) * (particles_.radii[i] + particles_.radii[j]);
    // An arm holds the nearest image. Other images may touch, also where they are as near.
    constexpr double kRounding = 1e-9;
    const Vector nearest =
        nearest_image(particles_.cell, particles_.position(j) - particles_.position(i));
    Vector apart{};
    std::ranges::copy(separation<D>(particles_, pair.first, pair.second, pair.image),
                      apart.begin());
    return length_at(arm.length, times_.end) >= touching &&
           norm(apart - nearest) <= kRounding * norm(nearest);
  }
  return false;
}

template <int D>
void ConstraintSystem<D>::add(const Contact<D>& contact, const Pair& pair,
                              const PairMemory& memory) {
  tangents_.push_back(tangents_of(contact, particles_, step_.obstacles, step_.begin, step_.end));
  tangents_.back().capacity =
      pair.gamma -
      step_.laws.lowest_gamma(pair, memory, radii_of(pair, particles_, step_.obstacles));
  frictions_.push_back(memory.friction());
  carried_.push_back(memory[Remembered::kCarried]);
  first_loads_.push_back(carried_.back());
  last_loads_.emplace_back();
  given_loads_.push_back(0);
  gave_up_.push_back(0);
  could_not_give_up_.push_back(0);
  residuals_.emplace_back();
}

/// Finds the islands of `system`, in the order of their first bodies, with their contacts and
/// links.
template <int D>
void ConstraintSystem<D>::find_islands(ContactSystem<D>& system) {
  islands_.clear();
  std::vector<std::int32_t> number(system.bodies().size(), -1);  // of the islands, at their roots
  const auto island_of = [&](std::int32_t particle) -> Island& {
    auto& n = number[index_of(system.island(system.body_of(particle)))];
    if (n < 0) {
      n = static_cast<std::int32_t>(islands_.size());
      islands_.emplace_back();
    }
    return islands_[index_of(n)];
  };
  for (const auto particle : system.bodies())
    island_of(particle).bodies.push_back(system.body_of(particle));
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    auto& island = island_of(system.contacts[c].second);
    island.contacts.push_back(c);
    island.has_given_up |= gave_up_[c] != 0;
    island.can_give_up &= could_not_give_up_[c] == 0;
  }
  for (std::size_t l = 0; l < links_.size(); ++l)
    island_of(links_[l].parts().front().particle).links.push_back(l);
}

/// True if the island was solved so accurately before, has no contact that was added since, and its
/// residuals are allowed. Those of Coulomb's law cannot be after the island has given up.
template <int D>
bool ConstraintSystem<D>::is_solved(const ContactSystem<D>& system, const Island& island,
                                    bool is_rough) const {
  const auto solved = progress_[index_of(island.bodies.front())].solved;
  if (!island.contacts.empty() && island.contacts.back() >= known_contacts_) return false;
  if (is_rough) return solved != Progress::Solved::kNot;
  if (solved != Progress::Solved::kAccurately) return false;
  return (island.has_given_up && !is_convex_) ||
         (std::ranges::all_of(island.contacts,
                              [&](std::size_t c) {
                                return residuals_[c].normal <= system.contacts[c].allowed &&
                                       residuals_[c].tangential <= slips_allowed[c];
                              }) &&
          std::ranges::all_of(
              island.links, [&](std::size_t l) { return link_residuals_[l] <= links_allowed[l]; }));
}

/// Makes a unit of each rigid body, and of each particle without a body, of the island.
template <int D>
void ConstraintSystem<D>::number_units(const ContactSystem<D>& system, Island& island) {
  for (const auto b : island.bodies)
    if (const auto body = particles_.bodies.body_of(system.bodies()[index_of(b)]); body >= 0)
      unit_of_body_[index_of(body)] = -1;
  for (const auto b : island.bodies) {
    const auto particle = system.bodies()[index_of(b)];
    const auto body = particles_.bodies.body_of(particle);
    auto& unit = unit_of_particle_[index_of(particle)];
    unit = body < 0 ? -1 : unit_of_body_[index_of(body)];
    if (unit >= 0) continue;
    unit = static_cast<std::int32_t>(island.problem.units.size());
    if (body >= 0) unit_of_body_[index_of(body)] = unit;
    const auto k = index_of(particle), turns = static_cast<std::size_t>(kTurns<D>);
    island.problem.units.push_back(
        body < 0
            ? unit_of_particle<D>(mobilities_[k], step_.turn_mobilities[k],
                                  system.free_displacement(index_of(b)), &free_turns_[k * turns])
            : unit_of_body<D>(free_bodies_[index_of(body)]));
  }
}

template <int D>
ContactSide ConstraintSystem<D>::side_of(std::int32_t particle) const {
  if (particle < 0) return {};
  const auto k = index_of(particle);
  return {unit_of_particle_[k], particles_.bodies.body_of(particle) < 0 ? Vector{} : offsets_[k]};
}

template <int D>
void ConstraintSystem<D>::add_contact(const Contact<D>& contact, std::size_t c, double allowed_slip,
                                      ConstraintProblem<D>& problem) {
  const auto& tangents = tangents_[c];
  ConstraintBlock block;
  block.row = problem.rows.size();
  block.lowest = contact.lowest;
  block.friction = step_.laws.friction ? step_.laws.friction->coefficient : 0;
  block.capacity = tangents.capacity;
  block.allowed = contact.allowed;
  block.allowed_slip = allowed_slip;
  // The film of smooth particles absorbs every impulse, so that there is no friction.
  const bool rubs = block.friction > 0 && std::isfinite(block.capacity);
  block.rows = rubs ? static_cast<std::size_t>(D) : 1;
  if (problem.is_convex && rubs) {
    block.friction_bound = block.has_film() ? FrictionBound::kGiven : FrictionBound::kCone;
    block.given_load = first_loads_[c];
  }
  problem.blocks.push_back(block);
  const auto first = side_of(contact.first), second = side_of(contact.second);
  for (std::size_t k = 0; k < block.rows; ++k) {
    const double guess = k == 0 ? contact.impulse : dot(tangents.directions[k - 1], frictions_[c]);
    add_contact_row(contact, tangents, first, second, k, guess, problem);
  }
}

template <int D>
void ConstraintSystem<D>::add_link(std::size_t l, double allowed, ConstraintProblem<D>& problem) {
  const auto& link = links_[l];
  ConstraintBlock block;
  block.row = problem.rows.size();
  block.rows = link.rows.size();
  // The stop of a hinge pushes like a contact without film and friction.
  const bool is_stop = link.kind == LinkEquations::Kind::kStop;
  block.is_contact = is_stop;
  block.allowed = link.is_angle() ? allowed / mean_radius_ : allowed;
  block.compliance = link.rows.front().compliance;
  problem.blocks.push_back(block);
  for (std::size_t k = 0; k < link.rows.size(); ++k) {
    const auto& equation = link.rows[k];
    std::vector<RowPart<D>> parts;
    for (const auto& part : equation.parts)
      parts.push_back({unit_of_particle_[index_of(part.particle)], row_of<D>(part)});
    const double guess = is_stop ? 0 : link_forces_[link.first_force + k];
    problem.add_row(equation.value, parts, times_.kick * guess);
  }
}

template <int D>
UnitMotion ConstraintSystem<D>::motion_of(std::int32_t unit,
                                          std::span<const Motion<D>> motions) const {
  UnitMotion result;
  if (unit < 0) return result;
  const auto& motion = motions[static_cast<std::size_t>(unit)];
  constexpr auto d = static_cast<std::size_t>(D), r = static_cast<std::size_t>(kTurns<D>);
  for (std::size_t i = 0; i < d; ++i) result.displacement[i] = motion[i];
  for (std::size_t i = 0; i < r; ++i) result.turn[3 - r + i] = motion[d + i];
  return result;
}

/// Moves the particles of the island with their units, with finite turns of rigid bodies.
template <int D>
void ConstraintSystem<D>::move_particles(const ContactSystem<D>& system, const Island& island,
                                         std::span<const Motion<D>> motions) {
  constexpr auto d = static_cast<std::size_t>(D), r = static_cast<std::size_t>(kTurns<D>);
  for (const auto b : island.bodies) {
    const auto particle = system.bodies()[index_of(b)];
    const auto k = index_of(particle);
    const auto motion = motion_of(unit_of_particle_[k], motions);
    Vector moved = motion.displacement;
    if (particles_.bodies.body_of(particle) >= 0)
      moved = displacement_at(motion.displacement, motion.turn, offsets_[k], D);
    for (std::size_t i = 0; i < d; ++i) displacements_[k * d + i] = moved[i];
    for (std::size_t i = 0; i < r; ++i) step_.turns[k * r + i] = motion.turn[3 - r + i];
  }
}

/// Changes the offsets of the rows so that their linear values after `solution` become those after
/// the motion: gaps as ContactSystem::gap() gives them, and lengths of links after finite turns.
/// Stores the changes as shifts, and returns the largest one over its bound, without those of
/// contacts that stay open.
template <int D>
double ConstraintSystem<D>::correct(ContactSystem<D>& system, Island& island,
                                    const ConstraintSolution<D>& solution) {
  const std::span<const Motion<D>> motions = solution.motions;
  auto& problem = island.problem;
  double largest = 0;
  island.shifts.assign(problem.blocks.size(), 0.0);
  const auto shift = [&](std::size_t b, std::size_t k, double value) {
    const std::size_t r = problem.blocks[b].row + k;
    const double linear = problem.rows[r].offset + problem.product(r, motions);
    problem.rows[r].offset += value - linear;
    // A contact that is open before and after the change moves nothing.
    const auto& block = problem.blocks[b];
    if (block.is_contact && block.lowest == 0 && problem.impulses[r] == 0 && linear > 0 &&
        value > 0)
      return;
    island.shifts[b] = std::max(island.shifts[b], std::abs(value - linear));
    largest = std::max(largest, std::abs(value - linear) / block.allowed);
  };
  std::size_t b = 0;
  for (const auto c : island.contacts) {
    const auto& contact = system.contacts[c];
    const bool has_body = particles_.bodies.body_of(contact.second) >= 0 ||
                          (contact.first >= 0 && particles_.bodies.body_of(contact.first) >= 0);
    if (has_body || system.uses_distance(contact)) shift(b, 0, system.gap(contact));
    ++b;
  }
  for (const auto l : island.links) {
    const std::size_t of_link = b++;
    if (links_[l].is_spring()) continue;
    std::vector<UnitMotion> of_units;
    for (const auto& part : problem.parts_of(problem.blocks[of_link].row))
      of_units.push_back(motion_of(part.unit, motions));
    const auto values = values_after(links_[l], *step_.links, particles_, times_, of_units);
    for (std::size_t k = 0; k < values.size(); ++k) shift(of_link, k, values[k]);
  }
  return largest;
}

/// True if a last correction is larger than rounding errors and errors of solutions are.
template <int D>
bool ConstraintSystem<D>::has_large_shifts(const Island& island) const {
  constexpr double kPart = 1e-6;  // of the mean radius, a free choice
  const std::size_t contacts = island.contacts.size();
  for (std::size_t b = 0; b < island.shifts.size(); ++b) {
    const bool is_angle = b >= contacts && links_[island.links[b - contacts]].is_angle();
    if (island.shifts[b] * (is_angle ? mean_radius_ : 1) > kPart * mean_radius_) return true;
  }
  return false;
}

/// True if ContactSystem::use_distances() would change a gap of the island.
template <int D>
bool ConstraintSystem<D>::can_use_distances(ContactSystem<D>& system, const Island& island) const {
  return system.may_use_distances() && std::ranges::any_of(island.contacts, [&](std::size_t c) {
           const auto& contact = system.contacts[c];
           return contact.first >= 0 && system.is_held(contact) && !system.uses_distance(contact);
         });
}

/// Copies the solution of an island to the contacts of `system`, to the forces of links and the
/// motions of bodies of the step, and to the residuals of this object.
template <int D>
void ConstraintSystem<D>::take_over(ContactSystem<D>& system, const Island& island,
                                    const ConstraintSolution<D>& solution) {
  const auto& problem = island.problem;
  std::size_t b = 0;
  // A residual is that of the last solution plus the correction that would follow.
  for (const auto c : island.contacts) {
    const auto& block = problem.blocks[b];
    system.contacts[c].impulse = problem.impulses[block.row];
    frictions_[c] = {};
    carried_[c] =
        block.rows > 1 ? FrictionLaw::carried(system.contacts[c].impulse, block.capacity) : 0;
    for (std::size_t k = 1; k < block.rows; ++k)
      frictions_[c] =
          frictions_[c] + problem.impulses[block.row + k] * tangents_[c].directions[k - 1];
    residuals_[c] = residual_of_contact(island, b, solution);
    residuals_[c].normal += island.shifts[b];
    ++b;
  }
  const auto forces_of = [&](std::size_t l) {
    return std::span(link_forces_).subspan(links_[l].first_force, links_[l].rows.size());
  };
  for (const auto l : island.links) std::ranges::fill(forces_of(l), 0.0);
  for (const auto l : island.links) {
    const auto& link = links_[l];
    const auto& block = problem.blocks[b];
    link_residuals_[l] = solution.residuals[b].normal + island.shifts[b];
    if (link.is_angle()) link_residuals_[l] *= mean_radius_;
    // A hinge has one torque, the sum of those of its spring and its stops.
    const bool is_stop = link.kind == LinkEquations::Kind::kStop;
    const double sign = is_stop ? link.parts().front().direction[2] : 1;
    for (std::size_t k = 0; k < block.rows; ++k)
      forces_of(l)[k] += sign * problem.impulses[block.row + k] / times_.kick;
    ++b;
  }
  for (const auto in_system : island.bodies) {
    const auto body = particles_.bodies.body_of(system.bodies()[index_of(in_system)]);
    if (body < 0) continue;
    auto& step = step_.bodies[index_of(body)];
    step = free_bodies_[index_of(body)];
    const auto motion = motion_of(unit_of_body_[index_of(body)], solution.motions);
    constrain(step, motion.displacement, motion.turn, D);
  }
}

/// The residual of the contact with block `b` of the island [L]. If Coulomb's law was asked for, it
/// is the residual of this law, also if the solution has given loads.
template <int D>
BlockResidual ConstraintSystem<D>::residual_of_contact(
    const Island& island, std::size_t b, const ConstraintSolution<D>& solution) const {
  const auto& problem = island.problem;
  auto block = problem.blocks[b];
  if (is_convex_ || !island.has_given_up || block.rows == 1) return solution.residuals[b];
  block.friction_bound = FrictionBound::kCoulomb;
  std::array<double, kMostRows> v{};
  for (std::size_t k = 0; k < block.rows; ++k) {
    const auto r = block.row + k;
    v[k] = problem.rows[r].offset + problem.product(r, solution.motions);
  }
  const auto w = block_mobilities(problem, block);
  return residual_of(block, v.data(), &problem.impulses[block.row], w.data());
}

/// Bounds friction by the loads that the contacts had when the solver gave up their problems.
/// Contacts that were added later get the loads of the step before. Those of an island that was
/// joined get the loads of its last solution, or, if it could not give up, those before it.
template <int D>
void ConstraintSystem<D>::give_loads_of_step(Island& island) {
  give_loads(island.problem);
  for (std::size_t b = 0; b < island.contacts.size(); ++b) {
    const auto c = island.contacts[b];
    if (gave_up_[c] == 0)
      given_loads_[c] = could_not_give_up_[c] != 0 ? first_loads_[c] : carried_[c];
    gave_up_[c] = 1;
    island.problem.blocks[b].given_load = given_loads_[c];
  }
}

/// Solves a problem with given loads in place of those of the solution: the loads at its present
/// impulses, or, if `without_friction`, those of a solution without friction. If it is solved,
/// replaces `solution` and returns true. Adds its iterations to `result` in any case.
template <int D>
bool ConstraintSystem<D>::solve_with_given_loads(ConstraintProblem<D>& problem,
                                                 bool without_friction,
                                                 ConstraintSolution<D>& solution,
                                                 SolverResult& result) {
  give_loads(problem);
  if (without_friction) {
    for (auto& block : problem.blocks) block.given_load = 0;
    std::ranges::fill(problem.impulses, 0.0);
    problem.keeps_loads = problem.is_near = false;
  }
  auto with_given_loads = solve_constraints(problem, kMostOfGivenLoads);
  problem.keeps_loads = true;
  result.iterations += with_given_loads.result.iterations;
  const bool is_solved = with_given_loads.result.residual <= 1;
  if (is_solved) solution = std::move(with_given_loads);
  return is_solved;
}

/// Solves the problem of an island with given loads in place of those of the solution, in which
/// further iterations or corrections make no progress. Returns true if it is solved. The loads are
/// those of a solution without friction if `have_diverged`, because those of the present
/// impulses have no meaning then, and where these do not lead to a solution. Returns false, and
/// leaves the problem and `solution` as they are, if no contact has such loads, or if links
/// contradict each other. Adds the iterations to `result` in any case.
template <int D>
bool ConstraintSystem<D>::give_up(Island& island, bool have_diverged,
                                  ConstraintSolution<D>& solution, SolverResult& result) {
  auto& problem = island.problem;
  const bool has_own_loads = std::ranges::any_of(problem.blocks, [](const ConstraintBlock& block) {
    return block.is_contact && block.rows > 1 && block.friction_bound != FrictionBound::kGiven;
  });
  if (!has_own_loads || !island.can_give_up || island.has_given_up || problem.is_rough)
    return false;
  const auto with_own_loads = problem;
  island.has_given_up =
      (!have_diverged && solve_with_given_loads(problem, false, solution, result)) ||
      solve_with_given_loads(problem, true, solution, result);
  if (!island.has_given_up) {
    island.can_give_up = false;
    for (const auto c : island.contacts) could_not_give_up_[c] = 1;
    problem = with_own_loads;
    return false;
  }
  for (std::size_t b = 0; b < island.contacts.size(); ++b) {
    gave_up_[island.contacts[b]] = 1;
    given_loads_[island.contacts[b]] = problem.blocks[b].given_load;
  }
  return true;
}

/// Makes the problem of an island, as solve() describes it.
template <int D>
void ConstraintSystem<D>::make_problem(const ContactSystem<D>& system, Island& island,
                                       bool is_rough, double roughly_allowed) {
  auto& problem = island.problem;
  problem = {};
  problem.is_convex = is_convex_;
  problem.is_rough = is_rough;
  number_units(system, island);
  for (const auto c : island.contacts)
    add_contact(system.contacts[c], c, is_rough ? roughly_allowed : slips_allowed[c], problem);
  // Without friction every problem is convex.
  problem.is_convex |= std::ranges::all_of(
      problem.blocks, [](const ConstraintBlock& block) { return block.rows == 1; });
  // In a rough solution the impulses at work are not known yet.
  if (is_rough)
    for (auto& block : problem.blocks) block.allowed = roughly_allowed;
  for (const auto l : island.links)
    add_link(l, is_rough ? roughly_allowed : links_allowed[l], problem);
  const auto has_load = [&](std::size_t c) { return last_loads_[c].has_value(); };
  if (island.has_given_up) {
    give_loads_of_step(island);
  } else if (!is_rough && std::ranges::all_of(island.contacts, has_load)) {
    // Without further pairs the loads of the last solution remain, so that the motion does not
    // depend on how often it is solved, which rounding errors may decide.
    for (std::size_t b = 0; b < island.contacts.size(); ++b)
      problem.blocks[b].given_load = *last_loads_[island.contacts[b]];
    problem.keeps_loads = true;
  }
}

template <int D>
SolverResult ConstraintSystem<D>::solve(ContactSystem<D>& system, bool is_rough,
                                        double roughly_allowed, int max_iterations) {
  using Solved = typename Progress::Solved;
  find_islands(system);
  progress_.resize(system.bodies().size());
  SolverResult result;
  has_given_up_ = false;
  for (auto& island : islands_) {
    Progress progress;
    for (const auto b : island.bodies)
      progress.iterations = std::max(progress.iterations, progress_[index_of(b)].iterations);
    if (!is_solved(system, island, is_rough)) {
      const auto solved = solve_island(system, island, is_rough, roughly_allowed,
                                       max_iterations - progress.iterations);
      progress.iterations += solved.iterations;
      progress.solved = is_rough               ? Solved::kRoughly
                        : solved.residual <= 1 ? Solved::kAccurately
                                               : Solved::kNot;
      for (const auto b : island.bodies) progress_[index_of(b)] = progress;
      result.residual = largest_or_nan(result.residual, solved.residual);
    }
    result.iterations = std::max(result.iterations, progress.iterations);
    has_given_up_ |= island.has_given_up;
  }
  known_contacts_ = system.contacts.size();
  std::ranges::copy(link_forces_, step_.link_forces.begin());
  return result;
}

/// Solves the problem of one island, as solve() describes it.
template <int D>
SolverResult ConstraintSystem<D>::solve_island(ContactSystem<D>& system, Island& island,
                                               bool is_rough, double roughly_allowed,
                                               int max_iterations) {
  auto& problem = island.problem;
  // Each correction multiplies the error by about the turn of the bodies in the step [rad]. With
  // turns of 1 it gains little. Corrections diverge if they grow kPatience times in succession, or
  // if kMostWithoutGain of them do not halve the largest correction, which a factor of 0.87 would
  // do. Either the constraints contradict each other, or the step is too long.
  constexpr int kPatience = 3, kMostWithoutGain = 5;
  // A correction is fast if it is below kFast times the one before. All these numbers are free
  // choices.
  constexpr double kFast = 0.1;
  // An unsolved problem is still corrected if its residual is this small part of the correction.
  constexpr double kSmallPart = 1e-3;
  // Corrected problems take 10 to 300 iterations, unless constraints contradict each other.
  constexpr int kMostCorrected = 1000;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double last_change = kInfinity, gained_change = kInfinity;
  int growing = 0, gained_at = 0;
  const auto restart = [&] {
    make_problem(system, island, is_rough, roughly_allowed);
    last_change = gained_change = kInfinity;
    growing = gained_at = 0;
  };
  const auto use_distances = [&] {
    const bool is_change = can_use_distances(system, island);
    if (is_change) system.use_distances(island.bodies.front());
    return is_change;
  };
  restart();
  ConstraintSolution<D> solution;
  SolverResult result;
  for (int n = 0;; ++n) {
    int most = island.has_given_up ? kMostOfGivenLoads : max_iterations - result.iterations;
    if (n > 0 && can_use_distances(system, island)) most = std::min(most, kMostCorrected);
    solution = solve_constraints(problem, std::max(1, most));
    result.iterations += solution.result.iterations;
    const bool is_exhausted =
        result.iterations >= max_iterations + (island.has_given_up ? kMostOfGivenLoads : 0);
    // A convex problem is given up only if further iterations would not solve it.
    if (!(solution.result.residual <= 1) && !is_rough && !(is_convex_ && is_exhausted)) {
      if (n > 0 && use_distances()) {
        max_iterations += result.iterations;
        restart();
        n = -1;
        continue;
      }
      // Where friction locks particles that must move, impulses grow without bound, so that loads
      // have no meaning. This happens in every convex problem without a solution.
      give_up(island, is_convex_, solution, result);
    }
    result.residual = solution.result.residual;
    move_particles(system, island, solution.motions);
    const double change = correct(system, island, solution);
    result.residual += change;
    growing = change < last_change ? 0 : growing + 1;
    const bool is_fast = change < kFast * last_change;
    last_change = change;
    if (change < gained_change / 2) {
      gained_change = change;
      gained_at = n;
    }
    const bool is_unsolved = !(solution.result.residual <= std::max(1.0, kSmallPart * change));
    // Half of what is allowed is left to the residual of the solution.
    if (change <= 0.5 || is_rough || is_unsolved || is_exhausted) break;
    if (growing == kPatience || n - gained_at == kMostWithoutGain) {
      if (!has_large_shifts(island)) break;
      if (use_distances()) {
        restart();
        n = -1;
        continue;
      }
      // Friction may turn bodies so far that corrections do not converge.
      if (island.has_given_up) break;
      auto corrected = std::move(problem);
      restart();
      if (!give_up(island, true, solution, result)) {
        problem = std::move(corrected);
        break;
      }
      n = 0;
      continue;
    }
    // The loads of a solution bound the friction of the next one. With large friction this may
    // repeat without end, while corrections would follow the loads instead of vanishing. The first
    // correction contains most of what turns change. The loads are therefore those of the solution
    // after it, from the same first loads as before it, and later ones keep them.
    if (n == 0 && !problem.keeps_loads)
      for (std::size_t b = 0; b < island.contacts.size(); ++b)
        problem.blocks[b].given_load = first_loads_[island.contacts[b]];
    if (n > 0) problem.keeps_loads = true;
    problem.is_near =
        n > 0 && solution.result.residual <= 1 && (is_fast || !has_large_shifts(island));
  }
  take_over(system, island, solution);
  if (is_rough)
    for (const auto c : island.contacts) first_loads_[c] = carried_[c];
  if (is_rough || island.has_given_up) return result;
  for (std::size_t b = 0; b < island.contacts.size(); ++b)
    last_loads_[island.contacts[b]] = problem.blocks[b].given_load;
  return result;
}

template <int D>
std::vector<double> ConstraintSystem<D>::least_violations() const {
  const std::size_t contacts = residuals_.size();
  std::vector<double> all(contacts + links_.size());
  for (const auto& island : islands_) {
    if (island.problem.blocks.empty()) continue;
    const auto of_blocks = least_violations_of(island.problem);
    for (std::size_t b = 0; b < island.contacts.size(); ++b) all[island.contacts[b]] = of_blocks[b];
    for (std::size_t b = 0; b < island.links.size(); ++b) {
      const auto l = island.links[b];
      all[contacts + l] =
          of_blocks[island.contacts.size() + b] * (links_[l].is_angle() ? mean_radius_ : 1);
    }
  }
  return all;
}
template class ConstraintSystem<2>;
template class ConstraintSystem<3>;

}  // namespace viscontact::particles
