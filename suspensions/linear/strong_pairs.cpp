// Strong pairs, and rounds of spheres that have fewer of them than their neighbours.
#include "viscontact/suspensions/linear/strong_pairs.hpp"

#include <algorithm>
#include <functional>
#include <span>
#include <utility>

#include "viscontact/common/index.hpp"

namespace viscontact::suspensions {
namespace {

struct StrengthTuning {
  // Strong pairs for each sphere. Of 10 000 spheres at the volume fraction 0.55, sheared, a
  // reduction by 1e-3 takes 102 iterations without strong pairs, 37 with 1.6, 38 with 2, 60 with
  // 3.4.
  static constexpr double kStrongPairs = 1.7;
  // Pairs of this part of the least squeeze are strong, too, because equal squeezes have rounding
  // errors.
  static constexpr double kEqual = 1 - 1e-6;
  // Chunks of near spheres, and the least and the most spheres of one. Three quarters of the spheres
  // need only earlier ones of their own chunk.
  static constexpr std::size_t kChunks = 8, kLeastSpheres = 512, kMostSpheres = 2048;
  // Nodes in a chunk of spheres that are not near.
  static constexpr std::uint32_t kNodes = 512;
};

/// Rows of the strong pairs.
std::vector<std::uint32_t> strong_rows(const Resistance& resistance, ThreadPool& pool) {
  const auto& rows = resistance.pairs;
  const auto most = static_cast<std::size_t>(StrengthTuning::kStrongPairs *
                                             static_cast<double>(resistance.free_count()));
  double least = 0;
  if (most < rows.size()) {
    std::vector<double> squeezes(rows.size());
    pool.for_blocks(
        rows.size(),
        [&](std::size_t from, std::size_t end) {
          for (std::size_t p = from; p < end; ++p) squeezes[p] = rows[p].squeeze;
        },
        kPairsInBlock);
    const auto nth = squeezes.begin() + static_cast<std::ptrdiff_t>(most);
    std::ranges::nth_element(squeezes, nth, std::greater<>());
    least = StrengthTuning::kEqual * *nth;
  }
  using Strong = ConcatenatedBlocks<std::uint32_t>;
  return pool
      .sum_of_blocks<Strong>(
          rows.size(),
          [&](std::size_t from, std::size_t end) {
            Strong found;
            for (std::size_t p = from; p < end; ++p)
              if (rows[p].squeeze > 0 && rows[p].squeeze >= least &&
                  index_of(rows[p].second) < resistance.free_count())
                found.values.push_back(static_cast<std::uint32_t>(p));
            return found;
          },
          kPairsInBlock)
      .values;
}

}  // namespace

/// The strong pairs of each sphere.
struct StrongPairs::Graph {
  struct Edge {
    std::int32_t sphere = 0;
    std::uint32_t row = 0;
  };
  std::vector<std::uint32_t> begin;
  std::vector<Edge> edges;

