// The lines "viscontact-level LEVEL NUMBER ..." of a script, and orders of convergence.
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

/// The numbers that follow LEVEL, level by level, `count` of them each.
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

/// From a mesh to one of half its size.
inline double observed_order(double coarse_error, double fine_error) {
  return std::log2(std::abs(coarse_error / fine_error));
}

}  // namespace viscontact::freefem_axi
