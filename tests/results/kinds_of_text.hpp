// A small complete file of each kind that Viscontact writes, and a provenance for it.
#pragma once

#include <string>
#include <vector>

#include "viscontact/common/text/text_kind.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::results {

struct TextOfKind {
  TextKind kind;
  std::string text;
};

inline std::vector<TextOfKind> texts_of_all_kinds() {
  // A PNG of one grey pixel: header, data and end. Its bytes contain newlines and a brace.
  using std::string_literals::operator""s;
  const auto png =
      "\211PNG\r\n\032\n\0\0\0\rIHDR\0\0\0\001\0\0\0\001\010\0\0\0\0\072\176\233\125"
      "\0\0\0\nIDAT\170\234\143\250\001\000\000\176\000\175\170\131\012\033"
      "\0\0\0\0IEND\256\102\140\202"s;
  return {{TextKind::kHashComment, "gap,force\n0.1,2\n"},
          {TextKind::kJson, "{\n  \"gap\": 0.1\n}\n"},
          {TextKind::kSvg, "<?xml version=\"1.0\"?>\n<svg width=\"9\">\n</svg>\n"},
          {TextKind::kHtml, "<html><head>\n<title>A run</title>\n</head></html>\n"},
          {TextKind::kXml, "<?xml version=\"1.0\"?>\n<VTKFile>\n</VTKFile>\n"},
          {TextKind::kC, "double force(double gap);\n"},
          {TextKind::kFortran, "real function force(gap)\n"},
          {TextKind::kMatlab, "function f = force()\nend\n"},
          {TextKind::kPdf, "%PDF-1.5\ntrailer\n<< >>\nstartxref\n9\n%%EOF\n"},
          {TextKind::kXyz, "1\npbc=\"F F F\" Time=0\nX 0 0 0\n"},
          {TextKind::kPng, png}};
}

/// The provenance of a command that reads a file whose name contains the ends of all kinds of
/// comment.
inline Provenance sample_provenance() {
  Provenance provenance;
  provenance.command = {"/opt/bin/viscontact", "fit", "a --> */ </script> & \"b\".csv"};
  provenance.folder = "/home/someone";
  provenance.inputs = {{"table.csv", std::string(64, '0'), false}, {"fit.json", "", true}};
  provenance.versions = {{"Viscontact", "0.1.0"}};
  provenance.output = "out.txt";
  provenance.made = "2001-09-09T01:46:40Z";
  return provenance;
}

}  // namespace viscontact::results