  Graph(const Resistance& resistance, const std::vector<std::uint32_t>& strong)
      : begin(resistance.free_count() + 1, 0), edges(2 * strong.size()) {
    const auto& rows = resistance.pairs;
    for (const auto p : strong) {
      ++begin[index_of(rows[p].first) + 1];
      ++begin[index_of(rows[p].second) + 1];
    }
    for (std::size_t k = 1; k < begin.size(); ++k) begin[k] += begin[k - 1];
    auto next = begin;
    for (const auto p : strong) {
      edges[next[index_of(rows[p].first)]++] = {rows[p].second, p};
      edges[next[index_of(rows[p].second)]++] = {rows[p].first, p};
    }
  }
  std::span<const Edge> of(std::int32_t sphere) const {
    const auto k = index_of(sphere);
    return std::span(edges).subspan(begin[k], begin[k + 1] - begin[k]);
  }
};

struct StrongPairs::Sphere {
  double squeezes = 0;      // of its strong pairs
  std::int32_t degree = 0;  // strong pairs with spheres that are left
  std::int32_t round = -1;
  std::uint32_t chunk = 0;
  std::uint32_t node = 0;
};

StrongPairs::StrongPairs(const Resistance& resistance, ThreadPool& pool) {
  const Graph graph(resistance, strong_rows(resistance, pool));
  auto all = find_rounds(resistance, graph);
  find_stages(graph, all);
  list_pairs(graph, all);
}

std::vector<StrongPairs::Sphere> StrongPairs::find_rounds(const Resistance& resistance,
                                                          const Graph& graph) {
  const std::size_t count = resistance.free_count();
  std::vector<Sphere> all(count);
  std::vector<std::int32_t> left(count);
  for (std::size_t k = 0; k < count; ++k) {
    left[k] = static_cast<std::int32_t>(k);
    const auto edges = graph.of(left[k]);
    all[k].degree = static_cast<std::int32_t>(edges.size());
    for (const auto& edge : edges) all[k].squeezes += resistance.pairs[edge.row].squeeze;
  }
  const auto is_before = [&](std::int32_t a, std::int32_t b) {
    const auto &one = all[index_of(a)], &two = all[index_of(b)];
    return one.degree != two.degree
               ? one.degree < two.degree
               : (one.squeezes != two.squeezes ? one.squeezes < two.squeezes : a < b);
  };
  spheres.reserve(count);
  for (std::int32_t round = 0; !left.empty(); ++round) {
    const std::size_t begin = spheres.size();
    for (const auto k : left)
      if (std::ranges::none_of(graph.of(k), [&](const Graph::Edge& edge) {
            return all[index_of(edge.sphere)].round < 0 && is_before(edge.sphere, k);
          }))
        spheres.push_back(k);
    for (const auto k : std::span(spheres).subspan(begin)) {
      all[index_of(k)].round = round;
      for (const auto& edge : graph.of(k)) --all[index_of(edge.sphere)].degree;
    }
    std::erase_if(left, [&](std::int32_t k) { return all[index_of(k)].round >= 0; });
  }
  return all;
}

void StrongPairs::find_stages(const Graph& graph, std::vector<Sphere>& all) {
  // Most spheres need only earlier ones of their own block, others only those of blocks that are
  // shifted by a half; the rest has rounds.
  const std::size_t size = std::clamp(all.size() / StrengthTuning::kChunks,
                                      StrengthTuning::kLeastSpheres, StrengthTuning::kMostSpheres);
  const auto blocks = static_cast<std::uint32_t>(all.size() / size + 1), shifted = blocks + 1,
             rounds = blocks + shifted;
  std::vector<std::uint32_t> counts(rounds, 0);
  for (const auto k : spheres) {
    const auto block = static_cast<std::uint32_t>(index_of(k) / size),
               shift = blocks + static_cast<std::uint32_t>((index_of(k) + size / 2) / size);
    auto& chunk = all[index_of(k)].chunk;
    chunk = block;
    for (const auto& edge : graph.of(k)) {
      const auto& other = all[index_of(edge.sphere)];
      if (other.round >= all[index_of(k)].round) continue;
      if (chunk < blocks && other.chunk != block) chunk = shift;
      if (chunk >= blocks && other.chunk >= blocks && other.chunk != shift)
        chunk = std::max({chunk, rounds, other.chunk + 1});
    }
    if (chunk >= counts.size()) counts.resize(chunk + 1, 0);
    ++counts[chunk];
  }
  std::uint32_t begin = 0;
  for (std::uint32_t c = 0; c < counts.size(); ++c) {
    if (c == 0 || c == blocks || c >= rounds)
      stages.push_back(static_cast<std::uint32_t>(chunks.size()));
    const std::uint32_t end = begin + std::exchange(counts[c], begin);
    const auto most = c < rounds ? static_cast<std::uint32_t>(size) : StrengthTuning::kNodes;
    for (; begin < end; begin = std::min(begin + most, end)) chunks.push_back(begin);
  }
  stages.push_back(static_cast<std::uint32_t>(chunks.size()));
  chunks.push_back(begin);
  for (const auto k : spheres) all[index_of(k)].node = counts[all[index_of(k)].chunk]++;
  for (std::size_t k = 0; k < all.size(); ++k) spheres[all[k].node] = static_cast<std::int32_t>(k);
}

void StrongPairs::list_pairs(const Graph& graph, const std::vector<Sphere>& all) {
  const std::size_t count = spheres.size();
  pairs.reserve(graph.edges.size() / 2);
  pairs_begin.assign(count + 1, 0);
  with_earlier_begin.assign(count + 1, 0);
  for (std::size_t t = 0; t < count; ++t) {
    for (const auto& edge : graph.of(spheres[t])) {
      const auto other = all[index_of(edge.sphere)].node;
      if (other < t) continue;
      pairs.push_back({spheres[t], edge.sphere, edge.row});
      ++with_earlier_begin[other + 1];
    }
    pairs_begin[t + 1] = static_cast<std::uint32_t>(pairs.size());
  }
  for (std::size_t t = 0; t < count; ++t) with_earlier_begin[t + 1] += with_earlier_begin[t];
  with_earlier.resize(pairs.size());
  auto next = with_earlier_begin;
  for (std::size_t e = 0; e < pairs.size(); ++e)
    with_earlier[next[all[index_of(pairs[e].later)].node]++] = static_cast<std::uint32_t>(e);
}

}  // namespace viscontact::suspensions
