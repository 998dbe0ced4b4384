// Reads vectors and piecewise constant vectors (vector_values.hpp). Units are those of the case.
#include "viscontact/case_file/vector_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace viscontact::case_file {

using particles::PiecewiseConstant;
using particles::Vector;

namespace {

/// Reads the pieces of a list of tables { until, value }; `read_value` reads the value of one.
template <class ReadValue>
PiecewiseConstant read_list_of_pieces(const TomlSection& section, std::string_view key,
                                      double end_time, const ReadValue& read_value) {
  PiecewiseConstant function;
  double before = 0;
  for (const auto& piece : section.sections(key)) {
    const double until = piece.number("until", kPositive);
    if (!(until > before))
      piece.fail("until",
                 fmt::format("is {}; it must be greater than {}, where the piece before ends",
                             until, before));
    function.pieces.push_back({until, read_value(piece)});
    piece.finish();
    before = until;
  }
  if (before < end_time * (1 - 1e-9))
    section.fail(key, fmt::format("ends at {}; it must reach viscous_contact.end_time, {}", before,
                                  end_time));
  // The last piece is extended beyond end_time, because rounding errors could put the end of the
  // last time step after the end of this piece.
  function.pieces.back().until =
      std::max(before, std::nextafter(end_time * (1 + 1e-6), kLargestNumber));
  return function;
}

PiecewiseConstant constant(const Vector& value) {
  return {{{std::numeric_limits<double>::max(), value}}};
}

}  // namespace

Vector read_vector(const TomlSection& section, std::string_view key, int dimension) {
  if (dimension == 1 && section.has(key) && !section.is_array(key))
    return {section.number(key, kModerate), 0, 0};
  const auto numbers = section.numbers(key, kModerate);
  if (numbers.size() != static_cast<std::size_t>(dimension))
    section.fail(key,
                 fmt::format("contains {} numbers; it must contain {}", numbers.size(),
                             dimension == 1
                                 ? "1, along the axis"
                                 : fmt::format("{}, one for each dimension of space", dimension)));
  return {numbers[0], dimension > 1 ? numbers[1] : 0.0, dimension > 2 ? numbers[2] : 0.0};
}

PiecewiseConstant read_pieces(const TomlSection& section, std::string_view key, int dimension,
                              double end_time) {
  const auto read = [&](const TomlSection& at, std::string_view of) {
    return read_vector(at, of, dimension);
  };
  if (section.is_array_of_tables(key))
    return read_list_of_pieces(section, key, end_time,
                               [&](const TomlSection& piece) { return read(piece, "value"); });
  if (dimension > 1 && section.has(key) && !section.is_array(key))
    section.fail(
        key, "is not a list; it must be a list of numbers, or a list of pieces { until, value }");
  return constant(read(section, key));
}

PiecewiseConstant read_pieces_of_numbers(const TomlSection& section, std::string_view key,
                                         double end_time) {
  const auto read = [](const TomlSection& at, std::string_view of) {
    return Vector{0, 0, at.number(of, kModerate)};
  };
  if (section.is_array_of_tables(key))
    return read_list_of_pieces(section, key, end_time,
                               [&](const TomlSection& piece) { return read(piece, "value"); });
  return constant(read(section, key));
}

}  // namespace viscontact::case_file
