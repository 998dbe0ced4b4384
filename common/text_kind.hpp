// The kinds of text that Viscontact writes.
#pragma once

namespace viscontact {

/// By how a kind of text can carry a line that its readers pass over: "#" is that of CSV and Python.
enum class TextKind { kHashComment, kJson, kSvg, kHtml, kXml, kC, kFortran };

}  // namespace viscontact
