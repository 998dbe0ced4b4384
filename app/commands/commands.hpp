// The commands of the program. Each function adds the command that it is named after, with its
// options, to the command line `app`; the command runs while CLI11 parses the line, and throws
// viscontact::Error. docs/command-line.md describes the commands. pipeline/ and the libraries do
// the work. main.cpp calls these functions; a change must keep the names of commands and options,
// which scripts of users contain.
#pragma once

#include <CLI/CLI.hpp>

namespace viscontact::app {

void add_compare(CLI::App& app);  ///< `compare`: compares trajectories
/// `doctor`: says what is installed. Sets `healthy` to false if something is missing or wrong.
void add_doctor(CLI::App& app, bool& healthy);
void add_export(CLI::App& app);     ///< `export`: writes a fit as code or numbers
void add_fit(CLI::App& app);        ///< `fit`: fits a formula to a table
void add_init(CLI::App& app);       ///< `init`: writes a first case
void add_particles(CLI::App& app);  ///< `particles`: simulates many particles
void add_report(CLI::App& app);     ///< `report`: makes the page of a folder again
void add_rerun(CLI::App& app);      ///< `rerun`: repeats a recorded command
void add_run(CLI::App& app);        ///< `run`: runs the main job
void add_shift(CLI::App& app);      ///< `shift`: fits at which depth a rough wall acts as smooth
void add_simulate(CLI::App& app);   ///< `simulate`: computes trajectories
void add_sweep(CLI::App& app);      ///< `sweep`: runs a case with many values of its keys
void add_rolling(CLI::App& app);    ///< `rolling`: rolls a sphere along a plane
void add_swimmer(CLI::App& app);    ///< `swimmer`: swims with spheres
void add_tabulate(CLI::App& app);   ///< `tabulate`: computes tables of forces

}  // namespace viscontact::app
