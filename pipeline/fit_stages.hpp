// The stages that fit a formula to a table of forces: one basis (list of terms in the gap), every
// basis, and the shift of a rough wall. Lengths, masses and times are in the units of the table. If
// `stop` requests a stop, each function throws Error(kInterrupted); finished files are kept. The
// commands `run`, `fit` and `shift` call them. A change must not write a fit again whose numbers
// are the same, so that the file keeps its time of making.
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
/// table that is wrong or too small, Error(kNotConverged) if the least squares fail.
void fit_stage(const std::filesystem::path& table_path, const std::filesystem::path& fit_path,
               const fitting::FitSettings& settings, const results::Provenance& provenance,
               const StopToken& stop);

/// Fits a table in every basis, prints the fits side by side, as JSON if `json` is true, and draws
/// their residuals into the file of `picture`. Throws Error(kBadInput) if the table is wrong or no
/// basis can be fitted, Error(kExternalProgram) if gnuplot fails.
void compare_bases_stage(const std::filesystem::path& table_path,
                         const fitting::FitSettings& settings,
                         const results::PictureRequest& picture, bool json, const StopToken& stop);

/// Fits the shift of a rough wall: the depth below its crests at which a smooth wall has the same
/// drag (fitting/wall_shift.hpp). Reads the rough wall's table and the smooth wall's fit. Prints
/// the shift [L], writes the shift of each row to `shift_path` (CSV) and, unless the path of
/// `picture` is empty, a picture. Throws Error(kBadInput) for a wrong table or fit,
/// Error(kNotConverged) if the least squares fail, Error(kExternalProgram) if gnuplot fails.
void shift_stage(const std::filesystem::path& table_path, const std::filesystem::path& fit_path,
                 const std::filesystem::path& shift_path, const results::PictureRequest& picture,
                 const StopToken& stop);

}  // namespace viscontact::pipeline
