#include "tests/oracles/bispherical/pair_loads.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tests/oracles/bispherical/bispherical.hpp"
#include "tests/oracles/near_contact_expansion.hpp"

namespace viscontact {
namespace {

constexpr double kPi = std::numbers::pi;

/// A number of data/reference/two_spheres_loads.csv, whose axis goes from sphere 1 to sphere 2.
/// `quantity` is the number of F, T or S; `sign` is -1 if it changes sign in the mirror z -> -z.
struct Named {
  char quantity;
  std::string motion;  // with the number of the sphere at '#'
  double sign;
};
const std::vector<Named> kAxial{{'F', "U#z", -1}, {'S', "E0@#", 1}};
const std::vector<Named> kTransverse{{'F', "U#x", 1}, {'T', "W#y", -1}, {'S', "E1@#", -1}};
const std::vector<Named> kTwofold{{'S', "E2@#", 1}}, kSpin{{'T', "W#z", 1}};

/// The six loads of a motion, F1, T1, S1, F2, T2, S2.
using Motions = std::map<std::string, std::array<double, 6>>;

double reference_load(const Motions& motions, const std::vector<Named>& group, Eigen::Index i,
                      Eigen::Index j) {
  const auto count = static_cast<Eigen::Index>(group.size());
  const auto &row = group[static_cast<std::size_t>(i % count)],
             &column = group[static_cast<std::size_t>(j % count)];
  auto motion = column.motion;
  motion.replace(motion.find('#'), 1, j < count ? "1" : "2");
  const auto place = std::string("FTS").find(row.quantity) + (i < count ? 0U : 3U);
  return row.sign * column.sign * motions.at(motion).at(place);
}

void expect_loads(const Eigen::MatrixXd& loads, const Motions& motions,
                  const std::vector<Named>& group) {
  for (Eigen::Index i = 0; i < loads.rows(); ++i)
    for (Eigen::Index j = 0; j < loads.cols(); ++j) {
      const double exact = reference_load(motions, group, i, j);
      // Loads near a change of sign have the rounding errors of the larger ones.
      EXPECT_NEAR(loads(i, j), exact, 4e-15 * (std::abs(exact) + 1))
          << group.front().motion << " " << i << " " << j;
    }
}

TEST(PairLoads, AreTheReferenceValues) {
  std::istringstream lines(read_file(kReference / "two_spheres_loads.csv"));
  std::map<std::pair<double, double>, Motions> pairs;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#') || line.starts_with("size_ratio")) continue;
    std::istringstream fields(line);
    std::vector<std::string> words;
    for (std::string word; std::getline(fields, word, ',');) words.push_back(word);
    ASSERT_EQ(words.size(), 12U);
    auto& loads = pairs[{parse_number(words[0]).value(), parse_number(words[2]).value()}][words[5]];
    for (std::size_t i = 0; i < 6; ++i) loads.at(i) = parse_number(words[6 + i]).value();
  }
  EXPECT_EQ(pairs.size(), 21U);
  for (const auto& [pair, motions] : pairs) {
    SCOPED_TRACE(testing::Message() << "ratio " << pair.first << ", gap " << pair.second);
    const auto loads = exact_pair_loads(1, pair.first, pair.second);
    expect_loads(loads.axial, motions, kAxial);
    expect_loads(loads.transverse, motions, kTransverse);
    expect_loads(loads.twofold, motions, kTwofold);
    expect_loads(loads.spin, motions, kSpin);
  }
}

TEST(PairLoads, FarApartAreThoseOfASphereAlone) {
  const double radius = 2;
  const auto loads = exact_pair_loads(radius, 1, 1e5);
  // What the other sphere does falls as the radius over the distance, or faster.
  const double far = 1e-4;
  EXPECT_NEAR(loads.axial(0, 0) / (-6 * kPi * radius), 1, far);
  EXPECT_NEAR(loads.transverse(1, 1) / (-8 * kPi * std::pow(radius, 3)), 1, far);
  EXPECT_NEAR(loads.axial(1, 1) / (20 * kPi / 3 * std::pow(radius, 3) * 2 / 3), 1, far);
  EXPECT_NEAR(loads.twofold(0, 0) / (20 * kPi / 3 * std::pow(radius, 3)), 1, far);
}

TEST(PairLoads, OfALargeSphereTendToThoseOfAPlane) {
  // The loads are smooth in the curvature of the second sphere: the difference falls as 1/ratio.
  for (const double gap : {0.01, 1.0}) {
    const auto plane = exact_loads_above_plane(1, gap);
    EXPECT_NEAR(plane.axial(0, 0), -6 * kPi * bispherical_plane_factor(gap),
                1e-13 * std::abs(plane.axial(0, 0)));
    const auto difference = [&](double ratio) {
      const auto pair = exact_pair_loads(1, ratio, gap);
      return std::array{
          pair.axial(1, 1) - plane.axial(1, 1), pair.transverse(2, 0) - plane.transverse(2, 0),
          pair.transverse(1, 1) - plane.transverse(1, 1), pair.twofold(0, 0) - plane.twofold(0, 0),
          pair.spin(0, 0) - plane.spin(0, 0)};
    };
    const auto near = difference(50), far = difference(100);
    for (std::size_t i = 0; i < near.size(); ++i) EXPECT_NEAR(near.at(i) / far.at(i), 2, 0.1) << i;
  }
}

TEST(PairLoads, TracesOfEqualSpheresHaveTheSymmetryOfThePair) {
  const auto loads = exact_pair_loads(1, 1, 0.1);
  EXPECT_NEAR(loads.trace(0, 0), -loads.trace(1, 2), 1e-13 * std::abs(loads.trace(0, 0)));
  EXPECT_NEAR(loads.trace(0, 1), loads.trace(1, 3), 1e-13 * std::abs(loads.trace(0, 1)));
  // Near contact the film pushes both spheres at the arm of a radius: the trace is r F_z, but for a
  // part of the order gap ln(1/gap).
  const double gap = 1e-4;
  const auto touching = exact_pair_loads(1, 1, gap);
  EXPECT_NEAR(touching.trace(0, 0) / -touching.axial(0, 0), 1, 4 * gap * std::log(1 / gap));
}

}  // namespace
}  // namespace viscontact
