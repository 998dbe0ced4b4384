// The command line of `particles` (docs/command-line.md). The work is done in
// particles/run/particles_stage.hpp.
#include <memory>
#include <string>

#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/app/commands/commands.hpp"
#include "viscontact/app/commands/interrupt.hpp"
#include "viscontact/freefem_flow/freefem_solver.hpp"
#include "viscontact/particles/run/particles_stage.hpp"

namespace viscontact::app {

void add_particles(CLI::App& app) {
  auto* command = app.add_subcommand("particles", "simulate many particles with viscous contact");
  auto o = std::make_shared<particles::ParticlesRequest>();
  o->threads = default_jobs();
  add_value(*command, "CASE", o->case_file, kFile, "case file (TOML)")->required();
  add_value(*command, "-o,--output", o->folder, kFolder,
            "folder for frames, final state, restart file, page and record")
      ->required();
  add_value(*command, "--restart", o->restart, kFile,
            "restart.bin of a run to be continued with the case's forces, planes and end_time");
  add_jobs(*command, o->threads, "number of threads; the results do not depend on it");
  add_json(*command, o->json);
  command->callback([o] {
    check_outputs({o->folder});
    o->start_solver = freefem_flow::start_fluid_solver;
    o->stop = interrupt_token();
    particles::run_particles(*o);
  });
}

}  // namespace viscontact::app
