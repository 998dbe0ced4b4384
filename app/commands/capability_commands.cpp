// The command lines of `particles`, `rolling` and `swimmer` (docs/command-line.md). Each of these
// commands reads a case file (TOML) and writes all results of the case and a web page about them
// into the folder --output; numbers are in the units of the case. --jobs is from 1 to 1024.
// main.cpp adds the commands. They throw Error(kWrongUsage) for an empty name of the folder, or for
// --hdf5 if the module hdf5 is missing, Error(kBadInput) for a wrong case or a file that
// must not be replaced, Error(kExternalProgram) if FreeFEM or another program fails,
// Error(kNotConverged) if a computation fails, and Error(kInterrupted) after Ctrl-C.
// run_particles(), run_rolling() and run_swimmer() do the work. Texts of --help may be changed. A
// change must keep the names of the options; the names of the commands are also in the list
// kWriting of rerun_command.cpp.
#include <memory>
#include <string>

#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/app/arguments/interrupt.hpp"
#include "viscontact/app/commands/commands.hpp"
#include "viscontact/freefem_flow/freefem_solver.hpp"
#include "viscontact/particles/run/particles_stage.hpp"
#include "viscontact/rolling/job/rolling_stage.hpp"
#include "viscontact/swimmer/job/swimmer_stage.hpp"

namespace viscontact::app {
namespace {

/// Adds the argument CASE and the option --output, which must both be given. `contents` names the
/// files in the output folder, for --help.
template <class Request>
void add_case_and_folder(CLI::App& command, Request& o, const std::string& contents) {
  add_value(command, "CASE", o.case_file, kFile, "case file (TOML)")->required();
  add_value(command, "-o,--output", o.folder, kFolder, "folder for " + contents)->required();
}

/// Adds the options --plots and --json. When the command runs, it checks the name of the output folder and calls
/// `run` with the request `o`.
template <class Request>
void run_job(CLI::App& command, const std::shared_ptr<Request>& o, void (*run)(const Request&)) {
  auto plots = std::make_shared<std::string>();
  add_plots(command, *plots);
  add_json(command, o->json);
  command.callback([o, plots, run] {
    check_outputs({o->folder});
    check_plots(*plots);
    o->stop = interrupt_token();
    run(*o);
    make_plots(*plots, o->folder);
  });
}

}  // namespace

void add_particles(CLI::App& app) {
  auto* command = app.add_subcommand("particles", "simulate many particles with viscous contact");
  auto o = std::make_shared<particles::ParticlesRequest>();
  o->threads = default_jobs();
  o->start_solver = freefem_flow::start_fluid_solver;
  add_case_and_folder(*command, *o, "frames, final state, restart file, page and record");
  add_value(*command, "--restart", o->restart, kFile,
            "restart.bin of a run to be continued with the case's forces, planes and end_time");
  command->add_flag(
      "--hdf5", o->hdf5,
      "write all frames to one file particles.h5, too; also of a run that is finished");
  command->add_flag("--xyz", o->xyz,
                    "write all frames to one file particles.xyz for OVITO and ASE (extended XYZ), "
                    "too; also of a run that is finished");
  add_jobs(*command, o->threads, "number of threads; the results do not depend on it");
  run_job(*command, o, particles::run_particles);
}

void add_rolling(CLI::App& app) {
  auto* command = app.add_subcommand(
      "rolling", "roll a sphere along a plane: tables, fit, trajectories and a report");
  auto o = std::make_shared<rolling::RollingRequest>();
  o->jobs = default_jobs();
  add_case_and_folder(*command, *o, "tables, fit, trajectories and report");
  add_jobs(*command, o->jobs, "number of FreeFEM processes at once");
  run_job(*command, o, rolling::run_rolling);
}

void add_swimmer(CLI::App& app) {
  auto* command = app.add_subcommand(
      "swimmer",
      "swim with spheres on a line: table, fit, strokes, the optimal stroke and a report");
  auto o = std::make_shared<swimmer::SwimmerRequest>();
  o->jobs = default_jobs();
  add_case_and_folder(*command, *o, "table, fit, strokes and report");
  add_jobs(*command, o->jobs, "number of FreeFEM processes at once");
  run_job(*command, o, swimmer::run_swimmer);
}

}  // namespace viscontact::app
