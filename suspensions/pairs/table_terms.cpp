// The exact pair, divided into a part without loads in rigid motions and one of these, (9.6),
// (9.7).
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "viscontact/lubrication/pairs/pair_resistance.hpp"
#include "viscontact/suspensions/pairs/pair_terms.hpp"

namespace viscontact::suspensions {
namespace {

using lubrication::kPairComponents;
using lubrication::kSphereComponents;

constexpr std::size_t kUx = 0, kUz = 2, kWy = 4, kWz = 5, kAxial = 6, kTransverse = 7, kTwofold = 9;

/// The sign of a component if spheres are exchanged and the axis z is turned back.
constexpr double sign_exchanged(std::size_t component) {
  return component == kUz || component == kWy || component == kTransverse ? -1 : 1;
}

class Entries {
 public:
  /// Equal spheres, which the interpolation does not know as equal, get the same entries.
  Entries(const lubrication::PairMatrix& matrix, bool are_equal)
      : matrix_(matrix), are_equal_(are_equal) {}
  /// Components of spheres 0 and 1, as pair_resistance.hpp numbers them.
  double operator()(std::size_t sphere, std::size_t component, std::size_t other,
                    std::size_t other_component) const {
    const double here = entry(sphere, component, other, other_component);
    if (!are_equal_) return here;
    return (here + sign_exchanged(component) * sign_exchanged(other_component) *
                       entry(1 - sphere, component, 1 - other, other_component)) /
           2;
  }
  double entry(std::size_t sphere, std::size_t component, std::size_t other,
               std::size_t other_component) const {
    return matrix_[(sphere * kSphereComponents + component) * kPairComponents +
                   other * kSphereComponents + other_component];
  }
  /// Both spheres in one strain.
  double by_strain(std::size_t sphere, std::size_t component, std::size_t strain) const {
    return (*this)(sphere, component, 0, strain) + (*this)(sphere, component, 1, strain);
  }
  double stress(std::size_t strain) const {
    return by_strain(0, strain, strain) + by_strain(1, strain, strain);
  }

