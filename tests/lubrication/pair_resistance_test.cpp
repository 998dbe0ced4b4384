#include "viscontact/lubrication/pairs/pair_resistance.hpp"

#include <gmock/gmock.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "tests/common/failure.hpp"
#include "tests/oracles/bispherical/pair_matrix.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/lubrication/pairs/pair_near_contact.hpp"

namespace viscontact::lubrication {
namespace {

constexpr double kPi = std::numbers::pi;
using Matrix = Eigen::Matrix<double, 22, 22, Eigen::RowMajor>;

Matrix resistance(double radius1, double radius2, double gap, double viscosity = 1) {
  const auto matrix = pair_resistance(radius1, radius2, gap, viscosity);
  return Eigen::Map<const Matrix>(matrix.data());
}

Matrix pair_form(double radius1, double radius2, double gap, PairForm form) {
  const auto matrix = pair_resistance(radius1, radius2, gap, 1, form);
  return Eigen::Map<const Matrix>(matrix.data());
}

/// The largest difference over the mean of the diagonal entries.
double largest_error(const Matrix& matrix, const Matrix& exact) {
  const Eigen::VectorXd own = exact.diagonal().cwiseSqrt().cwiseInverse();
  return (own.asDiagonal() * (matrix - exact) * own.asDiagonal()).cwiseAbs().maxCoeff();
}

/// The largest error of an entry of both spheres beside what the small sphere 1 alone has where the
/// surface of sphere 2 moves.
double largest_mixed_error(const Matrix& matrix, const Matrix& exact, double ratio) {
  double largest = 0;
  for (int i = 0; i < 11; ++i)
    for (int j = 0; j < 11; ++j)
      largest = std::max(largest, std::abs(matrix(i, 11 + j) - exact(i, 11 + j)) /
                                      std::sqrt(6 * kPi * exact(i, i)) / (j < 3 ? 1 : ratio));
  return largest;
}

/// Draws ratios from 1 to 10 and gaps between two numbers, both uniform in the logarithm.
class Draws {
 public:
  double ratio() { return std::pow(10, share_(generator_)); }
  double gap(double from, double to) { return from * std::pow(to / from, share_(generator_)); }

