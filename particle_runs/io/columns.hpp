// Columns of the files of a run. Each is declared once; tables (CSV), frames (VTK), particles.h5,
// Python and the tables of docs/file-formats.md come from its declaration.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "viscontact/particles/values/vector.hpp"

namespace viscontact::particles {

/// What a column may depend on.
struct RunFacts {
  int dimension = 2;  ///< of the particles: 1, 2 or 3
  bool has_friction = false, is_periodic = false;
  bool is_in_fluid = false, has_inertia = false;  ///< of the fluid
  bool do_turn = false;                           ///< whether the rotation of particles is computed
  bool has_mass = false;                          ///< whether a particle has a mass > 0
  bool has_bodies = false;
  bool has_semi_axes = false;    ///< whether a particle is an ellipse or a plate
  bool has_given_loads = false;  ///< whether a particle has a given motion, without a fluid
};

/// A run of spheres in which all else is true, too.
inline constexpr RunFacts kAllFacts{3, true, true, true, true, true, true, true, true, true};

/// When a file has a column; `words` are those of docs/file-formats.md.
struct Condition {
  bool (*holds)(const RunFacts&);
  std::string_view words;
};
inline constexpr Condition kAlways{[](const RunFacts&) { return true; }, "yes"},
    kNever{[](const RunFacts&) { return false; }, "-"},
    kWithFriction{[](const RunFacts&run) { return run.has_friction; }, "with `[friction]`"},
    kInFluid{[](const RunFacts&run) { return run.is_in_fluid; }, "in a fluid"};

/// The places in which the columns of a kind of row stand.
enum class Output : std::uint8_t {
  kAtEnd,     ///< the table at the end of a run, such as final_contacts.csv
  kOverTime,  ///< a table over time, such as contacts.csv
  kFrames,    ///< the frames, and particles.h5 and particles.xyz, which are made from them
  kPython
};
struct Presence {
  Condition at_end = kAlways, over_time = kAlways, frames = kAlways, python = kAlways;
  const Condition& in(Output output) const;
};
/// The presence of columns of which only a table over time exists.
constexpr Presence only_over_time(const Condition& condition = kAlways) {
  return {.at_end = kNever, .over_time = condition, .frames = kNever, .python = kNever};
}

struct Declaration {
  /// Of the column, of the array and of the data set. A table has a column for each component of a
  /// vector, whose name is `prefix` and an axis.
  std::string_view name;
  std::string_view unit;       ///< such as "M L/T"; empty: none
  std::string_view meaning{};  ///< for docs/file-formats.md, as Markdown
  Presence presence{};
  const char* prefix = nullptr;   ///< null: `name` and an underscore
  std::string_view in_hdf5 = {};  ///< name of the data set; empty: `name`
};

// Types of values of columns, besides numbers, Vector, texts, and std::optional of these.

/// The vector of a rotation. In the plane it is one number, component 2, and on an axis none.
struct Turn {
  Vector vector{};
};
/// A unit quaternion w, x, y, z. Only spheres in space have one.
using Quaternion = std::array<double, 4>;
/// Component ij of a tensor is entry i D + j, with D dimensions.
using Tensor = std::vector<double>;
/// A number of which tables have three digits.
struct Rounded {
  double number = 0;
};

enum class ValueShape : std::uint8_t { kNumber, kVector, kTurn, kQuaternion, kTensor };
enum class ValueKind : std::uint8_t { kDecimal, kRounded, kWhole, kTruth, kText };

/// The numbers of a column in a row, of which an empty field has none.
struct Numbers {
  std::array<double, 9> values{};
  bool exist = true;
};

/// What is known of a column whatever its rows are.
struct ColumnForm : Declaration {
  ValueShape shape = ValueShape::kNumber;
  ValueKind kind = ValueKind::kDecimal;

