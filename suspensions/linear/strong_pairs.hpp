// The pairs whose squeezes are largest, and an order of the spheres for factors of these squeezes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/suspensions/pairs/resistance.hpp"

namespace viscontact::suspensions {

/// A node is the place of a sphere in an order in which each has been the one with the fewest
/// strong pairs among its neighbours that are left. Which of two spheres is earlier does not depend
/// on the order of all spheres. Stages follow each other, and threads share the chunks of a stage:
/// no strong pair connects two of them.
struct StrongPairs {
  StrongPairs() = default;
  StrongPairs(const Resistance& resistance, ThreadPool& pool);

  struct Pair {
    std::int32_t earlier = 0, later = 0;  ///< spheres
    std::uint32_t row = 0;                ///< of Resistance::pairs
  };
  std::vector<Pair> pairs;                        ///< in order of their earlier nodes
  std::vector<std::int32_t> spheres;              ///< of the nodes
  std::vector<std::uint32_t> chunks, stages;      ///< begins in nodes and in chunks, and the ends
  std::vector<std::uint32_t> pairs_begin;         ///< begins of `pairs` by their earlier nodes
  std::vector<std::uint32_t> with_earlier_begin;  ///< of with_earlier, by later nodes
  std::vector<std::uint32_t> with_earlier;        ///< numbers of pairs

 private:
  struct Graph;
  struct Sphere;
  // Sets the rounds of the spheres: those of one round have no strong pairs with each other.
  std::vector<Sphere> find_rounds(const Resistance& resistance, const Graph& graph);
  void find_stages(const Graph& graph, std::vector<Sphere>& all);
  void list_pairs(const Graph& graph, const std::vector<Sphere>& all);
};

}  // namespace viscontact::suspensions
