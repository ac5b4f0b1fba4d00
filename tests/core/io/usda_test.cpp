#include <gtest/gtest.h>

#include <iterator>
#include <regex>
#include <sstream>

#include "core/io/animation.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_folder.h"

namespace sprung {
namespace {

/// Two triangles, each a part of its own.
Skin two_parts() {
  Skin skin;
  skin.positions = Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  skin.normals = Points{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  skin.triangles = Triangles{{0, 1, 2}, {0, 2, 3}};
  skin.uvs = Floats2{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  SurfaceMaterial& red = skin.materials.emplace_back();
  red.name = "red paint";
  red.color = {0.8F, 0.1F, 0.2F, 0.5F};
  SurfaceMaterial& printed = skin.materials.emplace_back();
  printed.name = "2 printed";
  for (const int byte : {0x89, int('P'), int('N'), int('G'), 0}) printed.texture.push_back(std::byte(byte));
  skin.parts = {{.name = "lower", .first_triangle = 0, .triangle_count = 1, .material = 0},
                {.name = "upper", .first_triangle = 1, .triangle_count = 1, .material = 1}};
  return skin;
}

AnimatedMesh lifted(const Skin& skin, int frames) {
  AnimatedMesh film{.first = {.name = "a sheet", .rest = &skin, .positions = skin.positions, .normals = skin.normals},
                    .positions = {},
                    .normals = {}};
  for (int frame = 0; frame < frames; ++frame) {
    Points moved = skin.positions;
    moved.col(2).array() += 0.25 * frame;
    film.positions.emplace_back(moved.cast<float>());
    film.normals.emplace_back(skin.normals.cast<float>());
  }
  return film;
}

/// The numbers between the first pair of brackets behind a word, from a place on.
std::vector<double> numbers_behind(const std::string& text, const std::string& word, std::size_t from = 0) {
  const std::size_t begin = text.find('[', text.find(word, from) + word.size());
  std::string inside = text.substr(begin + 1, text.find(']', begin) - begin - 1);
  for (char& letter : inside) letter = letter == ',' || letter == '(' || letter == ')' ? ' ' : letter;
  std::istringstream stream(inside);
  return {std::istream_iterator<double>(stream), {}};
}

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

TEST(Usda, HasEveryFrameOfEveryVertex) {
  const TempFolder folder;
  const Skin skin = two_parts();
  write_usda({lifted(skin, 3)}, std::vector<double>{0.5, 0.75, 1}, 8, folder.path() / "film.usda");
  const std::string text = text_of(folder.path() / "film.usda");
  EXPECT_EQ(text.substr(0, 12), "#usda 1.0\n(\n");
  for (const char* words : {"upAxis = \"Y\"", "metersPerUnit = 1", "startTimeCode = 5", "endTimeCode = 9",
                            "timeCodesPerSecond = 8", "defaultPrim = \"film\"", "def Mesh \"a_sheet\""}) {
    EXPECT_TRUE(has(text, words)) << words;
  }
  EXPECT_EQ(numbers_behind(text, "int[] faceVertexCounts ="), (std::vector<double>{3, 3}));
  EXPECT_EQ(numbers_behind(text, "int[] faceVertexIndices ="), (std::vector<double>{0, 1, 2, 0, 2, 3}));
  const std::size_t points = text.find("point3f[] points.timeSamples = {");
  ASSERT_NE(points, std::string::npos);
  EXPECT_EQ(numbers_behind(text, " 7: ", points),
            (std::vector<double>{0, 0, 0.25, 1, 0, 0.25, 1, 1, 0.25, 0, 1, 0.25}));
  EXPECT_EQ(numbers_behind(text, " 9: ", points), (std::vector<double>{0, 0, 0.5, 1, 0, 0.5, 1, 1, 0.5, 0, 1, 0.5}));
  EXPECT_EQ(numbers_behind(text, " 9: ", text.find("extent.timeSamples")), (std::vector<double>{0, 0, 0.5, 1, 1, 0.5}));
  EXPECT_EQ(numbers_behind(text, "primvars:st ="), (std::vector<double>{0, 0, 1, 0, 1, 1, 0, 1}));
  EXPECT_EQ(std::count(text.begin(), text.end(), '{'), std::count(text.begin(), text.end(), '}'));
}

/// As in OpenUSD's examples of bound subsets and of UsdPreviewSurface with a texture.
TEST(Usda, BindsTheMaterialsOfItsParts) {
  const TempFolder folder;
  const Skin skin = two_parts();
  write_usda({lifted(skin, 1), lifted(skin, 1)}, std::vector<double>{0}, 24, folder.path() / "film.usda");
  const std::string text = text_of(folder.path() / "film.usda");
  EXPECT_TRUE(has(text, "point3f[] points = [(0, 0, 0)")) << "of a single frame";
  EXPECT_TRUE(has(text, "def Mesh \"a_sheet_2\"")) << "no two of one name";
  EXPECT_TRUE(has(text, "def GeomSubset \"lower\""));
  EXPECT_EQ(numbers_behind(text, "int[] indices =", text.find("def GeomSubset \"upper\"")), (std::vector<double>{1}));
  EXPECT_TRUE(has(text, "rel material:binding = </film/materials/a_sheet_red_paint>"));
  const std::regex surface(
      R"(def Material "a_sheet_red_paint"\s*\{\s*token outputs:surface\.connect = </film/materials/a_sheet_red_paint/surface\.outputs:surface>)");
  EXPECT_TRUE(std::regex_search(text, surface)) << text;
  EXPECT_TRUE(has(text, "float inputs:opacity = 0.5"));
  EXPECT_TRUE(has(text, "asset inputs:file = @a_sheet_2_printed.png@"));
  EXPECT_TRUE(
      has(text, "color3f inputs:diffuseColor.connect = </film/materials/a_sheet_2_printed/texture.outputs:rgb>"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "a_sheet_2_printed.png"));
}

TEST(Usda, LeavesVertexColoursToTheirPrimvar) {
  const TempFolder folder;
  Skin skin = two_parts();
  skin.parts.clear();
  skin.materials.clear();
  skin.colors = Floats4::Constant(4, 4, 0.5F);
  write_usda({lifted(skin, 1)}, std::vector<double>{0}, 24, folder.path() / "film.usda");
  const std::string text = text_of(folder.path() / "film.usda");
  EXPECT_FALSE(has(text, "rel material:binding")) << "which would hide them";
  EXPECT_NEAR(numbers_behind(text, "primvars:displayColor =").at(0), 0.2140411, 1e-6) << "linear";
  EXPECT_EQ(numbers_behind(text, "primvars:displayOpacity =").at(3), 0.5);
}

}  // namespace
}  // namespace sprung
