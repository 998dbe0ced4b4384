// The stages that fit a formula to a table of forces: one basis (list of terms in the gap), every
// basis, and the shift of a rough wall. Lengths, masses and times are in the units of the table. If
// `stop` requests a stop, a function throws Error(kInterrupted) at its next check; finished files
// are kept. If a file cannot be read or written, it throws Error(kBadInput). The commands `run`,
// `fit` and `shift` call them. A change must not write a fit again whose numbers are the same, so
// that the file keeps its time of making.
#pragma once

#include <filesystem>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/results/picture_kind.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::pipeline {

/// Fits the table in `table_path` and writes the fit to `fit_path`, with the record `provenance` of
/// how it was made. If the file there differs from the new one in this record only, it is left as
/// it is. Throws the errors of read_force_table() and fit_force_table(): Error(kBadInput) for a
/// table that is wrong or has too few gaps, Error(kNotConverged) if the terms are linearly
/// dependent or a robust loss does not converge.
void fit_stage(const std::filesystem::path& table_path, const std::filesystem::path& fit_path,
               const fitting::FitSettings& settings, const results::Provenance& provenance,
               const StopToken& stop);

/// Fits a table in every basis, prints the fits side by side, as JSON if `json` is true, and draws
/// their residuals into the file of `picture`, whose path must not be empty and must end as a kind
/// of picture does (not checked). Throws Error(kBadInput) if the table is wrong or no basis can be
/// fitted, Error(kExternalProgram), after printing, if gnuplot fails.
void compare_bases_stage(const std::filesystem::path& table_path,
                         const fitting::FitSettings& settings,
                         const results::PictureRequest& picture, bool json, const StopToken& stop);

/// Fits the shift of a rough wall: the depth below its crests at which a smooth wall has the same
/// drag (fitting/wall_shift.hpp). Reads the rough wall's table and the smooth wall's fit. Writes
/// the shift of each row to `shift_path` (CSV), prints the common shift [L], >= 0, and, unless the
/// path of `picture` is empty, draws a picture. `stop` is checked only while the picture is drawn.
/// Throws Error(kBadInput) for a wrong table or fit, Error(kNotConverged) if the least squares
/// fail, Error(kExternalProgram), after writing the CSV file, if gnuplot fails.
void shift_stage(const std::filesystem::path& table_path, const std::filesystem::path& fit_path,
                 const std::filesystem::path& shift_path, const results::PictureRequest& picture,
                 const StopToken& stop);

}  // namespace viscontact::pipeline
