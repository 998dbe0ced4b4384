// The period vectors of a cell that a linear flow u = G x strains, (9.24) to (9.26).
#pragma once

#include <array>
#include <cstdint>

#include "viscontact/suspensions/values/matrix.hpp"

namespace viscontact::suspensions {

/// Three period vectors [L].
using Lattice = std::array<Vector, 3>;

/// A basis of the same lattice whose vectors are as short as they can be (Minkowski). It is
/// right-handed, and its vectors point along x, y and z as far as they can.
Lattice reduced(Lattice lattice);

/// The numbers c with x = sum of c_k lattice[k] are (c_k) = fractions_of(lattice) x.
Matrix fractions_of(const Lattice& lattice);

/// Distances [L] of the opposite faces of the cell of a lattice.
Vector heights_of(const Lattice& lattice);

/// Whether both have the same points, to 1e-9 of the vectors.
bool are_same(const Lattice& a, const Lattice& b);

/// exp(t G) of the period vectors, reduced.
Lattice carried_lattice(const Matrix& gradient, double t, const Lattice& lattice);

/// The lattice of a box in a flow. If it is possible the box is turned at the start such that the
/// images of a sphere never come near it, whatever the strain: in a planar extension by the angle
/// of Kraynik & Reinelt 1992, and its extension to boxes with any edges and to planar flows with
/// rotation; for a cube in any extension along three axes onto the axes of a cubic field whose
/// units repeat the lattice (Dobson 2014). Otherwise the edges are along x, y and z at the start.
class StrainedLattice {
 public:
  enum class Kind : std::uint8_t {
    kAsTheBox,  ///< no turn keeps images apart, or none is needed
    kPlanar,    ///< turned in the plane of the flow
    kCubic,     ///< turned about all axes; the box must be a cube
  };
  /// That of a flow in a cube.
  static Kind kind_of(const Matrix& gradient);

  /// `lengths` are the edges of the box [L]. Only a cube is turned for kCubic.
  StrainedLattice(const Vector& lengths, const Matrix& gradient, bool may_turn);

  Kind kind() const { return kind_; }
  /// The rotation of the box and its spheres at the start.
  const Matrix& turn() const { return turn_; }
  /// The turned box.
  Lattice start() const;
  /// The lattice after the gradient has acted for the time `t` [T], reduced. It is computed from
  /// the start and not step by step, because errors of the lattice grow as exp(2 t G). The kind is
  /// kPlanar or kCubic, and `t` at least earliest().
  Lattice at(double t) const;
  /// The time [T] before which at() has no more digits, < 0: lattices of boxes whose edges in the
  /// plane of the flow differ, and of planar flows with rotation, do not last against the flow.
  /// Minus infinity for the others.
  double earliest() const;
  /// The least of heights_of() at all times from `from` <= 0 on [L]; 0 for kAsTheBox, and before
  /// earliest(), which may come down to 0.
  double least_height(double from = 0) const;

 private:
  void turn_in_plane(const Vector& lengths, const Matrix& gradient);
  void turn_cube(double edge, const Matrix& gradient);

  Kind kind_ = Kind::kAsTheBox;
  Matrix turn_{Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}};
  Lattice box_{};  // the edges before they are turned
  // Directions e_i of the flow, and the components of the period vectors along them at the start:
  // period k is sum of forms_[i][k] directions_[i]. They grow as exp(rates_[i] t).
  std::array<Vector, 3> directions_{}, forms_{};
  Vector rates_{};   // [1/T]
  Vector fading_{};  // a part of forms_[1] that falls as exp(-2 t rates_[0]) beside the rest
};

}  // namespace viscontact::suspensions