 private:
  std::mt19937 generator_{7};
  std::uniform_real_distribution<double> share_{0, 1};
};

TEST(PairResistance, IsThatOfTheExactSolution) {
  Draws draws;
  // The header promises the bounds; the draws have at most 0.6 of them.
  const auto expect = [](double ratio, double gap, double bound, double mixed_bound = 3e-6) {
    const auto matrix = resistance(1, ratio, gap), exact = Matrix(exact_pair_matrix(1, ratio, gap));
    EXPECT_LT(largest_error(matrix, exact), bound) << "ratio " << ratio << ", gap " << gap;
    EXPECT_LT(largest_mixed_error(matrix, exact, ratio), mixed_bound)
        << "ratio " << ratio << ", gap " << gap;
  };
  for (int i = 0; i < 40; ++i) {
    const double ratio = draws.ratio();
    expect(ratio, draws.gap(1e-3, 5), 3e-6);
  }
  for (const double gap : {1e-5, 1e-4, 20.0, 1e3})
    for (const double ratio : {1.0, 3.0}) expect(ratio, gap, 3e-6);
  for (const double ratio : {13.0, 52.0, 95.0})
    for (const double gap : {0.02, 0.5, 4.0, 100.0}) expect(ratio, gap, 3e-5, 5e-4);
  for (const double ratio : {101.0, 150.0, 500.0})
    for (const double gap : {0.05, 0.5, 20.0, 400.0}) expect(ratio, gap, 5e-4, 2e-3);
}

TEST(PairResistance, BesideAPlaneIsThatOfTheExactSolution) {
  const double plane = std::numeric_limits<double>::infinity();
  for (const double gap : {1e-5, 1e-3, 0.03, 0.4, 3.0, 50.0}) {
    const auto matrix = resistance(1, plane, gap);
    const Matrix none = Matrix::Zero();
    EXPECT_EQ(matrix.bottomRows<11>(), none.bottomRows<11>());
    EXPECT_EQ(matrix.rightCols<11>(), none.rightCols<11>());
    const Eigen::MatrixXd exact = exact_plane_matrix(1, gap);
    const Eigen::VectorXd own = exact.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd error = matrix.topLeftCorner<11, 11>() - exact;
    EXPECT_LT((own.asDiagonal() * error * own.asDiagonal()).cwiseAbs().maxCoeff(), 4e-6) << gap;
    // It is what large spheres have, but for terms like the inverse of the ratio.
    const auto large = resistance(1, 1e6, gap).topLeftCorner<11, 11>();
    const Eigen::MatrixXd change = large - exact;
    EXPECT_LT((own.asDiagonal() * change * own.asDiagonal()).cwiseAbs().maxCoeff(), 3e-5) << gap;
    // Exchanged: sphere 2 above the plane 1.
    EXPECT_EQ(resistance(plane, 1, gap)(11, 11), matrix(0, 0));
    EXPECT_EQ(resistance(1, plane, gap), Matrix(pair_form(1, plane, gap, PairForm::kBalanced)));
  }
}

/// The flow of a sphere alone, of radius b around 0, which moves with `velocity`, turns with `spin`, or
/// rests in the undisturbed strain `strain` without trace (Stokes; without the undisturbed flow).
Eigen::Vector3d flow_of_sphere(double b, const Eigen::Vector3d& velocity,
                               const Eigen::Vector3d& spin, const Eigen::Matrix3d& strain,
                               const Eigen::Vector3d& x) {
  const double s = x.norm(), ratio = b / s, cube = ratio * ratio * ratio;
  const Eigen::Vector3d n = x / s, strained = strain * x;
  return 0.75 * ratio * (velocity + n * n.dot(velocity)) +
         0.25 * cube * (velocity - 3 * n * n.dot(velocity)) + cube * spin.cross(x) -
         cube * ratio * ratio * strained -
         2.5 * n * n.dot(strained) * (cube - cube * ratio * ratio);
}

TEST(PairResistance, OfASmallSphereIsThatInTheFlowOfALargeOne) {
  // At gaps that are not small beside b a small sphere has the loads of a sphere alone in the flow of
  // the large one: F = -6 pi u, T = -8 pi w and S = (20/3) pi E. Its own flow
  // comes back, which has velocities like 1/q and gradients like 1/q^2, the latter beside those of
  // the large sphere, which are like 1/b; and the table has an error of 4e-6.
  Eigen::Matrix<double, 11, 1> alone;
  alone << 6, 6, 6, 8, 8, 8, 20.0 / 3, 20.0 / 3, 20.0 / 3, 20.0 / 3, 20.0 / 3;
  const double third = 1 / std::sqrt(6.0), half = 1 / std::sqrt(2.0);
  const std::array<Eigen::Matrix3d, 5> strains{
      Eigen::Vector3d(-third, -third, 2 * third).asDiagonal().toDenseMatrix(),
      Eigen::Matrix3d{{0, 0, half}, {0, 0, 0}, {half, 0, 0}},
      Eigen::Matrix3d{{0, 0, 0}, {0, 0, half}, {0, half, 0}},
      Eigen::Matrix3d{{half, 0, 0}, {0, -half, 0}, {0, 0, 0}},
      Eigen::Matrix3d{{0, half, 0}, {half, 0, 0}, {0, 0, 0}}};
  for (const double b : {150.0, 1e4, 1e8})
    for (const double share : {0.3, 1.0, 3.0}) {
      const double gap = share * b, r = 1 + b + gap;
      const auto matrix = resistance(1, b, gap);
      for (int j = 0; j < 11; ++j) {
        Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), spin = Eigen::Vector3d::Zero();
        Eigen::Matrix3d strain = Eigen::Matrix3d::Zero(), gradient;
        if (j < 3)
          velocity(j) = 1;
        else if (j < 6)
          spin(j - 3) = 1;
        else
          strain = strains.at(static_cast<std::size_t>(j - 6));
        const auto flow = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
          return flow_of_sphere(b, velocity, spin, strain, x);
        };
        const Eigen::Vector3d centre(0, 0, -r);
        const double step = 1e-4 * r;
        for (int k = 0; k < 3; ++k) {
          const Eigen::Vector3d d = step * Eigen::Vector3d::Unit(k);
          gradient.col(k) = (flow(centre + d) - flow(centre - d)) / (2 * step);
        }
        const Eigen::Matrix3d e = (gradient + gradient.transpose()) / 2;
        Eigen::Matrix<double, 11, 1> source;
        source << -flow(centre),
            -Eigen::Vector3d(gradient(2, 1) - gradient(1, 2), gradient(0, 2) - gradient(2, 0),
                             gradient(1, 0) - gradient(0, 1)) /
                2,
            0, 0, 0, 0, 0;
        for (int k = 0; k < 5; ++k)
          source(6 + k) = e.cwiseProduct(strains.at(static_cast<std::size_t>(k))).sum();
        const Eigen::VectorXd expected = kPi * alone.cwiseProduct(source);
        // The largest velocity and gradient of each flow are the scale of its parts that are not 0;
        // the step of the differences has an error of 1e-7.
        for (int i = 0; i < 11; ++i) {
          const double least = 1e-7 * (i < 3 ? source.head<3>().norm() : source.tail<8>().norm());
          if (std::abs(source(i)) <= least) continue;
          EXPECT_NEAR(matrix(i, 11 + j) / expected(i), 1, 1e-5 + 1.5 / gap + 1.5 * b / (gap * gap))
              << "ratio " << b << ", gap " << gap << ", entry " << i << ' ' << j;
        }
      }
    }
}

