// Chebyshev sums of the rest, terms near contact, and the places of the entries in the matrix.
#include "viscontact/lubrication/pairs/pair_resistance.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/lubrication/pairs/pair_near_contact.hpp"
#include "viscontact/lubrication/pairs/pair_rest.hpp"

namespace viscontact::lubrication {
namespace {

constexpr double kPi = std::numbers::pi;
// Entries are summed in groups of this size: the sums of a group stay in registers. A loop over all
// entries, whose sums are in memory, takes 1.5 times as long.
constexpr std::size_t kGroup = 8, kGroups = (kPairEntries + kGroup - 1) / kGroup;
using Group = Eigen::Array<double, kGroup, 1>;
using Entries = std::array<double, kGroup * kGroups>;

/// The numbers by group of entries; those of entries that do not exist are 0.
struct Tables {
  std::array<std::array<Group, kRatioTerms * kGapTerms>, kGroups> rest;
  std::array<std::array<std::array<Group, 7>, 3>, kGroups> contact;

  Tables() {
    for (auto& group : rest) group.fill(Group::Zero());
    for (auto& group : contact)
      for (auto& term : group) term.fill(Group::Zero());
    for (std::size_t e = 0; e < kPairEntries; ++e) {
      const auto group = e / kGroup;
      const auto member = static_cast<Eigen::Index>(e % kGroup);
      for (std::size_t i = 0; i < kRatioTerms; ++i)
        for (std::size_t j = 0; j < kGapTerms; ++j)
          rest[group][i * kGapTerms + j](member) = kPairRest[i][j][e];
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& term = kPairEntryTerms[e].terms[k];
        for (std::size_t p = 0; p < 7; ++p)
          contact[group][k][p](member) = static_cast<double>(term.numerator[p]) / term.denominator;
      }
    }
  }
};

/// The values of the first polynomials at x in [-1, 1].
template <std::size_t count>
std::array<double, count> chebyshev(double x) {
  std::array<double, count> values{1, x};
  for (std::size_t i = 2; i < count; ++i) values[i] = 2 * x * values[i - 1] - values[i - 2];
  return values;
}

/// The factors of the entries' components: the entry of a sphere alone is the square, for strains
/// E with the square E:E.
struct Scales {
  double move, turn, strain;
  explicit Scales(double radius)
      : move(std::sqrt(6 * kPi * radius)),
        turn(std::sqrt(8 * kPi * radius * radius * radius)),
        strain(std::sqrt(20 * kPi / 3 * radius * radius * radius)) {}
  double of(PairComponent component) const {
    return component == kMove ? move : component == kTurn ? turn : strain;
  }
};

/// E:E of the unit tensor of an entry in PairEntryTerms.
constexpr double square_of_strain(std::size_t entry) { return entry < 10 ? 2.0 / 3 : 2; }

/// The entries for viscosity 1, the radii 1 and b, 1 <= b <= kLargestRadiusRatio. Strains have the
/// basis of PairMatrix.
Entries entries_of(double b, double gap) {
  static const Tables tables;
  const PairCoordinates at(b, gap);
  const auto of_ratio = chebyshev<kRatioTerms>(at.ratio);
  const auto of_gap = chebyshev<kGapTerms>(at.gap);
  std::array<double, kRatioTerms * kGapTerms> products{};
  for (std::size_t i = 0; i < kRatioTerms; ++i)
    for (std::size_t j = 0; j < kGapTerms; ++j)
      products[i * kGapTerms + j] = of_ratio[i] * of_gap[j];
  const auto weights = at.contact_weights();
  Entries rest{}, contact{};
  for (std::size_t group = 0; group < kGroups; ++group) {
    Group sum = Group::Zero(), near = Group::Zero();
    for (std::size_t i = 0; i < products.size(); ++i) sum += products[i] * tables.rest[group][i];
    const auto& terms = tables.contact[group];
    for (std::size_t p = 7; p-- > 0;)
      near = near * b +
             (weights[0] * terms[0][p] + weights[1] * terms[1][p] + weights[2] * terms[2][p]);
    Group::Map(&rest[group * kGroup]) = sum;
    Group::Map(&contact[group * kGroup]) = near;
  }
  const std::array scales{Scales(1), Scales(b)};
  static const auto kStrainFactors = [] {
    std::array<double, kPairEntries> factors{};
    for (std::size_t e = 0; e < kPairEntries; ++e) {
      const auto& terms = kPairEntryTerms[e];
      const double one = 1 / std::sqrt(square_of_strain(e));
      factors[e] = (terms.row == kStrain ? one : 1) * (terms.column == kStrain ? one : 1);
    }
    return factors;
  }();
  for (std::size_t e = 0; e < kPairEntries; ++e) {
    const auto& terms = kPairEntryTerms[e];
    rest[e] = rest[e] * scales[static_cast<std::size_t>(terms.row_sphere)].of(terms.row) *
                  scales[static_cast<std::size_t>(terms.column_sphere)].of(terms.column) +
              contact[e] * kStrainFactors[e];
  }
  return rest;
}

/// Where an entry stands in the matrix: twice if its block has a second plane. If the smaller
/// sphere is sphere 2, the spheres are exchanged, and the axis z is mirrored.
struct Place {
  std::size_t row, column;
  double sign, sign_exchanged;
};

std::size_t component_of(std::size_t entry, PairComponent component, bool second_plane) {
  if (entry < 10) return component == kMove ? 2 : 6;
  if (entry < 31) {
    if (component == kMove) return second_plane ? 1 : 0;
    if (component == kTurn) return second_plane ? 3 : 4;
    return second_plane ? 8 : 7;
  }
  if (entry < 34) return second_plane ? 10 : 9;
  return 5;
}

/// In the plane of y and z, rotated from that of x and z, W_x has the sign of -W_y.
double sign_in_plane(std::size_t entry, PairComponent component, bool second_plane) {
  return entry >= 10 && entry < 31 && second_plane && component == kTurn ? -1 : 1;
}

double sign_in_mirror(std::size_t entry, PairComponent component) {
  if (entry < 10) return component == kMove ? -1 : 1;
  if (entry < 31) return component == kMove ? 1 : -1;
  return 1;
}

using Places = std::array<std::array<Place, 2>, kPairEntries>;

Places make_places() {
  Places places{};
  for (std::size_t e = 0; e < kPairEntries; ++e)
    for (const bool second : {false, true}) {
      const auto& terms = kPairEntryTerms[e];
      auto& place = places[e][second ? 1 : 0];
      place.row = kSphereComponents * static_cast<std::size_t>(terms.row_sphere) +
                  component_of(e, terms.row, second);
      place.column = kSphereComponents * static_cast<std::size_t>(terms.column_sphere) +
                     component_of(e, terms.column, second);
      place.sign = sign_in_plane(e, terms.row, second) * sign_in_plane(e, terms.column, second);
      place.sign_exchanged =
          place.sign * sign_in_mirror(e, terms.row) * sign_in_mirror(e, terms.column);
    }
  return places;
}

void require_pair(double radius1, double radius2, double gap, double viscosity) {
  const auto require_positive = [](double value, const char* name) {
    if (!(value > 0 && std::isfinite(value)))
      throw Error(ErrorKind::kBadInput, "the {} is {}; it must be positive and finite", name,
                  format_number(value));
  };
  require_positive(radius1, "radius of sphere 1");
  require_positive(radius2, "radius of sphere 2");
  require_positive(gap, "gap");
  require_positive(viscosity, "viscosity");
  const double ratio = std::max(radius1, radius2) / std::min(radius1, radius2);
  // The quotient of radii such as 0.7 and 7 may be above 10 by rounding.
  if (ratio > kLargestRadiusRatio * (1 + 1e-12))
    throw Error(ErrorKind::kBadInput, "the radii {} and {} differ by more than a factor of {}",
                format_number(radius1), format_number(radius2), kLargestRadiusRatio);
}

void fill(double radius1, double radius2, double gap, double viscosity, std::span<double> matrix) {
  static const Places places = make_places();
  require_pair(radius1, radius2, gap, viscosity);
  assert(matrix.size() == kPairComponents * kPairComponents);
  const bool exchanged = radius1 > radius2;
  const double unit = std::min(radius1, radius2);
  const auto entries = entries_of(std::max(radius1, radius2) / unit, gap / unit);
  // The unit of an entry has a power of the length for each angular velocity or strain.
  const std::array units{viscosity * unit, viscosity * unit * unit, viscosity * unit * unit * unit};
  std::ranges::fill(matrix, 0);
  for (std::size_t e = 0; e < kPairEntries; ++e) {
    const auto& terms = kPairEntryTerms[e];
    const double value =
        entries[e] * units[(terms.row == kMove ? 0U : 1U) + (terms.column == kMove ? 0U : 1U)];
    for (const auto& place : places[e]) {
      const auto other = [&](std::size_t k) {
        return !exchanged              ? k
               : k < kSphereComponents ? k + kSphereComponents
                                       : k - kSphereComponents;
      };
      const auto row = other(place.row), column = other(place.column);
      const double signed_value = (exchanged ? place.sign_exchanged : place.sign) * value;
      matrix[row * kPairComponents + column] = signed_value;
      matrix[column * kPairComponents + row] = signed_value;
    }
  }
}

}  // namespace

PairMatrix pair_resistance(double radius1, double radius2, double gap, double viscosity) {
  PairMatrix matrix;
  fill(radius1, radius2, gap, viscosity, matrix);
  return matrix;
}

void pair_resistances(std::span<const double> radius1, std::span<const double> radius2,
                      std::span<const double> gap, double viscosity, std::span<double> matrices) {
  constexpr std::size_t kSize = kPairComponents * kPairComponents;
  assert(radius1.size() == radius2.size() && radius1.size() == gap.size());
  assert(matrices.size() == kSize * gap.size());
  for (std::size_t i = 0; i < gap.size(); ++i)
    fill(radius1[i], radius2[i], gap[i], viscosity, matrices.subspan(kSize * i, kSize));
}

}  // namespace viscontact::lubrication
