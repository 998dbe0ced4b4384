// Writes the completion scripts for bash and zsh (completion.hpp). Texts of options must pass
// through zsh_description() and quoted(), because they contain special characters.
#include "viscontact/app/help/completion.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/reduced_model/models/models.hpp"

namespace viscontact::app {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

bool is_flag(const CLI::Option& option) { return option.get_type_size() == 0; }

/// The names of an option, such as "-o" and "--output".
std::vector<std::string> names_of_option(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const auto& name : option.get_snames()) names.push_back("-" + name);
  for (const auto& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

/// The words that the option's value can be, if it is a choice of words; otherwise empty.
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

/// The text as it must be written within single quotes of a shell.
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

}  // namespace viscontact::app
