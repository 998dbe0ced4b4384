// The blocks of a problem with the geometric stiffness of links and films, docs/physics.md (5.21).
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "viscontact/constraint_rows/tension.hpp"
#include "viscontact/contact_dynamics/constraints/constraint_system.hpp"
#include "viscontact/particles/contact/film_tension.hpp"
#include "viscontact/particles/domain/periods.hpp"

namespace viscontact::particles {
namespace {

struct TensionTuning {
  // Tensions that differ by less than this part of their sum count as the same. Each solution of a
  // problem whose loads may drift shifts them by up to 1e-5.
  static constexpr double kSame = 1e-4;
  // Shifts below this part of what is allowed change no tensions, as IslandTuning::kEnd.
  static constexpr double kSmall = 0.5;
};

/// The mobility of a row [T/M, T/(M L^2)].
template <int D>
double mobility_of(std::span<const RowPart<D>> parts, const ConstraintProblem<D>& problem) {
  double w = 0;
  for (const auto& part : parts) {
    const auto moved =
        problem.units[static_cast<std::size_t>(part.unit)].moved_by(part.coefficients);
    for (std::size_t k = 0; k < moved.size(); ++k) w += part.coefficients[k] * moved[k];
  }
  return w;
}

}  // namespace

template <int D>
std::vector<LinkRow> ConstraintSystem<D>::tension_rows(const ContactSystem<D>& system,
                                                       const Island& island, std::size_t b) const {
  const auto& problem = island.problem;
  const auto& block = problem.blocks[b];
  if (b >= island.contacts.size()) {
    std::vector<double> forces;
    for (std::size_t k = 0; k < block.rows; ++k)
      forces.push_back(problem.impulses[block.row + k] / times_.impulse_time);
    return rows_of_tension(links_[island.links[b - island.contacts.size()]], forces, particles_);
  }
  const auto& contact = system.contacts[island.contacts[b]];
  const double force = problem.impulses[block.row] / times_.impulse_time;
  if (contact.first < 0 || !(force < 0)) return {};
  auto first = side_of(contact.first), second = side_of(contact.second);
  if (first.unit == second.unit) return {};
  Vector apart{};
  std::ranges::copy(separation<D>(particles_, contact.first, contact.second, contact.image),
                    apart.begin());
  if (contact.shaped != nullptr) {
    const auto& centres = contact_states_[island.contacts[b]].tangents.centres;
    apart = apart + centres[1] - centres[0];
    first.offset = first.offset + centres[0];
    second.offset = second.offset + centres[1];
  }
  return rows_across({contact.first, {}, first.offset}, {contact.second, {}, second.offset}, apart,
                     -force, D);
}

template <int D>
std::vector<double> ConstraintSystem<D>::film_kappas_of_units(const ContactSystem<D>& system,
                                                              const Island& island) const {
  const auto& problem = island.problem;
  std::vector<double> kappas(problem.units.size());
  double largest = 0;
  for (std::size_t b = 0; b < island.contacts.size(); ++b) {
    const auto rows = tension_rows(system, island, b);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      // The second row across a film of spheres has the kappa of the first.
      if (D == 3 && k == 1 && !rows[k].parts.front().is_turn) continue;
      for (const auto& part : rows[k].parts) {
        if (is_given(part.particle)) continue;
        const auto unit = unit_of_particle_[index_of(part.particle)];
        const std::array<RowPart<D>, 1> own = {{{unit, row_of<D>(part)}}};
        auto& kappa = kappas[index_of(unit)];
        kappa += times_.impulse_time * rows[k].stiffness * mobility_of<D>(own, problem);
        largest = std::max(largest, kappa);
      }
    }
  }
  if (!(share_of_film(largest) > 0)) kappas.clear();
  return kappas;
}

