// The stages that fit: a table in one basis, a table in every basis, and the shift of a rough wall.
// Lengths, masses and times are in the units of the table. If `stop` requests a stop, a stage
// throws Error(kInterrupted); finished files are kept. The main job and the commands `fit` and
// `shift` call them. A change must keep that a fit that did not change is not written again.
#pragma once

#include <filesystem>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/results/picture_kind.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::pipeline {

/// Fits the table in `table_path` and writes the fit to `fit_path`. If the file there differs in
/// its provenance only, it is left as it is. Throws the errors of read_force_table() and
/// fit_force_table().
void fit_stage(const std::filesystem::path& table_path, const std::filesystem::path& fit_path,
               const fitting::FitSettings& settings, const results::Provenance& provenance,
               const StopToken& stop);

/// Fits a table in every basis, prints the fits side by side and draws their residuals.
/// Throws Error(kBadInput) if no basis can be fitted, Error(kExternalProgram) if gnuplot fails.
void compare_bases_stage(const std::filesystem::path& table_path,
                         const fitting::FitSettings& settings,
                         const results::PictureRequest& picture, bool json, const StopToken& stop);

/// Fits the shift of a rough wall: the depth below its crests at which a smooth wall has the same
/// drag (fitting/wall_shift.hpp). Uses the rough wall's table and the smooth wall's fit. Prints the
/// shift [L], writes the shift of each row (CSV) and, unless its path is empty, a picture.
/// Throws Error(kBadInput) for a wrong table or fit, Error(kExternalProgram) if gnuplot fails.
void shift_stage(const std::filesystem::path& table_path, const std::filesystem::path& fit_path,
                 const std::filesystem::path& shift_path, const results::PictureRequest& picture,
                 const StopToken& stop);

}  // namespace viscontact::pipeline
