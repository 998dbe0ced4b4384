// The pictures of a folder as PDF files, by rsvg-convert (librsvg).
#pragma once

#include <filesystem>

#include "viscontact/common/stop_token.hpp"

namespace viscontact::report {

/// Throws Error(kExternalProgram) if rsvg-convert is missing.
void require_pdf_converter();

/// Writes a PDF beside each SVG of Viscontact in `folder` and in its folder plots/. Throws
/// Error(kExternalProgram) if rsvg-convert is missing or fails, Error(kBadInput) if a PDF would
/// replace a file that Viscontact did not write or cannot be written, and Error(kInterrupted) if
/// `stop` requests a stop.
void write_pdfs(const std::filesystem::path& folder, const StopToken& stop = {});

/// Removes the PDF of the SVG at `picture` if Viscontact wrote it, because it is about to become
/// older than the SVG.
void remove_pdf_of(const std::filesystem::path& picture);

}  // namespace viscontact::report
