// The commands fit and export.
#pragma once

namespace CLI {
class App;
}

namespace viscontact {

void add_fit(CLI::App& app);
void add_export(CLI::App& app);

}  // namespace viscontact
