// A preconditioner of R: the blocks of all spheres, the squeezes of the strongest pairs, and the
// translation of all spheres.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/suspensions/linear/strong_pairs.hpp"
#include "viscontact/suspensions/pairs/resistance.hpp"
#include "viscontact/suspensions/values/lanes.hpp"

namespace viscontact::suspensions {

/// Approximates R by the 6 x 6 blocks of the spheres and by the forces between the velocities of
/// strong pairs, and factors this without fill: what an earlier sphere of the order adds to a pair
/// of later ones is left out. Each factor of a pair is therefore a dyad of its normal. To this the
/// inverse of what all spheres resist together is added: with little drag the rest does not see a
/// translation of all spheres.
class BlockPreconditioner {
 public:
  /// Factors `resistance`. The strong pairs and their order stay those of an earlier call since
  /// forget_order(), with the same pairs and spheres.
  void set(const Resistance& resistance, ThreadPool& pool);
  void forget_order() { strong_ = {}; }
  /// Subtracts length times `motions` from the loads, and then sets motions = M^-1 loads. Returns
  /// loads.M^-1 loads.
  double subtract_and_solve(double length, std::span<Motion> loads, std::span<Motion> motions,
                            ThreadPool& pool) const;

 private:
  // Components xx, xy, xz, yy, yz, zz.
  using Symmetric = std::array<double, 6>;
  // Sets the nodes to the blocks of their spheres. Returns the nodes of the spheres.
  std::vector<std::int32_t> add_blocks(const Resistance& resistance, ThreadPool& pool);
  // Forces by angular velocities and torques by velocities of a sphere, of its own block.
  Lanes force_by(std::size_t node, const Lanes& turn) const;
  Lanes torque_by(std::size_t node, const Lanes& move) const;
  void eliminate_turns(std::size_t node);

  // Of a node at first the block of its sphere, then the inverses in the factors.
  struct alignas(64) Node {
    Symmetric move{};               // forces by velocities, at last less what earlier nodes bear
    Symmetric turn{};               // torques by angular velocities
    std::array<double, 4> mixed{};  // an angular velocity w has the force `mixed` x w
  };
  StrongPairs strong_;
  std::vector<Node> nodes_;
  // The forces by angular velocities that `mixed` does not have, by columns; empty if no contact
  // slips.
  std::vector<std::array<double, 9>> slipping_;
  // The roots of the squeezes of strong pairs, along their normals.
  struct alignas(kLaneAlignment) Root {
    Lanes along{};
  };
  std::vector<Root> roots_;
  Symmetric translation_{};
};

}  // namespace viscontact::suspensions
