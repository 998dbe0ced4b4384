// The kinds of text files that Viscontact writes.
#pragma once

namespace viscontact {

/// A kind of text, named by the form of its comment lines: "#" (CSV, Python), JSON, SVG, HTML, XML,
/// C or Fortran.
enum class TextKind { kHashComment, kJson, kSvg, kHtml, kXml, kC, kFortran };

}  // namespace viscontact
