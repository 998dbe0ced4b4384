// The kinds of files that Viscontact writes. results/provenance.hpp says where each kind has its
// line of provenance, the record of how the file was made.
#pragma once

namespace viscontact {

/// kHashComment stands for CSV, Python and scripts of gnuplot, with comment lines "# ...".
enum class TextKind {
  kHashComment,
  kJson,
  kSvg,
  kHtml,
  kXml,
  kC,
  kFortran,
  kMatlab,
  kPdf,
  kPng,
  kXyz
};

}  // namespace viscontact
