// Writes the manual page, with options, exit codes and environment variables, in the language roff.
// help2man cannot make this page, because it reads one --help, and each command has its own.
#include "viscontact/app/help/manual.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <string>
#include <utility>

#include "viscontact/results/exit_code.hpp"

namespace viscontact::app {
namespace {

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
  const bool flag = option.get_type_size() == 0;
  const bool positional = option.get_snames().empty() && option.get_lnames().empty();
  std::string names;
  for (const auto& name : option.get_snames()) names += (names.empty() ? "-" : ", -") + name;
  for (const auto& name : option.get_lnames()) names += (names.empty() ? "--" : ", --") + name;
  if (positional) names = option.get_name(true);
  std::string text = option.get_description();
  if (!option.get_default_str().empty()) text += " (default: " + option.get_default_str() + ")";
  std::string head = ".TP\n\\fB" + escaped(names) + "\\fR";
  if (!flag && !positional) head += " \\fI" + escaped(option.get_type_name()) + "\\fR";
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
  std::string text = fmt::format(
      ".TH VISCONTACT 1 \"\" \"Viscontact {}\"\n.SH NAME\nviscontact \\- lubrication and viscous "
      "contact of a sphere\n.SH SYNOPSIS\n.B viscontact\n.I COMMAND\n[\\fIOPTIONS\\fR]\n"
      ".SH DESCRIPTION\n{}\n.SH COMMANDS\n",
      version, escaped(app.get_description()));
  for (const auto* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    std::string synopsis = command->get_name();
    for (const auto* option : command->get_options())
      if (option->get_snames().empty() && option->get_lnames().empty())
        synopsis += " " + option->get_name(true);
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
