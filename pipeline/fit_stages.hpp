// Declares the stages that fit a formula to a table of forces: a fit with one basis (list of terms
// in the gap), fits with every basis, and the fit of the shift of a rough wall. Lengths, masses and
// times are in the units of the table. Each function throws Error(kInterrupted) if `stop` requests
// a stop, and Error(kBadInput) if a file cannot be read or written; finished files are kept. The
// commands `run`, `fit` and `shift` call these functions. A change must not write a fit again whose
// numbers are the same, so that the file keeps the time at which it was made.
#pragma once

#include <filesystem>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/results/picture_kind.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::pipeline {

/// Fits the table in the file `table_path` (CSV: gaps [L], velocities [L/T], forces [M L/T^2]) and
/// writes the fit to `fit_path` (JSON), with the record `provenance` of how it was made. If a file
/// at `fit_path` differs from the new one in this record only, it is not written again. A poor fit
/// only causes warnings. Throws Error(kBadInput) if the table is wrong or has fewer different gaps
/// than coefficients are fitted, and Error(kNotConverged) if the terms are linearly dependent on
/// these gaps or a robust loss does not converge.
void fit_stage(const std::filesystem::path& table_path, const std::filesystem::path& fit_path,
               const fitting::FitSettings& settings, const results::Provenance& provenance,
               const StopToken& stop);

/// Fits a table in every basis, prints the fits side by side, as JSON if `json` is true, else as a
/// table, and draws their relative residuals [1] into the file `picture.path`. This path must end
/// with .svg, .pdf, .png or .gp (not checked). A basis that cannot be fitted is listed with the
/// reason. Throws Error(kBadInput) if the table is wrong or no basis can be fitted, and
/// Error(kExternalProgram), after printing, if gnuplot fails.
void compare_bases_stage(const std::filesystem::path& table_path,
                         const fitting::FitSettings& settings,
                         const results::PictureRequest& picture, bool json, const StopToken& stop);

/// Fits the shift of a rough wall: the depth below its crests at which a smooth wall has the same
/// drag (fitting/wall_shift.hpp). Reads the rough wall's table from `table_path` and the smooth
/// wall's fit from `fit_path`. Writes the shift of each row [L] and the common shift to
/// `shift_path` (CSV), prints the common shift [L], >= 0, and, unless `picture.path` is empty,
/// draws a picture. `stop` is checked only while the picture is drawn. Throws Error(kBadInput) if
/// the table or the fit is wrong or their radii or viscosities differ, Error(kNotConverged) if the
/// least squares do not converge, and Error(kExternalProgram), after writing the CSV file, if
/// gnuplot fails.
void shift_stage(const std::filesystem::path& table_path, const std::filesystem::path& fit_path,
                 const std::filesystem::path& shift_path, const results::PictureRequest& picture,
                 const StopToken& stop);

}  // namespace viscontact::pipeline
