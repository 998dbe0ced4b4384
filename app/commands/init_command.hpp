// The command init: a commented case to begin with.
#pragma once

namespace CLI {
class App;
}

namespace viscontact {

void add_init(CLI::App& app);

}  // namespace viscontact
