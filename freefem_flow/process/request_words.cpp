// Writes numbers and boundaries (request_words.hpp). Numbers must read back to the same double.
#include "viscontact/freefem_flow/process/request_words.hpp"

#include <fmt/format.h>

#include <cmath>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"

namespace viscontact::freefem_flow {

void append(std::string& text, std::span<const double> values, const char* what) {
  for (const double value : values) {
    if (!std::isfinite(value))
      throw Error(ErrorKind::kNotConverged,
                  fmt::format("{} of the particles in the fluid left the range of a double ({})",
                              what, value));
    text += ' ';
    text += format_number(value);
  }
}

std::string words_of(const MeshBoundary& boundary) {
  std::string text =
      fmt::format("boundary {} {}\n", boundary.points.size(), boundary.curves.size());
  for (const auto& point : boundary.points) {
    append(text, point, "a point of the mesh around one");
    text += '\n';
  }
  for (const auto& curve : boundary.curves)
    text += fmt::format("{} {} {}\n", curve.first, curve.edges, curve.label);
  return text;
}

}  // namespace viscontact::freefem_flow
