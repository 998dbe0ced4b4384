// Runs rsvg-convert.
#include "viscontact/report/pictures/pdf.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/system/process.hpp"
#include "viscontact/common/text/on_one_line.hpp"
#include "viscontact/common/text/text_kind.hpp"
#include "viscontact/results/foreign_files.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::report {
namespace {

namespace fs = std::filesystem;

fs::path pdf_of(fs::path picture) { return picture.replace_extension(".pdf"); }

[[noreturn]] void refuse_missing_converter(const std::string& reason) {
  throw Error(
      ErrorKind::kExternalProgram,
      "rsvg-convert, which makes PDF files, cannot be run ({}); install it (apt-get install "
      "librsvg2-bin)",
      reason);
}

/// The PDF of a picture. The text in it stays text.
std::string converted(const std::string& svg, const fs::path& picture, const StopToken& stop) {
  const auto result =
      run_process({"rsvg-convert", "--format=pdf"}, {"LC_ALL=C.UTF-8"}, svg, {}, {}, stop);
  if (!result.started) refuse_missing_converter(result.output);
  if (result.exit_status != 0 || !result.output.starts_with("%PDF-"))
    throw Error(ErrorKind::kExternalProgram,
                "rsvg-convert could not convert {} (exit status {}): {}", picture.string(),
                result.exit_status, on_one_line(result.output));
  return result.output;
}

}  // namespace

void require_pdf_converter() {
  const auto result = run_process({"rsvg-convert", "--version"}, {});
  if (!result.started) refuse_missing_converter(result.output);
}

void write_pdfs(const fs::path& folder, const StopToken& stop) {
  std::vector<fs::path> pictures;
  for (const auto& place : {folder, folder / "plots"})
    if (fs::is_directory(place))
      for (const auto& entry : fs::directory_iterator(place))
        if (entry.is_regular_file() && entry.path().extension() == ".svg" &&
            results::is_written_by_viscontact(entry.path()))
          pictures.push_back(entry.path());
  std::ranges::sort(pictures);
  for (const auto& picture : pictures)
    results::refuse_other_kind(pdf_of(picture), "%PDF-", "picture");
  for (const auto& picture : pictures) {
    stop.throw_if_stop_requested();
    const auto svg = read_file(picture);
    results::write_output(pdf_of(picture), TextKind::kPdf, converted(svg, picture, stop),
                          results::provenance_in(svg, picture.string())
                              .value_or(results::provenance_of({{}, {picture}})));
  }
  terminal::say("plots: {} PDF files in {}", pictures.size(), folder.string());
}

void remove_pdf_of(const fs::path& picture) {
  if (const auto pdf = pdf_of(picture); fs::exists(pdf) && results::is_written_by_viscontact(pdf))
    remove_file(pdf);
}

}  // namespace viscontact::report
