// The kinds of files that Viscontact writes. The kind says where a file has its line of provenance,
// the record of how it was made (results/provenance.hpp); a new kind needs such a place there. Used
// by results/ and all parts that write files. No numbers; nothing can fail.
#pragma once

namespace viscontact {

/// A kind of file. kHashComment are texts whose comment lines begin with "#" (CSV, Python).
enum class TextKind { kHashComment, kJson, kSvg, kHtml, kXml, kC, kFortran, kMatlab, kPdf, kPng };

}  // namespace viscontact
