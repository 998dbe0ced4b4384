// Only + - * / and sqrt are used, and nothing is fused (-ffp-contract=off in CMakeLists.txt), so
// that every machine computes the same bits.
#include "viscontact/arrangement/placed_particles.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <utility>

namespace viscontact::particles {

double edge_of(double size, std::size_t dimension) {
  assert(size > 0);
  if (dimension == 2) return std::sqrt(size);
  // Newton's method, because the cube root of the C library differs between machines.
  double root = size < 1 ? 1 : size;  // at least the cube root, so that the iterates fall to it
  for (double next = 0;; root = next) {
    next = root - (root - size / (root * root)) / 3;
    if (!(next < root)) return root;
  }
}

PlacedParticles::PlacedParticles(const std::vector<Places>& places, std::vector<double> radii,
                                 double gap, std::vector<FixedParticle> fixed)
    : places_(places), radii_(std::move(radii)), gap_(gap), fixed_(std::move(fixed)) {
  assert(std::ranges::is_sorted(radii_, std::greater<>()));
  assert(places_.size() == 1 || places_.size() == radii_.size());
  level_of_.resize(count());
  cell_of_.resize(count());
  for (std::size_t begin = 0, end = 0; begin < count(); begin = end) {
    // Particles of one level have reaches within a factor of 2.
    while (end < count() && 2 * (radii_[end] + gap_ / 2) >= radii_[begin] + gap_ / 2)
      level_of_[end++] = levels_.size();
    levels_.push_back(make_level(radii_[begin], end - begin));
  }
  const double side = edge_of(static_cast<double>(count()), dimension()) + 1;
  const double widest = 2 * radii_.front() + gap_;
  for (std::size_t d = 0; d < dimension(); ++d) {
    const double fit = std::min(widest_places().length(d) / widest, side);
    order_cells_[d] = std::max<std::uint32_t>(1, static_cast<std::uint32_t>(fit));
  }
}

PlacedParticles::Level PlacedParticles::make_level(double largest, std::size_t count) const {
  Level level{.largest = largest, .counts = {}, .entries = {}};
  // More cells than particles would cost memory without saving time.
  const double side = edge_of(static_cast<double>(count), dimension()) + 1;
  for (std::size_t d = 0; d < dimension(); ++d) {
    const double length = widest_places().length(d);
    const double fit = std::min(length / (2 * largest + gap_), side);
    level.cells[d] = std::max<std::size_t>(1, static_cast<std::size_t>(fit));
    level.per_length[d] = length > 0 ? static_cast<double>(level.cells[d]) / length : 0;
  }
  level.counts.resize(level.cells[0] * level.cells[1] * level.cells[2]);
  level.entries.resize(level.counts.size() * level.capacity);
  return level;
}

double PlacedParticles::distance() const {
  double sum = 0;
  for (const double radius : radii_) sum += radius;
  const double mean =
      radii_.front() == radii_.back() ? radii_.front() : sum / static_cast<double>(radii_.size());
  return 2 * mean + gap_;
}

void PlacedParticles::add(const Vector& x) {
  const std::size_t k = centres_.size();
  assert(k < count());
  auto& level = levels_[level_of_[k]];
  cell_of_[k] = cell_of(level, x);
  insert(level, cell_of_[k], {x, radii_[k], k});
  centres_.push_back(x);
  place_of_.push_back(place_of(x));
  came_.push_back(comings_++);
}

void PlacedParticles::move(std::size_t k, const Vector& x) {
  auto& level = levels_[level_of_[k]];
  const std::size_t before = cell_of_[k], now = cell_of(level, x);
  const std::size_t index = index_in(level, before, k);
  if (before == now) {
    level.entries[index].centre = x;
  } else {
    level.entries[index] = level.entries[before * level.capacity + --level.counts[before]];
    insert(level, now, {x, radii_[k], k});
    cell_of_[k] = now;
  }
  centres_[k] = x;
  const auto place = place_of(x);
  if (place == place_of_[k]) return;
  place_of_[k] = place;
  came_[k] = comings_++;
}

void PlacedParticles::insert(Level& level, std::size_t cell, const Entry& entry) {
  if (level.counts[cell] == level.capacity) {
    std::vector<Entry> wider(2 * level.entries.size());
    for (std::size_t i = 0; i < level.counts.size(); ++i)
      std::copy_n(&level.entries[i * level.capacity], level.counts[i],
                  &wider[2 * i * level.capacity]);
    level.entries = std::move(wider);
    level.capacity *= 2;
  }
  level.entries[cell * level.capacity + level.counts[cell]++] = entry;
}

std::size_t PlacedParticles::index_in(const Level& level, std::size_t cell, std::size_t k) {
  std::size_t index = cell * level.capacity;
  while (level.entries[index].number != k) ++index;
  assert(index < cell * level.capacity + level.counts[cell]);
  return index;
}

std::size_t PlacedParticles::cell_of(const Level& level, const Vector& x) const {
  std::array<std::size_t, 3> at{};
  for (std::size_t d = 0; d < dimension(); ++d) {
    const double cell = (x[d] - widest_places().from(d)) * level.per_length[d];
    at[d] = std::min(level.cells[d] - 1, cell > 0 ? static_cast<std::size_t>(cell) : 0);
  }
  return (at[0] * level.cells[1] + at[1]) * level.cells[2] + at[2];
}

PlacedParticles::Range PlacedParticles::range(const Level& level, std::size_t d, double x,
                                              double reach) const {
  const auto n = static_cast<std::int64_t>(level.cells[d]);
  const double at = (x - widest_places().from(d)) * level.per_length[d];
  const double half = reach * level.per_length[d];
  // A reach over the whole length is cut, because it might not be a 64-bit number.
  if (!(2 * half < static_cast<double>(n))) return {0, level.cells[d]};
  auto first = static_cast<std::int64_t>(std::floor(at - half)),
       last = static_cast<std::int64_t>(std::floor(at + half));
  if (widest_places().period(d) == 0) {
    first = std::clamp<std::int64_t>(first, 0, n - 1);
    last = std::clamp<std::int64_t>(last, 0, n - 1);
  } else if (last - first + 1 >= n) {
    return {0, level.cells[d]};
  }
  return {static_cast<std::size_t>(first < 0 ? first + n : first),
          static_cast<std::size_t>(last - first + 1)};
}

template <class Visit>
bool PlacedParticles::any_close(const Vector& x, std::size_t self, double factor,
                                const Visit& visit) const {
  // Slightly more than the rounding errors of the places of cells.
  constexpr double kWider = 1 + 1e-9;
  const auto& everywhere = widest_places();
  const double radius = radii_[self];
  for (const auto& level : levels_) {
    const double reach = kWider * factor * (radius + level.largest + gap_);
    std::array<Range, 3> ranges{{{0, 1}, {0, 1}, {0, 1}}};
    for (std::size_t d = 0; d < dimension(); ++d) ranges[d] = range(level, d, x[d], reach);
    std::size_t i = ranges[0].first;
    for (std::size_t a = 0; a < ranges[0].count; ++a, i = i + 1 == level.cells[0] ? 0 : i + 1) {
      std::size_t j = ranges[1].first;
      for (std::size_t b = 0; b < ranges[1].count; ++b, j = j + 1 == level.cells[1] ? 0 : j + 1) {
        const std::size_t row = (i * level.cells[1] + j) * level.cells[2];
        std::size_t l = ranges[2].first;
        for (std::size_t c = 0; c < ranges[2].count; ++c, l = l + 1 == level.cells[2] ? 0 : l + 1) {
          const Entry* entry = &level.entries[(row + l) * level.capacity];
          for (const Entry* end = entry + level.counts[row + l]; entry != end; ++entry) {
            if (entry->number == self) continue;
            const Vector apart = everywhere.difference(x, entry->centre);
            const double distance = entry->radius + radius + gap_, least = factor * distance;
            if (apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2] < least * least &&
                visit(apart, distance, *entry))
              return true;
          }
        }
      }
    }
  }
  return false;
}

