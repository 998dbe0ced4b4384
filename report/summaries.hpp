// Summaries of fits, shifts of rough walls and comparisons of models: words and tables for the
// terminal, JSON, and pictures. Gaps and times are in the units of the case, residuals are relative
// [1]. pipeline/fit_stages.cpp and pipeline/compare_stage.cpp print them. Fits must have
// diagnostics: without them fit_in_words() and basis_table() throw std::bad_optional_access. A
// change must keep the keys of the JSON, which users' scripts read.
#pragma once

#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/fitting/basis_comparison.hpp"
#include "viscontact/fitting/wall_shift.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/results/picture_kind.hpp"

namespace viscontact::report {

/// Lines on basis, residuals, cause of the misfit and outliers; the last has no line break.
std::string fit_in_words(const lubrication::Fit& fit);

/// A table with a line for each basis (of a failed fit, with the reason), and a last line that
/// names the basis with the smallest information criterion (AICc), if one has a criterion.
std::string basis_table(const std::vector<fitting::BasisResult>& results);

/// A JSON list with an object for each basis: the content of the fit file or, if the fit failed,
/// the keys "basis" and "failure" only.
std::string basis_json(const std::vector<fitting::BasisResult>& results);

/// A picture of the relative residuals of every basis over the gap, beside the table's error
/// estimates. `table` must be that of the fits (not checked). Throws Error(kExternalProgram) if
/// gnuplot is missing or fails, as it does if every fit failed and the table has no estimates, and
/// Error(kInterrupted) if `stop` requests a stop.
std::string plot_bases(const lubrication::MotionTable& table,
                       const std::vector<fitting::BasisResult>& results,
                       const results::PictureFormat& format, const StopToken& stop = {});

/// A picture with two panels over the gap: the shift of each row beside the common shift [L], by
/// which the smooth wall lies below the crests of the rough one, and the relative residuals with
/// the common shift. `wall` is the wall's name in the title. Throws the errors of plot_bases().
std::string plot_wall_shift(const fitting::WallShift& shift, const std::string& wall,
                            const results::PictureFormat& format, const StopToken& stop = {});

/// A table with a line for each model: smallest gap and its time, film recovered from gamma, times
/// of contact, largest distance to the reference, and when solids touch if they do in a model.
std::string comparison_table(const reduced_model::Comparison& comparison);

}  // namespace viscontact::report
