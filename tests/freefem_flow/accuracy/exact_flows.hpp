// Exact solutions of Stokes flow around discs, for viscosity 1 and disc radius 1 unless they are
// arguments; forces and torques are per unit length.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/freefem_flow/placed_flow.hpp"

namespace viscontact::freefem_flow {

/// Mobility of a disc of radius a at the centre of a round container of radius b: velocity over
/// force (Happel & Brenner 1983).
inline double concentric_mobility(double b, double a = 1) {
  const double a2 = a * a, b2 = b * b;
  return (std::log(b / a) - (b2 - a2) / (b2 + a2)) / (4 * std::numbers::pi);
}

/// Rotational mobility of this disc: angular velocity over torque.
inline double concentric_rotational_mobility(double b, double a = 1) {
  return (1 / (a * a) - 1 / (b * b)) / (4 * std::numbers::pi);
}

/// Relative error of the mean velocity of a disc of radius a in a round container of radius b, if
/// the disc is a fluid of `ratio` times the viscosity (Lambda in docs/physics.md section 6) and not
/// rigid.
inline double penalty_law(double b, double ratio, double a = 1) {
  const double a2 = a * a, b2 = b * b, a4 = a2 * a2, b4 = b2 * b2;
  return std::pow(b2 - a2, 3) /
         (2 * (ratio * (b4 - a4) + a4 + b4) * ((a2 + b2) * std::log(b / a) - (b2 - a2)));
}

// Drag of a disc of radius 1 at unit velocity, whose centre is `distance` > 1 from a plane, in
// unbounded fluid (Jeffrey & Onishi 1981).
inline double drag_along_plane(double distance) {
  return 4 * std::numbers::pi / std::acosh(distance);
}
inline double drag_towards_plane(double distance) {
  const double alpha = std::acosh(distance);
  return 4 * std::numbers::pi / (alpha - std::tanh(alpha));
}

// Velocities of discs in round containers at rest, to 12 digits. They were computed with Goursat
// functions with poles in each disc, and agree with a single-layer method and with Wannier's
// solution (1950). Forces and velocities have three numbers for each disc: x, y, and torque or
// angular velocity.
struct Mobility {
  const char* name;
  double container;
  std::vector<Body> discs;
  std::vector<double> forces, velocities;
};

inline const std::vector<Mobility> kMobilities = {
    {"off the centre, across", 5, {{1, 0}}, {0, 1, 0}, {0, 0.0546653225996646, 0.00291735829578}},
    {"near the wall, towards it", 5, {{3, 0}}, {1, 0, 0}, {0.025030389737691, 0, 0}},
    {"two discs, squeezed",
     6,
     {{-1.05, 0}, {1.05, 0}},
     {1, 0, 0, -1, 0, 0},
     {0.00282732505206915, 0, 0, -0.00282732505206915, 0, 0}},
    {"two discs, along",
     6,
     {{-1.05, 0}, {1.05, 0}},
     {1, 0, 0, 1, 0, 0},
     {0.0912761838083594, 0, 0, 0.0912761838083594, 0, 0}},
};

}  // namespace viscontact::freefem_flow
