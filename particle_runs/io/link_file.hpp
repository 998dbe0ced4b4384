// The motion of rigid bodies and the forces of links (hinges, springs, arms and membranes) as CSV
// tables over time, and the links at one time as a VTK file.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "viscontact/membranes/membrane_shape.hpp"
#include "viscontact/particle_runs/io/columns.hpp"
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

/// bodies.csv, hinges.csv, springs.csv, arms.csv and membranes.csv of a run, without those for
/// which the case has nothing.
std::vector<TimeTable> time_tables(const Setting& setting, const Particles& particles);

/// The tables of docs/file-formats.md with their columns.
std::vector<ColumnTable> link_column_tables();

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
