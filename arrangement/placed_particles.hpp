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

struct ClosePair {
  std::uint32_t first;   ///< number of a placed particle
  std::uint32_t second;  ///< number of another one, or of a fixed one
  bool is_fixed;         ///< the second one is a FixedParticle
  double distance;       ///< least distance that the two centres must have [L]
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

  /// Radius of particle `k` and half of the least gap [L].
  double reach(std::size_t k) const { return radii_[k] + gap_ / 2; }
  const std::vector<FixedParticle>& fixed() const { return fixed_; }
  /// The pairs of placed particles, and of a placed and a fixed one, whose centres are closer than
  /// their least distance + further [L].
  std::vector<ClosePair> pairs(double further) const;

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
  void close_to(std::size_t self, double factor, std::vector<CloseParticle>& close);

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
  /// The cells along an axis that a point reaches: `count` of them, from `first` on, which is < 0
  /// or beyond the last one across a periodic side.
  struct Range {
    std::int64_t first = 0, count = 1, cells = 1;
    std::int64_t home = 0;  // cell of the point, counted from `first`
    double at = 0;          // place of the point in widths of cells
    double width = 0;       // of a cell [L]; 0 if the point reaches all cells
    /// Counted from `first`, the i-th of the cells that are visited, the one of the point first.
    std::int64_t visited(std::int64_t i) const { return i == 0 ? home : i <= home ? i - 1 : i; }
    std::size_t cell(std::int64_t k) const {
      const std::int64_t c = first + k;
      return static_cast<std::size_t>(c < 0 ? c + cells : c >= cells ? c - cells : c);
    }
    /// Square of the distance along the axis between the point and cell `k` from `first` [L^2].
    double distance2(std::int64_t k) const {
      const double below = static_cast<double>(first + k) - at, above = -below - 1;
      const double outside = width * (below > 0 ? below : above > 0 ? above : 0);
      return outside * outside;
    }
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
  /// Calls visit(apart, distance, number) for each placed particle but `self` that is closer to `x`
  /// than factor * distance + further. Stops and returns true as soon as `visit` returns true.
  template <class Visit>
  bool any_in_cells(const Vector& x, std::size_t self, double factor, double further,
                    const Visit& visit) const;
  /// As any_in_cells() with further = 0, if the lists of neighbours have all particles that are
  /// close to `x`.
  template <class Visit>
  bool any_listed(const Vector& x, std::size_t self, double factor, const Visit& visit) const;
  /// True if the lists of neighbours have all particles that are close to `x`. Makes lists if they
  /// pay.
  bool are_listed(const Vector& x, std::size_t self);
  bool is_near_listed(const Vector& x, std::size_t k) const;
  void make_lists();

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
  // Lists of neighbours, which have all particles that are close as long as none has moved by more
  // than slack_ [L] from listed_, its centre when they were made.
  bool has_lists_ = false;
  double slack_;
  std::vector<std::uint32_t> neighbours_;
  std::vector<std::size_t> first_neighbour_;
  std::vector<Vector> listed_;
  std::size_t queries_ = 0, first_query_ = 0;  // since lists were made; before they are made
};

}  // namespace viscontact::particles
