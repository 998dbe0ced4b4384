// Reads the lines "viscontact-level LEVEL NUMBER ..." that FreeFEM scripts print for each mesh, and
// computes orders of convergence. Numbers have the units of the script.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "viscontact/common/system/process.hpp"
#include "viscontact/common/text/number.hpp"

namespace viscontact::freefem_axi {

/// For each level, the `count` numbers that follow LEVEL. Levels are numbered from 0. Fails the
/// test if the script failed; throws std::invalid_argument for a line with another number of
/// numbers.
inline std::vector<std::vector<double>> levels_of(const ProcessResult& result, std::size_t count) {
  EXPECT_EQ(result.exit_status, 0) << result.output;
  std::vector<std::vector<double>> levels;
  std::istringstream lines(result.output);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    std::vector<double> numbers;
    if (!(words >> word) || word != "viscontact-level") continue;
    while (words >> word) numbers.push_back(parse_number(word).value());
    if (numbers.size() != count + 1) throw std::invalid_argument("not a level: " + line);
    EXPECT_EQ(numbers[0], static_cast<double>(levels.size()));
    numbers.erase(numbers.begin());
    levels.push_back(numbers);
  }
  return levels;
}

/// Order of convergence from the errors on a mesh and on one with half the mesh size.
inline double observed_order(double coarse_error, double fine_error) {
  return std::log2(std::abs(coarse_error / fine_error));
}

}  // namespace viscontact::freefem_axi