bool PlacedParticles::is_free(const Vector& x, std::size_t self) const {
  if (places(self).has_planes() && !places(self).contain(x)) return false;
  for (const auto& fixed : fixed_) {
    const Vector apart = widest_places().difference(x, fixed.centre);
    const double least = fixed.radius + radii_[self] + gap_;
    if (apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2] < least * least)
      return false;
  }
  return !any_close(x, self, 1, [](const auto&...) { return true; });
}

bool PlacedParticles::are_all_free() const {
  for (std::size_t k = 0; k < centres_.size(); ++k)
    if (!is_free(centres_[k], k)) return false;
  return true;
}

PlacedParticles::Place PlacedParticles::place_of(const Vector& x) const {
  Place place{};
  for (std::size_t d = 0; d < dimension(); ++d) {
    const double share = (x[d] - widest_places().from(d)) / widest_places().length(d);
    const double at = share > 0 ? share * static_cast<double>(order_cells_[d]) : 0;
    place[d] = std::min(order_cells_[d] - 1, static_cast<std::uint32_t>(at));
  }
  return place;
}

std::uint32_t PlacedParticles::rank(std::uint32_t home, std::uint32_t other, std::size_t d) const {
  if (other == home) return 0;
  const std::uint32_t n = order_cells_[d];
  const bool is_ring = widest_places().period(d) > 0 && n > 2;
  if (other + 1 == home || (is_ring && home == 0 && other == n - 1)) return 1;
  if (other == home + 1 || (is_ring && other == 0 && home == n - 1)) return 2;
  return 3;
}

void PlacedParticles::close_to(std::size_t self, double factor,
                               std::vector<CloseParticle>& close) const {
  assert(1 <= factor && factor <= 1.001);
  close.clear();
  const Vector& x = centres_[self];
  for (const auto& fixed : fixed_) {
    const Vector apart = widest_places().difference(x, fixed.centre);
    const double distance = fixed.radius + radii_[self] + gap_, least = factor * distance;
    if (apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2] < least * least)
      close.push_back({apart, distance, true, 0});
  }
  const std::size_t begin = close.size();
  const Place home = place_of_[self];
  any_close(x, self, factor, [&](const Vector& apart, double distance, const Entry& entry) {
    const Place& place = place_of_[entry.number];
    std::uint64_t cell = 0;
    for (const std::size_t d : {0U, 1U, 2U}) {
      const auto at = rank(home[d], place[d], d);
      if (at > 2) return false;  // beyond the cells beside: between distance and factor * distance
      cell = 3 * cell + at;
    }
    close.push_back({apart, distance, false, (cell << 58U) | came_[entry.number]});
    return false;
  });
  // A few entries: insertion is faster than std::sort.
  for (std::size_t i = begin + 1; i < close.size(); ++i)
    for (std::size_t j = i; j > begin && close[j].key < close[j - 1].key; --j)
      std::swap(close[j], close[j - 1]);
}

}  // namespace viscontact::particles
