// VTK XML files (VTK's file formats, "XML file formats"), whose arrays are inline binary: base64 of
// blocks that zlib has compressed.
#pragma once

#include <cassert>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace viscontact {

/// The name that VTK has for a type of numbers.
template <class Number>
constexpr const char* vtk_type() {
  if constexpr (std::same_as<Number, double>)
    return "Float64";
  else if constexpr (std::same_as<Number, std::int64_t>)
    return "Int64";
  else if constexpr (std::same_as<Number, std::int32_t>)
    return "Int32";
  else {
    static_assert(std::same_as<Number, std::uint8_t>);
    return "UInt8";
  }
}

/// `type` is that of the file, such as PolyData.
std::string vtk_opening(std::string_view type);
inline constexpr std::string_view kVtkClosing = "</VTKFile>\n";

/// `type` is a VTK type, such as Float64.
std::string vtk_array_of_bytes(const char* type, std::string_view name, int components,
                               std::span<const std::byte> bytes);

/// The XML element `DataArray`. The values keep their bits. `components` >= 1 values of each point
/// or cell follow each other.
template <class Number>
std::string vtk_array(std::string_view name, int components, const std::vector<Number>& values) {
  return vtk_array_of_bytes(vtk_type<Number>(), name, components, std::as_bytes(std::span(values)));
}

/// The cells of a file of the type PolyData: vertices, which VTK numbers first, and lines between
/// two points. Points are numbered from 0.
struct PolyCells {
  std::vector<std::int64_t> vertices,  ///< the points that are vertices
      vertex_ends,  ///< for each vertex, the number of entries of `vertices` up to it
      lines,        ///< the two points of each line
      line_ends;    ///< for each line, the number of entries of `lines` up to it

  void add_vertex(std::int64_t point) {
    assert(point >= 0);
    vertices.push_back(point);
    vertex_ends.push_back(std::ssize(vertices));
  }
  void add_line(std::int64_t first, std::int64_t second) {
    assert(first >= 0 && second >= 0);
    lines.insert(lines.end(), {first, second});
    line_ends.push_back(std::ssize(lines));
  }
  /// The XML elements that open PolyData and a piece of it with `points` points and these cells.
  std::string opening(std::size_t points) const;
  /// The elements of the points, of the cells, and of the end of the piece and of PolyData.
  /// `points` has the coordinates x, y, z [L] of each point.
  std::string closing(const std::vector<double>& points) const;
};

/// The part of `text` between the first occurrence of `before` and the next one of `after`; nothing
/// if one of them is missing.
std::optional<std::string_view> between(std::string_view text, std::string_view before,
                                        std::string_view after);

/// Reads the arrays of a file that vtk_array() wrote on a machine with the same byte order.
class VtkReader {
 public:
  /// `text`, the content of `file`, must outlive this object. `what` says in messages what the file
  /// should be, such as "frame". Throws the error of refuse() if the text is not a whole file.
  VtkReader(std::string_view text, std::string file, std::string what);

  bool has_array(std::string_view section, std::string_view name) const;

  /// The values of all points or cells in the XML element `section`, such as PointData, one after
  /// the other. Throws the error of refuse() if there is no such array of this type, or if it is
  /// damaged.
  template <class Number>
  std::vector<Number> array(std::string_view section, std::string_view name) const {
    const auto bytes = bytes_of(section, name, vtk_type<Number>());
    if (bytes.size() % sizeof(Number) != 0) refuse();
    std::vector<Number> values(bytes.size() / sizeof(Number));
    if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }

  /// Throws Error(kBadInput), which names the file and says that it is not whole.
  [[noreturn]] void refuse() const;

 private:
  struct Array {
    std::string_view section, name, type, content;
  };
  void list_arrays(std::string_view text);
  const Array* find(std::string_view section, std::string_view name) const;
  std::string bytes_of(std::string_view section, std::string_view name, const char* type) const;

  std::string file_, what_;
  std::vector<Array> arrays_;
};

}  // namespace viscontact
