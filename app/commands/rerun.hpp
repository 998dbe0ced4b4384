// The command `rerun`: runs the command that made a file again, from the file's provenance.
#pragma once

namespace CLI {
class App;
}

namespace viscontact {

/// Adds the command `rerun` to the command line.
void add_rerun(CLI::App& app);

}  // namespace viscontact
