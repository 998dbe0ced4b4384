// The command line of `swimmer` (docs/command-line.md). The work is done in
// swimmer/job/swimmer_stage.hpp.
#include <memory>

#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/app/commands/commands.hpp"
#include "viscontact/app/commands/interrupt.hpp"
#include "viscontact/swimmer/job/swimmer_stage.hpp"

namespace viscontact::app {

void add_swimmer(CLI::App& app) {
  auto* command = app.add_subcommand(
      "swimmer",
      "swim with spheres on a line: table, fit, strokes, the optimal stroke and a report");
  auto o = std::make_shared<swimmer::SwimmerRequest>();
  o->jobs = default_jobs();
  add_value(*command, "CASE", o->case_file, kFile, "case file (TOML)")->required();
  add_value(*command, "-o,--output", o->folder, kFolder,
            "folder for table, fit, strokes and report")
      ->required();
  add_jobs(*command, o->jobs, "number of FreeFEM processes at once");
  add_json(*command, o->json);
  command->callback([o] {
    check_outputs({o->folder});
    o->stop = interrupt_token();
    swimmer::run_swimmer(*o);
  });
}

}  // namespace viscontact::app
