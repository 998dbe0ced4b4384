// The NIST Statistical Reference Datasets of linear regression, and how many of their certified
// digits our least squares reach.
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

/// Names of all sets here.
std::span<const std::string_view> nist_sets();

/// Reads tests/fitting/nist/NAME.csv.
NistSet read_nist_set(std::string_view name);

/// Digits in common, -log10 |value/certified - 1|, at most the 15 that are certified.
double digits(double value, double certified);

struct NistDigits {
  double coefficients = 15;  ///< the least over all coefficients
  double deviations = 15;    ///< the least over those that are not 0
  double condition_number = 0;
};

NistDigits digits_reached(const NistSet& set);

}  // namespace viscontact::fitting
