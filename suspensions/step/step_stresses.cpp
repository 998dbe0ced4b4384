// The stresses and the dissipation of a step, (9.9) and (9.17).
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "viscontact/common/index.hpp"
#include "viscontact/suspensions/pairs/row_blocks.hpp"
#include "viscontact/suspensions/step/step_parts.hpp"

namespace viscontact::suspensions {

void SuspensionStep::sum_stresses(StepSolution& solution) {
  auto& rows = system_.resistance().pairs;
  // The terms of films and contacts along n are added apart.
  std::vector<double> squeezes(rows.size());
  for (std::size_t p = 0; p < rows.size(); ++p) squeezes[p] = std::exchange(rows[p].squeeze, 0);
  for (auto& contact : contacts_) {
    if (!(problem_.friction > 0)) break;
    auto& row = rows[contact.pair];
    row.turn_first = contact.turn_first;
    row.turn_mixed = contact.turn_mixed;
    row.turn_second = contact.turn_second;
  }
  system_.resistance().slips.clear();
  auto& sums = solution.stresses;
  sums = {};
  sums.film.stress = system_.stresslets(motions_, strain_);
  std::vector<Motion> product(motions_.size()), strained(motions_.size());
  RowBlocks blocks;
  blocks.set(system_.resistance());
  blocks.multiply(system_.resistance(), motions_, product, *problem_.pool);
  system_.subtract_strain_loads(strain_, strained);
  solution.dissipation = sums.film.stress.contracted(strain_);
  double given = 0;
  for (std::size_t k = 0; k < motions_.size(); ++k) {
    const auto &v = motions_[k], &given_load = problem_.loads[k];
    solution.dissipation += dot(v.along, product[k].along - strained[k].along) +
                            dot(v.turn, product[k].turn - strained[k].turn);
    given += dot(v.along, given_load.along) + dot(v.turn, given_load.turn);
  }
  solution.dissipation -= power_of_inertia();
  given += power_of_momentum() - power_of_inertia();
  struct Sums {
    StressSums stresses;
    double dissipation = 0;
    Sums& operator+=(const Sums& other) {
      stresses += other.stresses;
      dissipation += other.dissipation;
      return *this;
    }
  };
  const auto add_pair = [&](std::size_t p, Sums& part) {
    const auto& row = rows[p];
    const auto& film = films_[p];
    const Vector n = vector_of(row.normal);
    const double along = dot(n, strain_.times(n)), rate = opening(p, motions_);
    if (film.alpha > 0) {
      const double gap = film.affine_gap + film.curvature + problem_.h * rate;
      const double force = film.force_at(gap, problem_.h);
      const double axial = film.arm * force + film.stress_axial * along;
      auto& stress = part.stresses.film.stress;
      stress.add_dyad(axial, n, n);
      stress.add_isotropic((system_.strains()[p].radii * force - axial) / 3);
      part.dissipation += force * (rate + film.arm * along) + film.stress_axial * along * along;
    }
    if (film.contact < 0) return;
    const auto& contact = contacts_[index_of(film.contact)];
    const double load = contact.memory.load;
    const Vector change =
        vector_of(motions_[index_of(row.second)].along - motions_[index_of(row.first)].along);
    if (load != 0) {
      const Vector lever =
          mean_path(problem_.gradient, problem_.h, problem_.pairs[p].apart, change);
      part.stresses.contact.add_pair_force(load * n, lever, problem_.gradient);
      part.dissipation -= load * (rate + dot(n, times(problem_.gradient, lever)));
    }
    if (!(problem_.friction > 0) || !(dot(contact.friction, contact.friction) > 0)) return;
    const Vector force = vector_of(cross(contact.friction, row.normal));
    part.stresses.friction.stress.add_dyad(-contact.arm, n, force);
    part.stresses.friction.power -= contact.arm * dot(force, strain_.times(n));
    part.dissipation += dot(contact.friction, slip(contact, motions_));
  };
  const auto of_pairs = problem_.pool->sum_of_blocks<Sums>(
      rows.size(),
      [&](std::size_t begin, std::size_t end) {
        Sums part;
        for (std::size_t p = begin; p < end; ++p) add_pair(p, part);
        return part;
      },
      kPairsInBlock);
  sums += of_pairs.stresses;
  solution.dissipation += of_pairs.dissipation;
  // The power that the dissipation needs. It differs from stress:E by the residuals of the motions,
  // and has an error of their square.
  sums.film.power = solution.dissipation - given - sums.contact.power - sums.friction.power;
  for (std::size_t p = 0; p < rows.size(); ++p) rows[p].squeeze = squeezes[p];
}

}  // namespace viscontact::suspensions
