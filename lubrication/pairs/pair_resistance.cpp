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

/// Choices of far_entries().
struct FarTuning {
  /// The gap at which the gap itself goes over into the share q kFarRatio/b of the gap, as the place
  /// in the table at kFarRatio.
  double between = 10;
  /// The gap at which the exact coefficients of the terms near contact go over into those of the
  /// approximations. With 0.01 errors of the small sphere's own entries are smaller by a factor of 2,
  /// and those of the mixed ones larger by 2; with 0.2 both are larger by 3.
  double contact = 0.05;
  /// The gap beyond which the entries beside a plane, but for the force by a velocity, have their
  /// largest power of the distance. There the table has rounding errors, which are not small beside
  /// the torque and the stresslet in the flow of a very large sphere.
  double powers = 100;
};

/// For b > kFarRatio, the entries of sphere 1 with sphere 2 at rest, and 0 elsewhere, by matching.
/// Where the gap q is not large, a large sphere 2 is a plane but for terms like 1/b, which the table
/// at kFarRatio has at the same gap. Where q is not small beside b, sphere 1 is a point; the terms
/// are 1/b for the force by a velocity and one more 1/b for each torque, stresslet, turn or strain,
/// times functions of q/b, which the table has at the gap q kFarRatio/b. Between both q/b or 1/q
/// times these terms are constant.
struct OwnEntries {
  Entries all, contact;
};

OwnEntries far_own_entries(double b, double gap, double near) {
  static const RestTable far(kFarPairRest);
  static const RestTable plane(kPlaneRest);
  constexpr double kRatio = PairCoordinates::kFarRatio;
  constexpr FarTuning kTuning;
  const double share = kRatio / b;
  const double there = gap * (1 + share * gap / kTuning.between) / (1 + gap / kTuning.between);
  // Each with its terms near contact.
  const std::array planes{entries_by(plane, kFlat, gap), contact_entries(kFlat, gap)};
  const std::array planes_there{entries_by(plane, kFlat, there), contact_entries(kFlat, there)};
  const std::array tables{entries_by(far, kRatio, there), contact_entries(kRatio, there)};
  OwnEntries own{{}, contact_entries(b, gap)};
  const double closer = there / gap;
  const double last = std::min(gap, kTuning.powers), decay = (1 + last) / (1 + gap);
  const auto powers = last < gap ? entries_by(plane, kFlat, last) : planes[0];
  for (std::size_t e = 0; e < kPairEntries; ++e) {
    const auto& terms = kPairEntryTerms[e];
    if (terms.column_sphere == 1) continue;
    const int moments = (terms.row == kMove ? 0 : 1) + (terms.column == kMove ? 0 : 1);
    const double factor = share * std::pow(closer, moments);
    const auto matched = [&](double beside_plane, std::size_t part) {
      return beside_plane + factor * (tables[part][e] - planes_there[part][e]);
    };
    double beside_plane = planes[0][e];
    if (last < gap && moments > 0) {
      const double alone = terms.row == terms.column ? Scales(1).of(terms.row) : 0;
      const double change = powers[e] - alone * alone;
      beside_plane = alone * alone + std::pow(decay, moments + 1) * change;
    }
    own.all[e] = matched(beside_plane, 0) + near * (own.contact[e] - matched(planes[1][e], 1));
  }
  return own;
}

/// The linear part of the flow of sphere 2 alone at the centre of sphere 1, by the components of
/// sphere 2 (columns), as components of sphere 1 at rest in this flow (rows), for each block.
struct FlowOfNeighbour {
  Eigen::Matrix2d axial;
  Eigen::Matrix3d transverse;
  double twofold, spin;

  /// With the radius b of sphere 2 at the distance r.
  FlowOfNeighbour(double b, double r) {
    const double s = b / r, s3 = s * s * s, s5 = s3 * s * s;
    const double strain = std::sqrt(1.5), across = std::sqrt(2.0);
    axial << -(1.5 * s - 0.5 * s3), -(2.5 * s3 - 1.5 * s5) * r / strain,  //
        strain * 1.5 * (s - s3) / r, 5 * s3 - 6 * s5;
    transverse << -(0.75 * s + 0.25 * s3), s3 * r, -s5 * r / across,  //
        -0.75 * s / r, 0.5 * s3, -2.5 * s3 / across,                  //
        across * 0.75 * s3 / r, -across * 1.5 * s3, 4 * s5 - 2.5 * s3;
    twofold = -s5;
    spin = -s3;
  }
};

/// Completes the upper triangle K_11 C, alone + C^T K_11 C from the block K_11 of sphere 1, where C
/// is the flow of sphere 2, and `alone` are the entries of sphere 2 alone (a diagonal).
template <int size>
void add_neighbour(double* upper_triangle, const Eigen::Matrix<double, size, size>& flow,
                   const Eigen::Matrix<double, size, 1>& alone) {
  Eigen::Matrix<double, size, size> own;
  const auto at = [&](int i, int j) { return upper_triangle + i * (4 * size - i + 1) / 2 + j - i; };
  for (int i = 0; i < size; ++i)
    for (int j = i; j < size; ++j) own(i, j) = own(j, i) = *at(i, j);
  const Eigen::Matrix<double, size, size> mixed = own * flow;
  Eigen::Matrix<double, size, size> other = flow.transpose() * mixed;
  other.diagonal() += alone;
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) {
      *at(i, size + j) = mixed(i, j);
      if (j >= i) *at(size + i, size + j) = other(i, j);
    }
}

void add_neighbour(Entries& entries, const FlowOfNeighbour& flow, const Scales& scales) {
  const double move = scales.move * scales.move, turn = scales.turn * scales.turn,
               strain = scales.strain * scales.strain;
  using Single = Eigen::Matrix<double, 1, 1>;
  add_neighbour<2>(entries.data(), flow.axial, {move, strain});
  add_neighbour<3>(&entries[10], flow.transverse, {move, turn, strain});
  add_neighbour<1>(&entries[31], Single(flow.twofold), Single(strain));
  add_neighbour<1>(&entries[34], Single(flow.spin), Single(turn));
}

/// For b > kFarRatio. Sphere 1 is small beside the lengths over which the flow of sphere 2 alone
/// changes, so that it feels its linear part only. If C are the components of this part for the
/// motions of sphere 2, sphere 1 at rest has the loads K_11 C, and K_22 is that of sphere 2 alone and
/// C^T K_11 C by the reciprocal theorem. The quadratic part is smaller by 1/b^2 in the velocity and, at
/// gaps below the radius, by 1/b in turns and strains. The terms near contact are exact, as in
/// far_own_entries().
Entries far_entries(double b, double gap) {
  const double cube = std::pow(gap / FarTuning{}.contact, 3), near = 1 / (1 + cube);
  auto [entries, own_contact] = far_own_entries(b, gap, near);
  const auto contact = own_contact;
  const FlowOfNeighbour flow(b, 1 + b + gap);
  add_neighbour(entries, flow, Scales(b));
  add_neighbour(own_contact, flow, Scales(0));
  for (std::size_t e = 0; e < kPairEntries; ++e) entries[e] += near * (contact[e] - own_contact[e]);
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
    require(value > 0 && std::isfinite(value), value, name,
            std::isinf(radius1) && std::isinf(radius2) ? "finite, because there is one plane only"
                                                       : "positive and finite");
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
    if (!std::isfinite(value))
      throw Error(
          ErrorKind::kBadInput,
          "the gap {} beside the radii {} and {} has no finite resistances; choose a smaller "
          "gap or another unit of length",
          format_number(gap), format_number(radius1), format_number(radius2));
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
