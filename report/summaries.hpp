// Summaries of fits, shifts and comparisons: words and tables for the terminal, and pictures. Gaps
// and times are in the units of the case. The stages of pipeline/ print them. A change must keep
// the keys of the JSON, which users' scripts read.
#pragma once

#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/fitting/basis_comparison.hpp"
#include "viscontact/fitting/wall_shift.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/results/picture_kind.hpp"

namespace viscontact::report {

/// One or a few lines: basis, residuals, the cause of the misfit, outliers.
std::string fit_in_words(const lubrication::Fit& fit);

/// A table with one line for each basis, and a last line that names the best basis.
std::string basis_table(const std::vector<fitting::BasisResult>& results);

/// The results as JSON: a list with an object for each basis. The object is the content of the fit
/// file; if the fit failed, it has only the keys "basis" and "failure".
std::string basis_json(const std::vector<fitting::BasisResult>& results);

/// A picture: the relative residuals of every basis over the gap,
/// beside the table's error estimates. Throws Error(kExternalProgram) if gnuplot is missing or
/// fails.
std::string plot_bases(const lubrication::MotionTable& table,
                       const std::vector<fitting::BasisResult>& results,
                       const results::PictureFormat& format, const StopToken& stop = {});

/// A picture with two panels over the gap: the shift of each row
/// beside the common shift [L], and the relative residuals with the common shift. `wall` names the
/// wall in the title. Throws Error(kExternalProgram) if gnuplot is missing or fails.
std::string plot_wall_shift(const fitting::WallShift& shift, const std::string& wall,
                            const results::PictureFormat& format, const StopToken& stop = {});

/// One line per model: smallest gap and its time, recovered film, times of contact, largest
/// distance to the reference.
std::string comparison_table(const reduced_model::Comparison& comparison);

}  // namespace viscontact::report
