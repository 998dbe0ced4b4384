// Descriptions of options contain special characters: each text passes through zsh_description()
// and quoted() before it stands in a script, and through escaped() before it stands in the page.
#include "viscontact/app/help/self_description.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <utility>

#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/results/exit_code.hpp"

namespace viscontact::app {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

bool is_flag(const CLI::Option& option) { return option.get_type_size() == 0; }

/// The names, such as "-o" and "--output".
std::vector<std::string> names_of_option(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const auto& name : option.get_snames()) names.push_back("-" + name);
  for (const auto& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

/// The words that the option's value can be, if it is one known word or a list of them; or none.
std::vector<std::string> words_for(const CLI::Option& option) {
  std::string type = option.get_type_name();
  if (type == kModel || type == kModels) type = names_of(reduced_model::all_models(), "|");
  if (type.find('|') == std::string::npos || type.starts_with('[')) return {};
  return CLI::detail::split(type, '|');
}

/// Bash code that offers the possible values of the option; empty if they are not known.
std::string bash_offer(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (type == kFile) return "_viscontact_files";
  if (type == kFolder) return "_viscontact_folders";
  if (const auto words = words_for(option); !words.empty())
    return fmt::format("_viscontact_{} '{}'", type == kModels ? "list" : "words",
                       fmt::join(words, " "));
  return "";
}

/// The text as it must be written between single quotes in a shell script.
std::string quoted(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result;
}

/// The text with the special characters of zsh's function _arguments escaped.
std::string zsh_description(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

/// Zsh code that offers the possible values of the option; a blank, with which zsh shows the
/// description of the option only, if they are not known.
std::string zsh_action(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (type == kFile) return "_files";
  if (type == kFolder) return "_files -/";
  if (const auto words = words_for(option); !words.empty())
    return type == kModels ? fmt::format("_values -s , model {}", fmt::join(words, " "))
                           : fmt::format("({})", fmt::join(words, " "));
  return " ";
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
  std::string names, cases;
  for (const auto* command : commands_of(app)) {
    names += (names.empty() ? "" : " ") + command->get_name();
    std::string options, values, positional;
    for (const auto* option : command->get_options()) {
      const auto spellings = names_of_option(*option);
      if (spellings.empty()) {
        if (positional.empty()) positional = bash_offer(*option);
        continue;
      }
      options += fmt::format("{}{}", options.empty() ? "" : " ", fmt::join(spellings, " "));
      if (!is_flag(*option))
        values += fmt::format("        {}) {}; return ;;\n", fmt::join(spellings, "|"),
                              bash_offer(*option).empty() ? ":" : bash_offer(*option));
    }
    cases += fmt::format(
        "    {})\n      case \"$previous\" in\n{}      esac\n"
        "      if [[ $word == -* ]]; then _viscontact_words '{}'; else {}; fi ;;\n",
        command->get_name(), values, options, positional.empty() ? ":" : positional);
  }
  return fmt::format(R"BASH(# bash completion for viscontact; made by `viscontact completion bash`.
_viscontact_words() {{
  COMPREPLY=($(compgen -W "$1" -- "$word"))
}}
_viscontact_list() {{
  local before=""
  [[ $word == *,* ]] && before="${{word%,*}},"
  COMPREPLY=($(compgen -P "$before" -W "$1" -- "${{word##*,}}"))
}}
_viscontact_files() {{
  mapfile -t COMPREPLY < <(compgen -f -- "$word")
  compopt -o filenames
}}
_viscontact_folders() {{
  mapfile -t COMPREPLY < <(compgen -d -- "$word")
  compopt -o filenames
}}
_viscontact() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}}
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    _viscontact_words '{} --help --version'
    return
  fi
  case "${{COMP_WORDS[1]}}" in
{}  esac
}}
complete -F _viscontact viscontact
)BASH",
                     names, cases);
}