template <int D>
double ConstraintSystem<D>::change_tensions(const ContactSystem<D>& system, Island& island,
                                            std::span<const Motion<D>> motions, bool is_always) {
  auto& problem = island.problem;
  const std::size_t sources = island.contacts.size() + island.links.size();
  struct NewRow {
    std::vector<RowPart<D>> parts;
    ConstraintBlock block;
    Tension tension;
    double value, impulse;
  };
  // What is allowed between particles that are held at rest is less than what the solver resolves
  // in the rows across them, which move nothing there.
  double allowed = 0;
  const auto is_of_lengths = [&](std::size_t b) {
    if (b < island.contacts.size()) return true;
    const auto& link = links_[island.links[b - island.contacts.size()]];
    return !link.is_angle() && link.kind != LinkEquations::Kind::kArea;
  };
  for (std::size_t b = 0; b < sources; ++b)
    if (is_of_lengths(b)) allowed = std::max(allowed, problem.blocks[b].allowed);
  std::vector<NewRow> rows;
  std::vector<Motion<D>> changes;  // of the impulses of all units
  const auto add = [&](std::span<const RowPart<D>> parts, double impulse) {
    for (const auto& [unit, coefficients] : parts)
      for (std::size_t k = 0; k < coefficients.size(); ++k)
        changes[index_of(unit)][k] += impulse * coefficients[k];
  };
  const auto of_films = film_kappas_of_units(system, island);
  for (std::size_t b = 0; b < sources; ++b) {
    const bool is_film = b < island.contacts.size();
    if (is_film && of_films.empty()) continue;
    const auto from = tension_rows(system, island, b);
    for (const auto& equation : from) {
      NewRow row;
      double given = 0;
      for (const auto& part : equation.parts)
        if (is_given(part.particle))
          given += value_of(part, given_motion(part.particle));
        else
          row.parts.push_back({unit_of_particle_[index_of(part.particle)], row_of<D>(part)});
      if (row.parts.empty()) continue;
      double w = mobility_of<D>(row.parts, problem);
      const auto& first = equation.parts.front();
      if (!is_film &&
          links_[island.links[b - island.contacts.size()]].kind == LinkEquations::Kind::kHinge) {
        // A body that is held at a point also moves when it turns.
        const Vector around = cross(first.direction, first.arm);
        w = 1 / (1 / w + problem.units[index_of(row.parts.front().unit)].inverse_mobility *
                             dot(around, around));
      }
      double kappa = 0;
      for (const auto& part : row.parts)
        if (is_film) kappa = std::max(kappa, of_films[index_of(part.unit)]);
      double stiffness = equation.stiffness *
                         (is_film ? share_of_film(kappa)
                                  : share_of_tension(times_.impulse_time * equation.stiffness * w));
      const double rate = rate_of(equation, particles_);
      // The tension that keeps a pair on its circle does not pull it back.
      if (times_.is_first && !first.is_turn) {
        const double turn = rate / equation.length;
        stiffness -= times_.h / w * turn * turn;
      }
      if (!(stiffness > 0)) continue;
      row.tension = {b, times_.h * rate, given,
                     first.is_turn ? Vector{} : equation.parts.back().direction};
      for (const auto& part : equation.parts)
        if (!part.is_turn && is_given(part.particle))
          row.tension.on_given.emplace_back(part.particle, part.direction);
      row.block.is_contact = false;
      row.block.is_geometric = true;
      row.block.allowed = allowed / (first.is_turn ? mean_radius_ : 1);
      row.block.compliance = 1 / (times_.beta_across() * times_.impulse_time * stiffness);
      row.value = (times_.is_first ? 0 : -times_.h * rate) + given;
      double value = row.value;
      for (const auto& [unit, coefficients] : row.parts)
        for (std::size_t k = 0; k < coefficients.size(); ++k)
          value += coefficients[k] * motions[index_of(unit)][k];
      row.impulse = -value / row.block.compliance;
      rows.push_back(std::move(row));
    }
  }
  island.shifts.resize(sources);
  island.shifts_across.resize(sources);
  if (rows.empty() && island.tensions.empty()) return 0;
  if (!is_always && island.loads_may_drift && rows.size() == island.tensions.size()) {
    double impulses = 0, differences = 0;
    for (std::size_t t = 0; t < rows.size(); ++t) {
      impulses += std::abs(rows[t].impulse);
      differences += std::abs(rows[t].impulse - problem.impulses[problem.blocks[sources + t].row]);
    }
    if (differences <= TensionTuning::kSame * impulses) return 0;
  }
  changes.resize(problem.units.size());
  for (std::size_t t = 0; t < island.tensions.size(); ++t) {
    const auto r = problem.blocks[sources + t].row;
    add(problem.parts_of(r), -problem.impulses[r]);
  }
  for (const auto& row : rows) add(row.parts, row.impulse);
  double largest = 0;
  const auto take = [&](std::size_t b) {
    double moved = 0;
    for (const auto& part : problem.parts_of(problem.blocks[b].row)) {
      const auto by = problem.units[index_of(part.unit)].moved_by(changes[index_of(part.unit)]);
      for (std::size_t k = 0; k < by.size(); ++k)
        moved = std::max(moved, std::abs(by[k]) * (k < D ? 1 : mean_radius_));
    }
    // In proportion to what the block's own residual may be.
    const double own = moved * problem.blocks[b].allowed / allowed;
    island.shifts_across[b] = std::max(island.shifts_across[b], own);
    largest = std::max(largest, moved / allowed);
  };
  for (const auto& tension : island.tensions) take(tension.source);
  for (const auto& row : rows) take(row.tension.source);
  if (largest <= TensionTuning::kSmall && !is_always) return largest;
  if (!island.tensions.empty()) {
    const auto first_row = problem.blocks[sources].row;
    problem.parts.resize(problem.rows[first_row].first_part);
    problem.rows.resize(first_row);
    problem.impulses.resize(first_row);
    problem.blocks.resize(sources);
    island.tensions.clear();
  }
  for (const auto& row : rows) {
    island.tensions.push_back(row.tension);
    problem.blocks.push_back(row.block);
    problem.blocks.back().row = problem.rows.size();
    problem.add_row(row.value, row.parts, row.impulse);
  }
  return largest;
}

