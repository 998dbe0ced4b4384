// The command line of `rolling` (docs/command-line.md). The work is done in
// rolling/job/rolling_stage.hpp.
#include <memory>

#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/app/commands/commands.hpp"
#include "viscontact/app/commands/interrupt.hpp"
#include "viscontact/rolling/job/rolling_stage.hpp"

namespace viscontact::app {

void add_rolling(CLI::App& app) {
  auto* command = app.add_subcommand(
      "rolling", "roll a sphere along a plane: tables, fit, trajectories and a report");
  auto o = std::make_shared<rolling::RollingRequest>();
  o->jobs = default_jobs();
  add_value(*command, "CASE", o->case_file, kFile, "case file (TOML)")->required();
  add_value(*command, "-o,--output", o->folder, kFolder,
            "folder for tables, fit, trajectories and report")
      ->required();
  add_jobs(*command, o->jobs, "number of FreeFEM processes at once");
  add_json(*command, o->json);
  command->callback([o] {
    check_outputs({o->folder});
    o->stop = interrupt_token();
    rolling::run_rolling(*o);
  });
}

}  // namespace viscontact::app
