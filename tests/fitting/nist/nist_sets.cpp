#include "tests/fitting/nist/nist_sets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace viscontact::fitting {
namespace {

constexpr std::array<std::string_view, 9> kNames = {"Norris",   "Pontius",  "Longley",
                                                    "Wampler1", "Wampler2", "Wampler3",
                                                    "Wampler4", "Wampler5", "Filip"};

std::vector<double> numbers_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (double number = 0; stream >> number;) numbers.push_back(number);
  return numbers;
}

}  // namespace

std::span<const std::string_view> nist_sets() { return kNames; }

NistSet read_nist_set(std::string_view name) {
  std::ifstream file(VISCONTACT_SOURCE_FOLDER "/tests/fitting/nist/" + std::string(name) + ".csv");
  NistSet set;
  int degree = 0;  // of the polynomial; 0: linear in all predictors
  std::vector<std::vector<double>> rows;
  bool in_header = true;
  for (std::string line; std::getline(file, line);) {
    const auto value_of = [&](const std::string& key) {
      return line.starts_with(key) ? line.substr(key.size()) : "";
    };
    if (const auto text = value_of("# coefficients: "); !text.empty())
      set.coefficients = numbers_of(text);
    if (const auto text = value_of("# deviations: "); !text.empty())
      set.deviations = numbers_of(text);
    if (const auto text = value_of("# model: polynomial of degree "); !text.empty())
      degree = std::stoi(text);
    if (line.starts_with('#')) continue;
    std::ranges::replace(line, ',', ' ');
    if (!in_header) rows.push_back(numbers_of(line));
    in_header = false;
  }
  if (rows.empty()) throw std::runtime_error("no such NIST set: " + std::string(name));
  const auto columns = static_cast<Eigen::Index>(set.coefficients.size());
  set.matrix.resize(static_cast<Eigen::Index>(rows.size()), columns);
  set.right_hand_side.resize(set.matrix.rows());
  for (Eigen::Index i = 0; i < set.matrix.rows(); ++i) {
    const auto& row = rows[static_cast<std::size_t>(i)];
    set.right_hand_side(i) = row[0];
    for (Eigen::Index j = 0; j < columns; ++j)
      set.matrix(i, j) = j == 0       ? 1
                         : degree > 0 ? std::pow(row[1], static_cast<double>(j))
                                      : row[static_cast<std::size_t>(j)];
  }
  return set;
}

double digits(double value, double certified) {
  constexpr double kCertifiedDigits = 15;
  const double error = std::abs(value / certified - 1);
  return error == 0 ? kCertifiedDigits : std::min(kCertifiedDigits, -std::log10(error));
}

NistDigits digits_reached(const NistSet& set) {
  const auto solution = solve_least_squares(set.matrix, set.right_hand_side);
  NistDigits reached;
  reached.condition_number = solution.condition_number;
  for (std::size_t i = 0; i < set.coefficients.size(); ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    reached.coefficients =
        std::min(reached.coefficients, digits(solution.coefficients(j), set.coefficients[i]));
    if (set.deviations[i] > 0)
      reached.deviations = std::min(
          reached.deviations, digits(std::sqrt(solution.covariance(j, j)), set.deviations[i]));
  }
  return reached;
}

}  // namespace viscontact::fitting
