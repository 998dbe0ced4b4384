#include "tests/oracles/discs/reference_discs.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace viscontact {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

const std::map<DiscDomain2d, std::string> kDomains = {{DiscDomain2d::kRoundContainer, "container"},
                                                      {DiscDomain2d::kChannel, "channel"},
                                                      {DiscDomain2d::kSquareCell, "cell"}};

constexpr const char* kHead =
    "# Rigid discs in plane Stokes flow, exact to n_digits digits. Viscosity 1, per unit length.\n"
    "# domain: container: |z| < size; channel: walls at y = +-size/2, periodic along x with the\n"
    "# period `length`, no mean flow; cell: periodic both ways with the period `size`, mean "
    "velocity\n"
    "# 0. One row a disc; rows of one case together. The walls, or the cell in the mean, move at\n"
    "# (strain_x x + (strain_y - rotation) y, (strain_y + rotation) x - strain_x y).\n"
    "# force, torque: on the disc; velocity, spin: its motion, counter-clockwise > 0.\n"
    "# added_dissipation: dissipation with the discs over that without, less 1, for free discs.\n"
    "# Two methods: collocation with Goursat's functions, and a completed double layer; n_digits "
    "is\n"
    "# the number of digits in which they agree, at most 12. tests/oracles/discs has both;\n"
    "# its program discs_reference writes this file.\n"
    "case,domain,size,length,x,y,radius,force_x,force_y,torque,strain_x,strain_y,rotation,"
    "velocity_x,velocity_y,spin,added_dissipation,n_digits\n";

/// In bipolar coordinates two circles are alpha = asinh(focus/radius); the coefficients of poles in
/// the circle fall as exp(-n alpha).
double focus(double radius1, double radius2, double distance) {
  const double d2 = distance * distance, a2 = radius1 * radius1, b2 = radius2 * radius2;
  return std::sqrt((d2 - a2 - b2) * (d2 - a2 - b2) - 4 * a2 * b2) / (2 * distance);
}

struct Resolution {
  int poles = 8, regular = 10;
  int nodes() const { return 3 * poles + 40; }
};

Resolution resolution_of(const DiscProblem& problem) {
  constexpr double kDecay = 28;  // exp(-28) = 7e-13
  Resolution resolution;
  const auto raise = [](int& number, double to) {
    // More poles than these make the matrix too large for a test; a gap of 0.02 radii has 8 digits.
    number = std::clamp(static_cast<int>(to) + 8, number, 138);
  };
  for (const auto& disc : problem.discs) {
    const double a = disc.radius;
    if (problem.domain == DiscDomain2d::kRoundContainer) {
      if (const double d = std::abs(disc.centre); d > 0) {
        const double c = focus(a, problem.size, d);
        raise(resolution.poles, kDecay / std::asinh(c / a));
        raise(resolution.regular, kDecay / std::asinh(c / problem.size));
      }
      for (const auto& other : problem.discs)
        if (&other != &disc) {
          const double c = focus(a, other.radius, std::abs(other.centre - disc.centre));
          raise(resolution.poles, kDecay / std::asinh(c / a));
        }
    } else if (problem.domain == DiscDomain2d::kChannel) {
      const double half = problem.size / 2, near = std::min(half, problem.length / 2);
      raise(resolution.poles, kDecay / std::acosh(near / a));
      raise(resolution.regular,
            kDecay * problem.length / (2 * pi * std::sqrt(half * half - a * a)));
    } else {
      raise(resolution.poles, kDecay / std::acosh(problem.size / (2 * a)));
      raise(resolution.regular, 40 + 60 * a / problem.size);
    }
  }
  return resolution;
}

int wall_nodes(const DiscProblem& problem) {
  if (problem.domain == DiscDomain2d::kRoundContainer)
    return 5 * resolution_of(problem).regular / 2 + 40;
  if (problem.domain == DiscDomain2d::kSquareCell) return 0;
  // The trapezoidal rule errs by exp(-2 pi distance/spacing).
  const double free = problem.size / 2 - problem.discs[0].radius;
  return static_cast<int>(5 * problem.length / free) + 20;
}

using Disc = DiscProblem::Disc;

