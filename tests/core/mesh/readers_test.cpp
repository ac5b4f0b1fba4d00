#include "core/mesh/io/readers.h"

#include <gtest/gtest.h>

#include "core/mesh/io/text_scanner.h"
#include "tests/support/error_message.h"

/// How the readers of OBJ, PLY, STL and OFF handle texts that are unusual or damaged.
namespace sprung {
namespace {

SurfaceMesh obj(const std::string& text) {
  return read_obj(text, "a.obj", [](const std::string&) { return std::nullopt; });
}

template <class Read>
void expect_refusal(const Read& read, const std::string& text, const std::string& message) {
  const std::string said = error_message([&] { static_cast<void>(read(text)); });
  EXPECT_NE(said.find(message), std::string::npos) << "'" << said << "' of\n" << text;
}

const auto kOff = [](const std::string& text) { return read_off(text, "a.off"); };
const auto kPly = [](const std::string& text) { return read_ply(text, "a.ply"); };
const auto kStl = [](const std::string& text) { return read_stl(text, "a.stl"); };

TEST(Numbers, AreReadToTheNearestDouble) {
  EXPECT_EQ(number_of("0.1"), 0.1);
  EXPECT_EQ(number_of("+1000000.1234567891"), 1000000.1234567891);
  EXPECT_EQ(number_of("1e999"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(number_of("1e-999"), 0);
  EXPECT_TRUE(std::isnan(number_of("NaN").value()));
  for (const char* word : {"", "1,5", "1.#IND", "x", "1.0f", "--1"}) EXPECT_FALSE(number_of(word)) << word;
}

TEST(TextScanner, CountsLinesAndJoinsContinuedOnes) {
  TextScanner scanner("# head\n\n a b#c\r\nd \\\n  e\nf", "x");
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.line(), 3);
  EXPECT_EQ(scanner.word(), "a");
  EXPECT_EQ(scanner.rest(), "b#c");
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.line(), 4);
  EXPECT_EQ(scanner.word(), "d");
  EXPECT_EQ(scanner.word(), "e");
  EXPECT_EQ(scanner.word(), "");
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.line(), 6);
  EXPECT_FALSE(scanner.next_line() && scanner.next_line());
  TextScanner old("a\rb\r", "x");
  EXPECT_EQ(old.word_ahead(), "a");
  EXPECT_EQ(old.word_ahead(), "b");
  EXPECT_EQ(old.line(), 2);
}

TEST(ReadObj, SplitsVerticesWhereUvsOrNormalsDiffer) {
  const SurfaceMesh mesh =
      obj("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\nv 9 9 9\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 2\n"
          "f 1/1/1 2/2/1 3/3/1\nf 1/2/1 -3/3/1 4/1/1 # continued \\\n\nl 1 2\n");
  EXPECT_EQ(mesh.triangles.rows(), 2);
  EXPECT_EQ(mesh.positions.rows(), 6);  // one is split, and one is of no face
  EXPECT_EQ(mesh.uvs.rows(), 6);
  EXPECT_EQ(mesh.colors.row(4), Eigen::RowVector4f(1, 1, 1, 1));
  EXPECT_EQ(mesh.normals.row(0), Eigen::RowVector3f(0, 0, 1));
  ASSERT_EQ(mesh.notes.size(), 1U);
  EXPECT_EQ(mesh.notes[0], "left out 1 loose point or line");
}

TEST(ReadObj, MakesAPartOfEachGroupAndMaterial) {
  const std::string text =
      "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\no one\nusemtl red\nf 1 2 3\nusemtl blue\nf 2 3 1\nusemtl red\nf 3 1 2\n"
      "g two\nf 1 2 3\n";
  const SurfaceMesh mesh = read_obj(text, "a.obj", [](const std::string& name) {
    EXPECT_EQ(name, "a.mtl");
    return std::optional<std::string>(
        "newmtl blue\nKd 0 0 1\nnewmtl red\nKd 1 0 0\nmap_Kd -s 1 1 1 -clamp on my skin.png\n");
  });
  ASSERT_EQ(mesh.parts.size(), 3U);
  EXPECT_EQ(mesh.parts[0].name, "one");
  EXPECT_EQ(mesh.parts[0].triangle_count, 2);
  EXPECT_EQ(mesh.parts[1].first_triangle, 2);
  EXPECT_EQ(mesh.parts[2].name, "two");
  EXPECT_EQ(mesh.materials.at(mesh.parts[2].material).texture_name, "my skin.png");
}

TEST(ReadObj, NamesLineAndFace) {
  expect_refusal(obj, "v 0 0 0\nv 1 0\n", "a.obj:2: vertex 2 is cut short: a number is missing");
  expect_refusal(obj, "v 0 0 0\nv 1 x 0\n", "a.obj:2: vertex 2 holds 'x', which is not a number");
  expect_refusal(obj, "v 0 0 0\nf 1 1 0\nf 1 1 9\n", "a.obj:2: face 1 refers to vertex 0 of 1");
  expect_refusal(obj, "v 0 0 0\nf 1 1 9\nf 1 1 0\n", "a.obj:2: face 1 refers to vertex 9 of 1");
  expect_refusal(obj, "v 0 0 0\nf 1/2 1/2 1/2\n", "face 1 refers to UV 2 of 0");
  expect_refusal(obj, "v 0 0 0\nf 1 1 99999999999\n", "face 1 refers to vertex 99999999999");
  expect_refusal(obj, "v 0 0 0\nf 1 1 a\n", "a.obj:2: face 1 has a corner");
  expect_refusal(obj, "surf 0 1 0 1 1 2\nv 0 0 0\n", "free-form");
  expect_refusal(obj, "<html>", "no faces");
}

TEST(ReadOff, TakesWhatItsFirstWordPromises) {
  const SurfaceMesh mesh = kOff(
      "STCNOFF # all of it\n3 1 0\n\n0 0 0  0 0 1  255 0 0 255  0 0\n1 0 0  0 0 1  0 255 0  1 0 # green\n"
      "0 1 0  0 0 1  0 0 255  0 1\n3 0 1 2  1 0 0\n");
  EXPECT_EQ(mesh.triangles.rows(), 1);
  EXPECT_EQ(mesh.colors.row(1), Eigen::RowVector4f(0, 1, 0, 1));
  EXPECT_EQ(mesh.uvs.row(2), Eigen::RowVector2f(0, 1));
  EXPECT_EQ(mesh.normals.row(0), Eigen::RowVector3f(0, 0, 1));
  EXPECT_EQ(kOff("COFF\n3 1\n0 0 0 0.5 0.5 0.5 1\n1 0 0 1.0 0 0 1\n0 1 0 1.0 0 0 1\n3 0 1 2\n").colors(0, 0), 0.5F);
  EXPECT_EQ(kOff("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").triangles.rows(), 1);
}

TEST(ReadOff, NamesLineAndCause) {
  expect_refusal(kOff, "4OFF\n1 1 1\n", "is a 4OFF file");
  expect_refusal(kOff, "OFF BINARY\n", "is a binary OFF file");
  expect_refusal(kOff, "OFF\n3 x\n", "no counts of vertices and faces");
  expect_refusal(kOff, "OFF\n9 99 0\n0 0 0\n", "a.off:2: header declares 9 vertices, more than the file can hold");
  expect_refusal(kOff, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0", "the file ends before face 1: it is cut short");
  expect_refusal(kOff, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1", "the file ends before face 1: it is cut short");
  expect_refusal(kOff, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2.5\n", "face 1 holds 2.5, which is not a whole number");
  expect_refusal(kOff, "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "no faces (a point cloud); it holds 3 points");
}

std::string ply(const std::string& header, const std::string& body) { return "ply\n" + header + "end_header\n" + body; }

TEST(ReadPly, TakesUvsOfCornersStripsAndTheNameOfATexture) {
  const std::string vertices =
      "element vertex 4\nproperty double x\nproperty double y\nproperty double z\nproperty float nx\nproperty float "
      "ny\n"
      "property float nz\nproperty float quality\n";
  const std::string body = "0 0 0 0 0 1 5\n1 0 0 0 0 1 5\n1 1 0 0 0 1 5\n0 1 0 0 0 1 5\n";
  const SurfaceMesh wedges = kPly(ply("format ascii 1.0\ncomment TextureFile my skin.png\n" + vertices +
                                          "element face 2\nproperty list uchar int vertex_index\n"
                                          "property list uchar float texcoord\n",
                                      body + "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 0.5 0 1 1 0 1\n"));
  EXPECT_EQ(wedges.positions.rows(), 6);
  EXPECT_EQ(wedges.uvs.rows(), 6);
  EXPECT_EQ(wedges.materials.at(0).texture_name, "my skin.png");
  EXPECT_EQ(wedges.normals.row(5), Eigen::RowVector3f(0, 0, 1));
  const SurfaceMesh strip =
      kPly(ply("format ascii 1.0\n" + vertices + "element tristrips 1\nproperty list int int vertex_indices\n",
               body + "9 0 1 3 2 -1 0 1 3 -1\n"));
  Triangles expected(3, 3);
  expected << 0, 1, 3, 3, 1, 2, 0, 1, 3;
  EXPECT_EQ(strip.triangles, expected);
}

TEST(ReadPly, ReadsBothByteOrders) {
  const std::string header =
      "element vertex 3\nproperty short x\nproperty short y\nproperty short z\nelement face 1\n"
      "property list uchar uchar vertex_indices\n";
  const std::string big("\0\1\0\2\0\3\0\0\0\0\0\0\0\0\1\0\0\0\3\0\1\2", 22);
  const std::string little("\1\0\2\0\3\0\0\0\0\0\0\0\0\0\0\1\0\0\3\0\1\2", 22);
  const SurfaceMesh a = kPly(ply("format binary_big_endian 1.0\n" + header, big));
  const SurfaceMesh b = kPly(ply("format binary_little_endian 1.0\n" + header, little));
  EXPECT_EQ(a.positions.row(0), Eigen::RowVector3d(1, 2, 3));
  EXPECT_EQ(a.positions(2, 1), 256);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_FALSE(a.single_precision);
}

TEST(ReadPly, NamesVertexOrFace) {
  const std::string header =
      "format ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\n";
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  expect_refusal(kPly, ply(header, points + "3 0 1 3\n"), "face 1 refers to vertex 3, but they run from 0 to 2");
  expect_refusal(kPly, ply(header, points + "3 0 1"), "a.ply:13: the file ends before face 1");
  expect_refusal(kPly, ply(header, points + "-3 0 1 2 3 4\n"), "face 1 has a list of -3");
  expect_refusal(kPly, ply(header, "0 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n"), "vertex 2 has a coordinate that is not finite");
  expect_refusal(kPly,
                 ply("format ascii 1.0\nelement vertex 1\nproperty float x\nelement face 1\nproperty list uchar "
                     "int vertex_indices\n",
                     "0\n3 0 0 0\n"),
                 "vertices have no x, y and z");
  expect_refusal(kPly, ply("format ascii 1.0\nelement vertex 1\nproperty floaty x\n", ""), "'floaty' is not a type");
  expect_refusal(kPly, ply(header + "element vertex 1\n", points + "3 0 1 2\n"), "more than one element 'vertex'");
  expect_refusal(kPly, ply("format middle_endian 1.0\n", ""), "the format is neither");
}

std::string facet(const std::string& corners) {
  return "facet normal 0 0 1\nouter loop\n" + corners + "endloop\nendfacet\n";
}

TEST(ReadStl, TakesTextInDoublePrecisionAndAPartForEachSolid) {
  const std::string corners = "vertex 1000000.0000001 0 0\nvertex 1 0 0\nvertex 0 1 0\n";
  const SurfaceMesh mesh =
      kStl("solid one\n" + facet(corners) + "endsolid one\nSOLID two\n" + facet(corners) + "endsolid\n");
  ASSERT_EQ(mesh.parts.size(), 2U);
  EXPECT_EQ(mesh.parts[1].name, "two");
  EXPECT_EQ(mesh.positions(0, 0), 1000000.0000001);
  EXPECT_FALSE(mesh.single_precision);
  EXPECT_EQ(kStl("solid one\n" + facet(corners)).notes.at(0), "the file ends without 'endsolid'; it may be cut short");
  expect_refusal(kStl, "solid one\n" + facet(corners).substr(0, 57), "inside facet 1");
  expect_refusal(kStl, "solid one\n" + facet("vertex 0 0 0\n"), "facet 1 has less than 3 vertices");
  expect_refusal(kStl, "solid one\nendsolid\n", "no faces");
  expect_refusal(kStl, "hello", "is not an STL file");
  expect_refusal(kStl, "solid one\n" + facet(corners) + "end\n", "facet 1 is followed by an 'end' without a keyword");
  expect_refusal(kStl, "solid one\n" + facet(corners) + "end end end end",
                 "facet 1 is followed by an 'end' without a keyword");
}

/// As written by programs that do not follow the format to the letter.
TEST(ReadStl, TakesCommonVariantsOfItsText) {
  const std::string corners = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";
  for (const std::string& text : std::initializer_list<std::string>{
           "solid a\n" + facet(corners) + "end solid a\n",
           "solid a\nfacet normal 0 0 1\nouter loop\n" + corners + "end loop\nend facet\nend solid\n",
           "SOLID A\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1 0\nENDLOOP\nENDFACET\n"
           "ENDSOLID A\n",
           "solid a\ncolor 0.5 0.5 0.5\n" + facet(corners) + "endsolid a\n",
           "solid a\r\nfacet normal nan nan nan outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\r\n"
           "endsolid a\r\n",
           "solid\nfacet normal -1.#IND 0 0\nouter loop\n" + corners + "endloop\nendfacet\nendsolid\n",
           "  solid a\n" + facet(corners) + "endsolid a\nsolid a\n" + facet(corners) + "endsolid a\n",
       }) {
    const SurfaceMesh mesh = kStl(text);
    EXPECT_GE(mesh.triangles.rows(), 1) << text;
    EXPECT_TRUE(mesh.notes.empty()) << text << mesh.notes.at(0);
  }
}

TEST(ReadStl, TakesTheColoursOfFacets) {
  std::string bytes("solid but binary");
  bytes.resize(80, ' ');
  bytes.append("\1\0\0\0", 4);
  bytes.append(48, '\0');
  bytes.append("\x00\xFC", 2);  // red in the upper 5 bits
  EXPECT_EQ(kStl(bytes).colors.row(2), Eigen::RowVector4f(1, 0, 0, 1));
  bytes.replace(0, 16, "COLOR=...       ");
  EXPECT_EQ(kStl(bytes).colors.rows(), 0);  // of Magics the highest bit means none
  bytes[133] = '\x00';
  bytes[132] = '\x1F';
  EXPECT_EQ(kStl(bytes).colors.row(2), Eigen::RowVector4f(1, 0, 0, 1));
}

}  // namespace
}  // namespace sprung
