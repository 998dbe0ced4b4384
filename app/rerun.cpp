#include "app/rerun.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>

#include "app/command_options.hpp"
#include "app/progress.hpp"
#include "app/provenance.hpp"
#include "app/slurm.hpp"
#include "common/error.hpp"
#include "common/file.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string file, output;
  bool changed_inputs = false, dry_run = false;
};

/// What has become of an input since; nothing if it is as it was.
std::string change_of(const InputFile& input, const fs::path& folder) {
  const auto path = folder / input.file;
  if (!fs::is_regular_file(path)) return fmt::format("{} is not there any more", path.string());
  if (sha256(read_file(path)) != input.sha256) return fmt::format("{} has changed", path.string());
  return "";
}

/// The command with another output. Throws Error(kWrongUsage) if it has none.
std::vector<std::string> with_output(std::vector<std::string> command, const std::string& output) {
  for (std::size_t i = 1; i < command.size(); ++i) {
    if ((command[i] == "-o" || command[i] == "--output") && i + 1 < command.size()) {
      command[i + 1] = output;
      return command;
    }
    for (const std::string begin : {"--output=", "-o="})
      if (command[i].starts_with(begin)) {
        command[i] = begin + output;
        return command;
      }
  }
  throw Error(ExitCode::kWrongUsage,
              "the command that made the file has no -o to be replaced; leave out rerun's");
}

std::string in_words(const std::vector<std::string>& command) {
  std::string text = "viscontact";
  for (std::size_t i = 1; i < command.size(); ++i) text += " " + shell_word(command[i]);
  return text;
}

void rerun(const Options& o) {
  const auto provenance = read_provenance(o.file);
  if (!provenance || provenance->command.empty())
    throw_bad_input({o.file},
                    "does not say how it was made (no line 'provenance'); files that "
                    "Viscontact writes do, copies of yours do not");
  const fs::path folder = provenance->folder;
  std::vector<std::string> changes;
  for (const auto& input : provenance->inputs)
    if (const auto change = input.intermediate ? "" : change_of(input, folder); !change.empty())
      changes.push_back(change);
  const std::string list = fmt::format("{}", fmt::join(changes, "; "));
  if (!changes.empty() && !o.changed_inputs && !o.dry_run)
    throw_bad_input({o.file}, fmt::format("was made from other inputs: {}; with --changed-inputs "
                                          "what is there now is used",
                                          list));
  auto command = provenance->command;
  if (!o.output.empty()) command = with_output(command, fs::absolute(o.output).string());
  if (const auto ours = provenance->versions.find("Viscontact");
      ours != provenance->versions.end() && ours->second != VISCONTACT_VERSION)
    warn(fmt::format("rerun: warning: made by Viscontact {}; this is {}", ours->second,
                     VISCONTACT_VERSION));
  if (!changes.empty()) warn("rerun: warning: " + list);
  const std::string words =
      fmt::format("cd {} && {}", shell_word(folder.string()), in_words(command));
  if (o.dry_run) {
    fmt::print("{}\n", words);
    return;
  }
  say("rerun: " + words);
  if (::chdir(folder.c_str()) != 0)
    throw_bad_input({folder.string()}, fmt::format("the folder in which it was made cannot be "
                                                   "entered ({})",
                                                   std::strerror(errno)));
  // This very program, whatever the command called it then.
  std::vector<char*> arguments;
  for (auto& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv("/proc/self/exe", arguments.data());
  throw Error(ExitCode::kExternalProgram,
              fmt::format("viscontact cannot be started again ({})", std::strerror(errno)));
}

}  // namespace

void add_rerun(CLI::App& app) {
  auto* command = app.add_subcommand(
      "rerun", "the command that made a file once more, if its inputs are the same");
  auto o = std::make_shared<Options>();
  command
      ->add_option("FILE", o->file,
                   "a file that Viscontact wrote: table, fit, trajectory, report, picture, ...")
      ->required()
      ->type_name(kFile);
  command
      ->add_option("-o,--output", o->output,
                   "write there, from nothing; default: where the command wrote, what is up to "
                   "date there is left")
      ->type_name(kFile);
  command->add_flag("--changed-inputs", o->changed_inputs,
                    "go on although inputs have changed since");
  command->add_flag("--dry-run", o->dry_run, "print the command, do not run it");
  command->callback([o] { rerun(*o); });
}

}  // namespace viscontact
