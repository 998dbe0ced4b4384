// Only + - * / and sqrt are used, and nothing is fused (-ffp-contract=off in CMakeLists.txt), so
// that every machine computes the same bits.
#include "viscontact/arrangement/placed_particles.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <utility>

namespace viscontact::particles {
namespace {

constexpr double kLargestFactor = 1.001;  // of close_to()

}  // namespace

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
    : places_(places),
      radii_(std::move(radii)),
      gap_(gap),
      fixed_(std::move(fixed)),
      slack_(ArrangementTuning::kSlack * (2 * radii_.back() + gap_)) {
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
  has_lists_ = false;
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
  if (has_lists_ && !is_near_listed(x, k)) has_lists_ = false;
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
  const Range all{.count = n, .cells = n};
  // A reach over the whole length may be too large for a 64-bit number.
  if (!(2 * half < static_cast<double>(n))) return all;
  // The sum is positive, so that the cast is the floor.
  const auto shift = static_cast<double>(2 * n);
  auto first = static_cast<std::int64_t>(at - half + shift) - 2 * n,
       last = static_cast<std::int64_t>(at + half + shift) - 2 * n;
  auto home = static_cast<std::int64_t>(at);
  if (widest_places().period(d) == 0) {
    first = std::clamp<std::int64_t>(first, 0, n - 1);
    last = std::clamp<std::int64_t>(last, 0, n - 1);
    home = std::clamp<std::int64_t>(home, 0, n - 1);
  } else if (last - first + 1 >= n) {
    return all;
  }
  return {first, last - first + 1, n, home - first, at, 1 / level.per_length[d]};
}

template <class Visit>
bool PlacedParticles::any_in_cells(const Vector& x, std::size_t self, double factor, double further,
                                   const Visit& visit) const {
  // Slightly more than the rounding errors of the places of cells.
  constexpr double kWider = 1 + 1e-9;
  const auto& everywhere = widest_places();
  const double radius = radii_[self];
  for (const auto& level : levels_) {
    const double reach = kWider * (factor * (radius + level.largest + gap_) + further),
                 reach2 = reach * reach;
    std::array<Range, 3> ranges{};
    for (std::size_t d = 0; d < dimension(); ++d) ranges[d] = range(level, d, x[d], reach);
    for (std::int64_t i = 0; i < ranges[0].count; ++i) {
      const auto i0 = ranges[0].visited(i);
      const double d0 = ranges[0].distance2(i0);
      for (std::int64_t j = 0; j < ranges[1].count; ++j) {
        const auto j0 = ranges[1].visited(j);
        const double d1 = d0 + ranges[1].distance2(j0);
        if (d1 > reach2) continue;
        const std::size_t row =
            (ranges[0].cell(i0) * level.cells[1] + ranges[1].cell(j0)) * level.cells[2];
        for (std::int64_t l = 0; l < ranges[2].count; ++l) {
          const auto l0 = ranges[2].visited(l);
          const std::size_t cell = row + ranges[2].cell(l0);
          const Entry* entry = &level.entries[cell * level.capacity];
          for (const Entry* end = entry + level.counts[cell]; entry != end; ++entry) {
            if (entry->number == self) continue;
            const Vector apart = everywhere.difference(x, entry->centre);
            const double distance = entry->radius + radius + gap_,
                         least = factor * distance + further;
            if (apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2] < least * least &&
                visit(apart, distance, entry->number))
              return true;
          }
        }
      }
    }
  }
  return false;
}

template <class Visit>
bool PlacedParticles::any_listed(const Vector& x, std::size_t self, double factor,
                                 const Visit& visit) const {
  const auto& everywhere = widest_places();
  const double radius = radii_[self];
  for (std::size_t i = first_neighbour_[self]; i < first_neighbour_[self + 1]; ++i) {
    const std::size_t k = neighbours_[i];
    const Vector apart = everywhere.difference(x, centres_[k]);
    const double distance = radii_[k] + radius + gap_, least = factor * distance;
    if (apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2] < least * least &&
        visit(apart, distance, k))
      return true;
  }
  return false;
}

