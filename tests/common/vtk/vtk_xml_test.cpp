#include "viscontact/common/vtk/vtk_xml.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "tests/common/failure.hpp"
#include "tests/common/well_formed_xml.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/text/base64.hpp"

namespace viscontact {
namespace {

// VTK's block of 32768 bytes.
constexpr std::size_t kBlockOfDoubles = 4096;

std::vector<double> sines(std::size_t count) {
  std::vector<double> values;
  for (std::size_t k = 0; k < count; ++k) values.push_back(std::sin(static_cast<double>(k)));
  return values;
}

/// A file with an array of points and an array of cells, both with the name "numbers".
std::string file_of(const std::vector<double>& points, const std::vector<std::int32_t>& cells) {
  return vtk_opening("PolyData") + "<!-- DataArray Name=\"numbers\" is no element here -->\n" +
         "<PolyData>\n<PointData Scalars=\"numbers\">\n" + vtk_array("numbers", 1, points) +
         "</PointData>\n<CellData>\n" + vtk_array("numbers", 1, cells) +
         "</CellData>\n</PolyData>\n" + std::string(kVtkClosing);
}

std::vector<double> points_in(const std::string& text) {
  return VtkReader(text, "frame.vtp", "frame").array<double>("PointData", "numbers");
}

TEST(VtkXml, GivesArraysOfAnySizeBack) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, kBlockOfDoubles - 1,
                                  kBlockOfDoubles, kBlockOfDoubles + 1, 3 * kBlockOfDoubles}) {
    auto points = sines(count);
    if (count > 2) points[1] = -0.0;
    const std::vector<std::int32_t> cells = {-1, 7};
    const auto text = file_of(points, cells);
    expect_well_formed(text);
    const VtkReader reader(text, "frame.vtp", "frame");
    const auto read = reader.array<double>("PointData", "numbers");
    ASSERT_EQ(read.size(), count);
    EXPECT_EQ(std::memcmp(read.data(), points.data(), count * sizeof(double)), 0);
    EXPECT_EQ(reader.array<std::int32_t>("CellData", "numbers"), cells);
    EXPECT_FALSE(reader.has_array("Points", "numbers"));
  }
}

// VTK's header: number of blocks, bytes of a block, bytes of the last one if it is shorter, and the
// compressed bytes of each.
TEST(VtkXml, HasTheHeaderOfVtksCompressor) {
  const auto header_of = [](std::size_t count) {
    const auto text = file_of(sines(count), {});
    const auto begin = text.find("format=\"binary\">\n") + 17;
    const auto bytes = from_base64(text.substr(begin, 32)).value();
    std::vector<std::uint64_t> header(3);
    std::memcpy(header.data(), bytes.data(), 24);
    return header;
  };
  EXPECT_EQ(header_of(0), (std::vector<std::uint64_t>{0, 32768, 0}));
  EXPECT_EQ(header_of(kBlockOfDoubles), (std::vector<std::uint64_t>{1, 32768, 0}));
  EXPECT_EQ(header_of(2 * kBlockOfDoubles + 3), (std::vector<std::uint64_t>{3, 32768, 24}));
}

TEST(VtkXml, OfAnotherTypeOrCutAnywhereIsRefused) {
  const auto points = sines(100);
  const auto text = file_of(points, {1, 2, 3});
  const VtkReader reader(text, "frame.vtp", "frame");
  const auto refused = IsAt("frame.vtp");
  EXPECT_THAT(bad_input([&] { (void)reader.array<std::int32_t>("PointData", "numbers"); }),
              refused);
  EXPECT_THAT(bad_input([&] { (void)reader.array<double>("PointData", "radius"); }), refused);
  for (std::size_t size = 0; size < text.size(); size += 7)
    EXPECT_THAT(bad_input([&] { (void)points_in(text.substr(0, size)); }), refused) << size;
}

// zlib has a checksum of the numbers; the sizes in the header must fit to each other.
TEST(VtkXml, WithAWrongCharacterIsRefusedOrHasTheSameNumbers) {
  const auto points = sines(40);
  const auto text = file_of(points, {});
  const auto begin = text.find("format=\"binary\">\n") + 17, end = text.find("\n</DataArray>");
  int refused = 0;
  for (auto at = begin; at < end; ++at) {
    auto damaged = text;
    damaged[at] = text[at] == 'A' ? 'B' : 'A';
    try {
      EXPECT_EQ(points_in(damaged), points) << at;
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, (end - begin) * 9 / 10);
}

}  // namespace
}  // namespace viscontact
