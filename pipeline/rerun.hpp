// The command rerun: repeats what made a file.
#pragma once

namespace CLI {
class App;
}

namespace viscontact {

void add_rerun(CLI::App& app);

}  // namespace viscontact
