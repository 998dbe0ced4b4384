// Names and fields of columns, and their descriptions.
#include "viscontact/particle_runs/io/columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>

#include "viscontact/common/text/number.hpp"

namespace viscontact::particles {

const Condition& Presence::in(Output output) const {
  switch (output) {
    case Output::kAtEnd:
      return at_end;
    case Output::kOverTime:
      return over_time;
    case Output::kFrames:
      return frames;
    case Output::kPython:
      break;
  }
  return python;
}

std::size_t ColumnForm::count(int dimension) const {
  assert(dimension >= 1 && dimension <= 3);
  const auto axes = static_cast<std::size_t>(dimension);
  switch (shape) {
    case ValueShape::kNumber:
      break;
    case ValueShape::kVector:
      return axes;
    case ValueShape::kTurn:
      return dimension == 1 ? 0 : 2 * axes - 3;
    case ValueShape::kQuaternion:
      return 4;
    case ValueShape::kTensor:
      return axes * axes;
  }
  return 1;
}

std::size_t ColumnForm::count_in_frames(int dimension) const {
  return shape == ValueShape::kVector ? 3 : count(dimension);
}

std::vector<std::string> ColumnForm::names(int dimension) const {
  const bool is_one =
      shape == ValueShape::kNumber || (shape == ValueShape::kTurn && dimension == 2);
  if (is_one) return {std::string(name)};
  // On an axis there is only z.
  const auto axes = dimension == 1
                        ? std::string_view("z")
                        : std::string_view("xyz").substr(0, static_cast<std::size_t>(dimension));
  const auto begin = prefix == nullptr ? fmt::format("{}_", name) : std::string(prefix);
  std::vector<std::string> names;
  if (shape == ValueShape::kTensor) {
    for (const char i : axes)
      for (const char j : axes) names.push_back(fmt::format("{}{}{}", begin, i, j));
  } else if (count(dimension) > 0) {
    for (const char axis : shape == ValueShape::kQuaternion ? "wxyz" : axes)
      names.push_back(begin + axis);
  }
  return names;
}

void ColumnForm::append(std::string& row, double entry) const {
  if (is_whole())
    fmt::format_to(std::back_inserter(row), "{}", static_cast<std::int64_t>(entry));
  else if (kind == ValueKind::kRounded)
    fmt::format_to(std::back_inserter(row), "{:.3g}", entry);
  else
    append_number(row, entry);
}

namespace {

std::string in_words(const ColumnForm& column) {
  auto text = fmt::format("`{}`", column.name);
  if (column.prefix != nullptr)
    text += fmt::format(", in tables `{}`", fmt::join(column.names(3), ","));
  if (!column.in_hdf5.empty()) text += fmt::format(", in HDF5 `{}`", column.in_hdf5);
  return text;
}

std::string_view in_words(const ColumnForm& column, ValueKind kind) {
  if (kind == ValueKind::kText) return "text";
  switch (column.shape) {
    case ValueShape::kNumber:
      break;
    case ValueShape::kVector:
      return "vector";
    case ValueShape::kTurn:
      return "rotation";
    case ValueShape::kQuaternion:
      return "quaternion";
    case ValueShape::kTensor:
      return "tensor";
  }
  return column.is_whole() ? "whole" : "1";
}

}  // namespace

std::string describe(std::span<const ColumnForm* const> columns,
                     std::span<const TitledOutput> outputs) {
  const bool is_plain =
      outputs.size() == 1 && std::ranges::all_of(columns, [&](const ColumnForm* column) {
        return column->presence.in(outputs[0].output).words == kAlways.words;
      });
  std::string head = "| column | number | dimension |", line = "| --- | --- | --- |", rows;
  for (const auto& output : outputs) {
    if (is_plain) continue;
    head += fmt::format(" {} |", output.title);
    line += " --- |";
  }
  for (const auto* column : columns) {
    rows += fmt::format("| {} | {} | {} |", in_words(*column), in_words(*column, column->kind),
                        column->unit);
    for (const auto& output : outputs)
      if (!is_plain) rows += fmt::format(" {} |", column->presence.in(output.output).words);
    rows += fmt::format(" {} |\n", column->meaning);
  }
  return head + " meaning |\n" + line + " --- |\n" + rows;
}

}  // namespace viscontact::particles
