// The ConstraintProblem of an island of a ConstraintSystem.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "viscontact/contact_dynamics/constraints/constraint_system.hpp"

namespace viscontact::particles {

template <int D>
void ConstraintSystem<D>::number_units(const ContactSystem<D>& system, Island& island) {
  for (const auto b : island.bodies)
    if (const auto body = particles_.bodies.body_of(system.bodies()[index_of(b)]); body >= 0)
      unit_of_body_[index_of(body)] = -1;
  for (const auto b : island.bodies) {
    const auto particle = system.bodies()[index_of(b)];
    if (is_given(particle)) continue;
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
UnitMotion ConstraintSystem<D>::given_motion(std::int32_t particle) const {
  constexpr auto turns = static_cast<std::size_t>(kTurns<D>);
  UnitMotion motion{point_of(displacements_.data(), index_of(particle), D)};
  for (std::size_t i = 0; i < turns; ++i)
    motion.turn[3 - turns + i] = step_.turns[index_of(particle) * turns + i];
  return motion;
}

template <int D>
ContactSide ConstraintSystem<D>::side_of(std::int32_t entry) const {
  if (entry < 0) return {};
  if (is_given(entry)) {
    const auto motion = given_motion(entry);
    return {-1, {}, motion.displacement, motion.turn};
  }
  const auto k = index_of(entry);
  return {unit_of_particle_[k], particles_.bodies.body_of(entry) < 0 ? Vector{} : offsets_[k]};
}

template <int D>
bool ConstraintSystem<D>::has_friction(const ContactTangents<D>& tangents) const {
  return step_.laws.friction && step_.laws.friction->coefficient > 0 &&
         std::isfinite(tangents.capacity);
}

template <int D>
bool ConstraintSystem<D>::has_given_slip(const Contact<D>& contact) const {
  return contact.loaded_plane >= 0 && is_given(contact.second);
}

template <int D>
Vector ConstraintSystem<D>::friction_of_given_slip(const Contact<D>& contact,
                                                   const ContactState& state) const {
  assert(has_given_slip(contact));
  Vector normal{};
  std::copy_n(contact.normal.begin(), D, normal.begin());
  const auto motion = given_motion(contact.second);
  Vector slip = motion.displacement - state.tangents.second_arm * cross(motion.turn, normal) +
                cross(motion.turn, state.tangents.centres[1]) - state.tangents.surface;
  slip = slip - dot(slip, normal) * normal;
  const double length = norm(slip);
  if (!(length > 0)) return {};
  return (-step_.laws.friction->coefficient * state.solid_load / length) * slip;
}

template <int D>
void ConstraintSystem<D>::add_contact(const Contact<D>& contact, std::size_t c, double allowed_slip,
                                      ConstraintProblem<D>& problem) {
  const auto& state = contact_states_[c];
  const auto& tangents = state.tangents;
  ConstraintBlock block;
  block.row = problem.rows.size();
  block.lowest = contact.lowest;
  block.friction = step_.laws.friction ? step_.laws.friction->coefficient : 0;
  block.capacity = tangents.capacity;
  block.allowed = contact.allowed;
  block.allowed_slip = allowed_slip;
  // Friction that moves nothing has no rows, because their mobilities would be 0.
  const bool rubs = has_friction(tangents) && !has_given_slip(contact);
  block.rows = rubs ? static_cast<std::size_t>(D) : 1;
  if (problem.is_convex && rubs) {
    block.friction_bound = block.has_film() ? FrictionBound::kGiven : FrictionBound::kCone;
    block.given_load = state.first_load;
  }
  block.is_optional = contact.is_optional && rubs;
  problem.blocks.push_back(block);
  const auto first = side_of(contact.first_entry()), second = side_of(contact.second);
  for (std::size_t k = 0; k < block.rows; ++k) {
    const double guess = block.is_optional && contact.impulse == 0 ? 0
                         : k == 0                                  ? contact.impulse
                                  : dot(tangents.directions[k - 1], state.friction);
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
    double offset = equation.value;
    for (const auto& part : equation.parts)
      if (is_given(part.particle))
        offset += value_of(part, given_motion(part.particle));
      else
        parts.push_back({unit_of_particle_[index_of(part.particle)], row_of<D>(part)});
    const double guess = is_stop ? 0 : first_link_forces_[link.first_force + k];
    problem.add_row(offset, parts, times_.impulse_time * guess);
  }
}

template <int D>
bool ConstraintSystem<D>::has_motions_without_contacts(const Island& island) const {
  return !island.contacts.empty() && std::ranges::any_of(island.bodies, [&](std::int32_t b) {
    return index_of(b) < without_contacts_.size() && without_contacts_[index_of(b)];
  });
}

template <int D>
std::vector<Motion<D>> ConstraintSystem<D>::motions_without_contacts(const ContactSystem<D>& system,
                                                                     const Island& island) const {
  std::vector<Motion<D>> motions;
  for (const auto& unit : island.problem.units) motions.push_back(unit.free);
  for (const auto b : island.bodies)
    if (index_of(b) < without_contacts_.size() && without_contacts_[index_of(b)]) {
      const auto unit = unit_of_particle_[index_of(system.bodies()[index_of(b)])];
      motions[index_of(unit)] = *without_contacts_[index_of(b)];
    }
  return motions;
}

template <int D>
void ConstraintSystem<D>::give_loads_of_step(Island& island) {
  give_loads(island.problem);
  for (std::size_t b = 0; b < island.contacts.size(); ++b) {
    auto& state = contact_states_[island.contacts[b]];
    if (!state.gave_up)
      state.given_load = state.could_not_give_up ? state.first_load : state.solid_load;
    state.gave_up = true;
    island.problem.blocks[b].given_load = state.given_load;
  }
}

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
  // Before a rough solution the impulses are not known yet, on which Contact::allowed depends.
  if (is_rough)
    for (auto& block : problem.blocks) block.allowed = roughly_allowed;
  for (const auto l : island.links)
    add_link(l, is_rough ? roughly_allowed : links_allowed[l], problem);
  island.tensions.clear();
  island.shifts.clear();
  island.shifts_across.clear();
  std::vector<Motion<D>> free;
  for (const auto& unit : problem.units) free.push_back(unit.free);
  change_tensions(system, island, free, true);
  const auto has_load = [&](std::size_t c) { return contact_states_[c].last_load.has_value(); };
  if (island.has_given_up) {
    give_loads_of_step(island);
  } else if (!is_rough && std::ranges::all_of(island.contacts, has_load)) {
    // If no contact was added, the loads of the last solution remain. The motion then does not
    // depend on the number of solutions, which rounding errors may decide.
    for (std::size_t b = 0; b < island.contacts.size(); ++b)
      problem.blocks[b].given_load = *contact_states_[island.contacts[b]].last_load;
    problem.keeps_loads = true;
  }
}

template ContactSide ConstraintSystem<2>::side_of(std::int32_t) const;
template ContactSide ConstraintSystem<3>::side_of(std::int32_t) const;
template bool ConstraintSystem<2>::has_friction(const ContactTangents<2>&) const;
template bool ConstraintSystem<2>::has_given_slip(const Contact<2>&) const;
template Vector ConstraintSystem<2>::friction_of_given_slip(const Contact<2>&,
                                                            const ContactState&) const;
template void ConstraintSystem<2>::make_problem(const ContactSystem<2>&, Island&, bool, double);
template bool ConstraintSystem<2>::has_motions_without_contacts(const Island&) const;
template std::vector<Motion<2>> ConstraintSystem<2>::motions_without_contacts(
    const ContactSystem<2>&, const Island&) const;
template bool ConstraintSystem<3>::has_friction(const ContactTangents<3>&) const;
template bool ConstraintSystem<3>::has_given_slip(const Contact<3>&) const;
template Vector ConstraintSystem<3>::friction_of_given_slip(const Contact<3>&,
                                                            const ContactState&) const;
template void ConstraintSystem<3>::make_problem(const ContactSystem<3>&, Island&, bool, double);
template bool ConstraintSystem<3>::has_motions_without_contacts(const Island&) const;
template std::vector<Motion<3>> ConstraintSystem<3>::motions_without_contacts(
    const ContactSystem<3>&, const Island&) const;

}  // namespace viscontact::particles
