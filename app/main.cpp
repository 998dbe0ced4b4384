// Reads the command line and runs the command that it names. No exception leaves main().
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/app/arguments/interrupt.hpp"
#include "viscontact/app/commands/commands.hpp"
#include "viscontact/app/help/self_description.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/system/memory.hpp"
#include "viscontact/results/exit_code.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::app {
namespace {

std::string version_text() {
  std::string text;
  for (const auto& [program, version] : results::library_versions())
    if (program != "Viscontact") text += fmt::format("{} {}\n", program, version);
  return fmt::format("viscontact {}\nFreeFEM {}\n{}", VISCONTACT_VERSION,
                     results::freefem_version_or_not_found(interrupt_token()), text);
}

/// The commands `completion` and `man`, which print the texts of self_description.hpp.
void add_self_description(CLI::App& app) {
  auto* completion = app.add_subcommand(
      "completion", "print the completion for a shell: source <(viscontact completion bash)");
  auto shell = std::make_shared<std::string>();
  add_value(*completion, "SHELL", *shell, "bash|zsh", "the shell")
      ->required()
      ->check(one_of({"bash", "zsh"}));
  completion->callback([&app, shell] {
    fmt::print("{}", *shell == "zsh" ? zsh_completion(app) : bash_completion(app));
  });
  app.add_subcommand("man", "print the manual page: viscontact man | man -l -")->callback([&app] {
    fmt::print("{}", manual(app, VISCONTACT_VERSION));
  });
}

int run(int argc, char** argv) {
  CLI::App app("Lubrication force of a sphere near contact: tabulate, fit, simulate, compare.",
               "viscontact");
  app.require_subcommand(1);
  app.set_version_flag("--version", version_text,
                       "versions of Viscontact and of what it is built with");
  bool healthy = true;
  app.footer(help_footer());
  add_init(app);
  add_run(app);
  add_tabulate(app);
  add_fit(app);
  add_export(app);
  add_shift(app);
  add_simulate(app);
  add_sweep(app);
  add_particles(app);
  add_rolling(app);
  add_swimmer(app);
  add_compare(app);
  add_report(app);
  add_rerun(app);
  add_doctor(app, healthy);
  add_self_description(app);
  if (argc > 1 && argv[1][0] != '-') {
    std::vector<std::string> names;
    for (const auto* command : app.get_subcommands([](const CLI::App*) { return true; }))
      names.push_back(command->get_name());
    if (std::ranges::find(names, argv[1]) == names.end())
      throw Error(ErrorKind::kWrongUsage, "there is no subcommand '{}'; the subcommands are: {}",
                  argv[1], fmt::join(names, ", "));
  }
  try {
    auto arguments = with_files_apart({argv + std::min(argc, 1), argv + argc});
    std::ranges::reverse(arguments);  // parse(vector) reads the last element first
    app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    terminal::complain(fmt::format("viscontact: {}; see viscontact --help", error.what()));
    return results::exit_code_of(ErrorKind::kWrongUsage);
  }
  return healthy ? 0 : results::exit_code_of(ErrorKind::kExternalProgram);
}

/// Opens a file in place of each standard stream that this process was started without. Otherwise
/// the next file that a command opens would get the number of that stream, and messages would be
/// written into it. What is opened here can be neither read nor written, so that a missing standard
/// output is still an error.
void occupy_missing_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0)
      (void)::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

}  // namespace
}  // namespace viscontact::app

int main(int argc, char** argv) {
  using viscontact::ErrorKind;
  using viscontact::results::exit_code_of;
  viscontact::app::occupy_missing_streams();
  viscontact::app::catch_interrupts();
  viscontact::keep_freed_memory();
  try {
    const int exit_code = viscontact::app::run(argc, argv);
    if (!std::cout.flush() || std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      viscontact::throw_bad_input({"standard output"}, "cannot be written");
    return exit_code;
  } catch (const viscontact::Error& error) {
    viscontact::terminal::clear_progress();
    const bool wrong_usage = error.kind() == ErrorKind::kWrongUsage;
    viscontact::terminal::complain(fmt::format("viscontact: {}{}", error.what(),
                                               wrong_usage ? "; see viscontact --help" : ""));
    return exit_code_of(error.kind());
  } catch (const std::bad_alloc&) {
    viscontact::terminal::complain("viscontact: there is not enough memory for this command");
    return exit_code_of(ErrorKind::kNotConverged);
  } catch (const std::exception& error) {
    // An error of the file system or of a library that no earlier check has found.
    viscontact::terminal::complain(fmt::format("viscontact: {}", error.what()));
    return exit_code_of(ErrorKind::kBadInput);
  }
}