std::vector<ReferenceDiscs> cases() {
  const Complex i(0, 1);
  std::vector<ReferenceDiscs> all;
  const auto add = [&](const std::string& name, DiscDomain2d domain, double size, double length,
                       const std::vector<Disc>& discs, Complex strain = 0, double rotation = 0) {
    all.push_back({name, {domain, size, length, discs, strain, rotation}, {}, 0});
  };
  const auto container = DiscDomain2d::kRoundContainer;
  add("centre, force", container, 5, 0, {{0, 1, 1, 0}});
  add("centre, torque", container, 5, 0, {{0, 1, 0, 1}});
  add("off the centre, across", container, 5, 0, {{1, 1, i, 0}});
  add("near the wall, towards it", container, 5, 0, {{3, 1, 1, 0}});
  add("near the wall, across", container, 5, 0, {{3, 1, i, 0}});
  for (const auto& [gap, text] : {std::pair(0.5, "0.5"), {0.1, "0.1"}, {0.02, "0.02"}}) {
    const double x = 1 + gap / 2;
    const auto two = std::string("two, gap ") + text;
    add(two + ", squeezed", container, 6, 0, {{-x, 1, 1, 0}, {x, 1, -1, 0}});
    add(two + ", along", container, 6, 0, {{-x, 1, 1, 0}, {x, 1, 1, 0}});
  }
  add("unequal", container, 5, 0,
      {{{-1.5, 0.2}, 1, 1, 0}, {1, 0.7, -i, 0.5}, {2.0 * i, 0.5, {0.3, 0.2}, -0.1}});
  add("centre, strained", container, 4, 0, {{0, 1, 0, 0}}, 1);
  add("two, sheared", container, 5, 0, {{-1.25, 1, 0, 0}, {1.25, 1, 0, 0}}, i / 2.0, -0.5);
  const auto channel = DiscDomain2d::kChannel;
  for (const auto& [height, text] : {std::pair(20.0, "0.1"), {10.0, "0.2"}, {4.0, "0.5"}})
    for (const int cell : {1, 2, 4, 6})
      if (height > 4 || cell == 6)
        add(std::string("sheared, 2a/H = ") + text + ", cell of " + std::to_string(cell) + " H",
            channel, height, cell * height, {{0, 1, 0, 0}}, i / 2.0, -0.5);
  add("channel, force", channel, 10, 60, {{0, 1, 1, 0}});
  add("channel, torque", channel, 10, 60, {{0, 1, 0, 1}});
  for (const auto& [phi, text] : {std::pair(0.05, "0.05"),
                                  {0.1, "0.1"},
                                  {0.2, "0.2"},
                                  {0.3, "0.3"},
                                  {0.4, "0.4"},
                                  {0.5, "0.5"}}) {
    const double radius = std::sqrt(phi / pi);
    const std::string lattice = std::string("lattice ") + text;
    add(lattice + ", axes", DiscDomain2d::kSquareCell, 1, 0, {{0, radius, 0, 0}}, 1);
    add(lattice + ", diagonals", DiscDomain2d::kSquareCell, 1, 0, {{0, radius, 0, 0}}, i);
    add(lattice + ", force", DiscDomain2d::kSquareCell, 1, 0, {{0, radius, 1, 0}});
  }
  return all;
}

double largest_motion(const DiscProblem& problem, const DiscAnswer& answer) {
  double largest = 0;
  for (std::size_t k = 0; k < problem.discs.size(); ++k)
    largest = std::max({largest, std::abs(answer.velocities[k]),
                        std::abs(answer.spins[k]) * problem.discs[k].radius});
  return largest;
}

}  // namespace

DiscAnswer solved_by_collocation(const DiscProblem& problem) {
  const auto resolution = resolution_of(problem);
  return discs_by_collocation(problem, resolution.poles, resolution.regular);
}

DiscAnswer solved_by_boundary_integral(const DiscProblem& problem) {
  return discs_by_boundary_integral(problem, resolution_of(problem).nodes(), wall_nodes(problem));
}

