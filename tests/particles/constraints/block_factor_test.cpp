// The factors of small dense blocks against the formula of Woodbury, where stiff contacts of 1e10
// stand beside masses of 1, and in other units.
#include "viscontact/particles/constraints/block_factor.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "tests/particles/systems.hpp"

namespace viscontact::particles {
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

/// Random matrices on a lattice in which each body is connected to the next one along each axis.
template <int K>
class Lattice {
 public:
  Lattice(std::array<std::size_t, 3> size, bool is_symmetric) : is_symmetric_(is_symmetric) {
    bodies_ = size[0] * size[1] * size[2];
    const std::array<std::size_t, 3> steps{1, size[0], size[0] * size[1]};
    for (std::size_t b = 0; b < bodies_; ++b)
      for (std::size_t d = 0; d < 3; ++d)
        if (b / steps[d] % size[d] + 1 < size[d])
          edges_.push_back({static_cast<std::int32_t>(b), static_cast<std::int32_t>(b + steps[d])});
    factor_.analyse(bodies_, edges_, is_symmetric);
  }

  /// The sign of the determinant and the solution for a random diagonally dominant matrix, the same
  /// in each call. `spoilt`: a body whose block on the diagonal is no number, so that factorise()
  /// must return false and nothing is returned; -1: none.
  std::optional<std::vector<double>> solution(ThreadPool* pool, int spoilt = -1) {
    Random random(1);
    factor_.clear();
    for (std::size_t e = 0; e < edges_.size(); ++e)
      for (const std::size_t from : {0U, 1U})
        if (!is_symmetric_ || factor_.is_below(e, from))
          for (double& number : factor_.off_diagonal(e, from)) number = random.uniform(-1, 1);
    for (std::size_t b = 0; b < bodies_; ++b)
      for (std::size_t i = 0; i < K; ++i)
        factor_.diagonal(b)[i * (K + 1)] = random.uniform(10, 20) * K;
    if (spoilt >= 0)
      factor_.diagonal(static_cast<std::size_t>(spoilt))[0] =
          std::numeric_limits<double>::quiet_NaN();
    if (!factor_.factorise(pool)) return std::nullopt;
    std::vector<typename BlockFactor<K>::Vec> values(bodies_);
    for (auto& value : values)
      for (double& number : value) number = random.uniform(-1, 1);
    factor_.solve(values);
    std::vector<double> all = {static_cast<double>(factor_.sign_of_determinant())};
    for (const auto& value : values) all.insert(all.end(), value.begin(), value.end());
    return all;
  }

  std::size_t bodies() const { return bodies_; }

 private:
  bool is_symmetric_;
  std::size_t bodies_ = 0;
  std::vector<std::array<std::int32_t, 2>> edges_;
  BlockFactor<K> factor_;
};

template <int K>
void share_among_threads(std::array<std::size_t, 3> size) {
  for (const bool is_symmetric : {false, true}) {
    Lattice<K> lattice(size, is_symmetric);
    const auto alone = lattice.solution(nullptr);
    ASSERT_TRUE(alone);
    for (const int threads : {1, 2, 3, 5}) {
      SCOPED_TRACE(threads);
      ThreadPool pool(threads);
      for (int n = 0; n < 5; ++n) EXPECT_EQ(lattice.solution(&pool), alone);
      // No thread may wait for a task that another one gave up.
      for (std::size_t spoilt = 0; spoilt < lattice.bodies(); spoilt += lattice.bodies() / 7)
        EXPECT_FALSE(lattice.solution(&pool, static_cast<int>(spoilt)));
    }
    EXPECT_EQ(lattice.solution(nullptr), alone);
  }
}
TEST(BlockFactor, HasTheSameBitsForAnyNumberOfThreads) {
  share_among_threads<3>({40, 50, 1});
  share_among_threads<6>({8, 9, 8});
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
}  // namespace viscontact::particles
