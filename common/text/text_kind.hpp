// The kinds of files that Viscontact writes. The kind says where a file has its line of provenance,
// the record of how it was made (results/provenance.hpp); a new kind needs such a place there. Used
// by results/ and all parts that write files. The order of the kinds is free. The file has no
// numbers and no function that could fail.
#pragma once

namespace viscontact {

/// A kind of file, named after its format. kHashComment stands for all texts whose comment lines
/// begin with "#": CSV, Python and scripts of gnuplot.
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
