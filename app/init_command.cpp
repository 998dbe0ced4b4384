#include "app/init_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "app/case_template.hpp"
#include "app/command_options.hpp"
#include "app/progress.hpp"
#include "app/shell_words.hpp"
#include "common/error.hpp"
#include "common/file.hpp"

namespace viscontact {

void add_init(CLI::App& app) {
  auto* command = app.add_subcommand("init", "a commented case to begin with");
  auto file = std::make_shared<std::string>();
  command->add_option("CASE", *file, "case file to write (TOML); one that is there stays")
      ->required()
      ->type_name(kFile);
  command->callback([file] {
    check_outputs({*file});
    const std::filesystem::path path = *file;
    if (std::filesystem::exists(std::filesystem::symlink_status(path)))
      throw_bad_input({*file}, "is there and is not replaced; remove it first, or write elsewhere");
    write_file(path, case_template());
    const auto named = [](std::string name) {  // no option
      return shell_word(name.starts_with('-') ? "./" + name : name);
    };
    auto results = path;
    results.replace_extension(path.has_extension() ? "" : ".results");
    say(fmt::format("init: {}; edit it, then: viscontact run {} -o {}", *file, named(*file),
                    named(results.string())));
  });
}

}  // namespace viscontact
