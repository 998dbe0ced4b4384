// The motion of rigid bodies and the forces of links (hinges, springs, arms and membranes) as CSV
// tables over time, and the links at one time as a VTK file.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "viscontact/membranes/membrane_shape.hpp"
#include "viscontact/particles/setting/setting.hpp"

namespace viscontact::particles {

/// A table to which a run adds rows at each output time.
struct TimeTable {
  std::string name;    ///< of its file, such as "arms.csv"
  std::string header;  ///< names of its columns, with a line break at the end
  /// Makes the rows of a state, each with a line break at its end. `force_errors` are estimates >=
  /// 0 of the errors of State::link_forces, in the same order and units; empty if they are not
  /// known. State::link_forces has Links::force_count() entries or, before the first step, none.
  std::string (*rows)(const Setting& setting, const State& state,
                      std::span<const double> force_errors);
};

/// The tables of a run. A table is left out if the case has nothing for it:
///
/// - bodies.csv: time,id,x,y,angle,vx,vy,angular_velocity; in space
///   time,id,x,y,z,vx,vy,vz,orientation_w,..._x,..._y,..._z,angular_velocity_x,..._y,..._z
/// - hinges.csv: time,id,force_x,force_y,torque,angle,angular_velocity; in space
///   time,id,force_x,force_y,force_z
/// - springs.csv: time,id,length,force
/// - arms.csv: time,id,length,force,power
/// - membranes.csv: time,id, and then the members of MembraneMeasures
///   (membranes/membrane_shape.hpp)
///
/// In a fluid springs.csv and arms.csv end with the column force_error_estimate, and hinges.csv has
/// force_error_estimate,torque_error_estimate before angle: estimates of the errors that the mesh
/// of the fluid causes, in the units of force and torque, and empty where they are not known.
///
/// Units are: time [T], positions and lengths [L], angles [rad], velocities [L/T], angular
/// velocities [1/T], forces [M L/T^2], torques [M L^2/T^2], powers [M L^2/T^3], the last three per
/// length for discs in a fluid. Ids are numbers from 0 in the order of the case. The force of a
/// hinge is that on its body, its torque that of its torsion spring and its stops on this body.
/// Forces of springs and arms are > 0 where they push the ends apart. Forces and powers are means
/// over the step that ended at `time`, and 0 before the first step. The power of an arm is > 0
/// where the arm does work on the particles.
std::vector<TimeTable> time_tables(const Setting& setting, const Particles& particles);

/// Content of a VTK XML PolyData file (VTK's file formats, "XML file formats"; inline binary) with
/// a vertex at the place of each hinge, and a line between the centres of two particles for each
/// spring, for each arm, and for each two neighbouring particles (beads) of a membrane without a
/// fluid. In a periodic domain the line goes to the nearest image of the second particle. Each
/// vertex and each line has three arrays:
///
/// - kind: 0 for a hinge, 1 for a spring, 2 for an arm, 3 for a line of a membrane;
/// - id: the number of the link or membrane in its list of the case, from 0;
/// - force: the mean force in the last step on the body that a hinge holds, or on the second
///   particle of a line [M L/T^2], with three components; 0 before the first step.
std::string write_links(const Setting& setting, const State& state);

}  // namespace viscontact::particles
