// The conditions that rigid bodies and links (hinges, arms and springs) put on the velocities of
// particles in a fluid, and how bodies move, docs/physics.md (6.7). Each condition is a row of
// held_solver.hpp. A unit is a rigid body, or a particle without a body. Lengths, masses and times
// are in the units of the case. fluid_simulation.cpp and fluid_links.cpp use it; nothing is
// checked or thrown. A change must keep the order of the rows, bodies first, and bodies exactly
// rigid.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "viscontact/particles/fluid/held_solver.hpp"
#include "viscontact/particles/links/link_rows.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// The rows of one step from the present places of the particles, and the motion of their units.
///
/// A unit accelerates if it has a mass and no given motion. The rows of a link with such a unit are
/// those at the places that its units reach at about half the step with their velocities before it.
/// A force of a link then has its mean direction in the step, so that a mass that circles on a link
/// neither gains nor loses energy up to the second order of the step (the implicit midpoint rule;
/// Hairer, Lubich & Wanner 2006, section VII.1). In a step with theta = 1 (step_equation.hpp), in
/// which velocities may jump, the rows are those at the present places, which keeps the angular
/// momentum. So are the rows of units without mass, because FluidSimulation extrapolates how their
/// forces turn.
class HeldMotion {
 public:
  /// `links` and `particles` must outlive this object. `times.kick` is not used. `link_times` are
  /// those of StepEquation; empty: no particle accelerates.
  HeldMotion(const Links& links, const Particles& particles, const LinkTimes& times,
             std::span<const double> link_times = {});

  /// First the rows that make bodies rigid, then those of the links.
  std::vector<HeldRow> rows() const;

  /// By how much the sums of the rows must change, so that hinges and arms hold after a step with
  /// these velocities, in which bodies turn by finite angles [L/T, 1/T]; 0 for the other rows. For
  /// springs between units of which one accelerates, whose forces are `row_forces` so far, it is
  /// the error of extension and force in the equation at HeldRow::stiffness; `thetas` are those of
  /// the rows.
  std::vector<double> missing(std::span<const double> velocities,
                              std::span<const double> row_forces,
                              std::span<const double> thetas) const;

  /// Changes the velocities `at_end` at the end of the step, after the step with `velocities`,
  /// until bodies are rigid, hinges and arms hold at that time, and the springs for which
  /// `is_stiff` is set, one number for each row, have the mean rate of the step. The change is that
  /// by forces along the rows as they are then, with the mobility `mobility` of each component
  /// [T/M, 1/(M L^2) T]. Returns these forces [M L/T^2, M L^2/T^2], which are 0 in the rows of
  /// which no unit accelerates.
  std::vector<double> hold_at_end(std::span<const double> velocities,
                                  std::span<const double> mobility,
                                  const std::vector<char>& is_stiff,
                                  std::span<double> at_end) const;

  /// Replaces the velocities of members of bodies by their displacements in the step, divided by
  /// its length.
  std::vector<double> with_finite_turns(std::span<const double> velocities) const;

  /// Gives the members of each body the velocities at their present places of the rigid motion that
  /// is the mean of `velocities`, which may be those of an earlier step.
  void make_rigid(std::span<double> velocities) const;

  /// Adds couples to `forces` on the members of bodies that accelerate, so that the forces
  /// `of_fluid` of the particles on the fluid have the same torque about the centre of a body after
  /// the step with `velocities` as before it. All have motion_components() numbers for each
  /// particle [M L/T^2, M L^2/T^2], [L/T, 1/T].
  void keep_torques(std::span<const double> velocities, std::span<const double> of_fluid,
                    std::span<double> forces) const;

  /// Velocity of the centre of a body and its angular velocity: means over its members. In a
  /// periodic cell the velocities are those of the images that lie at their places in the body.
  UnitMotion motion_of_body(std::size_t body, std::span<const double> velocities) const;

  /// Rate at which the length of arm `k` grows with these velocities, by its row [L/T].
  double rate_of_arm(std::size_t k, std::span<const double> velocities) const;
  /// The same by its row after the step with the velocities `moved`.
  double rate_of_arm_at_end(std::size_t k, std::span<const double> moved,
                            std::span<const double> velocities) const;

  /// The forces of the links in the order of State::link_forces, from those of the rows.
  std::vector<double> link_forces(std::span<const double> row_forces) const;

 private:
  UnitMotion motion_of(const LinkPart& part, std::span<const double> velocities) const;
  std::vector<UnitMotion> motions_of(const LinkEquations& link,
                                     std::span<const double> velocities) const;
  void turn_rows();
  double link_time(std::int32_t particle) const;
  double link_time(const LinkEquations& link) const;
  std::size_t arm(std::size_t k) const;
  double rate_of(const LinkEquations& link, const LinkRow& row) const;
  double sum_of(const LinkRow& row, std::span<const double> velocities) const;
  std::vector<HeldRow> rows_of(const std::vector<LinkEquations>& equations) const;
  void add_entries(const LinkPart& part, HeldRow& row) const;
  void add_body_rows(const RigidBody& body, std::size_t number, std::vector<HeldRow>& rows) const;

  const Links& links_;
  const Particles& particles_;
  LinkTimes times_;
  MotionLayout layout_;
  std::vector<LinkEquations> equations_;      // at the present places
  std::vector<LinkEquations> in_rows_;        // where the rows have them
  std::vector<double> link_times_;            // of each particle
  std::vector<std::vector<double>> weights_;  // of the members of each body; their sum is 1
  // Velocities of the members' images at their places in each body, relative to the members.
  std::vector<std::vector<Vector>> image_velocities_;
  std::size_t body_rows_ = 0;  // number of rows of bodies
};

}  // namespace viscontact::particles
