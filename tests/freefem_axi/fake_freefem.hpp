// A shell script that tests run in the place of FreeFEM: it answers at once, records what it was
// asked, and fails where a test wants it to. Numbers are in the units of the case.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/journal/freefem.hpp"

namespace viscontact::freefem_axi {

/// Shell text that sets $gap, $velocity, $viscosity and $radius, or $gap1 and $gap2 of three
/// spheres on a line, from the arguments of FreeFEM, which is called as: FreeFem++-nw -nw -v 0
/// SCRIPT -name value ...
inline constexpr const char* kReadRow = R"(shift 4
while [ $# -gt 1 ]; do
  case $1 in
    -gap) gap=$2 ;;
    -gap1) gap1=$2 ;;
    -gap2) gap2=$2 ;;
    -velocity) velocity=$2 ;;
    -viscosity) viscosity=$2 ;;
    -radius) radius=$2 ;;
  esac
  shift 2
done
)";

class FakeFreeFem {
 public:
  /// Writes the script into `folder`. `before` is shell text that runs before a row is answered,
  /// with $gap, $velocity, $viscosity and $radius set, and with $folder as the folder; it may
  /// sleep, fail or exit. The question for the version (version.edp) is answered before it runs.
  explicit FakeFreeFem(std::filesystem::path folder, const std::string& before = "");

  /// The force that the script answers for a row: F = -6 pi mu r u0 (r/q + 1) with the viscosity
  /// mu, the radius r, the velocity u0 and the gap q, which the lecture's basis fits exactly. For
  /// three spheres on a line with the gaps p and q it answers a resistance matrix: 19 on the
  /// diagonal, resistances 1/p and 1/q against changes of the gaps, and -0.5 between the first and
  /// the last sphere.
  static double force(double radius, double viscosity, double gap, double velocity);

  FreeFem freefem() const { return {executable(), folder_}; }
  std::string executable() const { return (folder_ / "fake_freefem").string(); }

  /// "GAP VELOCITY", or both gaps of three spheres, of each row answered so far, in the order of
  /// the answers.
  std::vector<std::string> answered() const;

 private:
  std::filesystem::path folder_;
};

}  // namespace viscontact::freefem_axi
