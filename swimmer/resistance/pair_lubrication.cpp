// Evaluates the lubrication of pairs. Lengths are in the unit of the caller. Nothing is thrown. A
// change must keep the formula, because fit files contain only the rest.
#include "viscontact/swimmer/resistance/pair_lubrication.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace viscontact::swimmer {
namespace {

/// g1, g2, g3 for the ratio of radii beta (Jeffrey & Onishi 1984).
std::array<double, kLubricationTerms> coefficients(double beta) {
  const double sum3 = std::pow(1 + beta, 3);
  return {2 * beta * beta / sum3, beta * (1 + 7 * beta + beta * beta) / (5 * sum3),
          (1 + 18 * beta - 29 * beta * beta + 18 * std::pow(beta, 3) + std::pow(beta, 4)) /
              (42 * sum3)};
}

}  // namespace

double pair_lubrication(double a, double b, double gap, int terms) {
  const auto g = coefficients(b / a);
  const double xi = 2 * gap / (a + b), logarithm = std::log1p(1 / xi);
  const std::array<double, kLubricationTerms> values = {1 / xi, logarithm, xi * logarithm};
  double sum = 0;
  for (int i = 0; i < terms; ++i)
    sum += g[static_cast<std::size_t>(i)] * values[static_cast<std::size_t>(i)];
  return 6 * std::numbers::pi * a * sum;
}

double pair_lubrication_slope(double a, double b, double gap, int terms) {
  const auto g = coefficients(b / a);
  const double xi = 2 * gap / (a + b), logarithm = std::log1p(1 / xi);
  const std::array<double, kLubricationTerms> slopes = {-1 / (xi * xi), -1 / (xi * (1 + xi)),
                                                        logarithm - 1 / (1 + xi)};
  double sum = 0;
  for (int i = 0; i < terms; ++i)
    sum += g[static_cast<std::size_t>(i)] * slopes[static_cast<std::size_t>(i)];
  return 6 * std::numbers::pi * a * sum * 2 / (a + b);
}

Eigen::MatrixXd lubrication_matrix(std::span<const double> radii, std::span<const double> gaps,
                                   int terms) {
  const auto spheres = static_cast<Eigen::Index>(radii.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(spheres, spheres);
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    const double pair = pair_lubrication(radii[k], radii[k + 1], gaps[k], terms);
    const auto i = static_cast<Eigen::Index>(k);
    matrix(i, i) += pair;
    matrix(i + 1, i + 1) += pair;
    matrix(i, i + 1) -= pair;
    matrix(i + 1, i) -= pair;
  }
  return matrix;
}

}  // namespace viscontact::swimmer
