// The stresses and the dissipation of a step, (9.9) and (9.17).
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "viscontact/common/index.hpp"
#include "viscontact/suspensions/pairs/row_blocks.hpp"
#include "viscontact/suspensions/step/contacts.hpp"
#include "viscontact/suspensions/step/films.hpp"
#include "viscontact/suspensions/step/step_parts.hpp"

namespace viscontact::suspensions {

void SuspensionStep::sum_stresses(StepSolution& solution) {
  const auto& resistance = system_.resistance();
  const auto& rows = resistance.pairs;
  struct Sums {
    StressSums stresses;
    double dissipation = 0, given = 0;
    Sums& operator+=(const Sums& other) {
      stresses += other.stresses;
      dissipation += other.dissipation;
      given += other.given;
      return *this;
    }
  };
  const auto power = [](const Motion& load, const Motion& motion) {
    return dot(load.along, motion.along) + dot(load.turn, motion.turn);
  };
  const auto of_spheres = problem_.pool->sum_of_blocks<Sums>(
      motions_.size(),
      [&](std::size_t begin, std::size_t end) {
        Sums part;
        for (std::size_t k = begin; k < end; ++k) {
          const auto& v = motions_[k];
          const auto& [move, turn] = resistance.spheres[k];
          const double given = problem_.loads.empty() ? 0 : power(problem_.loads[k], v);
          // The loads of the strain are what the given loads differ by.
          part.dissipation +=
              power({move * v.along, turn * v.turn}, v) - (power(given_loads_[k], v) - given);
          part.given += given;
        }
        return part;
      },
      BlockTuning::kSpheres);
  // The terms of films and contacts along n, and of friction, are added apart.
  const auto add_turns = [&](std::size_t p, const FrictionContact* contact, Sums& part) {
    auto row = rows[p];
    row.squeeze = 0;
    if (contact) {
      row.turn_first = contact->turn_first;
      row.turn_mixed = contact->turn_mixed;
      row.turn_second = contact->turn_second;
    }
    const auto add_row = [&](const auto& of) {
      const auto &first = motions_[index_of(row.first)], &second = motions_[index_of(row.second)];
      const auto loads = loads_of(of, first, second);
      part.dissipation += power(loads.first, first) + power(loads.second, second);
    };
    add_row(row);
    if (!resistance.drags.empty()) add_row(resistance.drags[p]);
  };
  const auto add_pair = [&](std::size_t p, Sums& part) {
    const auto& row = rows[p];
    const auto& film = films_[p];
    const auto* friction =
        film.contact >= 0 && !frictions_.empty() ? &frictions_[index_of(film.contact)] : nullptr;
    add_turns(p, friction, part);
    const Vector n = vector_of(row.normal);
    const double along = dot(n, strain_.times(n)), rate = opening(p, motions_);
    if (film.alpha > 0) {
      const auto [arm, excess, stress_axial] = film_strain(p);
      const double force = film.force_at(film.width, solid_width(), problem_.h);
      const double axial = arm * force + stress_axial * along;
      auto& stress = part.stresses.film.stress;
      stress.add_dyad(axial, n, n);
      stress.add_isotropic((sizes(p).contact_distance * force - axial) / 3);
      part.dissipation += force * (rate + arm * along) + stress_axial * along * along;
    }
    if (film.contact < 0) return;
    const double load = contacts_[index_of(film.contact)].load;
    const Vector change =
        vector_of(motions_[index_of(row.second)].along - motions_[index_of(row.first)].along);
    if (load != 0) {
      const Vector lever =
          mean_path(problem_.gradient, problem_.h, problem_.pairs[p].apart, change);
      part.stresses.contact.add_pair_force(load * n, lever, problem_.gradient);
      part.dissipation -= load * (rate + dot(n, times(problem_.gradient, lever)));
    }
    if (!friction || !(dot(friction->friction, friction->friction) > 0)) return;
    const Vector force = vector_of(force_of(*friction));
    part.stresses.friction.stress.add_dyad(-friction->arm, n, force);
    part.stresses.friction.power -= friction->arm * dot(force, strain_.times(n));
    part.dissipation += dot(friction->friction, slip(*friction, motions_));
  };
  const auto of_pairs = problem_.pool->sum_of_blocks<Sums>(
      rows.size(),
      [&](std::size_t begin, std::size_t end) {
        Sums part;
        for (std::size_t p = begin; p < end; ++p) add_pair(p, part);
        return part;
      },
      kPairsInBlock);
  auto& sums = solution.stresses;
  sums = of_pairs.stresses;
  const auto strained = system_.stresslets(motions_, strain_);
  sums.film.stress.add(1, strained);
  // The momentum at the start is among the given loads.
  const double given = of_spheres.given + power_of_momentum() - power_of_inertia();
  solution.dissipation = of_spheres.dissipation + of_pairs.dissipation +
                         strained.contracted(strain_) + power_of_momentum() - power_of_inertia();
  // The power that the dissipation needs. It differs from stress:E by the residuals of the motions,
  // and has an error of their square.
  sums.film.power = solution.dissipation - given - sums.contact.power - sums.friction.power;
}

}  // namespace viscontact::suspensions
