// Columns of the files of a run. Each is declared once; tables (CSV), frames (VTK), particles.h5,
// Python and the tables of docs/file-formats.md come from its declaration.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
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
  /// Whether the case asks for the column `solver_stages`.
  bool has_solver_stages = false;
};

/// A run of spheres in which all else is true, too.
inline constexpr RunFacts kAllFacts{3, true, true, true, true, true, true, true, true, true, true};

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

/// The numbers of a value, which are at most so many as a tensor has.
using Entries = std::array<double, 9>;

/// What is known of a column whatever its rows are.
struct ColumnForm : Declaration {
  ValueShape shape = ValueShape::kNumber;
  ValueKind kind = ValueKind::kDecimal;

  bool is_whole() const { return kind == ValueKind::kWhole || kind == ValueKind::kTruth; }
  /// Whether the value is more than a number.
  bool is_vector(int dimension) const {
    return shape != ValueShape::kNumber && !(shape == ValueShape::kTurn && dimension == 2);
  }
  /// The number of fields of a row in tables, and of entries in Python.
  std::size_t count(int dimension) const;
  /// The number of entries of a row in frames, where vectors have three components.
  std::size_t count_in_frames(int dimension) const;
  /// The first of the entries that count() counts: a disc turns about the third axis.
  std::size_t begin(int dimension) const {
    return shape == ValueShape::kTurn && dimension == 2 ? 2 : 0;
  }
  /// The names of the fields in tables.
  std::vector<std::string> names(int dimension) const;
  std::string_view name_in_hdf5() const { return in_hdf5.empty() ? name : in_hdf5; }
  /// Appends an entry to a row of a table.
  void append(std::string& row, double entry) const;
};

template <class Row>
struct Column : ColumnForm {
  /// Sets the entries that count() counts; false if the field is empty. Null for texts.
  bool (*read)(const Row&, Entries& to) = nullptr;
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
bool set_entries(const Value& value, Entries& to) {
  if constexpr (IsOptional<Value>::value) {
    return value && set_entries(*value, to);
  } else if constexpr (std::is_same_v<Value, Turn>) {
    return set_entries(value.vector, to);
  } else if constexpr (std::is_same_v<Value, Rounded>) {
    to[0] = value.number;
  } else if constexpr (std::ranges::range<Value>) {
    assert(std::size(value) <= to.size());
    std::ranges::copy(value, to.begin());
  } else {
    to[0] = static_cast<double>(value);
  }
  return true;
}

}  // namespace detail

/// A column whose value in a row is read(row), where `read` captures nothing.
template <class Row, class Read>
Column<Row> column(const Declaration& declaration, Read /*read*/) {
  using Value = std::remove_cvref_t<std::invoke_result_t<Read, const Row&>>;
  Column<Row> made;
  static_cast<Declaration&>(made) = declaration;
  if constexpr (std::is_convertible_v<Value, std::string_view>) {
    // A text must live as long as the row.
    static_assert(std::is_reference_v<std::invoke_result_t<Read, const Row&>> ||
                  std::is_same_v<Value, std::string_view>);
    made.kind = ValueKind::kText;
    made.text = [](const Row& row) -> std::string_view { return Read{}(row); };
  } else {
    detail::set_form<Value>(made);
    made.read = [](const Row& row, Entries& to) { return detail::set_entries(Read{}(row), to); };
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

/// The columns of a kind of row that an output has; frames have no texts. First come those of
/// `first`, in this order, then the others in the order of `all`.
template <class AnyColumn>
std::vector<const AnyColumn*> columns_in(Output output, const std::vector<AnyColumn>& all,
                                         const RunFacts& run,
                                         std::span<const std::string_view> first = {}) {
  std::vector<const AnyColumn*> found;
  for (const auto& one : all)
    if (one.presence.in(output).holds(run) &&
        (output != Output::kFrames || one.kind != ValueKind::kText))
      found.push_back(&one);
  std::ranges::stable_sort(found, {}, [&](const AnyColumn* one) {
    return std::ranges::find(first, one->name) - first.begin();
  });
  return found;
}

/// The header and the rows of a CSV table.
template <class Row>
class CsvTable {
 public:
  /// The columns must live as long as this object.
  template <class AnyColumn>
  CsvTable(const std::vector<const AnyColumn*>& columns, int dimension) : dimension_(dimension) {
    for (const AnyColumn* one : columns)
      fields_.push_back(
          {one, one->begin(dimension), one->begin(dimension) + one->count(dimension)});
  }

  /// The line with the names of the columns.
  std::string header() const {
    std::string text;
    for (const auto& field : fields_)
      for (const auto& name : field.column->names(dimension_))
        text += (text.empty() ? "" : ",") + name;
    return text + "\n";
  }
  void add(std::string& text, const Row& row) const {
    const auto begin = text.size();
    Entries entries;
    for (const auto& [column, first, last] : fields_) {
      if (column->text != nullptr) {
        (text += ',') += column->text(row);
        continue;
      }
      const bool exists = column->read(row, entries);
      for (std::size_t i = first; i < last; ++i) {
        text += ',';
        if (exists) column->append(text, entries[i]);
      }
    }
    text.erase(begin, 1);
    text += '\n';
  }

 private:
  struct Field {
    const Column<Row>* column;
    std::size_t first, last;  ///< of its entries
  };
  std::vector<Field> fields_;
  int dimension_;
};

/// The table over time that has all columns.
template <class Row>
CsvTable<Row> table_over_time(const std::vector<Column<Row>>& columns, int dimension) {
  return {columns_in(Output::kOverTime, columns, kAllFacts), dimension};
}

/// The values of a column in all rows, of each row count_in_frames() entries if `in_frames` is
/// true, else count(); NaN where a field is empty. A vector on an axis is along z in frames.
template <class Number, class Row, class Rows>
std::vector<Number> values_of(const Column<Row>& column, const Rows& rows, int dimension,
                              bool in_frames) {
  assert(column.read != nullptr);
  const auto count = in_frames ? column.count_in_frames(dimension) : column.count(dimension);
  const bool is_turned = in_frames && dimension == 1 && column.shape == ValueShape::kVector;
  std::vector<Number> values(count * std::ranges::size(rows));
  auto to = values.begin();
  Entries entries;
  for (const auto& row : rows) {
    if (!column.read(row, entries)) entries.fill(std::numeric_limits<double>::quiet_NaN());
    if (is_turned) entries = {0, 0, entries[0]};
    const double* from = entries.data() + column.begin(dimension);
    to = std::transform(from, from + count, to,
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
