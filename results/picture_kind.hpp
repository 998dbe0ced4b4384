// The kinds of pictures that a user can ask for: SVG, PDF, PNG, and gnuplot's script. The ending of
// the file's name says the kind. The commands with --plot, pipeline/ and report/ use this file.
// Nothing is checked or thrown. A change must keep the first kind, which is the default, and the
// markers, by which files of earlier versions are recognised; a new kind needs a place for its
// provenance, the record of how a file was made (results/provenance.cpp).
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "viscontact/common/named.hpp"
#include "viscontact/common/text/text_kind.hpp"

namespace viscontact::results {

/// A kind of picture.
struct PictureKind {
  std::string_view name;  ///< ending of the file's name, with the dot and in small letters
  TextKind kind;          ///< kind of the text, which decides where its provenance is
  std::string_view
      marker;  ///< text in every such file, by which refuse_other_kind() knows the kind
};

/// The kinds, the default first. The last one is gnuplot's script with its data.
inline constexpr std::array kPictureKinds = {
    PictureKind{".svg", TextKind::kSvg, "<svg"}, PictureKind{".pdf", TextKind::kPdf, "%PDF-"},
    PictureKind{".png", TextKind::kPng, "PNG\r\n"},
    PictureKind{".gp", TextKind::kHashComment, "# gnuplot script by Viscontact"}};

/// The kind of picture that belongs to the ending of a path; nullptr if the ending is none of those
/// in kPictureKinds, such as ".SVG".
inline const PictureKind* picture_kind(const std::filesystem::path& path) {
  return find_named(kPictureKinds, path.extension().string());
}

/// How a picture is written.
struct PictureFormat {
  TextKind kind = TextKind::kSvg;  ///< one of the kinds in kPictureKinds
  /// Width [pixels of an SVG], >= 0; for each of them a PDF has a point and a PNG two pixels. The
  /// height is in proportion. 0: the width that each picture has by default.
  int width = 0;
  double font_size = 14;  ///< height of the font in the unit of `width`, > 0
};

/// The picture that the options of a command ask for.
struct PictureRequest {
  std::string path;       ///< its ending is that of one of kPictureKinds; empty: no picture
  int width = 0;          ///< PictureFormat::width; with --width from 100 to 10000
  double font_size = 14;  ///< PictureFormat::font_size; with --font-size from 2 to 200

  /// The format of the picture. `path` must have an ending in kPictureKinds (not checked).
  PictureFormat format() const { return {picture_kind(path)->kind, width, font_size}; }
};

}  // namespace viscontact::results
