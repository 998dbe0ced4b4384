// Spheres in a viscous fluid that is not resolved: each has its Stokes drag, and close pairs exert
// lubrication forces on each other; `[lubrication]` of a case, docs/physics.md (9.1).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "viscontact/lubrication/pairs/pair_resistances.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/values/vector.hpp"
#include "viscontact/particles/values/wave.hpp"

namespace viscontact::particles {

using Gradient = std::array<Vector, 3>;  ///< du_i/dx_j in row i and column j

/// Which resistances a pair of close spheres has to their motions relative to the flow.
enum class PairTerms : std::uint8_t {
  /// Those of two spheres in unbounded fluid, exact at every gap and ratio of radii.
  kTables,
  /// The terms 1/q and ln(1/q) (Jeffrey & Onishi 1984; Jeffrey 1992), with the gap q increased by
  /// `regularisation`.
  kNearContact,
  kNone,  ///< drag and contact alone
};

/// Repulsive force between two spheres, amplitude r_i r_j/(r_i + r_j) exp(-q/length) along the
/// normal, where q is the gap (Mari et al. 2014).
struct Repulsion {
  double amplitude = 0;  ///< [M/T^2]
  double length = 0;     ///< [L], > 0
};

/// The flow of PairLubrication from the end of the piece before on.
struct FlowPiece {
  double until = 0;              ///< [T]
  Gradient gradient{};           ///< as PairLubrication::gradient
  std::optional<double> stress;  ///< as PairLubrication::stress
};

/// Lengths named "in mean radii" are multiples of the mean radius of the pair.
struct PairLubrication {
  double viscosity = 0;  ///< [M/(L T)], > 0
  PairTerms pairs = PairTerms::kTables;
  /// Of `pairs` = kTables; without it the shipped ones.
  std::shared_ptr<const lubrication::PairResistances> fits;
  double range = 0.5;         ///< largest gap of a pair, in mean radii, > 0
  double regularisation = 0;  ///< delta, in mean radii, >= 0
  double drag = 1;            ///< multiple of the Stokes drag of the single spheres, > 0
  /// du_i/dx_j of the undisturbed flow in row i and column j [1/T], without trace. With a stress it
  /// is the flow of rate 1, and the rate is a result.
  Gradient gradient{};
  /// If it is given, the mean shear stress [M/(L T^2)] of the suspension, component xy.
  std::optional<double> stress;
  /// If there are pieces, they take the place of `gradient` and `stress`, which are those of the
  /// first piece. The first one begins at time 0, and the last one holds for ever.
  std::vector<FlowPiece> pieces;
  /// Factor on the gradient, or on the stress if it is given, in time.
  std::optional<Wave> wave;
  /// Displacement along x of the image of a sphere across the period y at the start [L].
  double offset = 0;
  bool inertia = false;  ///< whether the spheres have inertia; the fluid has none
  /// Whether a periodic box, with its spheres, is turned about its middle at the start so that the
  /// images of a sphere never come near it in an extension (suspensions/cell/strained_lattice.hpp).
  bool turns_box = true;
  double roughness = 0;  ///< gap at which solids touch, in mean radii, >= 0
  std::optional<Repulsion> repulsion;

  /// The gradient and the stress at a time [T], without the factor; at the end of a piece those of
  /// the next one.
  FlowPiece flow_at(double time) const;
  /// The factor of `wave`: at a time, or its mean if `to` > `from` [T]. 1 without a wave.
  double factor(double from, double to) const;
};

/// Whether the domain has three periods and a flow, at some time, that is no shear along x that
/// changes along y, so that its cell has period vectors that move with the flow.
bool strains_cell(const PairLubrication& lubrication, const Domain& domain);
/// Whether the acceleration of the fluid, (dG/dt + G^2) x, is the same at a point and at its
/// images. If not, spheres with inertia do not move as their images do.
bool accelerates_images_alike(const PairLubrication& lubrication, const Domain& domain);

/// The rate of strain (2 E:E)^(1/2) of a gradient, with its symmetric part E.
double rate_of_strain(const Gradient& gradient);
/// The same with the sign of the first entry of the gradient that is not 0.
double signed_rate_of_strain(const Gradient& gradient);

/// A flow whose gradients at all times are multiples of one.
struct FlowPath {
  /// The gradient of the rate of strain 1; 0 if the gradients are no multiples of one, or do not
  /// strain. Along it the net strain gets farther than against it.
  Gradient direction{};
  double sign = 1;  ///< of signed_rate_of_strain() of the direction
  /// The least net strain along the direction at all times, up to the end of the last piece, <= 0.
  double lowest = 0;
};
/// The rate is given.
FlowPath path_of(const PairLubrication& lubrication);

/// The largest rate of strain at all times [1/T]; 0 if it is the result of a stress.
double largest_rate_of_strain(const PairLubrication& lubrication);
/// The time [T] at which the integral of the rate of strain is `strain`; infinite if it stays
/// below. The rate is given.
double time_of_strain(const PairLubrication& lubrication, double strain);

}  // namespace viscontact::particles