  bool is_whole() const { return kind == ValueKind::kWhole || kind == ValueKind::kTruth; }
  /// The number of fields of a row in tables, and of entries in Python.
  std::size_t count(int dimension) const;
  /// The number of entries of a row in frames, where vectors have three components.
  std::size_t count_in_frames(int dimension) const;
  /// The numbers in the order of these entries; a vector on an axis is along z in frames.
  std::array<double, 9> entries(const Numbers& numbers, int dimension, bool in_frames) const;
  /// The names of the fields in tables.
  std::vector<std::string> names(int dimension) const;
  std::string_view name_in_hdf5() const { return in_hdf5.empty() ? name : in_hdf5; }
  /// Adds the fields to a row of a table, each after a comma.
  void add_fields(std::string& row, const Numbers& numbers, int dimension) const;
};

template <class Row>
struct Column : ColumnForm {
  Numbers (*numbers)(const Row&) = nullptr;        ///< null for texts
  std::string_view (*text)(const Row&) = nullptr;  ///< null but for texts
};

namespace detail {

template <class Value>
struct IsOptional : std::false_type {};
template <class Value>
struct IsOptional<std::optional<Value>> : std::true_type {
  using Content = Value;
};

template <class Value>
void set_form(ColumnForm& form) {
  if constexpr (IsOptional<Value>::value)
    set_form<typename IsOptional<Value>::Content>(form);
  else if constexpr (std::is_same_v<Value, Vector>)
    form.shape = ValueShape::kVector;
  else if constexpr (std::is_same_v<Value, Turn>)
    form.shape = ValueShape::kTurn;
  else if constexpr (std::is_same_v<Value, Quaternion>)
    form.shape = ValueShape::kQuaternion;
  else if constexpr (std::is_same_v<Value, Tensor>)
    form.shape = ValueShape::kTensor;
  else if constexpr (std::is_same_v<Value, Rounded>)
    form.kind = ValueKind::kRounded;
  else if constexpr (std::is_same_v<Value, bool>)
    form.kind = ValueKind::kTruth;
  else if constexpr (std::is_integral_v<Value> || std::is_enum_v<Value>)
    form.kind = ValueKind::kWhole;
  else
    static_assert(std::is_same_v<Value, double>);
}

template <class Value>
Numbers numbers_of(const Value& value) {
  Numbers numbers;
  if constexpr (IsOptional<Value>::value) {
    if (value) return numbers_of(*value);
    numbers.exist = false;
  } else if constexpr (std::is_same_v<Value, Turn>) {
    return numbers_of(value.vector);
  } else if constexpr (std::is_same_v<Value, Rounded>) {
    numbers.values[0] = value.number;
  } else if constexpr (std::ranges::range<Value>) {
    assert(std::size(value) <= numbers.values.size());
    std::ranges::copy(value, numbers.values.begin());
  } else {
    numbers.values[0] = static_cast<double>(value);
  }
  return numbers;
}

}  // namespace detail

/// A column whose value in a row is read(row), where `read` captures nothing.
template <class Row, class Read>
Column<Row> column(const Declaration& declaration, Read /*read*/) {
  using Value = std::remove_cvref_t<std::invoke_result_t<Read, const Row&>>;
  Column<Row> made;
  static_cast<Declaration&>(made) = declaration;
  if constexpr (std::is_convertible_v<Value, std::string_view>) {
    made.kind = ValueKind::kText;
    made.text = [](const Row& row) -> std::string_view { return Read{}(row); };
  } else {
    detail::set_form<Value>(made);
    made.numbers = [](const Row& row) { return detail::numbers_of(Read{}(row)); };
  }
  return made;
}

/// A column whose value is the member `kMember` of a row.
template <auto kMember>
auto column(const Declaration& declaration) {
  return []<class Row, class Value>(const Declaration& text, Value Row::* /*member*/) {
    return column<Row>(text, [](const Row& row) -> const Value& { return row.*kMember; });
  }(declaration, kMember);
}

/// The columns of a kind of row that an output has. First come those of `first`, in this order,
/// then the others in the order of `all`.
template <class AnyColumn>
std::vector<const AnyColumn*> columns_in(Output output, const std::vector<AnyColumn>& all,
                                         const RunFacts& run,
                                         std::span<const std::string_view> first = {}) {
  std::vector<const AnyColumn*> found;
  for (const auto& one : all)
    if (one.presence.in(output).holds(run)) found.push_back(&one);
  std::ranges::stable_sort(found, {}, [&](const AnyColumn* one) {
    return std::ranges::find(first, one->name) - first.begin();
  });
  return found;
}

/// The header and the rows of a CSV table.
template <class Row>
class CsvTable {
 public:
  /// The columns, of which there is at least one, must live as long as this object.
  CsvTable(std::vector<const Column<Row>*> columns, int dimension)
      : columns_(std::move(columns)), dimension_(dimension) {}

  /// The line with the names of the columns.
  std::string header() const {
    std::string text;
    for (const auto* one : columns_)
      for (const auto& name : one->names(dimension_)) (text += ',') += name;
    return text.substr(1) + "\n";
  }
  void add(std::string& text, const Row& row) const {
    const auto begin = text.size();
    for (const auto* one : columns_)
      if (one->kind == ValueKind::kText)
        (text += ',') += one->text(row);
      else
        one->add_fields(text, one->numbers(row), dimension_);
    text.erase(begin, 1);
    text += '\n';
  }

 private:
  std::vector<const Column<Row>*> columns_;
  int dimension_;
};

/// The table over time that has all columns.
template <class Row>
CsvTable<Row> table_over_time(const std::vector<Column<Row>>& columns, int dimension) {
  return {columns_in(Output::kOverTime, columns, kAllFacts), dimension};
}

/// The values of a column in all rows, of each row count_in_frames() entries if `in_frames` is
/// true, else count(); NaN where a field is empty.
template <class Number, class Row, class Rows>
std::vector<Number> values_of(const Column<Row>& column, const Rows& rows, int dimension,
                              bool in_frames) {
  assert(column.kind != ValueKind::kText);
  const auto count = in_frames ? column.count_in_frames(dimension) : column.count(dimension);
  std::vector<Number> values(count * std::ranges::size(rows));
  auto to = values.begin();
  for (const auto& row : rows) {
    const auto numbers = column.entries(column.numbers(row), dimension, in_frames);
    to = std::transform(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(count), to,
                        [](double number) { return static_cast<Number>(number); });
  }
  return values;
}

/// A table of docs/file-formats.md with a row for each column and, unless there is only one output
/// that always has all of them, a column for each of `outputs`, which has its title.
struct TitledOutput {
  Output output;
  std::string_view title;
};
std::string describe(std::span<const ColumnForm* const> columns,
                     std::span<const TitledOutput> outputs);

/// The table between the markers `columns of TITLE` in docs/file-formats.md.
struct ColumnTable {
  std::string title, markdown;
};
template <class AnyColumn>
ColumnTable column_table(std::string title, const std::vector<AnyColumn>& columns,
                         std::initializer_list<TitledOutput> outputs) {
  std::vector<const ColumnForm*> forms;
  for (const auto& one : columns) forms.push_back(&one);
  return {std::move(title), describe(forms, outputs)};
}
template <class AnyColumn>
ColumnTable column_table(const std::string& title, const std::vector<AnyColumn>& columns) {
  return column_table(title, columns, {{Output::kOverTime, title}});
}

}  // namespace viscontact::particles