std::string zsh_completion(const CLI::App& app) {
  std::string names, cases;
  for (const auto* command : commands_of(app)) {
    names += fmt::format("    '{}:{}'\n", command->get_name(),
                         quoted(zsh_description(command->get_description())));
    std::string lines;
    for (const auto* option : command->get_options()) {
      const auto spellings = names_of_option(*option);
      const auto description = zsh_description(option->get_description());
      if (spellings.empty()) {
        lines += fmt::format(" \\\n        '{}:{}:{}'", option->get_expected_max() > 1 ? "*" : "",
                             quoted(zsh_description(option->get_name(true))),
                             quoted(zsh_action(*option)));
        continue;
      }
      for (const auto& name : spellings)
        lines +=
            fmt::format(" \\\n        '{}{}[{}]{}'",
                        option->get_items_expected_max() > 1 ? "*" : "", name, quoted(description),
                        is_flag(*option) ? std::string()
                                         : ":" + quoted(zsh_description(option->get_type_name())) +
                                               ":" + quoted(zsh_action(*option)));
    }
    cases += fmt::format("      {})\n        _arguments{} ;;\n", command->get_name(), lines);
  }
  return fmt::format(R"ZSH(#compdef viscontact
# zsh completion for viscontact; made by `viscontact completion zsh`.
_viscontact() {{
  local -a commands
  commands=(
{}  )
  if ((CURRENT == 2)); then
    _describe command commands
    return
  fi
  local command=$words[2]
  words=("${{(@)words[2,-1]}}")
  ((CURRENT--))
  case $command in
{}  esac
}}
_viscontact "$@"
)ZSH",
                     names, cases);
}

namespace {

// The time limits are those of freefem_axi/journal/freefem.hpp.
constexpr std::array kEnvironment = {
    std::pair("VISCONTACT_FREEFEM", "the FreeFEM to run; default: FreeFem++-nw on the PATH"),
    std::pair("VISCONTACT_FREEFEM_TIME_LIMIT",
              "seconds after which FreeFEM is stopped; default: 1800 for a row of a table, 120 for "
              "asking its version"),
    std::pair("NO_COLOR", "set and not empty: no colours on a terminal"),
    std::pair("SOURCE_DATE_EPOCH",
              "seconds since 1970, which are written as the time at which a file was made"),
};

/// The text with the special characters of roff escaped.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else if ((c == '.' || c == '\'') && (result.empty() || result.back() == '\n'))
      result += std::string("\\&") + c;
    else
      result += c;
  }
  return result;
}

std::string item(const std::string& term, const std::string& text) {
  return fmt::format(".TP\n.B {}\n{}\n", escaped(term), escaped(text));
}

std::string option_item(const CLI::Option& option) {
  const auto spellings = names_of_option(option);
  const auto names =
      spellings.empty() ? option.get_name(true) : fmt::format("{}", fmt::join(spellings, ", "));
  std::string text = option.get_description();
  if (!option.get_default_str().empty()) text += " (default: " + option.get_default_str() + ")";
  std::string head = ".TP\n\\fB" + escaped(names) + "\\fR";
  if (!is_flag(option) && !spellings.empty())
    head += " \\fI" + escaped(option.get_type_name()) + "\\fR";
  return head + "\n" + escaped(text) + "\n";
}

}  // namespace

std::string help_footer() {
  std::string text = "Exit codes:\n";
  for (const auto& [kind, code, meaning] : results::exit_codes())
    text += fmt::format("  {:<29} {}\n", code, meaning);
  text += "Environment:\n";
  for (const auto& [name, meaning] : kEnvironment)
    text += fmt::format("  {:<29} {}\n", name, meaning);
  return text + "viscontact COMMAND --help documents a command.";
}

std::string manual(const CLI::App& app, const std::string& version) {
  // help2man reads one --help, and here each command has its own.
  std::string text = fmt::format(
      ".TH VISCONTACT 1 \"\" \"Viscontact {}\"\n.SH NAME\nviscontact \\- lubrication and viscous "
      "contact of a sphere\n.SH SYNOPSIS\n.B viscontact\n.I COMMAND\n[\\fIOPTIONS\\fR]\n"
      ".SH DESCRIPTION\n{}\n.SH COMMANDS\n",
      version, escaped(app.get_description()));
  for (const auto* command : commands_of(app)) {
    std::string synopsis = command->get_name();
    for (const auto* option : command->get_options())
      if (names_of_option(*option).empty()) synopsis += " " + option->get_name(true);
    text += fmt::format(".SS {}\n{}.\n", escaped(synopsis), escaped(command->get_description()));
    for (const auto* option : command->get_options()) text += option_item(*option);
  }
  text += ".SH EXIT STATUS\n";
  for (const auto& [kind, code, meaning] : results::exit_codes())
    text += item(std::to_string(code), std::string(meaning));
  text += ".SH ENVIRONMENT\n";
  for (const auto& [name, meaning] : kEnvironment) text += item(name, meaning);
  return text +
         ".SH EXAMPLES\n.nf\nviscontact init case.toml\nviscontact run case.toml \\-o results\n"
         "viscontact rerun results/fit.json \\-o again.json\n.fi\n";
}

}  // namespace viscontact::app
