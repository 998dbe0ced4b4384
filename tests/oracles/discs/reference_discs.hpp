// Reads data/reference/discs.csv: exact motions of discs in Stokes flow, and dissipations, in the
// units of DiscProblem.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/oracles/discs/discs_in_stokes_flow.hpp"

namespace viscontact {

/// A case of the file. Each disc of the case has a row; the rows of a case have the same name.
struct ReferenceDiscs {
  std::string name;
  DiscProblem problem;
  DiscAnswer answer;
  /// Digits in which both methods agree, relative to the largest velocity (or radius times angular
  /// velocity) of the case, and in added_dissipation; at most 12.
  int digits = 0;
};

/// All cases of the file below the source folder. Throws std::runtime_error if the file does not
/// have the form that reference_discs_text() writes.
std::vector<ReferenceDiscs> read_reference_discs(const std::filesystem::path& source_folder);

/// The case of this name. Throws std::runtime_error if there is none.
ReferenceDiscs reference_discs(const std::filesystem::path& source_folder, const std::string& name);

// Both methods, with as many unknowns as the narrowest gap needs for 12 digits, or for 8 digits
// below a gap of 0.1 radii.
DiscAnswer solved_by_collocation(const DiscProblem& problem);
DiscAnswer solved_by_boundary_integral(const DiscProblem& problem);

/// Largest difference of the motions of `a` and `b`, and of their added_dissipation, each divided
/// by its largest value.
double difference(const DiscProblem& problem, const DiscAnswer& a, const DiscAnswer& b);

/// The text of the file, with all cases computed anew.
std::string reference_discs_text();

}  // namespace viscontact
