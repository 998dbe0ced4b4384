// Summaries of fits, shifts of rough walls and comparisons of models: words and tables for the
// terminal, JSON, and pictures. Gaps [L] and times [T] are in the units of the case.
#pragma once

#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/fitting/basis_comparison.hpp"
#include "viscontact/fitting/wall_shift.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/results/picture_kind.hpp"

namespace viscontact::report {

/// Lines that say the basis of a fit, its residuals, the cause of its misfit and its outliers. The
/// last line has no line break. Throws std::bad_optional_access for a fit without diagnostics.
std::string fit_in_words(const lubrication::Fit& fit);

/// A table with a line for each basis, with numbers [1] or the reason why the fit failed. If a fit
/// has an information criterion (AICc), a last line names the basis with the smallest one. Throws
/// as fit_in_words() does.
std::string basis_table(const std::vector<fitting::BasisResult>& results);

/// A JSON list with an object for each basis: the content of a fit file (docs/file-formats.md), or
/// only the keys "basis" and "failure" (both texts) if the fit failed.
std::string basis_json(const std::vector<fitting::BasisResult>& results);

/// A picture of the relative residuals of every basis over the gap, beside the table's error
/// estimates. `table` must be the table that was fitted. Throws Error(kExternalProgram) if gnuplot
/// is missing or fails, also because nothing is to be drawn, as every fit failed and the table has
/// no error estimates; and Error(kInterrupted) if `stop` requests a stop.
std::string plot_bases(const lubrication::MotionTable& table,
                       const std::vector<fitting::BasisResult>& results,
                       const results::PictureFormat& format, const StopToken& stop = {});

/// A picture with two panels over the gap. A smooth wall that lies by a shift [L], >= 0, below the
/// crests of a rough wall has about the same drag. The first panel shows the shift of each row
/// beside the common shift of all rows, and the second the relative residuals with the common
/// shift. `wall` names the rough wall in the title. Throws as plot_bases() does if there is no row
/// to draw.
std::string plot_wall_shift(const fitting::WallShift& shift, const std::string& wall,
                            const results::PictureFormat& format, const StopToken& stop = {});

/// A line with the largest Stokes and Reynolds numbers of all models; empty if no trajectory states
/// them.
std::string regime_in_words(const reduced_model::Comparison& comparison);

/// A table with a line for each model: smallest gap and its time, smallest film from gamma (minus
/// the impulse that the film has absorbed), times of contact, and largest distance of the gap to
/// that of the reference model. If solids touch in a model, two more columns show the time and the
/// velocity of the touch. The lines of regime_in_words() follow. A dash replaces a missing value.
std::string comparison_table(const reduced_model::Comparison& comparison);

}  // namespace viscontact::report
