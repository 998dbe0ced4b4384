// The conditions that rigid bodies and links (hinges, arms and springs) put on the velocities of
// particles in a fluid, and how bodies move, docs/physics.md (6.7). Each condition is a row of
// held_solver.hpp. A unit is a rigid body, or a particle without a body. Velocities of all
// particles have motion_components() numbers each [L/T, 1/T]; forces of rows are one for each of
// rows() [M L/T^2, M L^2/T^2]. fluid_simulation.cpp, fluid_links.cpp and fluid_acceptance.cpp use
// it; nothing is checked or thrown. A change must keep the order of the rows, bodies first, and
// bodies rigid.
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
/// Hairer, Lubich & Wanner 2006, section VII.1). In a step in which velocities may jump, the rows
/// are those at the present places, which keeps the angular momentum. So are the rows of units
/// without mass, because FluidSimulation extrapolates the change of velocities by their turning.
class HeldMotion {
 public:
  /// `links` and `particles` must outlive this object. `times.kick` is not used; `times.h` > 0 is
  /// the length of the step [T]. `link_times` is StepEquation::link_times(), one time [T] for each
  /// particle, < 0 if it does not accelerate; empty: no particle accelerates.
  HeldMotion(const Links& links, const Particles& particles, const LinkTimes& times,
             std::span<const double> link_times = {});

  /// First the rows that make bodies rigid, motion_components() for each member but the first, then
  /// those of the links; empty without both.
  std::vector<HeldRow> rows() const;

  /// By how much the sums of the rows must change, so that hinges and arms hold after a step with
  /// these velocities, in which bodies turn by finite angles, one number for each row [L/T, 1/T]; 0
  /// for rows of bodies and of other links. For a spring of which an end accelerates it is -(force
  /// + stiffness (extension at the beginning + theta times its finite change in the step))/(theta h
  /// stiffness): the error of the equation at HeldRow::stiffness, with its force in `row_forces`
  /// and its theta in `thetas` (HeldSolver::thetas()).
  std::vector<double> missing(std::span<const double> velocities,
                              std::span<const double> row_forces,
                              std::span<const double> thetas) const;

  /// Changes the velocities `at_end` at the end of the step, in which particles moved with
  /// `velocities`, until bodies are rigid and hinges and arms hold for them. The extension of a
  /// spring then grows with its mean rate in the step if its row has a number other than 0 in
  /// `is_stiff`, which has one number for each row. Forces along the rows at the end of the step
  /// make the change, with the mobility `mobility` >= 0 of each component of each particle [T/M,
  /// T/(M L^2)]. Returns these forces; they are 0 in rows of which no unit accelerates. If rows
  /// contradict each other, they hold as nearly as possible (least squares).
  std::vector<double> hold_at_end(std::span<const double> velocities,
                                  std::span<const double> mobility,
                                  const std::vector<char>& is_stiff,
                                  std::span<double> at_end) const;

  /// Replaces the velocities of members of bodies by their displacements in the step, divided by
  /// its length [L/T, 1/T].
  std::vector<double> with_finite_turns(std::span<const double> velocities) const;

  /// Replaces the velocities of the members of each body by those of one rigid motion, the mean of
  /// their `velocities`, at their present places.
  void make_rigid(std::span<double> velocities) const;

  /// `of_fluid` are forces of the particles on the fluid, which have the shape of velocities, as
  /// `forces` [M L/T^2, M L^2/T^2]. If a body turns in the step with `velocities`, their torque
  /// about its centre changes. For bodies that accelerate, minus this change is added to the torque
  /// in `forces` on the first member.
  void keep_torques(std::span<const double> velocities, std::span<const double> of_fluid,
                    std::span<double> forces) const;

  /// Velocity [L/T] of the centre of a body, given by its number, and its angular velocity [1/T]:
  /// means over its members by mass, or equal ones without mass. In a sheared periodic cell the
  /// velocities are those of the images of the members that are at their places in the body.
  UnitMotion motion_of_body(std::size_t body, std::span<const double> velocities) const;

  /// Rate [L/T] at which the length of arm `k` (from 0, must exist) grows with these velocities, in
  /// the direction that the arm has in its row.
  double rate_of_arm(std::size_t k, std::span<const double> velocities) const;
  /// The same in the direction that the arm has after the step with the velocities `moved`.
  double rate_of_arm_at_end(std::size_t k, std::span<const double> moved,
                            std::span<const double> velocities) const;

  /// The forces of the links in the order of State::link_forces, Links::force_count() numbers, from
  /// those of the rows; empty without links.
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
  std::vector<LinkEquations> equations_;      // of the links at the present places
  std::vector<LinkEquations> in_rows_;        // of the links at the places of the rows
  std::vector<double> link_times_;            // of each particle [T]
  std::vector<std::vector<double>> weights_;  // of the members of each body; their sum is 1
  // Velocities [L/T] of the images at the places in each body, relative to the members.
  std::vector<std::vector<Vector>> image_velocities_;
  std::size_t body_rows_ = 0;  // number of rows of bodies
};

}  // namespace viscontact::particles
