// Chooses the contacts of a step in a fluid (step_contacts.hpp). Units are those of the case.
#include "viscontact/particles/fluid/contact/step_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "viscontact/particles/fluid/fluid_solver.hpp"

namespace viscontact::particles {
namespace {

/// Solves for contacts in rounds, in which those join whose gaps the others close.
StepContacts solve_listed(StepContacts step, std::span<const double> free_velocities,
                          const Mobility& mobility, const ContactConditions& conditions,
                          const MotionLayout& layout) {
  ContactProblem problem(free_velocities, conditions.h, mobility, layout, conditions.solver,
                         conditions.mean_radius, conditions.mobility_error);
  std::vector<std::size_t> chosen;
  std::vector<char> is_chosen(step.contacts.size(), 0);
  const int most = conditions.solver.max_iterations;
  for (;;) {
    const auto before = chosen.size();
    for (std::size_t c = 0; c < step.contacts.size(); ++c) {
      const auto& contact = step.contacts[c];
      const double after = gap_after(contact, problem.velocities().data(), conditions.h, layout);
      const bool takes_part = after < 0 || contact.gamma < 0 || contact.impulse != 0;
      if (is_chosen[c] != 0 || !takes_part) continue;
      is_chosen[c] = 1;
      chosen.push_back(c);
      problem.add(contact);
    }
    const bool has_joined = chosen.size() > before;
    if (!has_joined && !problem.is_rough()) break;
    step.is_solved = problem.solve(has_joined && problem.iterations() < most);
  }
  for (auto& contact : step.contacts) contact.impulse = 0;
  for (std::size_t i = 0; i < chosen.size(); ++i) step.contacts[chosen[i]] = problem.contacts()[i];
  step.loads = problem.loads();
  step.velocities = problem.velocities();
  step.iterations += problem.iterations();
  return step;
}

}  // namespace

StepContacts solve_contacts(const State& state, std::span<const double> free_velocities,
                            const Mobility& mobility, const ContactConditions& conditions,
                            ThreadPool& pool) {
  const auto& p = state.particles;
  const MotionLayout layout{motion_components(p.dimension)};
  const double h = conditions.h;
  const double of_images = norm(velocity_of_image(p.cell, Periods{1, 0})) +
                           norm(velocity_of_image(p.cell, Periods{0, 1}));
  // Contacts push particles at speeds that are seldom above twice the largest one without contact.
  double reach = conditions.threshold + h * (4 * fastest(free_velocities, layout) + of_images) +
                 1e-3 * conditions.mean_radius;
  int iterations = 0;
  for (;;) {
    StepContacts step;
    step.iterations = iterations;
    step.pairs = pairs_in_reach(state, conditions.obstacles, reach, pool);
    std::erase_if(step.pairs.pairs, [&](const Pair& pair) {
      return (!conditions.is_movable(pair.first) && !conditions.is_movable(pair.second)) ||
             (conditions.are_apart_by_arm && conditions.are_apart_by_arm(pair.first, pair.second));
    });
    std::erase_if(step.pairs.walls,
                  [&](const Pair& pair) { return !conditions.is_movable(pair.second); });
    for (const auto* list : {&step.pairs.pairs, &step.pairs.walls})
      for (const auto& pair : *list) {
        auto contact = fluid_contact_of(p, pair, conditions.obstacles, conditions.threshold,
                                        free_velocities, h);
        // A threshold gap that is crossed by less than the tolerance counts as reached.
        if (std::abs(contact.gap) <= conditions.solver.tolerance * conditions.mean_radius / 2)
          contact.gap = 0;
        step.contacts.push_back(contact);
      }
    step = solve_listed(std::move(step), free_velocities, mobility, conditions, layout);
    const double needed =
        conditions.threshold + h * (2 * fastest(step.velocities, layout) + of_images);
    if (needed <= reach) return step;
    iterations = step.iterations;
    reach = 2 * needed;
  }
}

}  // namespace viscontact::particles
