// Reads the files that vtk.cpp writes, so that an interrupted run can be continued. Units are those
// of vtk.hpp. It understands only that layout, not VTK's formats in general.
#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/particles/io/vtk.hpp"

namespace viscontact::particles {
namespace {

/// The text between `before` and the next `after`; nothing if one of them is missing.
std::optional<std::string_view> between(std::string_view text, std::string_view before,
                                        std::string_view after) {
  const auto found = text.find(before);
  if (found == std::string_view::npos) return {};
  const auto begin = found + before.size();
  const auto end = text.find(after, begin);
  if (end == std::string_view::npos) return {};
  return text.substr(begin, end - begin);
}

class VtpReader {
 public:
  VtpReader(std::string_view text, std::string file) : file_(std::move(file)) {
    constexpr std::string_view kMark = "<AppendedData encoding=\"raw\">\n_";
    const auto mark = text.find(kMark);
    if (mark == std::string_view::npos) refuse();
    head_ = text.substr(0, mark);
    bytes_ = text.substr(mark + kMark.size());
  }

  /// The array `name` in the element <section> or <section ...>.
  template <class Number>
  std::vector<Number> array(std::string_view section, std::string_view name) const {
    const auto begin = head_.find("<" + std::string(section));
    if (begin == std::string_view::npos) refuse();
    const auto element = between(head_.substr(begin), fmt::format("Name=\"{}\"", name), "/>");
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

  [[noreturn]] void refuse() const {
    throw_bad_input({file_}, "is not a whole frame that viscontact particles wrote");
  }

 private:
  std::string file_;
  std::string_view head_, bytes_;
};

}  // namespace

VtpContent read_vtp(const std::filesystem::path& path, int dimension) {
  const std::string text = read_file(path);
  const VtpReader reader(text, path.string());
  VtpContent content;
  const auto points = reader.array<double>("Points>", "Points");
  if (points.size() % 3 != 0) reader.refuse();
  for (std::size_t i = 0; i < points.size(); ++i)
    if (i % 3 < static_cast<std::size_t>(dimension)) content.positions.push_back(points[i]);
  const auto gaps = reader.array<double>("CellData", "gap");
  const auto gammas = reader.array<double>("CellData", "gamma");
  const auto partners = reader.array<std::int32_t>("CellData", "j");
  // These are numbers of particles, which differ from their ids: one vertex for each contact with a
  // plane, then one line for each contact of two particles.
  const auto vertices = reader.array<std::int64_t>("Verts", "connectivity");
  const auto lines = reader.array<std::int64_t>("Lines", "connectivity");
  const auto walls = vertices.size(), pairs = lines.size() / 2;
  if (gaps.size() != walls + pairs || gammas.size() != gaps.size() ||
      partners.size() != gaps.size() || lines.size() % 2 != 0)
    reader.refuse();
  const auto particle = [&](std::int64_t place) {
    if (place < 0 || place >= std::ssize(points) / 3) reader.refuse();
    return static_cast<std::int32_t>(place);
  };
  // A frame does not store the errors of gamma, because no picture shows them.
  for (std::size_t i = 0; i < pairs; ++i)
    content.contacts.push_back({particle(lines[2 * i]), particle(lines[2 * i + 1]), gaps[walls + i],
                                gammas[walls + i], 0});
  for (std::size_t i = 0; i < walls; ++i) {
    if (partners[i] >= 0) reader.refuse();
    content.contacts.push_back({partners[i], particle(vertices[i]), gaps[i], gammas[i], 0});
  }
  return content;
}

std::vector<std::pair<double, std::string>> read_pvd(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  if (text.find("</Collection>") == std::string::npos)
    throw_bad_input({path.string()}, "is not a whole list of frames");
  std::vector<std::pair<double, std::string>> files;
  constexpr std::string_view kBegin = "<DataSet ";
  for (auto at = text.find(kBegin); at != std::string::npos; at = text.find(kBegin, at + 1)) {
    const auto element = between(std::string_view(text).substr(at), kBegin, "/>");
    const auto time = element ? between(*element, "timestep=\"", "\"") : std::nullopt;
    const auto file = element ? between(*element, "file=\"", "\"") : std::nullopt;
    const auto number = time ? parse_number(std::string(*time)) : std::nullopt;
    if (!number || !file)
      throw_bad_input({path.string()}, "is not a list of frames that viscontact particles wrote");
    files.emplace_back(*number, std::string(*file));
  }
  return files;
}

}  // namespace viscontact::particles
