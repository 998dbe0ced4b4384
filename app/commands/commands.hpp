// The commands of the program. Each function adds the command that it is named after, with its
// options, to the command line `app`; the command runs while CLI11 parses the line, and throws
// Error. docs/command-line.md describes the commands. pipeline/ and the libraries do the work.
// main.cpp calls these functions; a change must keep the names of commands and options, which
// scripts of users contain.
#pragma once

#include <CLI/CLI.hpp>

namespace viscontact::app {

void add_compare(CLI::App& app);
/// Sets `healthy` to false if the command runs and something is missing or wrong.
void add_doctor(CLI::App& app, bool& healthy);
void add_export(CLI::App& app);
void add_fit(CLI::App& app);
void add_init(CLI::App& app);
void add_particles(CLI::App& app);
void add_report(CLI::App& app);
void add_rerun(CLI::App& app);
void add_run(CLI::App& app);
void add_shift(CLI::App& app);
void add_simulate(CLI::App& app);
void add_sweep(CLI::App& app);
void add_rolling(CLI::App& app);
void add_swimmer(CLI::App& app);
void add_tabulate(CLI::App& app);

}  // namespace viscontact::app
