// `init` writes a commented case that `viscontact run` accepts as it is.

#include <filesystem>
#include <memory>

#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/app/commands/commands.hpp"
#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/shell_words.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::app {
namespace {

/// The beginning of the case. The sections follow it in the file; commented_case() makes them from
/// the declarations of their keys.
const std::string kHead =
    R"(# A case for Viscontact. Lengths, times and masses may be in any coherent system of units: all in SI
# units, for example, or all lengths in radii of the sphere.
#
#   viscontact run THIS_FILE -o results                    tabulate, fit, simulate, compare, report
#   viscontact tabulate THIS_FILE -o table.csv --dry-run   say how many rows there are and how long
#                                                          they take
#
# A line "# key = value" shows an optional key with its default or an example. All keys and sections
# are in docs/case-file.md. With file or exact in the section [fit], and without the section
# [tabulation], FreeFEM is not needed.
title = "A sphere that is pushed towards a plane and pulled back"
)";

}  // namespace

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
    write_file(path, kHead + case_file::commented_case(case_file::tables_of_sphere_case()));
    // A name that begins with "-" is written as "./-...", so that it is not read as an option.
    const auto named = [](const std::string& name) {
      return shell_word(name.starts_with('-') ? "./" + name : name);
    };
    auto results = path;
    results.replace_extension(path.has_extension() ? "" : ".results");
    terminal::say("init: {}; edit it, then: viscontact run {} -o {}", *file, named(*file),
                  named(results.string()));
  });
}

}  // namespace viscontact::app
