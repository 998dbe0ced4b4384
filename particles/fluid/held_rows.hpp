// The conditions that rigid bodies and links (hinges, arms and springs) put on the velocities of
// particles in a fluid, and how bodies move, docs/physics.md (6.7). Each condition is a row, a
// HeldRow of held_solver.hpp. A unit is a rigid body, or a particle without a body. An array of
// velocities has motion_components() numbers for each particle [L/T, 1/T]; an array of forces of
// rows has one number for each of rows() [M L/T^2, M L^2/T^2]. Units are any consistent ones.
// fluid_simulation.cpp, fluid_links.cpp and fluid_acceptance.cpp use the class. Nothing is checked
// or thrown. A change must keep bodies exactly rigid, and the order of the rows: bodies first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/fluid/held_solver.hpp"
#include "viscontact/particles/links/link_rows.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// The forces of a step that turn with the motion, and what HeldMotion::add_turns() needs besides.
struct ForcesOfStep {
  std::span<const double> of_rows;       ///< forces of the rows, as far as they are known
  std::span<const double> on_particles;  ///< given forces and torques on all particles
  std::span<const Contact<2>> contacts;  ///< contacts with their impulses
  /// StepEquation::largest_mobility() of all components [T/M, T/(M L^2)].
  std::vector<double> mobility;
};

/// The rows of one step from the present places of the particles, and the motion of their units.
///
/// A unit accelerates if it has a mass and no given motion. The rows of a link with such a unit are
/// taken at the places that its units reach after about half of the step with the velocities that
/// they have before the step. A force of a link then has its mean direction in the step, so that a
/// mass that circles on a link neither gains nor loses energy up to the second order of the step
/// (the implicit midpoint rule; Hairer, Lubich & Wanner 2006, section VII.1). In a step in which
/// velocities may jump, the rows are taken at the present places, which keeps the angular momentum.
/// The rows of units without mass are also taken at the present places, because FluidSimulation
/// extrapolates the change of velocities that the turning of links causes.
class HeldMotion {
 public:
  /// `links` and `particles` must outlive this object. `times.h` > 0 is the length of the step [T];
  /// `times.kick` is not used. `link_times` is StepEquation::link_times(): one time [T] for each
  /// particle, < 0 if the particle does not accelerate. If it is empty, no particle accelerates.
  HeldMotion(const Links& links, const Particles& particles, const LinkTimes& times,
             std::span<const double> link_times = {});

  /// Returns first the rows that make bodies rigid, motion_components() rows for each member of a
  /// body but its first one, and then the rows of the links. The result is empty if there are
  /// neither bodies nor links.
  std::vector<HeldRow> rows() const;

  /// Adds geometric rows, docs/physics.md (6.15), for the forces whose turning the step may not
  /// resolve: pulling links and films across their line, and bodies and hinged particles about
  /// their centres. A row stays until the end of the step; the constant stiffnesses of all rows
  /// become those of `step`.
  void add_turns(const ForcesOfStep& step);
  /// The largest number z = h K (mobility) of links that push, >= 0 [1], with the forces and the
  /// mobilities of the last add_turns(): K is the stiffness of physics.md (6.15), without its sign.
  double pushing() const { return pushing_; }
  /// The geometric rows, which follow rows().
  std::vector<HeldRow> geometric_rows() const;

  /// Returns for each row the number [L/T, 1/T] by which its sum must change, so that hinges and
  /// arms hold after a step with `velocities`, in which bodies turn by finite angles. The number is
  /// 0 for rows of bodies and of other links, except for a spring of which an end accelerates. For
  /// such a spring the number is
  ///
  ///     -(force + stiffness (extension + theta growth))/(theta h stiffness),
  ///
  /// the error of the equation of a spring in held_solver.hpp. `extension` is that at the beginning
  /// of the step, and growth its finite change in the step; force is the entry of the row in
  /// `row_forces`, and theta its entry in `thetas`, which are HeldSolver::thetas().
  /// A geometric row of which an end accelerates has the error of its own equation, which is that
  /// of a spring with the growth of its sum. `stiffnesses` are HeldSolver::stiffnesses().
  std::vector<double> missing(std::span<const double> velocities,
                              std::span<const double> row_forces, std::span<const double> thetas,
                              std::span<const double> stiffnesses) const;

  /// Changes `at_end`, the velocities at the end of the step, until bodies are rigid and hinges and
  /// arms hold with these velocities. The particles moved with `velocities` in the step. `is_stiff`
  /// has one number for each row; if that of a spring is not 0, its extension then grows with its
  /// mean rate in the step. Forces along the rows at the end of the step make the change;
  /// `mobility` [T/M, T/(M L^2)], >= 0, is the change of each component of each particle's velocity
  /// per force. Returns these forces, but 0 for rows of which no unit accelerates. If rows
  /// contradict each other, they hold as nearly as possible (least squares).
  std::vector<double> hold_at_end(std::span<const double> velocities,
                                  std::span<const double> mobility,
                                  const std::vector<char>& is_stiff,
                                  std::span<double> at_end) const;

