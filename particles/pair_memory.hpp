// What contact laws remember of a pair besides gamma. It is declared once, in kMemoryFields, from
// which the restart file, contacts.csv, final_contacts.csv and the frames take it. To add a memory,
// add a row to kMemoryFields and a place to Remembered, with the unit in its comment. A memory is
// dropped when gamma is 0 and the pair leaves the lists of close pairs; a law must not rely on it
// longer.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// The places in a PairMemory, in the order of kMemoryFields.
enum class Remembered : std::uint8_t {
  kFrictionX,  ///< x, y and z of the impulse of friction on Pair::second in the last step [M L/T],
  kFrictionY,  ///< which is tangential, and the first guess of the next step
  kFrictionZ,
  kCarried,  ///< part of the impulse of the last step that the solids carried [M L/T], >= 0: p_s of
             ///< docs/physics.md (5.7), which bounds the friction
  kCount,    ///< number of places
};

/// How files know a number that a law remembers.
struct MemoryField {
  std::string_view name;  ///< in restart files and as a column
  bool is_impulse;        ///< an impulse of the last step, summed over the parts of a divided step
  bool is_shown;          ///< whether contacts.csv and the frames have the number
};

/// All numbers that laws remember. Restart files store them by name.
inline constexpr std::array kMemoryFields = {
    MemoryField{"friction_x", true, false},
    MemoryField{"friction_y", true, false},
    MemoryField{"friction_z", true, false},
    MemoryField{"carried", true, false},
};

static_assert(kMemoryFields.size() == static_cast<std::size_t>(Remembered::kCount),
              "each place of Remembered needs its row, in the same order");

/// The shown numbers of one pair, in the order of kMemoryFields.
using ShownMemory = std::array<double, static_cast<std::size_t>(std::ranges::count_if(
                                           kMemoryFields, &MemoryField::is_shown))>;

/// The numbers of one pair; all are 0 where nothing is remembered.
class PairMemory {
 public:
  /// The number in one place, in the unit that Remembered says.
  double& operator[](Remembered field) { return values_[static_cast<std::size_t>(field)]; }
  /// The number in one place, in the unit that Remembered says.
  double operator[](Remembered field) const { return values_[static_cast<std::size_t>(field)]; }
  /// All numbers, in the order of kMemoryFields.
  std::array<double, kMemoryFields.size()>& values() { return values_; }
  /// All numbers, in the order of kMemoryFields.
  const std::array<double, kMemoryFields.size()>& values() const { return values_; }

  /// The numbers that files show.
  ShownMemory shown() const {
    ShownMemory numbers{};
    auto number = numbers.begin();
    for (std::size_t f = 0; f < kMemoryFields.size(); ++f)
      if (kMemoryFields[f].is_shown) *number++ = values_[f];
    return numbers;
  }

  /// Impulse of friction [M L/T].
  Vector friction() const {
    const auto first = values_.begin() + static_cast<std::ptrdiff_t>(Remembered::kFrictionX);
    return {first[0], first[1], first[2]};
  }
  /// Sets the impulse of friction [M L/T].
  void set_friction(const Vector& p) {
    std::ranges::copy(p, values_.begin() + static_cast<std::ptrdiff_t>(Remembered::kFrictionX));
  }
  /// True if all members are equal.
  bool operator==(const PairMemory&) const = default;

 private:
  std::array<double, kMemoryFields.size()> values_{};
};

/// The memories of the pairs of a state. A pair has a row here only if a law remembers something of
/// it, so that cases without such laws need no room for them.
class PairMemories {
 public:
  /// The number of no row.
  static constexpr std::int32_t kNone = -1;

  /// The memory with number `row` (Pair::memory); zeros if it is kNone.
  const PairMemory& of(std::int32_t row) const {
    static constexpr PairMemory kZeros{};
    return row == kNone ? kZeros : rows_[static_cast<std::size_t>(row)];
  }
  /// The memory with number `row`, which the caller may change. If `row` is kNone, a row of zeros
  /// is made and `row` becomes its number.
  PairMemory& make(std::int32_t& row) {
    if (row == kNone) {
      row = static_cast<std::int32_t>(rows_.size());
      rows_.emplace_back();
    }
    return rows_[static_cast<std::size_t>(row)];
  }
  /// Sets the memory of a pair, which has no row afterwards if `memory` is zero and it had none.
  void set(std::int32_t& row, const PairMemory& memory) {
    if (row != kNone || !(memory == PairMemory{})) make(row) = memory;
  }
  bool empty() const { return rows_.empty(); }  ///< whether nothing is remembered

  /// Drops the rows of pairs that are in none of the lists of Pair, and the rows that hold zeros
  /// only. The numbers Pair::memory change with the rows.
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
