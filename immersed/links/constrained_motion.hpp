// The conditions that rigid bodies, hinges, arms and springs put on the velocities of particles in
// a fluid, and how bodies move, docs/physics.md (6.7).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/constraint_rows/link_rows.hpp"
#include "viscontact/immersed/links/constrained_solver.hpp"
#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/state/particles.hpp"

namespace viscontact::particles {

/// What ConstrainedMotion::add_turns() needs of a step: the forces that turn with the motion.
struct ForcesOfStep {
  std::span<const double> of_rows;       ///< forces of the rows, as far as they are known
  std::span<const double> on_particles;  ///< given forces and torques, without those of contacts
  std::span<const Contact<2>> contacts;
  /// StepEquation::largest_mobility() of all components [T/M, T/(M L^2)].
  std::vector<double> mobility;
};

/// The rows of one step from the present places of the particles, and the motion of their units. A
/// row is a condition on velocities (VelocityConstraint), a unit a rigid body or a particle without
/// a body. Arrays of velocities have motion_components() numbers for each particle [L/T, 1/T],
/// arrays of forces of rows one number for each row [M L/T^2, M L^2/T^2].
///
/// A unit accelerates if it has a mass and no given motion. The rows of a link with such a unit are
/// taken at the places that its units reach after about half of the step with the velocities before
/// the step (the implicit midpoint rule), so that a mass that circles on a link keeps its energy;
/// in a step in which velocities may jump at the present places, which keeps the angular momentum.
/// So are the rows of units without mass, because FluidSimulation extrapolates the change of
/// velocities that the turning of links causes.
class ConstrainedMotion {
 public:
  /// `links` and `particles` must outlive this object. `times.impulse_time` is not used.
  /// `link_times` is StepEquation::link_times(); if it is empty, no particle accelerates.
  ConstrainedMotion(const Links& links, const Particles& particles, const LinkTimes& times,
                    std::span<const double> link_times = {});

  /// The rows that make bodies rigid, motion_components() for each member of a body but its first,
  /// and then the rows of the links.
  std::vector<VelocityConstraint> rows() const;

  /// Adds geometric rows, docs/physics.md (6.15), for the forces whose turning the step may not
  /// resolve: pulling links and films across their line, and bodies and hinged particles about
  /// their centres. A row stays until the end of the step; the constant stiffnesses of all rows
  /// become those of `step`.
  void add_turns(const ForcesOfStep& step);
  /// The largest number z = h K (mobility) of links that push, >= 0 [1], with the forces and the
  /// mobilities of the last add_turns(): K is the stiffness of physics.md (6.15), without its sign.
  double pushing() const { return pushing_; }
  /// They follow rows().
  std::vector<VelocityConstraint> geometric_rows() const;

  /// For each row the number [L/T, 1/T] by which its sum must change, so that hinges and arms hold
  /// after a step with `velocities`, in which bodies turn by finite angles. For a spring of which
  /// an end accelerates, it is the error of its equation (VelocityConstraint),
  ///
  ///     -(force + stiffness (extension + theta growth))/(theta h stiffness),
  ///
  /// with the finite growth of the extension in the step, and the same for a geometric row with the
  /// growth of its sum; it is 0 for bodies and all other links. `thetas` and `stiffnesses` are
  /// those of the ConstrainedSolver.
  std::vector<double> missing(std::span<const double> velocities,
                              std::span<const double> row_forces, std::span<const double> thetas,
                              std::span<const double> stiffnesses) const;

  /// Changes `at_end`, the velocities at the end of a step in which particles moved with
  /// `velocities`, by forces along the rows and `mobility` [T/M, T/(M L^2)], >= 0, until bodies are
  /// rigid and hinges and arms hold with them. A spring whose entry of `is_stiff` is not 0 then
  /// grows with its mean rate in the step. Returns the forces, but 0 for rows of which no unit
  /// accelerates. Rows that contradict each other hold as nearly as possible (least squares).
  std::vector<double> hold_at_end(std::span<const double> velocities,
                                  std::span<const double> mobility,
                                  const std::vector<char>& is_stiff,
                                  std::span<double> at_end) const;

  /// `velocities`, but for members of bodies their displacements in the step, in which the body
  /// turns by a finite angle, divided by the length of the step.
  std::vector<double> with_finite_turns(std::span<const double> velocities) const;

  /// Gives the members of each body the velocities of one rigid motion, that of motion_of_body().
  void make_rigid(std::span<double> velocities) const;

