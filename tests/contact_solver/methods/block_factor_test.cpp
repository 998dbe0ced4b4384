// The factors of small dense blocks against the formula of Woodbury, where stiff contacts of 1e10
// stand beside masses of 1, and in other units.
#include "viscontact/contact_solver/methods/block_factor.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "tests/common/random.hpp"

namespace viscontact::contact_solver {
namespace {

using Eigen::Index;

/// Masses, and contacts of two neighbouring bodies in a ring that add left^T stiffness right.
template <int K>
struct Chain {
  std::size_t bodies;
  Eigen::VectorXd masses;
  Eigen::MatrixXd left, right;  // a row for each contact
  Eigen::VectorXd stiffnesses;
  Eigen::VectorXd sides;  // right side of the equation

  /// With `unit` != 1 the last number of each body is one of an angle, in another unit of length.
  Chain(std::size_t count, bool is_symmetric, double unit, unsigned seed) : bodies(count) {
    Random random(seed);
    const auto contacts = static_cast<Index>(bodies), size = K * contacts;
    masses.resize(size);
    sides.resize(size);
    stiffnesses.resize(contacts);
    left = right = Eigen::MatrixXd::Zero(contacts, size);
    for (Index c = 0; c < contacts; ++c) {
      stiffnesses[c] = c % 2 == 0 ? 1e10 : 1;
      for (Index k = 0; k < 2 * K; ++k) {
        const Index at = (c * K + k) % size;
        right(c, at) = random.uniform(-1, 1);
        left(c, at) = right(c, at) + (is_symmetric ? 0 : random.uniform(-0.3, 0.3));
      }
    }
    for (Index i = 0; i < size; ++i) {
      const double scale = i % K == K - 1 ? unit : 1;
      masses[i] = random.uniform(1, 2) * scale * scale;
      sides[i] = random.uniform(-1, 1) * scale;
      left.col(i) *= scale;
      right.col(i) *= scale;
    }
  }

  /// The solution after this number of solutions with the factors.
  Eigen::VectorXd solved(bool is_symmetric, int solutions) const {
    constexpr auto k = static_cast<std::size_t>(K);
    BlockFactor<K> factor;
    std::vector<std::array<std::int32_t, 2>> edges;
    for (std::size_t c = 0; c < bodies; ++c)
      edges.push_back({static_cast<std::int32_t>(c), static_cast<std::int32_t>((c + 1) % bodies)});
    factor.analyse(bodies, edges, is_symmetric);
    factor.clear();
    for (std::size_t b = 0; b < bodies; ++b)
      for (std::size_t i = 0; i < k; ++i)
        factor.diagonal(b)[i * k + i] += masses[static_cast<Index>(b * k + i)];
    for (std::size_t c = 0; c < bodies; ++c) {
      const auto contact = static_cast<Index>(c);
      const std::array<std::size_t, 2> ends{c, (c + 1) % bodies};
      const auto add = [&](auto& block, std::size_t rows, std::size_t columns) {
        for (std::size_t i = 0; i < k; ++i)
          for (std::size_t j = 0; j < k; ++j)
            block[i * k + j] += left(contact, static_cast<Index>(rows * k + i)) *
                                stiffnesses[contact] *
                                right(contact, static_cast<Index>(columns * k + j));
      };
      for (const std::size_t from : {0U, 1U}) {
        add(factor.diagonal(ends[from]), ends[from], ends[from]);
        if (!is_symmetric || factor.is_below(c, from))
          add(factor.off_diagonal(c, from), ends[from], ends[1 - from]);
      }
    }
    EXPECT_TRUE(factor.factorise());
    Eigen::VectorXd solution = Eigen::VectorXd::Zero(sides.size());
    Eigen::VectorXd forces = Eigen::VectorXd::Zero(stiffnesses.size());
    std::vector<typename BlockFactor<K>::Vec> values(bodies);
    for (int n = 0; n < solutions; ++n) {
      // As in InteriorPoints: what is missing, with the forces of the contacts as they were found.
      const Eigen::VectorXd missing =
          sides - masses.cwiseProduct(solution) - left.transpose() * forces;
      for (std::size_t i = 0; i < k * bodies; ++i)
        values[i / k][i % k] = missing[static_cast<Index>(i)];
      factor.solve(values);
      Eigen::VectorXd change(sides.size());
      for (std::size_t i = 0; i < k * bodies; ++i)
        change[static_cast<Index>(i)] = values[i / k][i % k];
      solution += change;
      forces += stiffnesses.cwiseProduct(right * change);
    }
    return solution;
  }

  /// Woodbury (1950), "Inverting modified matrices": only sums of the order of 1 and of 1e-10
  /// occur.
  Eigen::VectorXd expected() const {
    const Eigen::VectorXd free = sides.cwiseQuotient(masses);
    const Eigen::MatrixXd moved = masses.cwiseInverse().asDiagonal() * left.transpose();
    Eigen::MatrixXd small = right * moved;
    small.diagonal() += stiffnesses.cwiseInverse();
    return free - moved * small.fullPivLu().solve(right * free);
  }
};

template <int K>
void expect_digits(std::size_t bodies, bool is_symmetric, unsigned seed) {
  const Chain<K> chain(bodies, is_symmetric, 1, seed);
  const auto expected = chain.expected();
  // Numbers of 1e10 have rounding errors of 1e-6 beside masses of 1. A second solution squares what
  // the first one leaves, but for the rounding errors of numbers of 1.
  for (const auto& [solutions, accuracy] : {std::pair(1, 1e-4), std::pair(2, 1e-10)})
    EXPECT_LE((chain.solved(is_symmetric, solutions) - expected).norm(), accuracy * expected.norm())
        << seed;
}

TEST(BlockFactor, SolvesStiffContactsBesideMassesInTwoSolutions) {
  for (unsigned seed = 1; seed <= 20; ++seed)
    for (const bool is_symmetric : {false, true}) {
      expect_digits<3>(6, is_symmetric, seed);
      expect_digits<6>(6, is_symmetric, seed);
    }
}

TEST(BlockFactor, SolvesManyBodiesInTheOrderOfNestedDissection) {
  for (const bool is_symmetric : {false, true}) expect_digits<6>(600, is_symmetric, 1);
}

TEST(BlockFactor, HasTheSameBitsInUnitsThatArePowersOfTwo) {
  for (unsigned seed = 1; seed <= 20; ++seed)
    for (const double unit : {0x1p-20, 0x1p20}) {
      const auto plain = Chain<3>(6, false, 1, seed).solved(false, 1);
      const auto scaled = Chain<3>(6, false, unit, seed).solved(false, 1);
      for (Index i = 0; i < plain.size(); ++i)
        EXPECT_EQ(scaled[i] * (i % 3 == 2 ? unit : 1), plain[i]) << seed << " " << i;
    }
}

}  // namespace
}  // namespace viscontact::contact_solver
