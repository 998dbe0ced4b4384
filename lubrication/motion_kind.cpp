// The names of the motions (motion_kind.hpp). An unknown name is an Error(kBadInput). A change must
// keep the names, which case files, tables and fits contain.
#include "viscontact/lubrication/motion_kind.hpp"

#include <array>
#include <sstream>

#include "viscontact/common/named.hpp"

namespace viscontact::lubrication {
namespace {

constexpr std::array kMotions = {
    NamedMotion{"approach", MotionKind::kApproach}, NamedMotion{"slide", MotionKind::kSlide},
    NamedMotion{"roll", MotionKind::kRoll}, NamedMotion{"spin", MotionKind::kSpin}};

}  // namespace

std::span<const NamedMotion> all_motions() { return kMotions; }

std::string_view to_string(MotionKind motion) {
  return kMotions.at(static_cast<std::size_t>(motion)).name;
}

MotionKind parse_motion(std::string_view name) {
  return require_named(kMotions, name, "motion").kind;
}

std::string motions_in_words(const std::vector<MotionKind>& motions) {
  std::string words;
  for (const auto motion : motions)
    words += (words.empty() ? "" : ", ") + std::string(to_string(motion));
  return words;
}

std::vector<MotionKind> parse_motions_in_words(const std::string& words) {
  std::vector<MotionKind> motions;
  std::istringstream stream(words);
  for (std::string word; std::getline(stream >> std::ws, word, ',');)
    motions.push_back(parse_motion(word));
  return motions;
}

}  // namespace viscontact::lubrication
