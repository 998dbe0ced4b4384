// The commands of the program (docs/command-line.md). A new command that writes files must also be
// added to the list kWriting in rerun_command.cpp.
#pragma once

#include <CLI/CLI.hpp>

namespace viscontact::app {

// Each function adds the command that it is named after, with its options, to the command line
// `app`. A command runs while CLI11 parses the line. It then throws a viscontact::Error of any kind
// (kInterrupted after Ctrl-C), std::filesystem::filesystem_error for a path that the system
// refuses, or CLI::ParseError for a wrong option. A failure of FreeFEM, gnuplot or Slurm is an
// Error(kExternalProgram).

void add_compare(CLI::App& app);  ///< compares trajectories of several models
/// Says which programs are installed. When the command runs, it sets `healthy`, which must outlive
/// `app`: to true if all are installed and FreeFEM computes a right force, else to false.
void add_doctor(CLI::App& app, bool& healthy);
void add_export(CLI::App& app);  ///< writes a fit as code or numbers
void add_fit(CLI::App& app);     ///< fits a formula of the gap to a table of forces
void add_init(CLI::App& app);    ///< writes a case file to begin with
void add_particles(CLI::App& app);
/// Writes report.html of a folder of results again, from the other files in it.
void add_report(CLI::App& app);
void add_rerun(CLI::App& app);  ///< repeats the command that a result file has recorded
/// Computes all results of a case of one sphere: table of forces, fit, trajectories, report.
void add_run(CLI::App& app);
/// Fits how far below its crests a rough wall must be replaced by a smooth one so that the drag of
/// a sphere above it stays the same.
void add_shift(CLI::App& app);
void add_simulate(CLI::App& app);  ///< computes trajectories of one sphere
void add_sweep(CLI::App& app);     ///< runs a case with many values of its keys
void add_rolling(CLI::App& app);   ///< simulates a sphere that rolls along a plane
/// Simulates a swimmer made of spheres on a line, and finds its best stroke.
void add_swimmer(CLI::App& app);
void add_tabulate(CLI::App& app);  ///< computes tables of forces with FreeFEM

}  // namespace viscontact::app
