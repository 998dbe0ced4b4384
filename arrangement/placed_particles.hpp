// The particles of an arrangement that are placed so far, and which of them are close to a point.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "viscontact/arrangement/places.hpp"

namespace viscontact::particles {

/// The square root (dimension 2) or cube root (dimension 3) of `size` > 0, the same bits on every
/// machine.
double edge_of(double size, std::size_t dimension);

/// A particle that is in the domain before the new ones are placed.
struct FixedParticle {
  Vector centre;  ///< [L]
  double radius;  ///< [L]
};

/// A particle that is close to another one.
struct CloseParticle {
  Vector apart;       ///< from the centre of the other one to the centre of this one [L]
  double distance;    ///< least distance that the two centres must have [L]
  bool is_fixed;      ///< it is a FixedParticle
  std::uint64_t key;  ///< its place in the order of close_to()
};

/// The particles that are placed so far, in the order of falling radii. Particles of similar radii
/// are in one grid of cells, so that few small particles are near a small one however large the
/// largest particle is.
class PlacedParticles {
 public:
  /// `places` has the regions of the particles, or one if all radii are equal, and must outlive the
  /// object. `gap` [L] is the least gap of two particles.
  PlacedParticles(const std::vector<Places>& places, std::vector<double> radii, double gap,
                  std::vector<FixedParticle> fixed);

  std::size_t dimension() const { return widest_places().dimension(); }
  std::size_t count() const { return radii_.size(); }
  const std::vector<Vector>& centres() const { return centres_; }
  const Places& places(std::size_t k) const { return places_[places_.size() == 1 ? 0 : k]; }
  /// The region of the smallest particle, which contains the regions of all others.
  const Places& widest_places() const { return places_.back(); }
  /// Least distance of the centres of two particles of the mean radius [L].
  double distance() const;

  /// Adds the next particle, in the order of the radii, with its centre at `x`.
  void add(const Vector& x);
  void move(std::size_t k, const Vector& x);

  /// True if particle `self` may have its centre at `x`.
  bool is_free(const Vector& x, std::size_t self) const;
  /// True if all particles may have their centres where they are.
  bool are_all_free() const;

  /// Sets `close` to the particles, also fixed ones, whose centres are closer to that of particle
  /// `self` than factor * distance. `factor` is from 1 to 1.001. The order decides the order of
  /// sums and so the bits of arrangements: fixed particles; then particles in the same cell of a
  /// grid of cells that are as wide as the largest distance; then those in the cells beside it;
  /// within a cell in the order in which they came into it.
  void close_to(std::size_t self, double factor, std::vector<CloseParticle>& close) const;

 private:
  using Place = std::array<std::uint32_t, 3>;
  struct Entry {
    Vector centre;
    double radius;
    std::size_t number;
  };
  /// A grid of cells for the particles of similar radii.
  struct Level {
    double largest;                             // radius [L]
    std::array<std::size_t, 3> cells{1, 1, 1};  // number of cells along each axis
    Vector per_length{};                        // cells over the length of the region [1/L]
    std::size_t capacity = 4;                   // of each cell; it grows
    std::vector<std::uint32_t> counts;          // of the entries of each cell
    std::vector<Entry> entries;                 // those of cell i begin at i * capacity
  };
  /// Cells along an axis: `count` of them, from `first` on, across the side if it is periodic.
  struct Range {
    std::size_t first, count;
  };

  Level make_level(double largest, std::size_t count) const;
  std::size_t cell_of(const Level& level, const Vector& x) const;
  Range range(const Level& level, std::size_t d, double x, double reach) const;
  static void insert(Level& level, std::size_t cell, const Entry& entry);
  static std::size_t index_in(const Level& level, std::size_t cell, std::size_t k);
  /// The cell with the point `x`, from 0 along each axis, of the grid that orders sums.
  Place place_of(const Vector& x) const;
  /// 0, 1 or 2 if `other` is `home`, the cell before or the cell after it along axis d, each only
  /// once, also across a periodic side; otherwise 3.
  std::uint32_t rank(std::uint32_t home, std::uint32_t other, std::size_t d) const;
  /// Calls visit(apart, distance, entry) for each placed particle but `self` that is closer to `x`
  /// than factor * distance. Stops and returns true as soon as `visit` returns true.
  template <class Visit>
  bool any_close(const Vector& x, std::size_t self, double factor, const Visit& visit) const;

  const std::vector<Places>& places_;
  std::vector<double> radii_;
  double gap_;
  std::vector<FixedParticle> fixed_;
  std::vector<Level> levels_;
  std::vector<std::size_t> level_of_, cell_of_;  // of each particle
  Place order_cells_{1, 1, 1};                   // number of cells of the grid that orders sums
  std::vector<Place> place_of_;                  // cell of that grid, of each particle placed
  std::vector<std::uint64_t> came_;              // number of its coming into that cell
  std::uint64_t comings_ = 0;                    // into any cell of that grid
  std::vector<Vector> centres_;                  // of the particles that are placed [L]
};

}  // namespace viscontact::particles
