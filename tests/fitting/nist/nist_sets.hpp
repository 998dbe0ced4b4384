// The NIST Statistical Reference Datasets of linear regression, and how many of their certified
// digits the least squares of fitting/ reach. Numbers have no units.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/fitting/least_squares.hpp"

namespace viscontact::fitting {

struct NistSet {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right_hand_side;
  std::vector<double> coefficients;  ///< certified, 15 digits
  std::vector<double> deviations;    ///< of the coefficients, certified; 0: exact data
};

/// Names of the sets that are in tests/fitting/nist.
std::span<const std::string_view> nist_sets();

/// Reads tests/fitting/nist/NAME.csv.
NistSet read_nist_set(std::string_view name);

/// Number of digits that agree, -log10 |value/certified - 1|, at most 15, as many as are certified.
double digits(double value, double certified);

struct NistDigits {
  double coefficients = 15;  ///< smallest number of digits of all coefficients
  double deviations = 15;    ///< smallest number of digits of all deviations that are not 0
  double condition_number = 0;
};

NistDigits digits_reached(const NistSet& set);

}  // namespace viscontact::fitting