TEST(PairResistance, BesideAPlaneHasTheForceOfAShearFlow) {
  // F* of Goldman, Cox & Brenner 1967 (II), Table 1: the force of the shear u = g z on a sphere at rest
  // over 6 pi mu r g h, by centres at the heights h, with four digits. The plane is sphere 1.
  for (const auto& [height, expected] : {std::pair(1.003202, 1.6982), {1.5430806, 1.4391}}) {
    const auto matrix = resistance(std::numeric_limits<double>::infinity(), 1, height - 1);
    Eigen::Matrix<double, 11, 1> flow = Eigen::Matrix<double, 11, 1>::Zero();
    flow(0) = -height;
    flow(4) = -0.5;
    flow(7) = std::sqrt(0.5);
    const double force = -matrix.row(11).tail<11>().dot(flow);
    EXPECT_NEAR(force / (6 * kPi * height), expected, 1e-4) << height;
  }
}

TEST(PairResistance, BalancedHasNoLoadsOfRigidMotions) {
  for (const double ratio : {1.0, 0.2, 7.0, 60.0, 1e4, 1e8})
    for (const double gap : {1e-6, 0.01, 3.0}) {
      const auto complete = resistance(1, ratio, gap);
      const auto balanced = pair_form(1, ratio, gap, PairForm::kBalanced);
      const double distance = 1 + ratio + gap;
      // Translations, and turns about the centre of sphere 1 at z = 0.
      Eigen::Matrix<double, 22, 6> rigid = Eigen::Matrix<double, 22, 6>::Zero();
      for (int axis = 0; axis < 3; ++axis)
        for (const int sphere : {0, 11}) {
          rigid(sphere + axis, axis) = 1;
          rigid(sphere + 3 + axis, 3 + axis) = 1;
        }
      rigid(11, 4) = distance;
      rigid(12, 3) = -distance;
      const Eigen::VectorXd own = complete.diagonal().cwiseSqrt();
      // Loads of a rigid motion, and loads along rigid motions (forces and torques), beside the sums
      // of the terms' magnitudes.
      const Eigen::MatrixXd loads = balanced * rigid;
      const Eigen::MatrixXd terms = balanced.cwiseAbs() * rigid.cwiseAbs();
      EXPECT_LE((loads.cwiseAbs() - 1e-15 * terms).maxCoeff(), 0) << ratio << ' ' << gap;
      EXPECT_EQ(balanced, Matrix(balanced.transpose()));
      // The formula.
      const Eigen::MatrixXd drag = complete * rigid;
      const Eigen::MatrixXd formula =
          complete - drag * (rigid.transpose() * drag).ldlt().solve(drag.transpose());
      const Eigen::VectorXd scale = own.cwiseInverse();
      EXPECT_LT(
          (scale.asDiagonal() * (balanced - formula) * scale.asDiagonal()).cwiseAbs().maxCoeff(),
          1e-12)
          << ratio << ' ' << gap;
      const Eigen::MatrixXd scaled = scale.asDiagonal() * balanced * scale.asDiagonal();
      EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly)
                    .eigenvalues()(0),
                -1e-12);
    }
}

