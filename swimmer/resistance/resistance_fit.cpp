// R = mu (R_lub + l exp(S)) and its derivatives by the gaps.
#include "viscontact/swimmer/resistance/resistance_fit.hpp"

#include <algorithm>
#include <cassert>

#include "viscontact/common/error.hpp"
#include "viscontact/common/matrices/decompositions.hpp"

namespace viscontact::swimmer {
namespace {

/// The coefficients g1, g2, g3 of pair_lubrication() for the ratio of radii `beta` [1] (Jeffrey &
/// Onishi 1984).
std::array<double, kLubricationTerms> coefficients(double beta) {
  const double sum3 = std::pow(1 + beta, 3);
  return {2 * beta * beta / sum3, beta * (1 + 7 * beta + beta * beta) / (5 * sum3),
          (1 + 18 * beta - 29 * beta * beta + 18 * std::pow(beta, 3) + std::pow(beta, 4)) /
              (42 * sum3)};
}

/// Adds the resistance of spheres k and k + 1, from 0, against a change of their gap.
void add_pair(Eigen::MatrixXd& matrix, std::size_t k, double resistance) {
  const auto i = static_cast<Eigen::Index>(k);
  matrix(i, i) += resistance;
  matrix(i + 1, i + 1) += resistance;
  matrix(i, i + 1) -= resistance;
  matrix(i + 1, i) -= resistance;
}

}  // namespace

double pair_lubrication(double a, double b, double gap, int terms) {
  assert(a > 0 && b > 0 && gap > 0 && terms >= 0 && terms <= kLubricationTerms);
  const auto g = coefficients(b / a);
  const double xi = 2 * gap / (a + b), logarithm = std::log1p(1 / xi);
  const std::array<double, kLubricationTerms> values = {1 / xi, logarithm, xi * logarithm};
  double sum = 0;
  for (int i = 0; i < terms; ++i)
    sum += g[static_cast<std::size_t>(i)] * values[static_cast<std::size_t>(i)];
  return 6 * std::numbers::pi * a * sum;
}

double pair_lubrication_slope(double a, double b, double gap, int terms) {
  assert(a > 0 && b > 0 && gap > 0 && terms >= 0 && terms <= kLubricationTerms);
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
  assert(gaps.size() + 1 == radii.size());
  const auto spheres = static_cast<Eigen::Index>(radii.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(spheres, spheres);
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    add_pair(matrix, k, pair_lubrication(radii[k], radii[k + 1], gaps[k], terms));
  }
  return matrix;
}

namespace {

/// The nodes of the polynomials: for each gap, the inverse distances of the centres [1/L].
std::vector<Eigen::VectorXd> inverse_distances(const ResistanceFit& fit) {
  std::vector<Eigen::VectorXd> nodes;
  for (std::size_t k = 0; k < fit.gaps.size(); ++k) {
    Eigen::VectorXd inverse(static_cast<Eigen::Index>(fit.gaps[k].size()));
    for (Eigen::Index i = 0; i < inverse.size(); ++i)
      inverse[i] = 1 / (fit.gaps[k][static_cast<std::size_t>(i)] + fit.radii[k] + fit.radii[k + 1]);
    nodes.push_back(inverse);
  }
  return nodes;
}

/// The entries on and above the diagonal of each matrix, row by row; column m belongs to matrix m.
Eigen::MatrixXd columns_of(const std::vector<Eigen::MatrixXd>& matrices) {
  assert(!matrices.empty());
  const auto spheres = matrices.front().rows();
  Eigen::MatrixXd columns(spheres * (spheres + 1) / 2, static_cast<Eigen::Index>(matrices.size()));
  for (std::size_t m = 0; m < matrices.size(); ++m) {
    Eigen::Index row = 0;
    for (Eigen::Index i = 0; i < spheres; ++i)
      for (Eigen::Index j = i; j < spheres; ++j)
        columns(row++, static_cast<Eigen::Index>(m)) = matrices[m](i, j);
  }
  return columns;
}

/// The symmetric matrix with these entries on and above its diagonal, row by row.
Eigen::MatrixXd symmetric_matrix(const Eigen::VectorXd& entries, Eigen::Index spheres) {
  Eigen::MatrixXd matrix(spheres, spheres);
  Eigen::Index row = 0;
  for (Eigen::Index i = 0; i < spheres; ++i)
    for (Eigen::Index j = i; j < spheres; ++j) matrix(i, j) = matrix(j, i) = entries[row++];
  return matrix;
}

/// The divided difference (exp a - exp b)/(a - b), which is exp a for a = b. If |a - b| < 2e-4, the
/// first two terms of the series of sinh are exact to round-off.
double divided_difference_of_exp(double a, double b) {
  const double half = (a - b) / 2;
  const double ratio = std::abs(half) < 1e-4 ? 1 + half * half / 6 : std::sinh(half) / half;
  return std::exp((a + b) / 2) * ratio;
}

}  // namespace

FittedResistance::FittedResistance(const ResistanceFit& fit)
    : viscosity_(fit.viscosity),
      radii_(fit.radii),
      lubrication_terms_(fit.lubrication_terms),
      unit_length_(std::ranges::max(fit.radii)),
      logarithm_(inverse_distances(fit), columns_of(fit.logarithms)) {
  assert(fit.gaps.size() + 1 == fit.radii.size());
  for (const auto& gaps : fit.gaps) intervals_.push_back({gaps.front(), gaps.back()});
}

bool FittedResistance::contains(std::span<const double> gaps) const {
  assert(gaps.size() <= intervals_.size());
  // A relative difference that is allowed because gaps are rounded differences of arms and radii.
  // swimmer_case.cpp has the same number.
  constexpr double kRounding = 1e-12;
  for (std::size_t k = 0; k < gaps.size(); ++k)
    if (!(gaps[k] >= intervals_[k][0] * (1 - kRounding) &&
          gaps[k] <= intervals_[k][1] * (1 + kRounding)))
      return false;
  return true;
}

ResistanceWithSlopes FittedResistance::operator()(std::span<const double> gaps) const {
  assert(gaps.size() == intervals_.size());
  if (!contains(gaps))
    for (std::size_t k = 0; k < gaps.size(); ++k)
      if (!contains(gaps.first(k + 1)))
        throw Error(ErrorKind::kBadInput,
                    "the gap between spheres {} and {} is {}; the table has gaps from {} to {}",
                    k + 1, k + 2, gaps[k], intervals_[k][0], intervals_[k][1]);
  const auto spheres = static_cast<Eigen::Index>(radii_.size());
  std::vector<double> inverse(gaps.size());
  for (std::size_t k = 0; k < gaps.size(); ++k)
    inverse[k] = 1 / (gaps[k] + radii_[k] + radii_[k + 1]);
  const Eigen::MatrixXd logarithm = logarithm_(inverse);

  // Let S = Q diag(s) Q^T, and dS its derivative by a gap. The derivative of exp(S) is
  // Q (F o (Q^T dS Q)) Q^T, where o multiplies entry by entry and F_ij is the divided difference of
  // exp at s_i and s_j (Daleckii & Krein 1965).
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
      symmetric_matrix(logarithm.col(0), spheres));
  const auto& s = eigen.eigenvalues();
  const auto& q = eigen.eigenvectors();
  Eigen::MatrixXd differences(spheres, spheres);
  for (Eigen::Index i = 0; i < spheres; ++i)
    for (Eigen::Index j = 0; j < spheres; ++j)
      differences(i, j) = divided_difference_of_exp(s[i], s[j]);

  ResistanceWithSlopes resistance;
  resistance.value =
      viscosity_ *
      (lubrication_matrix(radii_, gaps, lubrication_terms_) +
       unit_length_ * (q * s.array().exp().matrix().asDiagonal() * q.transpose()).eval());
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k) + 1;
    // The polynomials are functions of t = 1/(distance of centres), so that d/dgap = -t^2 d/dt.
    const Eigen::MatrixXd slope =
        -inverse[k] * inverse[k] * symmetric_matrix(logarithm.col(column), spheres);
    Eigen::MatrixXd matrix =
        unit_length_ *
        (q * (differences.cwiseProduct(q.transpose() * slope * q)) * q.transpose()).eval();
    add_pair(matrix, k,
             pair_lubrication_slope(radii_[k], radii_[k + 1], gaps[k], lubrication_terms_));
    resistance.slopes.emplace_back(viscosity_ * matrix);
  }
  return resistance;
}

}  // namespace viscontact::swimmer
