// The tables that declarations of keys make for docs/case-file.md (keys.hpp).
#include "viscontact/case_file/keys.hpp"

namespace viscontact::case_file {

std::string KeyTable::markdown() const {
  std::string table = "| key | value | default | meaning |\n| --- | --- | --- | --- |\n";
  for (const auto& row : rows)
    table +=
        fmt::format("| `{}` | {} | {} | {} |\n", row.key, row.value, row.fallback, row.meaning);
  return table;
}

void Keys::describe(std::string_view key, std::string value, std::string fallback,
                    const Help& help) {
  if (!help.value.empty()) value = help.value;
  if (!help.fallback.empty()) fallback = help.fallback;
  table_->rows.push_back({std::string(key), std::move(value),
                          fallback.empty() ? "none" : std::move(fallback),
                          std::string(help.meaning)});
}

KeyTable describe_keys(std::string section, const std::function<void(Keys&)>& declaration) {
  KeyTable table{std::move(section), {}};
  Keys keys(table);
  declaration(keys);
  return table;
}

std::string number_in_words(double number) {
  auto text = fmt::format("{}", number);
  // fmt writes exponents with two digits at least.
  if (const auto at = text.find("e-0"); at != std::string::npos) text.erase(at + 2, 1);
  return text;
}

}  // namespace viscontact::case_file
