// The stages that fit a formula to a table of forces: with one basis, with every basis, and the
// shift of a rough wall. Lengths, masses and times are in the units of the table.
#pragma once

#include <filesystem>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/results/picture_kind.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::pipeline {

/// Fits the table and writes the fit to `fit_path` (JSON), with the record `provenance` of how it
/// was made. A file that differs in this record only is not written again, so that it keeps the
/// time at which it was made. A poor fit only causes warnings. Throws Error(kBadInput) if a file
/// cannot be read or written, or if the table has fewer different gaps than coefficients are
/// fitted, Error(kNotConverged) if the terms are linearly dependent on these gaps or a robust loss
/// does not converge, and Error(kInterrupted) at a stop.
void fit_stage(const std::filesystem::path& table_path, const std::filesystem::path& fit_path,
               const fitting::FitSettings& settings, const results::Provenance& provenance,
               const StopToken& stop);

/// Fits a table in every basis, prints the fits side by side, as JSON if `json` is true, else as a
/// table, and draws their relative residuals [1] into the file `picture.path`, which must end with
/// .svg, .pdf, .png or .gp. A basis that cannot be fitted is listed with the reason. Throws
/// Error(kBadInput) if the table is wrong, a file cannot be read or written or no basis can be
/// fitted, Error(kInterrupted) at a stop, and Error(kExternalProgram), after printing, if gnuplot
/// fails.
void compare_bases_stage(const std::filesystem::path& table_path,
                         const fitting::FitSettings& settings,
                         const results::PictureRequest& picture, bool json, const StopToken& stop);

/// Fits the shift of a rough wall: the depth below its crests at which a smooth wall has the same
/// drag (fitting/wall_shift.hpp). Reads the rough wall's table and the smooth wall's fit, writes
/// the shift of each row [L] and the common shift to `shift_path` (CSV, docs/file-formats.md),
/// prints the common shift [L], >= 0, and, unless `picture.path` is empty, draws a picture; only
/// that can be interrupted. Throws Error(kBadInput) if a file cannot be read or written or if radii
/// or viscosities differ, Error(kNotConverged) if the least squares do not converge, and
/// Error(kExternalProgram), after writing the CSV file, if gnuplot fails.
void shift_stage(const std::filesystem::path& table_path, const std::filesystem::path& fit_path,
                 const std::filesystem::path& shift_path, const results::PictureRequest& picture,
                 const StopToken& stop);

}  // namespace viscontact::pipeline
