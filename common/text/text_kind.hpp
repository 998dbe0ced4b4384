// The kinds of files that Viscontact writes.
#pragma once

namespace viscontact {

/// A kind of file. A text is named by the form of its comment lines: "#" (CSV, Python), JSON, SVG,
/// HTML, XML, C or Fortran; pictures are also PDF and PNG.
enum class TextKind { kHashComment, kJson, kSvg, kHtml, kXml, kC, kFortran, kPdf, kPng };

}  // namespace viscontact
