// The command `init`: writes a case with comments to begin with.
#pragma once

namespace CLI {
class App;
}

namespace viscontact {

/// Adds the command `init`.
void add_init(CLI::App& app);

}  // namespace viscontact
