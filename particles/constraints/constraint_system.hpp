// The constraints of a step on particles that turn: contacts with friction, rigid bodies and links.
// Makes the problem of constraint_problem.hpp and takes over its solution. Lengths, masses and
// times are in the units of the case. step_projection.hpp uses it; nothing is thrown. A change must
// keep the order of units, on which results depend.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/particles/bodies/rigid_bodies.hpp"
#include "viscontact/particles/constraints/constraint_problem.hpp"
#include "viscontact/particles/constraints/constraint_solver.hpp"
#include "viscontact/particles/contact/contact_laws.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/dual_problem/contact_system.hpp"
#include "viscontact/particles/links/link_rows.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// What the constraints of a step depend on, besides its contacts. Arrays are those of the
/// simulation: before the solution they hold the motion without constraints, after it that of the
/// solution.
struct ConstraintStep {
  /// Of the contacts.
  const ContactLaws& laws;
  /// The planes, which may move.
  std::span<const Plane> obstacles;
  double begin = 0,         ///< time at which the step begins [T]
      end = 0;              ///< time at which the step ends [T]
  bool is_first = false;    ///< LinkTimes::is_first
  double kick = 0;          ///< time for which forces act on the velocities in it [T]
  std::span<double> turns;  ///< h w of all particles [rad]
  std::span<const double> turn_mobilities;  ///< h/I [T/(M L^2)]
  std::span<BodyStep> bodies;               ///< of all rigid bodies
  const Links* links = nullptr;             ///< must be there, but may be empty
  /// State::link_forces [M L/T^2], [M L^2/T^2]: a guess, then the solution.
  std::span<double> link_forces;
};

/// The contacts, rigid bodies and links of a step as one ConstraintProblem, and its solution.
template <int D>
class ConstraintSystem {
 public:
  /// All arguments must outlive this object. `displacements` and `mobilities` are those of
  /// ContactSystem.
  ConstraintSystem(const ConstraintStep& step, const Particles& particles,
                   std::span<double> displacements, std::span<const double> mobilities);

  /// Makes the particles of all links take part. Call it before the first contact is added.
  void join_linked(ContactSystem<D>& system) const;

  /// Adds the contact that is next in the ContactSystem, which is that of `pair`. Its memory holds
  /// the guess of the friction.
  void add(const Contact<D>& contact, const Pair& pair, const PairMemory& memory);

  /// The equations of the links and of the stops of hinges, and what their residuals may be [L], to
  /// be set before solve().
  const std::vector<LinkEquations>& links() const { return links_; }
  /// The allowed residual of each link [L], > 0, in the order of links().
  std::vector<double> links_allowed;

  /// Takes the place of ContactSystem::solve. Also sets the turns of all particles that take part
  /// and the motions of the rigid bodies. `allowed_slip` is the largest residual of a tangential
  /// displacement [L]; a rough solution takes it for the gaps, too.
  ///
  /// Rows are linear in the turns of rigid bodies. A solution is followed by others, whose offsets
  /// are corrected by the difference between the linear values and those of the finite turns, until
  /// hinges, arms and the contacts of rigid bodies hold with these.
  ///
  /// If Coulomb's law is not solved in `max_iterations`, give_loads() takes its place with the
  /// loads of the best iterate, in this and all later solutions of the step, so that gaps, films
  /// and links are exact. The residuals remain those of Coulomb's law.
  SolverResult solve(ContactSystem<D>& system, bool is_rough, double allowed_slip,
                     int max_iterations);

  /// Whether loads of the friction are given because Coulomb's law was not solved.
  bool has_given_up() const { return has_given_up_; }

  /// Writes the friction of contact number `c` and what its solids carry into its memory.
  void remember(std::size_t c, PairMemory& memory) const {
    memory.set_friction(frictions_[c]);
    memory[Remembered::kCarried] = carried_[c];
  }
  /// Residual of contact number `c` in the last solution [L].
  const BlockResidual& residual(std::size_t c) const { return residuals_[c]; }
  /// Residual of link number `l` of links() in the last solution [L]; of an angle times the mean
  /// radius.
  double link_residual(std::size_t l) const { return link_residuals_[l]; }
  /// By how much each constraint of the last problem is violated [L], >= 0, in the motion that
  /// violates them least: first of the contacts, then of the links. That motion has the smallest
  /// sum of v^2/w over the rows of bilateral constraints without compliance and the negative gaps.
  /// If some motion satisfies all of them, these are 0 but for rounding. Otherwise the values v/w
  /// of the rows, as impulses, move nothing and so prove the contradiction (Farkas' lemma), and a
  /// constraint that has no part in it is not violated.
  std::vector<double> least_violations() const;

 private:
  ContactSide side_of(std::int32_t particle) const;
  void number_units(const ContactSystem<D>& system);
  void add_contact(const Contact<D>& contact, std::size_t c, double allowed_slip);
  void add_link(std::size_t l, double mean_radius);
  UnitMotion motion_of(std::int32_t unit, std::span<const Motion<D>> motions) const;
  void move_particles(const ContactSystem<D>& system, std::span<const Motion<D>> motions);
  double correct(ContactSystem<D>& system, const ConstraintSolution<D>& solution);
  void give_loads_of_step();
  ConstraintSolution<D> solve_problem(int max_iterations);
  BlockResidual residual_of_contact(std::size_t c, const ConstraintSolution<D>& solution) const;
  void take_over(ContactSystem<D>& system, const ConstraintSolution<D>& solution);

  const ConstraintStep& step_;
  const Particles& particles_;
  std::span<double> displacements_;
  std::span<const double> mobilities_;
  double mean_radius_;
  LinkTimes times_;
  std::vector<double> free_turns_;     // h w* of all particles
  std::vector<BodyStep> free_bodies_;  // of the motion without constraints
  std::vector<LinkEquations> links_;
  std::vector<ContactTangents<D>> tangents_;  // of the contacts
  std::vector<Vector> frictions_;
  std::vector<double> carried_;
  std::vector<BlockResidual> residuals_;
  std::vector<double> link_residuals_, link_forces_;
  // Of the present solution: the unit of each particle that takes part (-1: none), of each body.
  std::vector<std::int32_t> unit_of_particle_, unit_of_body_;
  std::vector<Vector> offsets_;  // of all members of bodies, from the centres, by particle
  ConstraintProblem<D> problem_;
  std::vector<double> shifts_;  // last corrections of the blocks [L]
  bool has_given_up_ = false, can_give_up_ = true;
  std::vector<double> given_loads_;  // of the contacts, if has_given_up_ [M L/T]
};

}  // namespace viscontact::particles
