// Chebyshev sums of the rest, terms near contact, and the places of the entries in the matrix.
#include "viscontact/lubrication/pairs/pair_resistance.hpp"

#include <Eigen/LU>
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

/// A table of pair_rest.hpp by groups of entries; those of entries that do not exist are 0.
template <std::size_t products>
struct RestTable {
  std::array<std::array<std::size_t, 2>, products> orders{};
  std::array<std::array<Group, products>, kGroups> coefficients;

  explicit RestTable(const std::array<PairProduct, products>& table) {
    for (auto& group : coefficients) group.fill(Group::Zero());
    for (std::size_t k = 0; k < products; ++k) {
      orders[k] = {table[k].ratio_order, table[k].gap_order};
      for (std::size_t e = 0; e < kPairEntries; ++e)
        coefficients[e / kGroup][k](static_cast<Eigen::Index>(e % kGroup)) =
            table[k].coefficients[e];
    }
  }
};

/// The numerators over denominators of the terms near contact.
struct ContactTable {
  std::array<std::array<std::array<Group, 7>, 3>, kGroups> coefficients;

  ContactTable() {
    for (auto& group : coefficients)
      for (auto& term : group) term.fill(Group::Zero());
    for (std::size_t e = 0; e < kPairEntries; ++e)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& term = kPairEntryTerms[e].terms[k];
        for (std::size_t p = 0; p < 7; ++p)
          coefficients[e / kGroup][k][p](static_cast<Eigen::Index>(e % kGroup)) =
              static_cast<double>(term.numerator[p]) / term.denominator;
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

/// The sums of a table.
template <std::size_t products>
Entries sums(const RestTable<products>& table, const PairCoordinates& at) {
  const auto of_ratio = chebyshev<kRatioTerms>(at.ratio);
  const auto of_gap = chebyshev<kGapTerms>(at.gap);
  std::array<double, products> factors;
  for (std::size_t k = 0; k < products; ++k)
    factors[k] = of_ratio[table.orders[k][0]] * of_gap[table.orders[k][1]];
  Entries rest;
  for (std::size_t group = 0; group < kGroups; ++group) {
    Group sum = Group::Zero();
    for (std::size_t k = 0; k < products; ++k) sum += factors[k] * table.coefficients[group][k];
    Group::Map(&rest[group * kGroup]) = sum;
  }
  return rest;
}

/// The first entry of the block of azimuthal flows that has this entry.
std::size_t block_of(std::size_t entry) {
  return entry < 10 ? 0 : entry < 31 ? 10 : entry < 34 ? 31 : 34;
}

/// For an entry of sphere 1 and a component of the large sphere 2: the entry of sphere 1 and the
/// motion of its neighbour's surface there, and this motion for a component 1. Turns and strains
/// across move the surface, at the distance b from the centre of sphere 2, by b times this number.
struct SurfaceMotion {
  std::size_t entry;
  PairComponent component;
  double motion;
  bool has_arm;
};

SurfaceMotion surface_motion(std::size_t entry) {
  const auto block = block_of(entry);
  const auto& terms = kPairEntryTerms[entry];
  if (block > 10) return {block, terms.column, 1, false};
  const std::size_t with_velocity = block + (terms.row == kMove                 ? 0
                                             : terms.row == kTurn || block == 0 ? 1
                                                                                : 2);
  const double motion = terms.column == kMove   ? 1
                        : terms.column == kTurn ? -1
                                                : std::sqrt(block == 0 ? 2.0 / 3 : 0.5);
  return {with_velocity, kMove, motion, terms.column != kMove};
}

/// The terms near contact, with strains in the basis of PairMatrix.
Entries contact_entries(double b, double gap) {
  static const ContactTable table;
  static const auto kStrainFactors = [] {
    Entries factors{};
    for (std::size_t e = 0; e < kPairEntries; ++e) {
      const auto& terms = kPairEntryTerms[e];
      const double one = 1 / std::sqrt(square_of_strain(e));
      factors[e] = (terms.row == kStrain ? one : 1) * (terms.column == kStrain ? one : 1);
    }
    return factors;
  }();
  const auto weights = PairCoordinates(b, gap).contact_weights();
  Entries contact;
  for (std::size_t group = 0; group < kGroups; ++group) {
    Group sum = Group::Zero();
    const auto& terms = table.coefficients[group];
    for (std::size_t p = 7; p-- > 0;)
      sum = sum * b +
            (weights[0] * terms[0][p] + weights[1] * terms[1][p] + weights[2] * terms[2][p]);
    Group::Map(&contact[group * kGroup]) = sum * Group::Map(&kStrainFactors[group * kGroup]);
  }
  return contact;
}

/// The entries of a table.
template <std::size_t products>
Entries entries_by(const RestTable<products>& table, double b, double gap) {
  auto entries = sums(table, PairCoordinates(b, gap));
  const auto contact = contact_entries(b, gap);
  const std::array scales{Scales(1), Scales(b)};
  for (std::size_t e = 0; e < kPairEntries; ++e) {
    const auto& terms = kPairEntryTerms[e];
    entries[e] = entries[e] * scales[static_cast<std::size_t>(terms.row_sphere)].of(terms.row) *
                     scales[static_cast<std::size_t>(terms.column_sphere)].of(terms.column) +
                 contact[e];
  }
  return entries;
}

/// At this ratio 1 + b is b, and the entries of sphere 1 are those beside a plane.
constexpr double kFlat = 1e17;

/// For b > kFarRatio, by matching. Where the gap q is not large, a large sphere 2 is a plane but for
/// terms like 1/b, which the table at kFarRatio has at the same gap; its motion is that of its
/// surface, which has the loads of sphere 1 with the opposite sign; and its own entries are those of
/// a sphere alone. Where the gap is not small beside b, sphere 1 is a point, and the terms depend on
/// q/b, so that the table has them at the gap q kFarRatio/b. Between both they are constant.
Entries far_entries(double b, double gap) {
  static const RestTable far(kFarPairRest);
  static const RestTable plane(kPlaneRest);
  constexpr double kRatio = PairCoordinates::kFarRatio;
  // Free choices: where the one gap goes over into the other one, and where the exact coefficients
  // of the terms near contact go over into those of the matching.
  constexpr double kBetween = 10, kContact = 0.2;
  const double share = kRatio / b, cube = std::pow(gap / kContact, 3), near = 1 / (1 + cube);
  const double there = gap * (1 + share * gap / kBetween) / (1 + gap / kBetween);
  // Each with its terms near contact.
  const std::array planes{entries_by(plane, kFlat, gap), contact_entries(kFlat, gap)};
  const std::array planes_there{entries_by(plane, kFlat, there), contact_entries(kFlat, there)};
  const std::array tables{entries_by(far, kRatio, there), contact_entries(kRatio, there)};
  const auto contact = contact_entries(b, gap);
  const std::array scales{Scales(1), Scales(b)}, scales_there{Scales(1), Scales(kRatio)};
  Entries entries{};
  for (std::size_t e = 0; e < kPairEntries; ++e) {
    const auto& terms = kPairEntryTerms[e];
    const auto matched = [&](std::size_t part) {
      if (terms.column_sphere == 0)
        return planes[part][e] + share * (tables[part][e] - planes_there[part][e]);
      if (terms.row_sphere == 1) {
        const double alone = part == 0 && terms.row == terms.column ? 1 : 0;
        const double unit = scales_there[1].of(terms.row) * scales_there[1].of(terms.column);
        return (alone + share * (tables[part][e] / unit - alone)) * scales[1].of(terms.row) *
               scales[1].of(terms.column);
      }
      const auto of = surface_motion(e);
      const double in_table = tables[part][e] / (of.has_arm ? kRatio : 1);
      return (share * gap / there * (in_table + of.motion * planes_there[part][of.entry]) -
              of.motion * planes[part][of.entry]) *
             (of.has_arm ? b : 1);
    };
    entries[e] = matched(0) + near * (contact[e] - matched(1));
  }
  return entries;
}

/// The entries for viscosity 1, the radii 1 and b >= 1. Only those of sphere 1 have a meaning if b is
/// infinite.
Entries entries_of(double b, double gap) {
  static const RestTable near(kPairRest);
  static const RestTable far(kFarPairRest);
  static const RestTable plane(kPlaneRest);
  if (b <= PairCoordinates::kNearRatio) return entries_by(near, b, gap);
  if (b <= PairCoordinates::kFarRatio) return entries_by(far, b, gap);
  return std::isinf(b) ? entries_by(plane, kFlat, gap) : far_entries(b, gap);
}

/// Replaces the K of a block by P^T (K_rr - K_rn K_nn^-1 K_nr) P. N are the rigid motions of the
/// pair (columns), R motions of sphere 1 and strains alone, K_rn = R^T K N; and P are the numbers of
/// motions R of which, with a rigid motion, any motion consists, so that P N = 0. This is K - K N
/// (N^T K N)^-1 N^T K, without differences of large numbers if sphere 2 is large.
template <int size, int rigid>
void balance(double* upper_triangle, const Eigen::Matrix<double, size, rigid>& n,
             const Eigen::Matrix<double, size - rigid, size>& p,
             const Eigen::Matrix<double, size, size - rigid>& r) {
  Eigen::Matrix<double, size, size> k;
  for (int i = 0, next = 0; i < size; ++i)
    for (int j = i; j < size; ++j) k(i, j) = k(j, i) = upper_triangle[next++];
  const Eigen::Matrix<double, size, rigid> kn = k * n;
  const Eigen::Matrix<double, rigid, rigid> nn = n.transpose() * kn;
  const Eigen::Matrix<double, size - rigid, rigid> rn = r.transpose() * kn;
  const Eigen::Matrix<double, size - rigid, size - rigid> reduced =
      r.transpose() * k * r - rn * nn.inverse() * rn.transpose();
  const Eigen::Matrix<double, size, size> balanced = p.transpose() * reduced * p;
  for (int i = 0, next = 0; i < size; ++i)
    for (int j = i; j < size; ++j) upper_triangle[next++] = balanced(i, j);
}

/// The entries of the balanced form, with the distance of the centres.
void balance(Entries& entries, double distance) {
  {  // U_z, E_1 of sphere 1, of sphere 2.
    Eigen::Matrix<double, 4, 1> n{1, 0, 1, 0};
    Eigen::Matrix<double, 3, 4> p;
    p << 1, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1;
    Eigen::Matrix<double, 4, 3> r;
    r << 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1;
    balance<4, 1>(entries.data(), n, p, r);
  }
  {  // U_x, W_y, E_2; rotations are about the centre of sphere 2.
    Eigen::Matrix<double, 6, 2> n;
    n << 1, -distance, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0;
    Eigen::Matrix<double, 4, 6> p;
    p << 1, 0, 0, -1, distance, 0,  //
        0, 1, 0, 0, -1, 0,          //
        0, 0, 1, 0, 0, 0,           //
        0, 0, 0, 0, 0, 1;
    Eigen::Matrix<double, 6, 4> r = Eigen::Matrix<double, 6, 4>::Zero();
    r(0, 0) = r(1, 1) = r(2, 2) = r(5, 3) = 1;
    balance<6, 2>(&entries[10], n, p, r);
  }
  // W_z.
  const double one = entries[34], mixed = entries[35], two = entries[36];
  const double relative = one - (one + mixed) * (one + mixed) / (one + 2 * mixed + two);
  entries[34] = entries[36] = relative;
  entries[35] = -relative;
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
  const auto require = [](bool is_right, double value, const char* name, const char* what) {
    if (!is_right)
      throw Error(ErrorKind::kBadInput, "the {} is {}; it must be {}", name, format_number(value),
                  what);
  };
  const auto require_positive = [&](double value, const char* name) {
    require(value > 0 && std::isfinite(value), value, name, "positive and finite");
  };
  const bool has_plane = std::isinf(radius1) != std::isinf(radius2);
  if (!(has_plane && radius1 > 0)) require_positive(radius1, "radius of sphere 1");
  if (!(has_plane && radius2 > 0)) require_positive(radius2, "radius of sphere 2");
  require_positive(gap, "gap");
  require_positive(viscosity, "viscosity");
  const double ratio = std::max(radius1, radius2) / std::min(radius1, radius2);
  if (!has_plane && ratio > kLargestRadiusRatio)
    throw Error(ErrorKind::kBadInput,
                "the radii {} and {} differ by more than a factor of {}; a plane has an infinite "
                "radius",
                format_number(radius1), format_number(radius2), kLargestRadiusRatio);
}

void fill(double radius1, double radius2, double gap, double viscosity, PairForm form,
          std::span<double> matrix) {
  static const Places places = make_places();
  require_pair(radius1, radius2, gap, viscosity);
  assert(matrix.size() == kPairComponents * kPairComponents);
  const bool exchanged = radius1 > radius2;
  const double unit = std::min(radius1, radius2);
  const double b = std::max(radius1, radius2) / unit;
  const bool has_plane = std::isinf(b);
  auto entries = entries_of(b, gap / unit);
  if (form == PairForm::kBalanced && !has_plane) balance(entries, 1 + b + gap / unit);
  // The unit of an entry has a power of the length for each angular velocity or strain.
  const std::array units{viscosity * unit, viscosity * unit * unit, viscosity * unit * unit * unit};
  std::ranges::fill(matrix, 0);
  for (std::size_t e = 0; e < kPairEntries; ++e) {
    const auto& terms = kPairEntryTerms[e];
    if (has_plane && terms.column_sphere == 1) continue;
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

PairMatrix pair_resistance(double radius1, double radius2, double gap, double viscosity,
                           PairForm form) {
  PairMatrix matrix;
  fill(radius1, radius2, gap, viscosity, form, matrix);
  return matrix;
}

void pair_resistances(std::span<const double> radius1, std::span<const double> radius2,
                      std::span<const double> gap, double viscosity, std::span<double> matrices,
                      PairForm form) {
  constexpr std::size_t kSize = kPairComponents * kPairComponents;
  assert(radius1.size() == radius2.size() && radius1.size() == gap.size());
  assert(matrices.size() == kSize * gap.size());
  for (std::size_t i = 0; i < gap.size(); ++i)
    fill(radius1[i], radius2[i], gap[i], viscosity, form, matrices.subspan(kSize * i, kSize));
}

}  // namespace viscontact::lubrication
