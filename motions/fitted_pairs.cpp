// The places of fitted entries in the matrix of a pair, with their signs and units of strain.
#include "viscontact/motions/fitted_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/lubrication/fit.hpp"

namespace viscontact::motions {
namespace {

namespace fs = std::filesystem;
using lubrication::kPairComponents;
using lubrication::kSphereComponents;

constexpr std::size_t kUx = 0, kUz = 2, kWy = 4, kWz = 5, kE1 = 6, kE2 = 7, kE4 = 9;
constexpr double kRoot2 = std::numbers::sqrt2;
/// E_zz of the unit tensor e_1 is the root of 2/3, and S:e_1 is S_zz over this.
const double kAxialUnit = std::sqrt(2.0 / 3);

/// A load by a component of the sphere is `factor` times the entry.
struct EntryPlace {
  PairEntry entry;
  bool of_neighbour;
  std::size_t load, component;
  double factor;
};

const std::vector<EntryPlace>& places() {
  using enum PairEntry;
  constexpr bool kSelf = false, kOther = true;
  // clang-format off
  static const std::vector<EntryPlace> all = {
      {kSqueeze, kSelf, kUz, kUz, 1},
      {kSlide, kSelf, kUx, kUx, 1},
      {kRoll, kSelf, kWy, kWy, 1},
      {kSlideRoll, kSelf, kWy, kUx, -1},
      {kSpin, kSelf, kWz, kWz, 1},
      {kSqueezeStress, kSelf, kE1, kUz, 1 / kAxialUnit},
      {kSlideStress, kSelf, kE2, kUx, kRoot2},
      {kRollStress, kSelf, kE2, kWy, kRoot2},
      {kAxialStrain, kSelf, kE1, kE1, 1},
      {kShearStrain, kSelf, kE2, kE2, 1},
      {kTwofoldStrain, kSelf, kE4, kE4, 1},
      {kNeighbourSqueeze, kOther, kUz, kUz, 1},
      {kNeighbourSlide, kOther, kUx, kUx, 1},
      {kNeighbourSlideTorque, kOther, kWy, kUx, 1},
      {kNeighbourRollForce, kOther, kUx, kWy, 1},
      {kNeighbourRoll, kOther, kWy, kWy, 1},
      {kNeighbourSpin, kOther, kWz, kWz, 1},
      {kNeighbourSqueezeStress, kOther, kE1, kUz, 1 / kAxialUnit},
      {kNeighbourSlideStress, kOther, kE2, kUx, kRoot2},
      {kNeighbourRollStress, kOther, kE2, kWy, kRoot2},
      {kNeighbourAxialForce, kOther, kUz, kE1, kAxialUnit},
      {kNeighbourShearForce, kOther, kUx, kE2, 1 / kRoot2},
      {kNeighbourShearTorque, kOther, kWy, kE2, 1 / kRoot2},
      {kNeighbourAxialStrain, kOther, kE1, kE1, 1},
      {kNeighbourShearStrain, kOther, kE2, kE2, 1},
      {kNeighbourTwofoldStrain, kOther, kE4, kE4, 1},
  };
  // clang-format on
  return all;
}

/// Components in the axes that are turned by pi about x.
constexpr std::array<double, kSphereComponents> kTurned{1, -1, -1, 1, -1, -1, 1, -1, 1, 1, -1};

/// The same component in the plane y, z in place of x, z, and its sign; the component itself if it
/// is symmetric about z.
std::pair<std::size_t, double> in_other_plane(std::size_t component) {
  switch (component) {
    case kUx:
      return {1, 1};
    case kWy:
      return {3, -1};
    case kE2:
      return {8, 1};
    case kE4:
      return {10, 1};
    default:
      return {component, 1};
  }
}

double& at(lubrication::PairMatrix& matrix, std::size_t row, std::size_t column) {
  return matrix[row * kPairComponents + column];
}

/// The matrix of the pair with its spheres exchanged.
lubrication::PairMatrix exchanged(const lubrication::PairMatrix& matrix) {
  lubrication::PairMatrix result;
  for (std::size_t i = 0; i < kPairComponents; ++i)
    for (std::size_t j = 0; j < kPairComponents; ++j) {
      const std::size_t a = (i + kSphereComponents) % kPairComponents;
      const std::size_t b = (j + kSphereComponents) % kPairComponents;
      at(result, i, j) = kTurned[i % kSphereComponents] * kTurned[j % kSphereComponents] *
                         matrix[a * kPairComponents + b];
    }
  return result;
}

/// The radius of the neighbour over that of the sphere, from words such as "plane" or "sphere,
/// radius 2, velocity_ratio 0".
double neighbour_of(const PairFit& fit) {
  if (fit.geometry == "plane") return std::numeric_limits<double>::infinity();
  double radius = 0, velocity = 1;
  if (std::sscanf(fit.geometry.c_str(), "sphere, radius %lf, velocity_ratio %lf", &radius,
                  &velocity) == 2 &&
      velocity == 0 && radius > 0)
    return radius / fit.radius;
  throw Error(ErrorKind::kBadInput,
              "the fit has the geometry '{}'; it must be that of a plane or a sphere at rest",
              fit.geometry);
}

// Ratios of radii that users round.
constexpr double kRounding = 1e-6;

PairFit read_one(const fs::path& file) {
  if (is_pair_fit(file)) return read_pair_fit(file);
  auto fit = lubrication::read_fit(file);
  if (fit.terms.empty())
    throw Error(ErrorKind::kBadInput, "the fit has no terms; it must be a fit of a table");
  for (auto& term : fit.terms) term.coefficient /= -fit.reference_velocity;
  fit.reference_velocity = -1;
  PairFit pair;
  pair.viscosity = fit.viscosity;
  pair.radius = fit.radius;
  pair.geometry = fit.geometry;
  pair.gap_interval = fit.gap_interval;
  pair.entries[PairEntry::kSqueeze] = {std::move(fit), {}};
  return pair;
}

}  // namespace

FittedPairs::FittedPairs(std::span<const PairFit> fits) {
  for (const auto& fit : fits) {
    Pair pair{neighbour_of(fit), fit.viscosity, fit.radius, fit.gap_interval, {}};
    for (auto& gap : pair.gap_interval) gap /= fit.radius;
    if (find(pair.neighbour) != nullptr)
      throw Error(
          ErrorKind::kBadInput,
          "two fits have a neighbour of {} radii of the sphere; one of them must be left out",
          format_number(pair.neighbour));
    for (std::size_t p = 0; p < places().size(); ++p) {
      const auto& place = places()[p];
      const auto found = fit.entries.find(place.entry);
      const auto& named = pair_entries()[static_cast<std::size_t>(place.entry)];
      if (found == fit.entries.end()) {
        if (std::isinf(pair.neighbour)) continue;
        throw Error(
            ErrorKind::kBadInput,
            "the fit of a sphere beside one of {} radii lacks the entry {}; beside a sphere "
            "all entries must be there, from a table of the motion \"all\"",
            format_number(pair.neighbour), named.name);
      }
      if (std::isinf(pair.neighbour) && place.of_neighbour) continue;
      Entry entry{p, named.power, {}};
      for (const auto& term : found->second.fit.terms) {
        const auto formula = lubrication::find_term(term.name);
        if (!formula)
          throw Error(ErrorKind::kBadInput,
                      "the fit has the term {}, which belongs to a second wall; beside spheres "
                      "there is none",
                      term.name);
        entry.terms.emplace_back(term.coefficient, *formula);
      }
      pair.entries.push_back(std::move(entry));
    }
    pairs_.push_back(std::move(pair));
  }
  for (const auto& pair : pairs_)
    if (!std::isinf(pair.neighbour) && find(1 / pair.neighbour) == nullptr)
      throw Error(
          ErrorKind::kBadInput,
          "there is a fit of a sphere beside one of {} radii, but none beside one of {}; the "
          "loads on both spheres need both",
          format_number(pair.neighbour), format_number(1 / pair.neighbour));
}

const FittedPairs::Pair* FittedPairs::find(double neighbour) const {
  for (const auto& pair : pairs_)
    if (pair.neighbour == neighbour ||
        (!std::isinf(neighbour) && std::abs(pair.neighbour - neighbour) <= kRounding * neighbour))
      return &pair;
  return nullptr;
}

bool FittedPairs::Pair::has_gap(double gap_over_radius) const {
  return gap_over_radius >= (1 - kRounding) * gap_interval[0] &&
         gap_over_radius <= (1 + kRounding) * gap_interval[1];
}

void FittedPairs::Pair::put(double of_radius, double gap, double of_viscosity,
                            lubrication::PairMatrix& matrix) const {
  const double scale = of_radius / radius;
  for (const auto& [p, power, terms] : entries) {
    const auto& place = places()[p];
    double value = 0;
    for (const auto& [coefficient, term] : terms) value += coefficient * term.value(gap / scale);
    value *= place.factor * of_viscosity / viscosity * std::pow(scale, power);
    const auto put_at = [&](std::size_t load, std::size_t component, double signed_value) {
      const std::size_t row = load + (place.of_neighbour ? 0 : kSphereComponents);
      const std::size_t column = component + kSphereComponents;
      at(matrix, row, column) = signed_value;
      at(matrix, column, row) = signed_value;
    };
    put_at(place.load, place.component, value);
    const auto [load, sign] = in_other_plane(place.load);
    const auto [component, other_sign] = in_other_plane(place.component);
    put_at(load, component, sign * other_sign * value);
  }
}

lubrication::PairMatrix FittedPairs::resistance(double radius1, double radius2, double gap,
                                                double viscosity) const {
  if (radius1 < radius2) return exchanged(resistance(radius2, radius1, gap, viscosity));
  auto matrix = lubrication::pair_resistance(radius1, radius2, gap, viscosity);
  const auto* pair = find(radius1 / radius2);
  if (pair == nullptr || !pair->has_gap(gap / radius2)) return matrix;
  if (std::isinf(radius1)) {
    pair->put(radius2, gap, viscosity, matrix);
    return matrix;
  }
  const auto* other = find(radius2 / radius1);
  if (!other->has_gap(gap / radius1)) return matrix;
  lubrication::PairMatrix turned{};
  other->put(radius1, gap, viscosity, turned);
  const auto of_first = exchanged(turned);
  for (std::size_t i = 0; i < kSphereComponents; ++i)
    for (std::size_t j = 0; j < kSphereComponents; ++j)
      at(matrix, i, j) = of_first[i * kPairComponents + j];
  pair->put(radius2, gap, viscosity, matrix);
  return matrix;
}

std::vector<fs::path> fit_files_in(const fs::path& path) {
  std::error_code error;
  if (fs::is_regular_file(path, error)) return {path};
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path, error))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  if (files.empty())
    throw Error(
        ErrorKind::kBadInput,
        "'{}' {}; it must be a fit that viscontact fit writes, or a folder with such files *.json",
        path.string(), error ? "cannot be read as a file or folder" : "has no file *.json");
  std::ranges::sort(files);
  return files;
}

FittedPairs read_fitted_pairs(std::span<const fs::path> files) {
  std::vector<PairFit> fits;
  for (const auto& file : files)
    fits.push_back(with_place(file.string(), [&] { return read_one(file); }));
  return FittedPairs(fits);
}

}  // namespace viscontact::motions