 private:
  const lubrication::PairMatrix& matrix_;
  bool are_equal_;
};

lubrication::PairMatrix matrix_of(double radius1, double radius2, double gap, double viscosity,
                                  const lubrication::PairResistances* fits) {
  return fits != nullptr ? fits->resistance(radius1, radius2, gap, viscosity)
                         : lubrication::pair_resistance(radius1, radius2, gap, viscosity);
}

/// Velocities along n: K = squeeze (n.d)^2 + (axial modes)^2.
void divide_axial(const Entries& k, TableTerms& terms) {
  const double mixed = k(0, kUz, 1, kUz);
  const double first = k(0, kUz, 0, kUz) + mixed, second = k(1, kUz, 1, kUz) + mixed;
  const double drag = first + second, root = std::sqrt(drag);
  // The unit tensor of the strain is (nn - 1/3) sqrt(3/2).
  const double unit = std::sqrt(1.5);
  const double strain1 = unit * k.by_strain(0, kUz, kAxial);
  const double strain2 = unit * k.by_strain(1, kUz, kAxial);
  auto& balanced = terms.balanced;
  balanced.squeeze = first * second / drag - mixed;
  balanced.strain_squeeze = strain2 - second * (strain1 + strain2) / drag;
  balanced.stress_axial = 1.5 * k.stress(kAxial) - (strain1 + strain2) * (strain1 + strain2) / drag;
  terms.drag.axial = {first / root, second / root};
  terms.drag.axial_strain = (strain1 + strain2) / root;
}

/// Velocities along x and angular velocities about y. `distance` is that of the centres.
void divide_transverse(const Entries& k, double distance, TableTerms& terms) {
  constexpr std::size_t kSphere[] = {0, 0, 1, 1}, kComponent[] = {kUx, kWy, kUx, kWy};
  // Loads in the translation along x, and in the rotation about the centre of sphere 1.
  double translation[4], rotation[4], strain[4];
  for (std::size_t i = 0; i < 4; ++i) {
    const auto entry = [&](std::size_t j) {
      return k(kSphere[i], kComponent[i], kSphere[j], kComponent[j]);
    };
    translation[i] = entry(0) + entry(2);
    rotation[i] = entry(1) + entry(3) + distance * entry(2);
    strain[i] = std::numbers::sqrt2 * k.by_strain(kSphere[i], kComponent[i], kTransverse);
  }
  const auto along = [](const double* load) { return load[0] + load[2]; };
  const auto about = [&](const double* load) { return load[1] + load[3] + distance * load[2]; };
  // Two modes by Cholesky's factors of the 2 x 2 matrix of the drag.
  const double root1 = std::sqrt(along(translation)), ratio = along(rotation) / root1;
  const double root2 = std::sqrt(about(rotation) - ratio * ratio);
  double mode1[4], mode2[4];
  for (std::size_t i = 0; i < 4; ++i) {
    mode1[i] = translation[i] / root1;
    mode2[i] = (rotation[i] - ratio * mode1[i]) / root2;
  }
  const double strain1 = along(strain) / root1, strain2 = (about(strain) - ratio * strain1) / root2;
  const auto rest = [&](std::size_t i, std::size_t j) {
    return k(kSphere[i], kComponent[i], kSphere[j], kComponent[j]) - mode1[i] * mode1[j] -
           mode2[i] * mode2[j];
  };
  auto& balanced = terms.balanced;
  balanced.arm = distance;
  balanced.turn_first = rest(1, 1);
  balanced.turn_mixed = rest(1, 3);
  balanced.turn_second = rest(3, 3);
  balanced.strain_turn_first = strain[1] - mode1[1] * strain1 - mode2[1] * strain2;
  balanced.strain_turn_second = strain[3] - mode1[3] * strain1 - mode2[3] * strain2;
  balanced.stress_transverse = 2 * k.stress(kTransverse) - strain1 * strain1 - strain2 * strain2;
  // w about y is n x w = -w along x.
  terms.drag.transverse[0] = {{mode1[0], mode1[2]}, {-mode1[1], -mode1[3]}, strain1};
  terms.drag.transverse[1] = {{mode2[0], mode2[2]}, {-mode2[1], -mode2[3]}, strain2};
}

void divide_spin(const Entries& k, TableTerms& terms) {
  const double mixed = k(0, kWz, 1, kWz);
  const double first = k(0, kWz, 0, kWz) + mixed, second = k(1, kWz, 1, kWz) + mixed;
  const double root = std::sqrt(first + second);
  terms.balanced.spin = first * second / (first + second) - mixed;
  terms.drag.spin = {first / root, second / root};
}

}  // namespace

TableTerms table_terms(double viscosity, double radius1, double radius2, double gap,
                       double regularisation, const lubrication::PairResistances* fits) {
  const double q = gap + regularisation * (radius1 + radius2) / 2;
  const auto matrix = matrix_of(radius1, radius2, q, viscosity, fits);
  const Entries k(matrix, radius1 == radius2);
  TableTerms terms;
  divide_axial(k, terms);
  divide_transverse(k, radius1 + radius2 + gap, terms);
  divide_spin(k, terms);
  const auto cube = [](double a) { return a * a * a; };
  const double alone = 20 * std::numbers::pi / 3 * viscosity * (cube(radius1) + cube(radius2));
  terms.balanced.stress_axial -= 1.5 * alone;
  terms.balanced.stress_transverse -= 2 * alone;
  terms.balanced.stress_twofold = k.stress(kTwofold) - alone;
  return terms;
}

BalancedTerms table_plane_terms(double viscosity, double radius, double gap, double regularisation,
                                const lubrication::PairResistances* fits) {
  using std::numbers::pi;
  const auto matrix = matrix_of(radius, std::numeric_limits<double>::infinity(),
                                gap + regularisation * radius, viscosity, fits);
  const Entries k(matrix, false);
  const double cube = radius * radius * radius, stress_alone = 20 * pi / 3 * viscosity * cube;
  BalancedTerms terms;
  terms.arm = radius + gap;
  terms.squeeze = k(0, kUz, 0, kUz) - 6 * pi * viscosity * radius;
  terms.strain_squeeze = -std::sqrt(1.5) * k(0, kUz, 0, kAxial);
  terms.stress_axial = 1.5 * (k(0, kAxial, 0, kAxial) - stress_alone);
  // With the velocity v along x, u_1 = w + v/arm and u_2 = v/arm about y.
  const double moved = k(0, kUx, 0, kUx) - 6 * pi * viscosity * radius;
  const double mixed = terms.arm * k(0, kUx, 0, kWy);
  terms.turn_first = k(0, kWy, 0, kWy) - 8 * pi * viscosity * cube;
  terms.turn_mixed = mixed - terms.turn_first;
  terms.turn_second = terms.arm * terms.arm * moved - 2 * mixed + terms.turn_first;
  terms.strain_turn_first = std::numbers::sqrt2 * k(0, kWy, 0, kTransverse);
  terms.strain_turn_second =
      std::numbers::sqrt2 * terms.arm * k(0, kUx, 0, kTransverse) - terms.strain_turn_first;
  terms.stress_transverse = 2 * (k(0, kTransverse, 0, kTransverse) - stress_alone);
  terms.stress_twofold = k(0, kTwofold, 0, kTwofold) - stress_alone;
  terms.spin = k(0, kWz, 0, kWz) - 8 * pi * viscosity * cube;
  return terms;
}

}  // namespace viscontact::suspensions
