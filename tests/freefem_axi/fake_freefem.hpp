// A shell script in FreeFEM's place: answers at once, remembers what it was asked, and fails as it
// is told to.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/freefem.hpp"

namespace viscontact::freefem_axi {

/// Shell text that sets $gap, $velocity, $viscosity and $radius, or $gap1 and $gap2 of three spheres
/// on a line, from the arguments of FreeFEM,
/// which is called as: FreeFem++-nw -nw -v 0 SCRIPT -name value ...
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
  /// with $gap, $velocity, $viscosity and $radius set and $folder the folder; it may sleep, fail or
  /// exit. (version.edp is answered before that.)
  explicit FakeFreeFem(std::filesystem::path folder, const std::string& before = "");

  /// What the row of a gap and velocity answers: F = -6 pi mu r u0 (r/q + 1), which the lecture's
  /// basis fits exactly. Three spheres on a line at gaps p and q answer R = diag(19) plus 1/p and
  /// 1/q against changes of the gaps, and R13 = -0.5.
  static double force(double radius, double viscosity, double gap, double velocity);

  FreeFem freefem() const { return {executable(), folder_}; }
  std::string executable() const { return (folder_ / "fake_freefem").string(); }

  /// "GAP VELOCITY", or both gaps of three spheres, of every row answered so far, in the order of answering.
  std::vector<std::string> answered() const;

 private:
  std::filesystem::path folder_;
};

}  // namespace viscontact::freefem_axi
