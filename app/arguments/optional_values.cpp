// The three options whose value may be left out, and how a value is told from the name of a file.
// The list must contain every option for which a command calls expected(0, 1).
#include "viscontact/app/arguments/optional_values.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "viscontact/common/text/number.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::app {

std::vector<std::string> with_files_apart(std::vector<std::string> arguments) {
  struct Option {
    std::string_view command, name;
    bool (*is_value)(std::string_view word);  // true: a value even if a file has this name
  };
  constexpr auto is_number = [](std::string_view word) {
    return parse_number(word.substr(0, word.find(','))).has_value();
  };
  constexpr auto is_term = [](std::string_view word) {
    return word.starts_with(lubrication::kLeadingTerm);
  };
  constexpr auto is_limit = [](std::string_view word) {
    return word == "fitted" || word == "theory";
  };
  const auto options = std::to_array<Option>({{"fit", "--fix", is_term},
                                              {"tabulate", "--plot", is_number},
                                              {"simulate", "--lubrication-limit", is_limit}});
  const auto is_file = [](const std::string& word) {
    std::error_code ignored;  // some words cannot be names of files
    return word.ends_with(".csv") || word.ends_with(".toml") ||
           std::filesystem::exists(word, ignored);
  };
  for (const auto& option : options) {
    if (arguments.empty() || arguments[0] != option.command) continue;
    // Words behind -- are files, even if one has the name of an option.
    const auto end = std::ranges::find(arguments, "--");
    const auto at = std::find(arguments.begin(), end, option.name);
    if (at == end || at + 1 == end) continue;
    if (option.is_value(at[1]) || !is_file(at[1])) continue;
    // At its new place, no word follows the option that it could take as its value.
    std::rotate(at, at + 1, end);
  }
  return arguments;
}

}  // namespace viscontact::app
