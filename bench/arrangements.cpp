// Time of random arrangements of spheres and discs in a periodic box, and how random they are.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/arrangement/arrangement.hpp"
#include "viscontact/common/error.hpp"

namespace {

using namespace viscontact;
using namespace viscontact::particles;

struct Bond {
  std::size_t to;
  double distance;  // of the centres over the sum of the radii
  Vector direction;
};

struct Sample {
  Arrangement asked;
  BoxDomain box;
  std::vector<double> centres;
};

/// The nearest particles of particle `i`, beginning with the nearest one.
std::vector<Bond> bonds_of(const Sample& sample, std::size_t i, std::size_t most) {
  const auto n = static_cast<int>(sample.box.dimension());
  const auto periods = periods_of(sample.box);
  std::vector<Bond> all;
  for (std::size_t j = 0; j < sample.asked.radii.size(); ++j) {
    if (j == i) continue;
    Vector apart = point_of(sample.centres.data(), j, n) - point_of(sample.centres.data(), i, n);
    for (std::size_t d = 0; d < 3; ++d)
      if (periods[d] > 0) apart[d] = std::remainder(apart[d], periods[d]);
    const double length = norm(apart);
    all.push_back(
        {j, length / (sample.asked.radii[i] + sample.asked.radii[j]), (1 / length) * apart});
  }
  std::ranges::nth_element(all, all.begin() + static_cast<std::ptrdiff_t>(most), {},
                           &Bond::distance);
  all.resize(most);
  return all;
}

/// Sum of P_6 over all pairs of directions of two particles (in the plane cos 6 times the angle):
/// up to a factor the product of their vectors of bond orders of Steinhardt, Nelson & Ronchetti
/// (1983).
double product(const std::vector<Bond>& a, const std::vector<Bond>& b, bool is_flat) {
  double sum = 0;
  for (const auto& x : a)
    for (const auto& y : b) {
      const double c = dot(x.direction, y.direction), c2 = c * c;
      sum += is_flat ? ((32 * c2 - 48) * c2 + 18) * c2 - 1
                     : (((231 * c2 - 315) * c2 + 105) * c2 - 5) / 16;
    }
  return sum;
}

/// Prints how many of the nearest particles are closer than 1.1 diameters, the share of the
/// particles in crystals, and the mean squares of the components of the directions to near ones.
void print_order(const Sample& sample) {
  const bool is_flat = sample.box.dimension() == 2;
  const std::size_t count = sample.asked.radii.size(), nearest = is_flat ? 6 : 12;
  std::vector<std::vector<Bond>> bonds;
  std::vector<double> length2;
  Vector fabric{};
  double near = 0;
  for (std::size_t i = 0; i < count; ++i) {
    bonds.push_back(bonds_of(sample, i, nearest));
    length2.push_back(product(bonds.back(), bonds.back(), is_flat));
    for (const auto& bond : bonds.back()) {
      if (bond.distance < 1.1) near += 1;
      if (bond.distance < 1.1)
        for (std::size_t d = 0; d < 3; ++d) fabric[d] += bond.direction[d] * bond.direction[d];
    }
  }
  // ten Wolde, Ruiz-Montero & Frenkel (1995): a particle is in a crystal if the normalised products
  // with at least 7 of its 12 (in the plane 4 of its 6) neighbours exceed 0.7.
  std::size_t ordered = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto alike = std::ranges::count_if(bonds[i], [&](const Bond& bond) {
      return product(bonds[i], bonds[bond.to], is_flat) >
             0.7 * std::sqrt(length2[i] * length2[bond.to]);
    });
    if (alike >= (is_flat ? 4 : 7)) ++ordered;
  }
  const auto n = static_cast<double>(count);
  std::printf("  near %.2f, crystal %.3f, fabric", near / n, static_cast<double>(ordered) / n);
  for (std::size_t d = 0; d < sample.box.dimension(); ++d) std::printf(" %.3f", fabric[d] / near);
}

/// `ratio` of the radii of two kinds that have half of the volume each; 1: all are equal.
void run(std::size_t dimension, std::size_t count, double ratio, double fraction) {
  Sample sample;
  const auto power = static_cast<double>(dimension);
  const auto large = static_cast<std::size_t>(
      std::round(static_cast<double>(count) / (1 + std::pow(ratio, power))));
  for (std::size_t i = 0; i < count; ++i) sample.asked.radii.push_back(i < large ? ratio : 1);
  const double size = size_of(sample.asked, static_cast<int>(dimension)) / fraction;
  const double length = std::pow(size, 1 / power);
  for (std::size_t d = 0; d < dimension; ++d) {
    sample.box.to[d] = length;
    sample.box.periodic[d] = true;
  }
  std::printf("%zuD %7zu ratio %.1f fraction %.3f:", dimension, count, ratio, fraction);
  const auto start = std::clock();
  try {
    sample.centres = arrange(sample.asked, sample.box, {});
  } catch (const Error& error) {
    std::printf(" %6.2f s %s\n", static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC,
                error.what());
    return;
  }
  std::printf(" %6.2f s", static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  if (count <= 4000) print_order(sample);
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 5) {
    run(std::stoul(arguments[1]), std::stoul(arguments[2]), std::stod(arguments[3]),
        std::stod(arguments[4]));
    return 0;
  }
  for (const double fraction : {0.45, 0.55, 0.60, 0.62, 0.63})
    for (const std::size_t n : {200U, 1000U, 10000U, 100000U})
      for (const double ratio : {1.0, 1.4}) run(3, n, ratio, fraction);
  for (const double fraction : {0.70, 0.80, 0.82, 0.83})
    for (const double ratio : {1.0, 1.4}) run(2, 1000, ratio, fraction);
}