TEST(PairResistance, HasTheFunctionsOfJeffreyAndOnishi) {
  // docs/pairs.md: rows and columns of the entry, the power of s, and the factor over pi.
  struct Function {
    int row, column, power;
    double factor;
  };
  const double g = -std::sqrt(2.0 / 3), h = -std::sqrt(2.0);
  const std::map<std::string, Function> functions{
      {"XA", {2, 2, 1, 3}},       {"YA", {0, 0, 1, 3}},       {"YB", {4, 0, 2, -1}},
      {"XC", {5, 5, 3, 1}},       {"YC", {4, 4, 3, 1}},       {"XG", {6, 2, 2, g}},
      {"YG", {7, 0, 2, h}},       {"YH", {7, 4, 3, h}},       {"XM", {6, 6, 3, 5.0 / 6}},
      {"YM", {7, 7, 3, 5.0 / 6}}, {"ZM", {9, 9, 3, 5.0 / 6}},
  };
  std::istringstream lines(read_file(std::filesystem::path(VISCONTACT_SOURCE_FOLDER) /
                                     "data/reference/two_spheres_functions.csv"));
  int compared = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#') || line.starts_with("size_ratio")) continue;
    std::istringstream fields(line);
    std::vector<std::string> words;
    for (std::string word; std::getline(fields, word, ',');) words.push_back(word);
    ASSERT_EQ(words.size(), 9U);
    const auto number = [&](std::size_t i) { return parse_number(words.at(i)).value(); };
    const std::array radii{1.0, number(0)};
    const auto matrix = resistance(radii[0], radii[1], number(2));
    const auto& function = functions.at(words[4]);
    for (const int i : {0, 1})
      for (const int j : {0, 1}) {
        const double s =
            radii.at(static_cast<std::size_t>(i)) + radii.at(static_cast<std::size_t>(j));
        const auto entry = [&](int row, int column) {
          return matrix(11 * i + row, 11 * j + column);
        };
        const double unit = function.factor * kPi * std::pow(s, function.power);
        const double own = std::sqrt(matrix(11 * i + function.row, 11 * i + function.row) *
                                     matrix(11 * j + function.column, 11 * j + function.column));
        EXPECT_NEAR(entry(function.row, function.column),
                    unit * number(static_cast<std::size_t>(5 + 2 * i + j)), 3e-6 * own)
            << line;
        ++compared;
      }
  }
  EXPECT_EQ(compared, 3 * 7 * 11 * 4);
}

TEST(PairResistance, IsSymmetricToTheLastBit) {
  const auto matrix = resistance(0.7, 3, 0.02, 1.3);
  EXPECT_EQ(matrix, Matrix(matrix.transpose()));
}

TEST(PairResistance, IsPositiveDefiniteAtEveryGapAndRatio) {
  Draws draws;
  double least = 1;
  for (int i = 0; i < 100000; ++i) {
    // Up to 10, and every fourth one up to 1e6.
    const double ratio = i % 4 == 0 ? std::pow(draws.ratio(), 6) : draws.ratio();
    const double gap = draws.gap(1e-9, 100);
    const auto matrix = resistance(1, ratio, gap);
    // Blocks of the components U_z, E_1; U_x, W_y, E_2; E_4; W_z of both spheres.
    for (const auto& block :
         std::vector<std::vector<int>>{{2, 6, 13, 17}, {0, 4, 7, 11, 15, 18}, {9, 20}, {5, 16}}) {
      const Eigen::MatrixXd part = matrix(block, block);
      Eigen::VectorXd alone(part.rows());
      for (Eigen::Index k = 0; k < part.rows(); ++k) {
        const int which = block[static_cast<std::size_t>(k)] % 11;
        const double a = block[static_cast<std::size_t>(k)] < 11 ? 1 : ratio;
        alone(k) = which < 3 ? 6 * kPi * a : (which < 6 ? 8 : 20.0 / 3) * kPi * a * a * a;
      }
      const Eigen::VectorXd scale = alone.cwiseSqrt().cwiseInverse();
      const Eigen::MatrixXd scaled = scale.asDiagonal() * part * scale.asDiagonal();
      least = std::min(
          least, Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly)
                     .eigenvalues()(0));
    }
  }
  // Two spheres that move together have the drag 0.645 of two alone (Cooley & O'Neill 1969); other
  // motions of the pair have a little less.
  EXPECT_GT(least, 0.55);
}

TEST(PairResistance, ExchangedSpheresHaveTheSameNumbers) {
  const auto one = resistance(1, 3, 0.1), other = resistance(3, 1, 0.1);
  // A turn by 180 degrees about y exchanges the spheres: x and z change sign, and so do components
  // with an odd number of them.
  const std::array<double, 11> sign{-1, 1, -1, -1, 1, -1, 1, 1, -1, 1, -1};
  for (int i = 0; i < 22; ++i)
    for (int j = 0; j < 22; ++j)
      EXPECT_EQ(other(i, j), sign.at(static_cast<std::size_t>(i % 11)) *
                                 sign.at(static_cast<std::size_t>(j % 11)) *
                                 one((i + 11) % 22, (j + 11) % 22))
          << i << " " << j;
}

