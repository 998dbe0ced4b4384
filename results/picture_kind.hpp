// The kinds of pictures, by the ending of the file's name: SVG, PDF, PNG, and gnuplot's script.
#pragma once

#include <array>
#include <cassert>
#include <filesystem>
#include <string>
#include <string_view>

#include "viscontact/common/named.hpp"
#include "viscontact/common/text/text_kind.hpp"

namespace viscontact::results {

struct PictureKind {
  std::string_view name;  ///< ending of the file's name, with the dot and in small letters
  TextKind kind;          ///< decides where the provenance is
  std::string_view
      marker;  ///< text in every such file, by which refuse_other_kind() knows the kind
};

/// The default is first. The last one is gnuplot's script with its data.
inline constexpr std::array kPictureKinds = {
    PictureKind{".svg", TextKind::kSvg, "<svg"}, PictureKind{".pdf", TextKind::kPdf, "%PDF-"},
    PictureKind{".png", TextKind::kPng, "PNG\r\n"},
    PictureKind{".gp", TextKind::kHashComment, "# gnuplot script by Viscontact"}};

/// The kind that belongs to the ending of a path; nullptr for others, such as ".SVG".
inline const PictureKind* picture_kind(const std::filesystem::path& path) {
  return find_named(kPictureKinds, path.extension().string());
}

struct PictureFormat {
  TextKind kind = TextKind::kSvg;  ///< one of the kinds in kPictureKinds
  /// Width [pixels of an SVG], >= 0; for each of them a PDF has a point and a PNG two pixels. The
  /// height is in proportion. 0: the width that each picture has by default.
  int width = 0;
  double font_size = 14;  ///< in the unit of `width`, > 0
};

struct PictureRequest {
  std::string path;       ///< its ending is that of one of kPictureKinds; empty: no picture
  int width = 0;          ///< PictureFormat::width; with --width from 100 to 10000
  double font_size = 14;  ///< PictureFormat::font_size; with --font-size from 2 to 200

  /// `path` must have an ending in kPictureKinds.
  PictureFormat format() const {
    assert(picture_kind(path) != nullptr);
    return {picture_kind(path)->kind, width, font_size};
  }
};

}  // namespace viscontact::results
