// The commands `fit` and `export`.
#pragma once

namespace CLI {
class App;
}

namespace viscontact {

/// Adds the command `fit`.
void add_fit(CLI::App& app);
/// Adds the command `export`.
void add_export(CLI::App& app);

}  // namespace viscontact