template <int D>
double ConstraintSystem<D>::buckling() const {
  using Kind = LinkEquations::Kind;
  double largest = 0;
  for (const auto& link : links_) {
    const double force = link_forces_[link.first_force];
    if (link.kind == Kind::kArea) {
      for (const auto& part : link.parts())
        largest = std::max(
            largest, times_.impulse_time * std::abs(force) * mobilities_[index_of(part.particle)]);
      continue;
    }
    if (!(force > 0) ||
        (link.kind != Kind::kArm && link.kind != Kind::kSpring && link.kind != Kind::kDistance))
      continue;
    const auto& parts = link.parts();
    const double length =
        norm(nearest_image(particles_.cell, particles_.position(index_of(parts[1].particle)) -
                                                particles_.position(index_of(parts[0].particle))));
    double w = 0;
    for (const auto& part : parts) w += mobilities_[index_of(part.particle)];
    if (length > 0) largest = std::max(largest, times_.impulse_time * force / length * w);
  }
  return largest;
}

template <int D>
void ConstraintSystem<D>::take_impulses_across(const Island& island,
                                               std::span<const Motion<D>> motions) {
  const auto& problem = island.problem;
  for (const auto l : island.links)
    if (links_[l].kind == LinkEquations::Kind::kArm) step_.works_across[links_[l].number] = 0;
  for (const auto c : island.contacts) contact_states_[c].across = {};
  across_on_given_.resize(links_.size());
  for (const auto l : island.links) across_on_given_[l].clear();
  const std::size_t contacts = island.contacts.size(), sources = contacts + island.links.size();
  for (std::size_t t = 0; t < island.tensions.size(); ++t) {
    const auto& tension = island.tensions[t];
    const auto r = problem.blocks[sources + t].row;
    if (tension.source < contacts) {
      auto& across = contact_states_[island.contacts[tension.source]].across;
      across = across + problem.impulses[r] * tension.direction;
      continue;
    }
    const auto l = island.links[tension.source - contacts];
    const auto& link = links_[l];
    for (const auto& [particle, direction] : tension.on_given)
      across_on_given_[l].push_back({particle, problem.impulses[r] * direction, {}});
    if (link.kind == LinkEquations::Kind::kArm)
      step_.works_across[link.number] +=
          problem.impulses[r] *
          (tension.moved_before + tension.moved_given + problem.product(r, motions)) /
          (2 * times_.h);
  }
}

template std::vector<LinkRow> ConstraintSystem<2>::tension_rows(const ContactSystem<2>&,
                                                                const Island&, std::size_t) const;
template std::vector<double> ConstraintSystem<2>::film_kappas_of_units(const ContactSystem<2>&,
                                                                       const Island&) const;
template double ConstraintSystem<2>::change_tensions(const ContactSystem<2>&, Island&,
                                                     std::span<const Motion<2>>, bool);
template double ConstraintSystem<2>::buckling() const;
template void ConstraintSystem<2>::take_impulses_across(const Island&, std::span<const Motion<2>>);
template std::vector<LinkRow> ConstraintSystem<3>::tension_rows(const ContactSystem<3>&,
                                                                const Island&, std::size_t) const;
template std::vector<double> ConstraintSystem<3>::film_kappas_of_units(const ContactSystem<3>&,
                                                                       const Island&) const;
template double ConstraintSystem<3>::change_tensions(const ContactSystem<3>&, Island&,
                                                     std::span<const Motion<3>>, bool);
template double ConstraintSystem<3>::buckling() const;
template void ConstraintSystem<3>::take_impulses_across(const Island&, std::span<const Motion<3>>);

}  // namespace viscontact::particles