std::vector<ClosePair> PlacedParticles::pairs(double further) const {
  std::vector<ClosePair> all;
  for (std::size_t k = 0; k < centres_.size(); ++k) {
    const auto first = static_cast<std::uint32_t>(k);
    any_in_cells(centres_[k], k, 1, further, [&](const auto&, double distance, std::size_t other) {
      if (other > k) all.push_back({first, static_cast<std::uint32_t>(other), false, distance});
      return false;
    });
    for (std::size_t j = 0; j < fixed_.size(); ++j) {
      const Vector apart = widest_places().difference(centres_[k], fixed_[j].centre);
      const double distance = fixed_[j].radius + radii_[k] + gap_, least = distance + further;
      if (apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2] < least * least)
        all.push_back({first, static_cast<std::uint32_t>(j), true, distance});
    }
  }
  return all;
}

bool PlacedParticles::is_near_listed(const Vector& x, std::size_t k) const {
  const Vector apart = widest_places().difference(listed_[k], x);
  return apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2] <= slack_ * slack_;
}

bool PlacedParticles::are_listed(const Vector& x, std::size_t self) {
  ++queries_;
  if (has_lists_ && is_near_listed(x, self)) return true;
  if (queries_ < first_query_ || centres_.size() < count()) return false;
  // Lists that are of use for a few queries of each particle cost more than they save. The next
  // ones are made later.
  first_query_ =
      queries_ < ArrangementTuning::kUses * count() ? ArrangementTuning::kPause * count() : 0;
  queries_ = 0;
  if (first_query_ > 0) {
    has_lists_ = false;
    return false;
  }
  make_lists();
  return is_near_listed(x, self);
}

void PlacedParticles::make_lists() {
  neighbours_.clear();
  first_neighbour_.assign(1, 0);
  listed_ = centres_;
  for (std::size_t k = 0; k < count(); ++k) {
    any_in_cells(centres_[k], k, kLargestFactor, 2 * slack_,
                 [&](const auto&, double, std::size_t other) {
                   neighbours_.push_back(static_cast<std::uint32_t>(other));
                   return false;
                 });
    first_neighbour_.push_back(neighbours_.size());
  }
  has_lists_ = true;
}

bool PlacedParticles::is_free(const Vector& x, std::size_t self) const {
  if (places(self).has_planes() && !places(self).contain(x)) return false;
  for (const auto& fixed : fixed_) {
    const Vector apart = widest_places().difference(x, fixed.centre);
    const double least = fixed.radius + radii_[self] + gap_;
    if (apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2] < least * least)
      return false;
  }
  return !any_in_cells(x, self, 1, 0, [](const auto&...) { return true; });
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

void PlacedParticles::close_to(std::size_t self, double factor, std::vector<CloseParticle>& close) {
  assert(1 <= factor && factor <= kLargestFactor);
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
  const auto visit = [&](const Vector& apart, double distance, std::size_t k) {
    const Place& place = place_of_[k];
    std::uint64_t cell = 0;
    for (const std::size_t d : {0U, 1U, 2U}) {
      const auto at = rank(home[d], place[d], d);
      if (at > 2) return false;  // beyond the cells beside: between distance and factor * distance
      cell = 3 * cell + at;
    }
    close.push_back({apart, distance, false, (cell << 58U) | came_[k]});
    return false;
  };
  if (are_listed(x, self))
    any_listed(x, self, factor, visit);
  else
    any_in_cells(x, self, factor, 0, visit);
  // A few entries: insertion is faster than std::sort.
  for (std::size_t i = begin + 1; i < close.size(); ++i)
    for (std::size_t j = i; j > begin && close[j].key < close[j - 1].key; --j)
      std::swap(close[j], close[j - 1]);
}

}  // namespace viscontact::particles
