// The arrays of a VTK XML file with appended raw data (VTK's file formats, "XML file formats"):
// writes them, and reads what was written on a machine with the same byte order. Numbers are copied
// without conversion, in the units of the caller. Writing checks and throws nothing; AppendedReader
// throws Error(kBadInput) for a file that is not whole. particles/ and flow_vtk.cpp use this file
// for frames (the particles at one time) and flows. Further kinds of cells may be added; a change
// must keep the files of earlier versions readable.
#pragma once

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/common/error.hpp"

namespace viscontact {

/// Collects the `AppendedData` of a file and makes the elements that refer to it.
class AppendedData {
 public:
  /// Appends `values` and returns the XML element `DataArray` with the name `name` that refers to
  /// them. `type` is the type of the values in VTK, such as Float64 for double. `components` >= 1
  /// is the number of values of each point or cell, which follow each other. Neither is checked;
  /// `values` may be empty.
  template <class Number>
  std::string array(const char* type, std::string_view name, int components,
                    const std::vector<Number>& values) {
    auto element = fmt::format(
        R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}"/>)"
        "\n",
        type, name, components, bytes_.size());
    const std::uint64_t size = values.size() * sizeof(Number);
    bytes_.append(reinterpret_cast<const char*>(&size), sizeof size);
    bytes_.append(reinterpret_cast<const char*>(values.data()), size);
    return element;
  }
  /// The first lines of a VTK file of the type `type`, such as PolyData; its words are not checked.
  static std::string opening(std::string_view type) {
    return fmt::format(
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\">\n",
        type, std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian");
  }
  /// The last lines of a file, with the data of all arrays.
  std::string closing() const {
    return "<AppendedData encoding=\"raw\">\n_" + bytes_ + "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  std::string bytes_;
};

/// The cells of a file of the type PolyData: vertices, which VTK numbers first, and lines between
/// two points.
struct PolyCells {
  std::vector<std::int64_t> vertices,  ///< numbers of the points that are vertices, from 0
      vertex_ends,  ///< for each vertex, the number of entries of `vertices` up to it
      lines,        ///< numbers of the two points of each line, from 0
      line_ends;    ///< for each line, the number of entries of `lines` up to it

  /// Adds a vertex at the point with this number, from 0. That the point exists is not checked.
  void add_vertex(std::int64_t point) {
    vertices.push_back(point);
    vertex_ends.push_back(std::ssize(vertices));
  }
  /// Adds a line between the points with these numbers, from 0. That the points exist is not
  /// checked.
  void add_line(std::int64_t first, std::int64_t second) {
    lines.insert(lines.end(), {first, second});
    line_ends.push_back(std::ssize(lines));
  }
  /// The XML elements that open PolyData and a piece of it with `points` points and the cells of
  /// this object.
  std::string opening(std::size_t points) const {
    return fmt::format(
        "<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\">\n",
        points, vertex_ends.size(), line_ends.size());
  }
  /// Returns the elements of the points, of the cells, and of the end of the piece and of PolyData,
  /// and appends their arrays to `data`. `points` has the three coordinates x, y, z [L] of each
  /// point, one point after the other (not checked).
  std::string closing(AppendedData& data, const std::vector<double>& points) const {
    std::string text = "<Points>\n" + data.array("Float64", "Points", 3, points);
    text += "</Points>\n<Verts>\n";
    text += data.array("Int64", "connectivity", 1, vertices);
    text += data.array("Int64", "offsets", 1, vertex_ends);
    text += "</Verts>\n<Lines>\n";
    text += data.array("Int64", "connectivity", 1, lines);
    text += data.array("Int64", "offsets", 1, line_ends);
    return text + "</Lines>\n</Piece>\n</PolyData>\n";
  }
};

/// The part of `text` between the first occurrence of `before` and the next one of `after`; nothing
/// if one of them is missing. `text` must outlive the result.
inline std::optional<std::string_view> between(std::string_view text, std::string_view before,
                                               std::string_view after) {
  const auto found = text.find(before);
  if (found == std::string_view::npos) return {};
  const auto begin = found + before.size();
  const auto end = text.find(after, begin);
  if (end == std::string_view::npos) return {};
  return text.substr(begin, end - begin);
}

/// Reads the arrays of a file that AppendedData wrote. `text` must outlive this object.
class AppendedReader {
 public:
  /// `text` is the content of the file with the name `file`, which messages contain. `what` says in
  /// messages what the file should be, such as "frame". Throws the error of refuse() if the text
  /// has no appended data.
  AppendedReader(std::string_view text, std::string file, std::string what)
      : file_(std::move(file)), what_(std::move(what)) {
    constexpr std::string_view kMark = "<AppendedData encoding=\"raw\">\n_";
    const auto mark = text.find(kMark);
    if (mark == std::string_view::npos) refuse();
    head_ = text.substr(0, mark);
    bytes_ = text.substr(mark + kMark.size());
  }

  /// True if the XML element `section`, such as PointData, contains the array `name`.
  bool has_array(std::string_view section, std::string_view name) const {
    return after_name(section, name).has_value();
  }

  /// The array `name` in the XML element `section`: the values of all points or cells, one after
  /// the other. It may be empty. Throws Error(kBadInput), which names the file, if there is no such
  /// array, if the file ends within it, or if its size is not a multiple of that of `Number`.
  /// Whether `Number` is the type that the file states is not checked.
  template <class Number>
  std::vector<Number> array(std::string_view section, std::string_view name) const {
    const auto element = after_name(section, name);
    const auto offset = element ? between(*element, "offset=\"", "\"") : std::nullopt;
    std::uint64_t at = 0, size = 0;
    if (!offset ||
        std::from_chars(offset->data(), offset->data() + offset->size(), at).ec != std::errc())
      refuse();
    if (at > bytes_.size() || bytes_.size() - at < sizeof size) refuse();
    std::memcpy(&size, bytes_.data() + at, sizeof size);
    if (bytes_.size() - at - sizeof size < size || size % sizeof(Number) != 0) refuse();
    std::vector<Number> values(size / sizeof(Number));
    if (size > 0) std::memcpy(values.data(), bytes_.data() + at + sizeof size, size);
    return values;
  }

  /// Throws Error(kBadInput), which names the file and says that it is not whole.
  [[noreturn]] void refuse() const {
    throw_bad_input({file_}, "is not a whole " + what_ + " that viscontact particles wrote");
  }

 private:
  /// The text that follows the name of an array: the rest of its element and of the section.
  std::optional<std::string_view> after_name(std::string_view section,
                                             std::string_view name) const {
    const auto begin = head_.find("<" + std::string(section));
    if (begin == std::string_view::npos) return {};
    const auto whole = head_.substr(begin, head_.find("\n</", begin) - begin);
    const auto mark = fmt::format("Name=\"{}\"", name);
    const auto at = whole.find(mark);
    if (at == std::string_view::npos) return {};
    return whole.substr(at + mark.size());
  }

  std::string file_, what_;
  std::string_view head_, bytes_;
};

}  // namespace viscontact
