#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/refusal.h"

/// Files that are not meshes, given to the built program: each run ends quickly, with little memory, exit code 3 and
/// one clear line.
namespace sprung {
namespace {

struct BadFile {
  std::string name;
  std::string reason;
};

/// A name that GoogleTest accepts for a test.
std::string test_name(std::string file) {
  std::replace(file.begin(), file.end(), '.', '_');
  return file;
}

/// Files made here, which the readers of other formats crash, hang or give up on.
class BadMesh : public testing::TestWithParam<std::pair<BadFile, std::string>> {};

TEST_P(BadMesh, IsRefusedInOneLine) {
  const auto& [bad, text] = GetParam();
  const TempFolder folder;
  expect_refusal(folder, folder.write(bad.name, text).string(), bad.reason);
}

const std::string kPlyStart = "ply\nformat ascii 1.0\nelement vertex 3\n";

/// A Collada file with one triangle that refers to vertices that do not exist.
const std::string kDae =
    "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\"><library_geometries>"
    "<geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"a\" count=\"9\">0 0 0 1 0 0 0 1 0</float_array>"
    "<technique_common><accessor source=\"#a\" count=\"3\" stride=\"3\"/></technique_common></source>"
    "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"1\">"
    "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 7</p></triangles></mesh></geometry>"
    "</library_geometries></COLLADA>";

/// Two triangles, the second of which refers to a vertex that does not exist: assimp omits it silently.
const std::string kGltf =
    R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],)"
    R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],)"
    R"("accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},)"
    R"({"bufferView": 1, "componentType": 5125, "count": 6, "type": "SCALAR"}],)"
    R"("bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],)"
    R"("buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAEAAAACAAAAAAAAAAEAAABwEQEA"}]})";

INSTANTIATE_TEST_SUITE_P(
    All, BadMesh,
    testing::Values(
        std::pair{BadFile{"cut.ply", "no 'end_header'"}, kPlyStart},
        std::pair{BadFile{"cut.stl", "the file ends inside facet 1: it is cut short"},
                  std::string("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n")},
        std::pair{BadFile{"wrong.obj", "no vertices and no faces"}, std::string("<!DOCTYPE html><html></html>\n")},
        std::pair{BadFile{"lines.obj", "no faces (lines only); it holds 2 points and 1 line"},
                  std::string("v 0 0 0\nv 1 0 0\nl 1 2\n")},
        std::pair{BadFile{"text.stl", "is not an STL file"}, std::string(200, 'x')},
        std::pair{BadFile{"range.gltf", "index out of range"}, kGltf},
        std::pair{BadFile{"sheet.obj", "an open sheet"}, std::string("v 0 0 0\nv 1 0 0\nv 0 1 1\nv 9 9 9\nf 1 2 3\n")},
        std::pair{BadFile{"wrong.gltf", "not a valid mesh file"}, std::string("{\"asset\": 3}")},
        std::pair{BadFile{"meshopt.gltf", "EXT_meshopt_compression, which is not supported"},
                  std::string("{\"extensionsRequired\": [\"EXT_meshopt_compression\"]}")},
        std::pair{BadFile{"wrong.fbx", "not a valid mesh file"},
                  std::string("Kaydara FBX Binary  \0\x1A\0 garbage", 31)},
        std::pair{BadFile{"wrong.3mf", "cut short or not a 3MF"}, std::string("PK\3\4 garbage")},
        std::pair{BadFile{"range.dae", "range.dae"}, kDae},
        std::pair{BadFile{"wrong.dae", "not a valid mesh file"}, std::string("<COLLADA>")}),
    [](const auto& bad) { return test_name(bad.param.first.name); });

}  // namespace
}  // namespace sprung