double difference(const DiscProblem& problem, const DiscAnswer& a, const DiscAnswer& b) {
  double motions = 0;
  for (std::size_t k = 0; k < problem.discs.size(); ++k)
    motions = std::max({motions, std::abs(a.velocities[k] - b.velocities[k]),
                        std::abs(a.spins[k] - b.spins[k]) * problem.discs[k].radius});
  // Discs that a symmetry keeps at rest move by rounding errors of the flow around them.
  double unit = largest_motion(problem, a);
  if (std::abs(problem.strain) > 0)
    unit = std::max(unit, std::abs(problem.strain) * problem.discs[0].radius);
  const double added = std::abs(a.added_dissipation - b.added_dissipation);
  return std::max(motions / unit, added > 0 ? added / std::abs(a.added_dissipation) : 0);
}

std::string reference_discs_text() {
  std::string text = kHead;
  for (const auto& [name, problem, unused, also_unused] : cases()) {
    const auto answer = solved_by_collocation(problem);
    const double differ = difference(problem, answer, solved_by_boundary_integral(problem));
    const int digits = differ > 1e-12 ? static_cast<int>(-std::log10(differ)) : 12;
    const double zero = 1e-11 * std::max(largest_motion(problem, answer), std::abs(problem.strain));
    const auto number = [](double value) {
      char buffer[40];
      std::snprintf(buffer, sizeof buffer, ",%.14g", value);
      return std::string(buffer);
    };
    // Motions that vanish by symmetry are rounding errors here, and are written as 0.
    const auto motion = [&](double value) { return number(std::abs(value) < zero ? 0 : value); };
    for (std::size_t k = 0; k < problem.discs.size(); ++k) {
      const auto& disc = problem.discs[k];
      text += '"' + name + "\"," + kDomains.at(problem.domain) + number(problem.size) +
              number(problem.length) + number(disc.centre.real()) + number(disc.centre.imag());
      char radius[40];
      std::snprintf(radius, sizeof radius, ",%.17g", disc.radius);
      text += radius + number(disc.force.real()) + number(disc.force.imag()) + number(disc.torque) +
              number(problem.strain.real()) + number(problem.strain.imag()) +
              number(problem.rotation) + motion(answer.velocities[k].real()) +
              motion(answer.velocities[k].imag()) + motion(answer.spins[k]) +
              number(answer.added_dissipation) + "," + std::to_string(digits) + "\n";
    }
  }
  return text;
}

std::vector<ReferenceDiscs> read_reference_discs(const std::filesystem::path& source_folder) {
  const auto path = source_folder / "data" / "reference" / "discs.csv";
  std::ifstream stream(path);
  std::vector<ReferenceDiscs> all;
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line[0] != '"') continue;
    const auto end = line.find('"', 1);
    const std::string name = line.substr(1, end - 1);
    std::istringstream fields(line.substr(end + 2));
    std::string domain;
    std::getline(fields, domain, ',');
    std::vector<double> n;
    for (std::string field; std::getline(fields, field, ',');) n.push_back(std::stod(field));
    if (n.size() != 16) throw std::runtime_error(path.string() + ": " + line);
    if (all.empty() || all.back().name != name) {
      ReferenceDiscs added;
      added.name = name;
      for (const auto& [kind, word] : kDomains)
        if (word == domain) added.problem.domain = kind;
      added.problem.size = n[0];
      added.problem.length = n[1];
      added.problem.strain = {n[8], n[9]};
      added.problem.rotation = n[10];
      added.answer.added_dissipation = n[14];
      added.digits = static_cast<int>(n[15]);
      all.push_back(added);
    }
    all.back().problem.discs.push_back({{n[2], n[3]}, n[4], {n[5], n[6]}, n[7]});
    all.back().answer.velocities.emplace_back(n[11], n[12]);
    all.back().answer.spins.push_back(n[13]);
  }
  if (all.empty()) throw std::runtime_error(path.string() + " has no rows");
  return all;
}

ReferenceDiscs reference_discs(const std::filesystem::path& source_folder,
                               const std::string& name) {
  for (const auto& found : read_reference_discs(source_folder))
    if (found.name == name) return found;
  throw std::runtime_error("data/reference/discs.csv has no case " + name);
}

}  // namespace viscontact
