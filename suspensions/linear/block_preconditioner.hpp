// A preconditioner of R: the blocks of all spheres, the squeezes of the strongest pairs, and the
// translation of all spheres.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/suspensions/pairs/resistance.hpp"
#include "viscontact/suspensions/values/lanes.hpp"

namespace viscontact::suspensions {

/// The columns of a 3 x 3 matrix.
struct alignas(kLaneAlignment) Columns {
  std::array<Lanes, 3> columns{};
  Lanes& operator[](std::size_t c) { return columns[c]; }
  const Lanes& operator[](std::size_t c) const { return columns[c]; }
};

/// Approximates R by the 6 x 6 blocks of the spheres and by the forces between the velocities of
/// the pairs whose squeezes are largest, and factors this without fill (incomplete Cholesky
/// factors). To this the inverse of what all spheres resist together is added: with little drag the
/// rest does not see a translation of all spheres. The order of the factors does not depend on that
/// of the spheres, and spheres of one round of it have no strong pairs with each other, so that
/// threads share them.
class BlockPreconditioner {
 public:
  BlockPreconditioner(const Resistance& resistance, ThreadPool& pool);
  /// motions = M^-1 loads. Returns loads.M^-1 loads.
  double apply(std::span<const Motion> loads, std::span<Motion> motions, ThreadPool& pool) const;

 private:
  struct Block;
  struct Graph;
  // Forces of a node by the velocity of a later one. Floats would do but for frames and units, in
  // which they are rounded differently.
  struct Coupling {
    std::array<double, 9> entries{};  // components xx, yx, zx, xy, ...
    std::int32_t node = 0;            // the later node; in the end its sphere
    Columns matrix() const {
      const auto& e = entries;
      return {{Lanes{e[0], e[1], e[2], 0}, Lanes{e[3], e[4], e[5], 0}, Lanes{e[6], e[7], e[8], 0}}};
    }
  };
  void add_blocks(const Resistance& resistance, std::vector<Block>& blocks, ThreadPool& pool) const;
  // Forces by angular velocities and torques by velocities of a sphere, of its own block.
  Lanes force_by(std::size_t sphere, const Lanes& turn) const;
  Lanes torque_by(std::size_t sphere, const Lanes& move) const;
  void factor(const Resistance& resistance, std::vector<Block>& blocks, ThreadPool& pool);

  struct alignas(kLaneAlignment) Turning {
    Columns inverse{};  // of torques by angular velocities
    Lanes mixed{};      // an angular velocity w has the force `mixed` x w
  };
  std::vector<Turning> turning_;  // of the spheres
  // The forces by angular velocities that `mixed` does not have; empty if no contact slips.
  std::vector<Columns> slipping_;
  // By node, which is the place of a sphere in the order of the factors.
  std::vector<std::int32_t> spheres_;
  std::vector<Columns> moves_;  // inverses of forces by velocities, less what earlier nodes bear
  std::vector<std::size_t> rounds_;  // where they begin, and the end
  // Strong pairs with later and earlier nodes; the coupling has the force of this node by the
  // velocity of the later one.
  std::vector<std::uint32_t> later_, earlier_;
  std::vector<Coupling> couplings_;
  struct Earlier {
    std::int32_t node = 0;  // in the end its sphere
    std::uint32_t coupling = 0;
  };
  std::vector<Earlier> earlier_pairs_;
  Columns translation_{};
};

}  // namespace viscontact::suspensions
