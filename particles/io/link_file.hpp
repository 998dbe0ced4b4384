// The motion of rigid bodies, and the forces of links, as CSV tables over time, and the links at
// one time as a VTK file. Lengths, masses and times are in the units of the case. run/run_log.hpp
// writes them. A change must keep the names of the columns, which users' scripts read.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "viscontact/particles/setting.hpp"

namespace viscontact::particles {

/// A table that gets rows at each output time.
struct TimeTable {
  std::string name;    ///< of its file
  std::string header;  ///< line with the names of its columns
  /// The rows of a state. `force_errors` are estimates of the errors of State::link_forces, as many
  /// and in the same units; empty: not known.
  std::string (*rows)(const Setting& setting, const State& state,
                      std::span<const double> force_errors);
};

/// The tables that a run has, each only if the case has what it lists:
///
/// - bodies.csv: time,id,x,y,angle,vx,vy,angular_velocity; in space
///   time,id,x,y,z,vx,vy,vz,orientation_w,...,angular_velocity_x,...
/// - hinges.csv: time,id,force_x,force_y,torque,angle,angular_velocity; in space
///   force_x,force_y,force_z
/// - springs.csv: time,id,length,force
/// - arms.csv: time,id,length,force,power
/// - membranes.csv: see membrane_rows()
///
/// In a fluid springs.csv and arms.csv end with the column force_error_estimate, and hinges.csv has
/// force_error_estimate,torque_error_estimate before angle: estimates of the errors that the mesh
/// causes, in the units of the results, and empty where they are not known.
///
/// Ids are numbers from 0 in the order of the case. The force of a hinge is that on its body, and
/// its torque that of its torsion spring and its stops. Forces of springs and arms are positive
/// where they push the ends apart. Forces are those of the step that ended at the time, 0 before
/// the first one. The power is the work of an arm in this step over the length of the step.
std::vector<TimeTable> time_tables(const Setting& setting, const Particles& particles);

/// Content of a VTK XML PolyData file (VTK's file formats, "XML file formats"; appended raw data)
/// with a vertex for each hinge, at its place, and a line for each spring and each arm, and between
/// neighbouring beads of a membrane without a fluid, between the centres of the two particles. In a
/// periodic domain the line goes to the nearest image of the second particle. Each cell has
///
/// - kind: 0 hinge, 1 spring, 2 arm, 3 line of a membrane;
/// - id: number of the link or membrane in its list of the case, from 0;
/// - force: in the last step, on the body of a hinge or on the second particle [M L/T^2].
std::string write_links(const Setting& setting, const State& state);

}  // namespace viscontact::particles
