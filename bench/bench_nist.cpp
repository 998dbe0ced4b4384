// How many certified digits the least squares of the fit reach on the data sets for linear
// regression of the NIST Statistical Reference Datasets.
#include <fmt/format.h>

#include "tests/fitting/nist/nist_sets.hpp"

int main() {
  fmt::print("{:<10} {:>5} {:>8} {:>10} {:>20} {:>18}\n", "set", "rows", "columns", "condition",
             "digits, coefficients", "digits, deviations");
  for (const auto name : viscontact::fitting::nist_sets()) {
    const auto set = viscontact::fitting::read_nist_set(name);
    const auto reached = viscontact::fitting::digits_reached(set);
    fmt::print(
        "{:<10} {:>5} {:>8} {:>10.1e} {:>20.1f} {:>18}\n", name, set.matrix.rows(),
        set.matrix.cols(), reached.condition_number, reached.coefficients,
        set.deviations.front() > 0 ? fmt::format("{:.1f}", reached.deviations) : "exact data");
  }
}