TEST(PairResistance, HasTheUnitsOfItsArguments) {
  const double length = 0.4, viscosity = 3;
  const auto one = resistance(1, 3, 0.1), other = resistance(0.4, 1.2, 0.04, viscosity);
  for (int i = 0; i < 22; ++i)
    for (int j = 0; j < 22; ++j) {
      const int power = 1 + (i % 11 > 2 ? 1 : 0) + (j % 11 > 2 ? 1 : 0);
      const double unit = viscosity * std::pow(length, power);
      EXPECT_NEAR(other(i, j), unit * one(i, j), 1e-12 * unit * std::sqrt(one(i, i) * one(j, j)));
    }
}

TEST(PairResistance, TermsNearContactLeaveRigidMotionsFree) {
  // 1/xi and ln xi multiply matrices that resist no rigid motion of the pair: translations, and a
  // turn about y, in which the centre of sphere 2 moves at the distance 1 + b. The polynomials are
  // integers, so that this holds exactly for integer b.
  for (const int b : {1, 2, 7}) {
    const auto polynomial = [&](std::size_t entry, std::size_t term) {
      const auto& numbers = kPairEntryTerms[entry].terms[term];
      double value = 0;
      for (std::size_t p = 7; p-- > 0;) value = value * b + numbers.numerator[p];
      return value / numbers.denominator;
    };
    // Rows U1 of the axial block, U1, W1, E1 of the transverse one.
    for (const std::size_t term : {0U, 1U}) {
      EXPECT_NEAR(polynomial(0, term) + polynomial(2, term), 0, 1e-12);
      EXPECT_NEAR(polynomial(1, term) + polynomial(5, term), 0, 1e-12);
    }
    const double size = std::abs(polynomial(16, 1));
    EXPECT_NEAR(polynomial(10, 1) + polynomial(13, 1), 0, 1e-12 * size);
    EXPECT_NEAR(polynomial(11, 1) + (1 + b) * polynomial(13, 1) + polynomial(14, 1), 0,
                1e-12 * size);
    EXPECT_NEAR(polynomial(16, 1) + (1 + b) * polynomial(18, 1) + polynomial(19, 1), 0,
                1e-12 * size);
  }
}

TEST(PairResistance, OfManyPairsIsThatOfEach) {
  const std::vector<double> radius1{1, 2, 0.3}, radius2{1, 5, 0.1}, gap{0.1, 0.01, 2};
  std::vector<double> matrices(3 * kPairComponents * kPairComponents);
  pair_resistances(radius1, radius2, gap, 2, matrices);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto one = pair_resistance(radius1[i], radius2[i], gap[i], 2);
    EXPECT_TRUE(std::ranges::equal(one, std::span(matrices).subspan(i * one.size(), one.size())));
  }
}

TEST(PairResistance, RefusesWhatIsNoPair) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(bad_input([] { (void)pair_resistance(1, 1, 0, 1); }), Names("gap"));
  EXPECT_THAT(bad_input([] { (void)pair_resistance(-1, 1, 1, 1); }), Names("sphere 1"));
  EXPECT_THAT(bad_input([] { (void)pair_resistance(1, 0, 1, 1); }), Names("sphere 2"));
  EXPECT_THAT(bad_input([&] { (void)pair_resistance(1, 1, 1, nan); }), Names("viscosity"));
  EXPECT_THAT(bad_input([] { (void)pair_resistance(1, 1.1e9, 1, 1); }), Names("1.1e+09"));
  const double plane = std::numeric_limits<double>::infinity();
  EXPECT_THAT(bad_input([&] { (void)pair_resistance(plane, plane, 1, 1); }), Names("sphere 1"));
  EXPECT_THAT(bad_input([&] { (void)pair_resistance(1, -plane, 1, 1); }), Names("sphere 2"));
  // Numbers whose products are beyond those of the machine.
  EXPECT_THAT(bad_input([] { (void)pair_resistance(1, 1e5, 1e300, 1); }), Names("1e+300"));
  EXPECT_THAT(bad_input([] { (void)pair_resistance(1e150, 1e150, 1e150, 1); }), Names("1e+150"));
  EXPECT_NO_THROW((void)pair_resistance(0.7, 7, 1, 1));
}

}  // namespace
}  // namespace viscontact::lubrication