  /// A body that turns in the step with `velocities` changes the torque of the forces `of_fluid`
  /// about its centre. Subtracts this change from the torque on the first member in `forces`, both
  /// of the particles on the fluid, for each body that accelerates; and, with `forces` in place of
  /// `of_fluid`, for a body without mass whose geometric row acts.
  void keep_torques(std::span<const double> velocities, std::span<const double> of_fluid,
                    std::span<const double> stiffnesses, std::span<double> forces) const;

  /// Velocity [L/T] and angular velocity [1/T] of body number `body`: means over its members with
  /// their shares of the mass, or equal shares, as weights. In a sheared periodic cell the
  /// velocities are those of the images of the members that are at their places in the body.
  UnitMotion motion_of_body(std::size_t body, std::span<const double> velocities) const;

  /// Rate [L/T] at which arm `k` grows with `velocities`, in the direction of its row.
  double rate_of_arm(std::size_t k, std::span<const double> velocities) const;
  /// The same in the direction that the arm has after a step in which the particles moved with
  /// `moved`.
  double rate_of_arm_at_end(std::size_t k, std::span<const double> moved,
                            std::span<const double> velocities) const;

  /// Power [M L^2/T^3] with `velocities` of the geometric row of arm `k`; 0 without such a row.
  double power_of_turning(std::size_t k, std::span<const double> row_forces,
                          std::span<const double> velocities) const;

  /// The forces of rows() from those of links, 0 for bodies; empty if `link_forces` is empty.
  std::vector<double> row_forces(std::span<const double> link_forces) const;

  /// The entries of `row_forces` that belong to links, in the order of State::link_forces.
  std::vector<double> link_forces(std::span<const double> row_forces) const;

 private:
  /// A geometric row and what it turns: a link (its place in equations_), a unit (its first
  /// particle) or a film (both particles and the image).
  struct Turn {
    enum What : std::int32_t { kLink, kUnit, kFilm };
    using Key = std::array<std::int32_t, 4>;
    Key key;
    VelocityConstraint row;
  };
  /// The place in turns_ of the row that turns the unit of a particle; turns_.size(): none.
  std::size_t turn_of_unit(std::int32_t particle) const;
  VelocityConstraint row_across(const LinkEquations& link, double length) const;
  std::vector<Turn> turns_of_links(std::span<const double> before) const;
  std::vector<Turn> turns_of_units(const ForcesOfStep& step, std::span<const double> before) const;
  std::vector<Turn> turns_of_films(const ForcesOfStep& step) const;
  void turn_to_end(std::span<const LinkEquations> turned, std::span<const double> velocities,
                   std::vector<VelocityConstraint>& rows, std::vector<double>& rates) const;
  // The sum of a row [L/T, 1/T].
  static double sum_of(const VelocityConstraint& row, std::span<const double> velocities);
  std::vector<double> velocities_before() const;
  // Displacement [L] and turn [rad] in the step, of the periodic image that the part names.
  UnitMotion motion_of(const LinkPart& part, std::span<const double> velocities) const;
  std::vector<UnitMotion> motions_of(const LinkEquations& link,
                                     std::span<const double> velocities) const;
  void turn_rows();
  /// When links act on a particle in the step [T]; < 0: it does not accelerate.
  double link_time(std::int32_t particle) const;
  double link_time(const LinkEquations& link) const;
  /// In equations_.
  std::size_t arm(std::size_t k) const;
  double rate_of(const LinkEquations& link, const LinkRow& row) const;
  double sum_of(const LinkRow& row, std::span<const double> velocities) const;
  std::vector<VelocityConstraint> rows_of(const std::vector<LinkEquations>& equations) const;
  void add_entries(const LinkPart& part, VelocityConstraint& row) const;
  void add_body_rows(const RigidBody& body, std::size_t number,
                     std::vector<VelocityConstraint>& rows) const;

  const Links& links_;
  const Particles& particles_;
  LinkTimes times_;
  MotionLayout layout_;
  std::vector<LinkEquations> equations_;      // of the links at the present places
  std::vector<LinkEquations> in_rows_;        // of the links at the places of the rows
  std::vector<double> link_times_;            // of each particle [T], or empty
  std::vector<std::vector<double>> weights_;  // weights of the members of each body; their sum is 1
  // Velocities [L/T] of the images at the places in each body, relative to the members.
  std::vector<std::vector<Vector>> image_velocities_;
  std::size_t body_rows_ = 0;
  std::vector<Turn> turns_;
  double pushing_ = 0;
};

}  // namespace viscontact::particles
