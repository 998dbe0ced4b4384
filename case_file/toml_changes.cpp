// Copies of TOML tables with other values, and tables as text (toml_section.hpp).
#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "viscontact/case_file/toml_node.hpp"
#include "viscontact/case_file/toml_section.hpp"
#include "viscontact/common/error.hpp"

namespace viscontact::case_file {
namespace {

/// True if the number can be stored as an integer without loss.
bool is_integer(double value) {
  constexpr double kLargestInteger = 1e15;  // below 2^53
  return value == std::floor(value) && std::abs(value) <= kLargestInteger &&
         !(value == 0 && std::signbit(value));
}

}  // namespace

TomlSection TomlSection::with_numbers(
    std::span<const std::pair<std::string, double>> numbers) const {
  auto root = std::make_shared<toml::table>(*node_->root);
  for (const auto& number : numbers) {
    const std::string& path = number.first;
    const double value = number.second;
    const auto refuse = [&](const std::string& what) {
      throw_bad_input({node_->file}, fmt::format("{} {}", path, what));
    };
    auto* place = root->at_path(path).node();
    // In place of a node of another type, because the node of an integer cannot store a fraction.
    const auto replace = [&](auto new_value) {
      const auto dot = path.rfind('.');
      const auto bracket = path.rfind('[');
      if (place != nullptr && bracket != std::string::npos && path.back() == ']') {
        auto* array = root->at_path(path.substr(0, bracket)).as_array();
        const auto index = static_cast<std::size_t>(std::stoul(path.substr(bracket + 1)));
        array->replace(array->cbegin() + static_cast<std::ptrdiff_t>(index), new_value);
        return;
      }
      auto* parent =
          dot == std::string::npos ? root.get() : root->at_path(path.substr(0, dot)).as_table();
      if (parent == nullptr) refuse("is not a key of this case");
      // The reader of the case checks whether this key exists.
      parent->insert_or_assign(path.substr(dot + 1), new_value);
    };
    if (place != nullptr && place->is_floating_point())
      **place->as_floating_point() = value;
    else if (place != nullptr && !place->is_integer())
      refuse("is not a number in this case");
    else if (is_integer(value))
      replace(static_cast<std::int64_t>(value));
    else
      replace(value);
  }
  const auto* table = root.get();
  return TomlSection(std::make_shared<Node>(Node{std::move(root), table, node_->file, "", {}}));
}

TomlSection TomlSection::with_texts(
    std::span<const std::pair<std::string, std::string>> texts) const {
  auto root = std::make_shared<toml::table>(*node_->root);
  for (const auto& [path, text] : texts) {
    auto* place = root->at_path(path).as_string();
    if (place == nullptr)
      throw_bad_input({node_->file}, fmt::format("{} is not a text in this case", path));
    **place = text;
  }
  const auto* table = root.get();
  return TomlSection(std::make_shared<Node>(Node{std::move(root), table, node_->file, "", {}}));
}

std::string TomlSection::as_toml() const {
  std::ostringstream text;
  text << *node_->root << "\n";
  return text.str();
}

}  // namespace viscontact::case_file
