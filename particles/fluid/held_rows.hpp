// The conditions that rigid bodies and links put on the velocities of particles in a fluid, and how
// bodies move, docs/physics.md (6.7). Units are those of the case.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "viscontact/particles/fluid/contact/fluid_contact.hpp"
#include "viscontact/particles/fluid/held_solver.hpp"
#include "viscontact/particles/links/link_rows.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// The rows of one step from the present places of the particles, and the motion of their units.
class HeldMotion {
 public:
  /// `links` and `particles` must outlive this object. `times.kick` is not used.
  HeldMotion(const Links& links, const Particles& particles, const LinkTimes& times);

  /// First the rows that make bodies rigid, then those of the links.
  std::vector<HeldRow> rows() const;

  /// By how much the sums of the rows must change, so that hinges and arms hold after a step with
  /// these velocities, in which bodies turn by finite angles [L/T, 1/T]; 0 for the other rows.
  std::vector<double> missing(std::span<const double> velocities) const;

  /// Replaces the velocities of members of bodies by their displacements in the step, divided by its
  /// length.
  std::vector<double> with_finite_turns(std::span<const double> velocities) const;

  /// Gives the members of each body the velocities at their present places of the rigid motion that
  /// is the mean of `velocities`, which may be those of an earlier step.
  void make_rigid(std::span<double> velocities) const;

  /// Velocity of the centre and angular velocity of a body: the means over the images of its
  /// members at their places in the body, whose offsets cancel in the first.
  UnitMotion motion_of_body(std::size_t body, std::span<const double> velocities) const;

  /// Rate at which the length of arm `k` grows with these velocities [L/T].
  double rate_of_arm(std::size_t k, std::span<const double> velocities) const;

  /// The forces of the links in the order of State::link_forces, from those of the rows.
  std::vector<double> link_forces(std::span<const double> row_forces) const;

 private:
  UnitMotion motion_of(const RowPart& part, std::span<const double> velocities) const;
  Vector offset_in_body(std::int32_t particle) const;
  void add_entries(const RowPart& part, HeldRow& row) const;
  void add_body_rows(const RigidBody& body, std::size_t number, std::vector<HeldRow>& rows) const;

  const Links& links_;
  const Particles& particles_;
  LinkTimes times_;
  MotionLayout layout_;
  std::vector<LinkEquations> equations_;
  std::vector<std::vector<double>> weights_;  // of the members of each body; their sum is 1
  // Velocities of the members' images at their places in each body, relative to the members.
  std::vector<std::vector<Vector>> image_velocities_;
  std::size_t body_rows_ = 0;  // number of rows of bodies
};

}  // namespace viscontact::particles
