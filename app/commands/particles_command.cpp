// Options of `particles`.
#include "viscontact/app/commands/particles_command.hpp"

#include <memory>
#include <string>

#include "viscontact/app/command_options.hpp"
#include "viscontact/pipeline/particles/particles_stage.hpp"

namespace viscontact {

void add_particles(CLI::App& app) {
  auto* command = app.add_subcommand("particles", "many particles with viscous contact");
  auto o = std::make_shared<ParticlesRequest>();
  o->threads = default_jobs();
  command->add_option("CASE", o->case_file, "case file (TOML)")->required()->type_name(kFile);
  command
      ->add_option("-o,--output", o->folder,
                   "folder for frames, final state, restart file, page and record")
      ->required()
      ->type_name(kFolder);
  command
      ->add_option(
          "--restart", o->restart,
          "restart.bin of a run to be continued with the case's forces, planes and end_time")
      ->type_name(kFile);
  add_jobs(*command, o->threads, "threads; the results do not depend on it");
  add_json(*command, o->json);
  command->callback([o] {
    check_outputs({o->folder});
    run_particles(*o);
  });
}

}  // namespace viscontact
