// Numbers that contact laws remember of a pair of bodies from step to step, besides Pair::gamma.
// Restart files, tables and VTK files take their names from kMemoryFields.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "viscontact/particles/values/vector.hpp"

namespace viscontact::particles {

/// The numbers in a PairMemory, in the order of kMemoryFields. Those of discs in a fluid are per
/// length.
enum class Remembered : std::uint8_t {
  /// x of the impulse of friction on Pair::second in the last step [M L/T]. This vector is
  /// tangential; the solver of the next step takes it as its first guess.
  kFrictionX,
  kFrictionY,  ///< [M L/T]
  kFrictionZ,  ///< [M L/T]
  kSolidLoad,  ///< part of the normal impulse of the last step that the solids carried and not the
               ///< film [M L/T], >= 0: p_s of docs/physics.md (5.7), which bounds the friction
  /// x of the impulse across the normal [M L/T] with which a film that pulls acted on Pair::second
  /// in the last step, docs/physics.md (5.21). It acts on the centres and turns no particle.
  kAcrossX,
  kAcrossY,  ///< [M L/T]
  kAcrossZ,  ///< [M L/T]
  kCount,    ///< it must stay the last one
};

struct MemoryField {
  std::string_view name;  ///< name of the number in restart files and of its column in tables
  bool is_impulse;        ///< whether it is an impulse, added over the parts of a divided step
  bool is_shown;          ///< whether contacts.csv and the VTK files of output times have it
};

/// All numbers that laws remember. Restart files store them by name, so that names stay as they
/// are; "carried" is the name of Remembered::kSolidLoad there.
inline constexpr std::array kMemoryFields = {
    MemoryField{"friction_x", true, false}, MemoryField{"friction_y", true, false},
    MemoryField{"friction_z", true, false}, MemoryField{"carried", true, false},
    MemoryField{"across_x", true, false},   MemoryField{"across_y", true, false},
    MemoryField{"across_z", true, false},
};

static_assert(kMemoryFields.size() == static_cast<std::size_t>(Remembered::kCount),
              "each place of Remembered needs its row, in the same order");

/// The numbers of one pair whose MemoryField::is_shown is true, in the order of kMemoryFields.
using ShownMemory = std::array<double, static_cast<std::size_t>(std::ranges::count_if(
                                           kMemoryFields, &MemoryField::is_shown))>;

/// All numbers of one pair, which are 0 if nothing is remembered.
class PairMemory {
 public:
  double& operator[](Remembered field) { return values_[static_cast<std::size_t>(field)]; }
  double operator[](Remembered field) const { return values_[static_cast<std::size_t>(field)]; }
  /// The numbers in the order of kMemoryFields.
  std::array<double, kMemoryFields.size()>& values() { return values_; }
  const std::array<double, kMemoryFields.size()>& values() const { return values_; }

  ShownMemory shown() const {
    ShownMemory numbers{};
    auto number = numbers.begin();
    for (std::size_t f = 0; f < kMemoryFields.size(); ++f)
      if (kMemoryFields[f].is_shown) *number++ = values_[f];
    return numbers;
  }

  Vector friction() const { return vector_at(Remembered::kFrictionX); }
  void set_friction(const Vector& p) { set_vector(Remembered::kFrictionX, p); }
  Vector across() const { return vector_at(Remembered::kAcrossX); }
  void set_across(const Vector& p) { set_vector(Remembered::kAcrossX, p); }
  bool operator==(const PairMemory&) const = default;

 private:
  Vector vector_at(Remembered x) const {
    const auto first = values_.begin() + static_cast<std::ptrdiff_t>(x);
    return {first[0], first[1], first[2]};
  }
  void set_vector(Remembered x, const Vector& p) {
    std::ranges::copy(p, values_.begin() + static_cast<std::ptrdiff_t>(x));
  }

  std::array<double, kMemoryFields.size()> values_{};
};

/// The memories of the pairs of a state. A pair has a row here only if a law remembers something of
/// it, so that cases without such laws need no space in memory. A pair loses its memory when its
/// gamma is 0 and it leaves the lists of close pairs.
class PairMemories {
 public:
  /// Stands for the number of a row if the pair has no row.
  static constexpr std::int32_t kNone = -1;

  /// The memory with number `row` (Pair::memory), from 0; a memory of zeros if `row` is kNone.
  const PairMemory& of(std::int32_t row) const {
    assert(row >= kNone && row < static_cast<std::int32_t>(rows_.size()));
    static constexpr PairMemory kZeros{};
    return row == kNone ? kZeros : rows_[static_cast<std::size_t>(row)];
  }
  /// If `row` is kNone, a row of zeros is made and `row` becomes its number; references to other
  /// rows are then no longer valid.
  PairMemory& make(std::int32_t& row) {
    if (row == kNone) {
      row = static_cast<std::int32_t>(rows_.size());
      rows_.emplace_back();
    }
    assert(row >= 0 && row < static_cast<std::int32_t>(rows_.size()));
    return rows_[static_cast<std::size_t>(row)];
  }
  /// If `row` is kNone, a row is made as by make(), unless all numbers of `memory` are 0.
  void set(std::int32_t& row, const PairMemory& memory) {
    if (row != kNone || !(memory == PairMemory{})) make(row) = memory;
  }
  bool empty() const { return rows_.empty(); }

  /// Drops the rows of all pairs that are in none of `lists` (containers of Pair), and the rows of
  /// zeros. Pair::memory of each pair in `lists` becomes the new number of its row, or kNone.
  template <class... Lists>
  void keep_only(Lists&... lists) {
    if (rows_.empty()) return;
    PairMemories kept;
    const auto keep = [&](auto& pairs) {
      for (auto& pair : pairs) {
        const auto memory = of(pair.memory);
        pair.memory = kNone;
        kept.set(pair.memory, memory);
      }
    };
    (keep(lists), ...);
    *this = std::move(kept);
  }

 private:
  std::vector<PairMemory> rows_;
};

}  // namespace viscontact::particles
