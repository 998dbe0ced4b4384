// Reads vectors and piecewise constant vectors from the keys of a case of many particles. A vector
// has 1, 2 or 3 numbers, as many as the space has dimensions, in the unit that the key says, each
// at most 1e100 in magnitude. The times [T] of pieces are in the unit of the case; they are > 0,
// increase, and reach the end of the run. A wrong value is an Error(kBadInput) with its line. The
// sources in particles/case/ use this file. A change must keep accepting users' cases.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "viscontact/particles/case/particles_sections.hpp"

namespace viscontact::particles {

namespace {

using ReadVector = void (*)(const case_file::TomlSection&, std::string_view, Vector&,
                            int dimension);

/// Reads a constant, or a list of tables { until, value }, into `place`. The last time `until` of a
/// list must not be earlier than `end_time` [T]. `read` reads each value. Throws Error(kBadInput)
/// if times do not increase or end too early, and for a wrong or unknown key.
void read_constant_or_pieces(const case_file::TomlSection& section, std::string_view key,
                             PiecewiseConstant& place, int dimension, double end_time,
                             ReadVector read) {
  place.pieces.clear();
  if (!section.is_array_of_tables(key)) {
    place.pieces.push_back({std::numeric_limits<double>::max(), {}});
    read(section, key, place.pieces.back().value, dimension);
    return;
  }
  double before = 0;
  for (const auto& piece : section.sections(key)) {
    const double until = piece.number("until", kPositive);
    piece.require(until > before, "until",
                  "is {}; it must be greater than {}, where the piece before ends", until, before);
    place.pieces.push_back({until, {}});
    read(piece, "value", place.pieces.back().value, dimension);
    piece.finish();
    before = until;
  }
  section.require(before >= end_time * (1 - 1e-9), key,  // 1e-9 is far above rounding errors
                  "ends at {}; it must reach viscous_contact.end_time, {}", before, end_time);
  // The last piece is extended a little beyond end_time, because rounding errors could let the last
  // step end after end_time, where the value would be 0. The fraction 1e-6 is a free choice.
  place.pieces.back().until =
      std::max(before, std::nextafter(end_time * (1 + 1e-6), kLargestNumber));
}

/// Reads a constant vector, or a list of pieces of time, each of which has a vector as its value.
/// Throws Error(kBadInput) if the key has neither of the two.
void read_pieces(const case_file::TomlSection& section, std::string_view key,
                 PiecewiseConstant& place, int dimension, double end_time) {
  section.require(
      dimension == 1 || !section.has(key) || section.is_array(key), key,
      "is not a list; it must be a list of numbers, or a list of pieces {{ until, value }}");
  read_constant_or_pieces(section, key, place, dimension, end_time, read_vector);
}

/// Reads a torque [M L^2/T^2] or an angular velocity [1/T]: three numbers if `dimension` is 3,
/// otherwise one number, which becomes component 2 of `place`.
void read_turn(const case_file::TomlSection& section, std::string_view key, Vector& place,
               int dimension) {
  if (dimension == 3)
    read_vector(section, key, place, dimension);
  else
    place = {0, 0, section.number(key, kModerate)};
}

/// Reads a constant torque or angular velocity as read_turn() does, or a list of pieces of time
/// with such values.
void read_pieces_of_turn(const case_file::TomlSection& section, std::string_view key,
                         PiecewiseConstant& place, int dimension, double end_time) {
  if (dimension == 3)
    read_pieces(section, key, place, dimension, end_time);
  else
    read_constant_or_pieces(section, key, place, dimension, end_time, read_turn);
}

}  // namespace

/// Reads `dimension` numbers, in the unit of the key, into `place`, whose other components become
/// 0. If `dimension` is 1, the number may be without brackets.
void read_vector(const case_file::TomlSection& section, std::string_view key, Vector& place,
                 int dimension) {
  if (dimension == 1 && section.has(key) && !section.is_array(key)) {
    place = {section.number(key, kModerate), 0, 0};
    return;
  }
  const auto numbers = section.numbers(key, kModerate);
  section.require(numbers.size() == static_cast<std::size_t>(dimension), key,
                  "contains {} numbers; it must contain {}", numbers.size(),
                  dimension == 1 ? "1, along the axis"
                                 : fmt::format("{}, one for each dimension of space", dimension));
  place = {};
  std::ranges::copy(numbers, place.begin());
}

// Each of the next four functions returns a KeyValue, which says how the value of a key is read. A
// KeyValue keeps references to the arguments of the function, which must outlive it.

case_file::KeyValue vector(Vector& place, const int& dimension) {
  return case_file::custom("a list of numbers", read_vector, place, dimension);
}

/// A constant vector, or a list of pieces of time, which must reach `end_time` [T].
case_file::KeyValue pieces(PiecewiseConstant& place, const int& dimension, const double& end_time) {
  return case_file::custom("a list of numbers, or of pieces", read_pieces, place, dimension,
                           end_time);
}

/// A torque or an angular velocity, as read_turn() reads it.
case_file::KeyValue turn(Vector& place, const int& dimension) {
  return case_file::custom("a number; in 3D a list", read_turn, place, dimension);
}

/// A constant torque or angular velocity, or a list of pieces of time, which must reach `end_time`.
case_file::KeyValue pieces_of_turn(PiecewiseConstant& place, const int& dimension,
                                   const double& end_time) {
  return case_file::custom("a number, in 3D a list; or pieces", read_pieces_of_turn, place,
                           dimension, end_time);
}

}  // namespace viscontact::particles
