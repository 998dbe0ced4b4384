// Vectors and piecewise constant vectors as values of keys.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>

#include "viscontact/particle_runs/case/particles_sections.hpp"

namespace viscontact::particles {

namespace {

using ReadVector = void (*)(const case_file::TomlSection&, std::string_view, Vector&,
                            int dimension);

/// Reads a constant, or a list of tables { until, value }, into `place`. `read` reads each value.
/// Throws Error(kBadInput) if times do not increase or end before `end_time`, and for a wrong or
/// unknown key.
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
  // step end after end_time, where the value would be 0.
  place.pieces.back().until =
      std::max(before, std::nextafter(end_time * (1 + 1e-6), kLargestNumber));
}

/// The value must be a list, of numbers or of pieces, except on an axis.
void read_pieces(const case_file::TomlSection& section, std::string_view key,
                 PiecewiseConstant& place, int dimension, double end_time) {
  section.require(
      dimension == 1 || !section.has(key) || section.is_array(key), key,
      "is not a list; it must be a list of numbers, or a list of pieces {{ until, value }}");
  read_constant_or_pieces(section, key, place, dimension, end_time, read_vector);
}

/// Reads a torque or an angular velocity: three numbers if `dimension` is 3, otherwise one number,
/// which becomes component 2 of `place`.
void read_turn(const case_file::TomlSection& section, std::string_view key, Vector& place,
               int dimension) {
  if (dimension == 3)
    read_vector(section, key, place, dimension);
  else
    place = {0, 0, section.number(key, kModerate)};
}

void read_pieces_of_turn(const case_file::TomlSection& section, std::string_view key,
                         PiecewiseConstant& place, int dimension, double end_time) {
  if (dimension == 3)
    read_pieces(section, key, place, dimension, end_time);
  else
    read_constant_or_pieces(section, key, place, dimension, end_time, read_turn);
}

}  // namespace

void read_vector(const case_file::TomlSection& section, std::string_view key, Vector& place,
                 int dimension) {
  assert(dimension >= 1 && dimension <= 3);
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

case_file::KeyValue vector(Vector& place, const int& dimension) {
  return case_file::custom("a list of numbers", read_vector, place, dimension);
}

case_file::KeyValue pieces(PiecewiseConstant& place, const int& dimension, const double& end_time) {
  return case_file::custom("a list of numbers, or of pieces", read_pieces, place, dimension,
                           end_time);
}

case_file::KeyValue turn(Vector& place, const int& dimension) {
  return case_file::custom("a number; in 3D a list", read_turn, place, dimension);
}

case_file::KeyValue pieces_of_turn(PiecewiseConstant& place, const int& dimension,
                                   const double& end_time) {
  return case_file::custom("a number, in 3D a list; or pieces", read_pieces_of_turn, place,
                           dimension, end_time);
}

}  // namespace viscontact::particles
