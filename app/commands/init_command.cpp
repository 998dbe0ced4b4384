// The command `init`: writes a commented case and prints the command that runs it.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/app/commands/commands.hpp"
#include "viscontact/app/commands/template/case_template.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/shell_words.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::app {

void add_init(CLI::App& app) {
  auto* command = app.add_subcommand("init", "write a commented case as a starting point");
  auto file = std::make_shared<std::string>();
  add_value(*command, "CASE", *file, kFile,
            "case file to write (TOML); a file that exists is not replaced")
      ->required();
  command->callback([file] {
    check_outputs({*file});
    const std::filesystem::path path = *file;
    if (std::filesystem::exists(std::filesystem::symlink_status(path)))
      throw_bad_input({*file}, "exists and is not replaced; remove it first, or write elsewhere");
    write_file(path, case_template());
    // A name that begins with "-" is written as "./-...", so that it is not read as an option.
    const auto named = [](const std::string& name) {
      return shell_word(name.starts_with('-') ? "./" + name : name);
    };
    auto results = path;
    results.replace_extension(path.has_extension() ? "" : ".results");
    terminal::say(fmt::format("init: {}; edit it, then: viscontact run {} -o {}", *file,
                              named(*file), named(results.string())));
  });
}

}  // namespace viscontact::app