  /// Returns `velocities`, but with the displacements of the members of bodies in the step, divided
  /// by the length of the step, in place of their velocities [L/T, 1/T].
  std::vector<double> with_finite_turns(std::span<const double> velocities) const;

  /// Replaces the velocities of the members of each body by those of one rigid motion, the mean of
  /// their `velocities`, at their present places.
  void make_rigid(std::span<double> velocities) const;

  /// If a body turns in the step with `velocities`, the places of its members change, and with them
  /// the torque of the forces `of_fluid` about the centre of the body. For each body that
  /// accelerates, this function subtracts the change of this torque from the torque on the first
  /// member in `forces`. It does the same for a body without mass whose geometric row acts
  /// (`stiffnesses` are HeldSolver::stiffnesses()), with `forces` in place of `of_fluid`. Both arrays are forces and torques of the particles on the fluid
  /// [M L/T^2, M L^2/T^2], motion_components() numbers for each particle.
  void keep_torques(std::span<const double> velocities, std::span<const double> of_fluid,
                    std::span<const double> stiffnesses, std::span<double> forces) const;

  /// Velocity [L/T] of the centre of the body with the number `body`, and its angular velocity
  /// [1/T]. Both are means over its members, weighted by their masses, or with equal weights if the
  /// body has no mass. In a sheared periodic cell the velocities are those of the images of the
  /// members that are at their places in the body.
  UnitMotion motion_of_body(std::size_t body, std::span<const double> velocities) const;

  /// Rate [L/T] at which the length of arm `k` (from 0, must exist) grows with `velocities`, in the
  /// direction that the arm has in its row.
  double rate_of_arm(std::size_t k, std::span<const double> velocities) const;
  /// Rate [L/T] at which the length of arm `k` grows with `velocities`, in the direction that the
  /// arm has after a step in which the particles moved with `moved`.
  double rate_of_arm_at_end(std::size_t k, std::span<const double> moved,
                            std::span<const double> velocities) const;

  /// Power [M L^2/T^3] with `velocities` of the geometric row of arm `k`, which turns the force of
  /// the arm; 0 without such a row. `row_forces` has the forces of all rows.
  double power_of_turning(std::size_t k, std::span<const double> row_forces,
                          std::span<const double> velocities) const;

  /// The inverse of link_forces(): the forces of rows(), 0 for those of bodies. Empty if
  /// `link_forces` is empty.
  std::vector<double> row_forces(std::span<const double> link_forces) const;

  /// The forces of the links in the order of State::link_forces, Links::force_count() numbers. They
  /// are those of `row_forces` that belong to links; the torques of stops are not in them. Empty
  /// without links.
  std::vector<double> link_forces(std::span<const double> row_forces) const;

 private:
  /// A geometric row and what it turns: a link (its place in equations_), a unit (its particle or
  /// first member) or a film (both particles and the image).
  struct Turn {
    enum What : std::int32_t { kLink, kUnit, kFilm };
    using Key = std::array<std::int32_t, 4>;
    Key key;
    HeldRow row;
  };
  /// The place in turns_ of the row that turns the unit of a particle; turns_.size(): none.
  std::size_t turn_of_unit(std::int32_t particle) const;
  HeldRow row_across(const LinkEquations& link, double length) const;
  std::vector<Turn> turns_of_links(std::span<const double> before) const;
  std::vector<Turn> turns_of_units(const ForcesOfStep& step, std::span<const double> before) const;
  std::vector<Turn> turns_of_films(const ForcesOfStep& step) const;
  void turn_to_end(std::span<const LinkEquations> turned, std::span<const double> velocities,
                   std::vector<HeldRow>& rows, std::vector<double>& rates) const;
  static double sum_of(const HeldRow& row, std::span<const double> velocities);
  std::vector<double> velocities_before() const;
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
  std::vector<LinkEquations> equations_;      // equations of the links at the present places
  std::vector<LinkEquations> in_rows_;        // equations of the links at the places of the rows
  std::vector<double> link_times_;            // link_times of the constructor [T]
  std::vector<std::vector<double>> weights_;  // weights of the members of each body; their sum is 1
  // Velocities [L/T] of the images at the places in each body, relative to the members.
  std::vector<std::vector<Vector>> image_velocities_;
  std::size_t body_rows_ = 0;  // number of rows of bodies
  std::vector<Turn> turns_;
  double pushing_ = 0;
};

}  // namespace viscontact::particles
