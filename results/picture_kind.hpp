// The kinds of pictures that a user can ask for. The ending of a file's name says which one. The
// commands with --plot use them; a new kind needs a place for its provenance
// (results/provenance.cpp).
#pragma once

#include <array>
#include <filesystem>
#include <string_view>

#include "viscontact/common/named.hpp"
#include "viscontact/common/text/text_kind.hpp"

namespace viscontact::results {

/// A kind of picture.
struct PictureKind {
  std::string_view name;  ///< ending of the file's name
  TextKind kind;          ///< how the provenance is written into it
  std::string_view
      marker;  ///< text in every such file, by which refuse_other_kind() knows the kind
};

/// The kinds, the default first.
inline constexpr std::array kPictureKinds = {PictureKind{".svg", TextKind::kSvg, "<svg"},
                                             PictureKind{".pdf", TextKind::kPdf, "%PDF-"},
                                             PictureKind{".png", TextKind::kPng, "PNG\r\n"}};

/// The kind of picture that the ending of a path asks for; nullptr if it asks for none of them.
inline const PictureKind* picture_kind(const std::filesystem::path& path) {
  return find_named(kPictureKinds, path.extension().string());
}

}  // namespace viscontact::results
