// `rerun` starts the command in the provenance of a file again. Anybody may have written the file,
// so check_command() decides before execv which commands and options are run.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/app/commands/commands.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/shell_words.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::app {
namespace {

namespace fs = std::filesystem;

struct RerunOptions {
  std::string file,             ///< path of the file whose command is repeated
      output,                   ///< path of the new output; empty: the recorded one
      folder;                   ///< where the command runs; empty: the recorded one
  bool changed_inputs = false,  ///< runs although inputs have changed
      dry_run = false;          ///< prints the command and does not run it
};

/// Throws Error(kBadInput) unless the command is one of Viscontact that writes files. Refuses
/// `rerun`, and options by which a file could make this program run others (--launcher,
/// --slurm-options).
void check_command(const std::string& file, const std::vector<std::string>& command) {
  constexpr auto kWriting = std::to_array<std::string_view>(
      {"run", "tabulate", "fit", "export", "shift", "simulate", "sweep", "compare", "report",
       "particles", "rolling", "swimmer"});
  const bool known =
      command.size() > 1 && std::ranges::find(kWriting, command[1]) != kWriting.end();
  const auto is_refused = [](const std::string& word) {
    return word.find('\0') != std::string::npos || word.starts_with("--launcher") ||
           word.starts_with("--slurm-options");
  };
  if (!known || std::ranges::any_of(command, is_refused))
    throw_bad_input({file}, "its line 'provenance' contains a command that 'rerun' does not run");
}

/// The place of an option's value in a command: the index of a word of the command, and the
/// position in this word at which the value begins.
struct ValuePlace {
  std::size_t word = 0, begin = 0;
};

/// The place of the value of the option `name`, such as --output, with the one-letter name `letter`
/// ('\0': none), written as "-o VALUE", "-oVALUE", "--output VALUE" or "--output=VALUE".
std::optional<ValuePlace> value_of(const std::vector<std::string>& command, char letter,
                                   const std::string& name) {
  const std::string shorter = letter == '\0' ? "" : std::string("-") + letter;
  for (std::size_t i = 2; i < command.size(); ++i) {
    const auto& word = command[i];
    if ((word == name || (!shorter.empty() && word == shorter)) && i + 1 < command.size())
      return ValuePlace{i + 1, 0};
    if (word.starts_with(name + "=")) return ValuePlace{i, name.size() + 1};
    if (!shorter.empty() && word.size() > shorter.size() && word.starts_with(shorter))
      return ValuePlace{i, shorter.size()};
  }
  return {};
}

std::string value_at(const std::vector<std::string>& command, const ValuePlace& place) {
  return command[place.word].substr(place.begin);
}

/// The command of the provenance, changed so that it writes to `o.output`. Throws
/// Error(kWrongUsage) if the command has no option for that, if the file is a picture that was
/// drawn beside a table, or if `o.output` must be a folder but is the name of a file.
std::vector<std::string> with_output(const RerunOptions& o, const results::Provenance& provenance) {
  auto command = provenance.command;
  const auto put = [&](const ValuePlace& place) {
    auto& word = command[place.word];
    word = word.substr(0, place.begin) + fs::absolute(o.output).string();
    return command;
  };
  // If the file is the picture of --plot, only the path of the picture is changed. The command's
  // main output stays at its place, and is not written again if nothing has changed.
  if (const auto plot = value_of(command, '\0', "--plot");
      plot && value_at(command, *plot) == provenance.output)
    return put(*plot);
  const auto output = value_of(command, 'o', "--output");
  // If `fit` made the file and the file is not its --output, it is the picture of --compare-bases
  // with the default name.
  if (command[1] == "fit" && (!output || value_at(command, *output) != provenance.output)) {
    command.insert(command.end(), {"--plot", fs::absolute(o.output).string()});
    return command;
  }
  if (!output) {
    if (command[1] == "compare") {
      command.insert(command.end(), {"-o", fs::absolute(o.output).string()});
      return command;
    }
    throw Error(ErrorKind::kWrongUsage,
                "the command that made {} ('{}') has no option for another output; leave out -o",
                o.file, command[1]);
  }
  const bool one_of_many = value_at(command, *output) != provenance.output;
  if (one_of_many && command[1] == "tabulate" && fs::path(provenance.output).extension() != ".csv")
    throw Error(ErrorKind::kWrongUsage,
                "{} is a picture that was drawn beside a table; rerun the table with -o TABLE, and "
                "its pictures are drawn beside it",
                o.file);
  if (one_of_many && (fs::is_regular_file(o.output) || fs::path(o.output).has_extension()))
    throw Error(ErrorKind::kWrongUsage,
                "{} is one of the files that the command ('{}') wrote into {}; -o must be a folder "
                "for all of them, but it is '{}'",
                o.file, command[1], value_at(command, *output), o.output);
  put(*output);
  // The picture of --plot would replace the earlier picture, so --plot and the options that need it
  // are left out. `tabulate` draws its pictures beside the new table.
  for (const auto* option : {"--plot", "--width", "--font-size"})
    if (const auto place = value_of(command, '\0', option); place && command[1] != "tabulate") {
      const auto begin = command.begin() + static_cast<std::ptrdiff_t>(place->word);
      command.erase(place->begin == 0 ? begin - 1 : begin, begin + 1);
    }
  return command;
}

/// Changes absolute paths below the old folder so that the command runs in the folder `to`, to
/// which its files have moved.
void move_to(results::Provenance& provenance, const fs::path& to) {
  const std::string from = provenance.folder + "/";
  // A provenance without its folder has no absolute paths either, because
  // results::without_folders() removes both.
  const bool tells_folder = !provenance.folder.empty();
  const auto move = [&](std::string& word, std::size_t begin) {
    if (tells_folder && word.compare(begin, from.size(), from) == 0)
      word.replace(begin, from.size(), (to / "").string());
  };
  for (std::size_t i = 2; i < provenance.command.size(); ++i)
    move(provenance.command[i], results::path_in_word(provenance.command[i]));
  for (auto& input : provenance.inputs) move(input.file, 0);
  move(provenance.output, 0);
  provenance.folder = to.string();
}

void rerun(const RerunOptions& o) {
  auto provenance = results::read_provenance(o.file);
  if (!provenance || provenance->command.empty())
    throw_bad_input({o.file},
                    "does not say how it was made, because it has no line 'provenance'; every file "
                    "that Viscontact writes has one, but copies of your own files have none");
  const std::string made_in = provenance->folder;
  move_to(*provenance, o.folder.empty() ? results::folder_to_run_in(o.file, *provenance)
                                        : fs::weakly_canonical(o.folder));
  const fs::path folder = provenance->folder;
  if (!fs::is_directory(folder))
    throw_bad_input({folder.string()},
                    "is not a folder; the command that made {} ran in {}, and '--folder DIR' names "
                    "another folder to run it in",
                    o.file, made_in);
  std::vector<std::string> changes;
  for (const auto& input : provenance->inputs)
    if (const auto change = input.intermediate ? "" : results::change_of(input, folder);
        !change.empty())
      changes.push_back(change);
  const std::string list = fmt::format("{}", fmt::join(changes, "; "));
  if (!changes.empty() && !o.changed_inputs && !o.dry_run)
    throw_bad_input(
        {o.file},
        "was made from other inputs: {}; give --changed-inputs to use the inputs as they are now",
        list);
  check_command(o.file, provenance->command);
  auto command = o.output.empty() ? provenance->command : with_output(o, *provenance);
  // --gather needs the rows of an array job, which may have been deleted since. Without --gather,
  // the command computes the missing rows.
  std::erase(command, "--gather");
  if (const auto ours = provenance->versions.find("Viscontact");
      ours != provenance->versions.end() && ours->second != VISCONTACT_VERSION)
    terminal::warn("rerun: warning: the file was made by Viscontact {}, and this is {}",
                   ours->second, VISCONTACT_VERSION);
  if (!changes.empty()) terminal::warn("rerun: warning: " + list);
  const std::string words = fmt::format("cd {} && viscontact{}", shell_word(folder.string()),
                                        shell_arguments(std::span(command).subspan(1)));
  if (o.dry_run) {
    fmt::print("{}\n", words);
    return;
  }
  terminal::say("rerun: " + words);
  if (::chdir(folder.c_str()) != 0)
    throw_bad_input({folder.string()},
                    "the folder in which the file was made cannot be entered ({})",
                    std::strerror(errno));
  // execv starts the program that runs now, and not the program that the recorded command names.
  std::vector<char*> arguments;
  for (auto& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv("/proc/self/exe", arguments.data());
  throw Error(ErrorKind::kExternalProgram, "viscontact cannot be started again ({})",
              std::strerror(errno));
}

}  // namespace

void add_rerun(CLI::App& app) {
  auto* command = app.add_subcommand(
      "rerun", "repeat the command that made a file, if its inputs are the same");
  auto o = std::make_shared<RerunOptions>();
  add_value(*command, "FILE", o->file, kFile,
            "a file that Viscontact wrote: table, fit, trajectory, report, picture, ...")
      ->required();
  add_value(*command, "-o,--output", o->output, kFile,
            "where to write all files again; for a file of a run, a folder for all files of the "
            "run; default: where the command wrote, where files that are up to date are kept");
  add_value(
      *command, "--folder", o->folder, kFolder,
      "folder to run the command in, if files have moved; default: the folder in which it ran");
  command->add_flag("--changed-inputs", o->changed_inputs,
                    "run the command although inputs have changed since");
  command->add_flag("--dry-run", o->dry_run, "print the command and do not run it");
  command->callback([o] { rerun(*o); });
}

}  // namespace viscontact::app
