#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <set>

#include "core/appearance.h"
#include "core/files.h"
#include "core/io/animation.h"

namespace sprung {
namespace {

constexpr int kIndent = 4;  // spaces a level

std::string name_in_usd(const std::string& name, std::set<std::string>& taken) {
  std::string word = name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) != 0 ? "_" + name : name;
  std::replace_if(
      word.begin(), word.end(), [](unsigned char letter) { return letter >= 0x80 || std::isalnum(letter) == 0; }, '_');
  std::string free = word;
  for (int copy = 2; !taken.insert(free).second; ++copy) free = fmt::format("{}_{}", word, copy);
  return free;
}

/// Text of a stage, indented by its braces.
class UsdText {
 public:
  template <class... Values>
  void line(fmt::format_string<Values...> words, Values&&... values) {
    indent();
    fmt::format_to(std::back_inserter(text_), words, std::forward<Values>(values)...);
    text_ += '\n';
  }
  void open() {
    line("{{");
    ++depth_;
  }
  void close() {
    --depth_;
    line("}}");
  }

  /// "name = [(x, y), ...]", with `more` behind it.
  template <class Rows>
  void rows(std::string_view name, const Rows& rows, std::string_view more = "") {
    indent();
    fmt::format_to(std::back_inserter(text_), "{} = ", name);
    add_rows(rows);
    fmt::format_to(std::back_inserter(text_), "{}\n", more);
  }

  /// "name.timeSamples = { 1: [...], ... }", or a plain value if there is only one.
  template <class Rows>
  void samples(std::string_view name, const std::vector<Rows>& frames, std::span<const double> codes) {
    if (frames.size() == 1) return rows(name, frames.front());
    line("{}.timeSamples = {{", name);
    ++depth_;
    for (std::size_t frame = 0; frame < frames.size(); ++frame) {
      rows_of_time(codes[frame], frames[frame]);
    }
    close();
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void indent() { text_.append(std::size_t(kIndent * depth_), ' '); }

  template <class Rows>
  void rows_of_time(double code, const Rows& rows) {
    indent();
    fmt::format_to(std::back_inserter(text_), "{}: ", code);
    add_rows(rows);
    text_ += ",\n";
  }

  template <class Rows>
  void add_rows(const Rows& rows) {
    const auto out = std::back_inserter(text_);
    text_ += '[';
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      if (i > 0) text_ += ", ";
      if constexpr (Rows::ColsAtCompileTime == 1) {
        fmt::format_to(out, "{}", rows(i, 0));
      } else {
        for (Eigen::Index k = 0; k < rows.cols(); ++k) fmt::format_to(out, "{}{}", k == 0 ? "(" : ", ", rows(i, k));
        text_ += ')';
      }
    }
    text_ += ']';
  }

  std::string text_;
  int depth_ = 0;
};

using Counts = Eigen::Matrix<int, Eigen::Dynamic, 1>;

/// Low and high corner of every frame.
std::vector<Floats3> extents_of(const std::vector<Floats3>& frames) {
  std::vector<Floats3> extents;
  for (const Floats3& frame : frames) {
    Floats3& corners = extents.emplace_back(2, 3);
    corners << frame.colwise().minCoeff(), frame.colwise().maxCoeff();
  }
  return extents;
}

/// Writes meshes and the materials that they are bound to.
class UsdStage {
 public:
  UsdStage(std::span<const double> codes, double fps, std::filesystem::path file)
      : codes_(codes), file_(std::move(file)) {
    text_.line("#usda 1.0");
    text_.line("(");
    text_.line("    defaultPrim = \"film\"");
    text_.line("    upAxis = \"Y\"");
    text_.line("    metersPerUnit = 1");
    text_.line("    startTimeCode = {}", codes.front());
    text_.line("    endTimeCode = {}", codes.back());
    text_.line("    timeCodesPerSecond = {}", fps);
    text_.line("    framesPerSecond = {}", fps);
    text_.line(")");
    text_.line("");
    text_.line("def Xform \"film\"");
    text_.open();
  }

  void add(const AnimatedMesh& mesh) {
    const Skin& rest = *mesh.first.rest;
    const std::vector<PosedPart> parts = parts_of(mesh.first);
    text_.line("def Mesh \"{}\" (", name_in_usd(mesh.first.name, mesh_names_));
    text_.line("    prepend apiSchemas = [\"MaterialBindingAPI\"]");
    text_.line(")");
    text_.open();
    text_.line("uniform token subdivisionScheme = \"none\"");
    text_.line("uniform bool doubleSided = true");
    text_.rows("int[] faceVertexCounts", Counts::Constant(rest.triangles.rows(), 3).eval());
    text_.rows("int[] faceVertexIndices", Counts(rest.triangles.reshaped<Eigen::RowMajor>()));
    text_.samples("float3[] extent", extents_of(mesh.positions), codes_);
    text_.samples("point3f[] points", mesh.positions, codes_);
    text_.line("normal3f[] normals (interpolation = \"vertex\")");
    text_.samples("normal3f[] normals", mesh.normals, codes_);
    constexpr std::string_view kOfVertices = " (interpolation = \"vertex\")";
    if (rest.uvs.rows() > 0) text_.rows("texCoord2f[] primvars:st", rest.uvs, kOfVertices);
    if (rest.colors.rows() > 0) {
      const Floats4 colors = rest.colors.cwiseMax(0.0F).cwiseMin(1.0F);
      text_.rows("color3f[] primvars:displayColor", Floats3(colors.leftCols<3>().unaryExpr(&linear_from_srgb)),
                 kOfVertices);
      text_.rows("float[] primvars:displayOpacity", colors.col(3).eval(), kOfVertices);
    }
    if (parts.size() == 1) {
      bind(parts.front(), rest);
    } else {
      std::set<std::string> names;
      for (const PosedPart& part : parts) add_subset(part, rest, names);
    }
    text_.close();
  }

  [[nodiscard]] std::string finish() {
    text_.line("def Scope \"materials\"");
    text_.open();
    for (const Material& material : materials_) describe(material);
    text_.close();
    text_.close();
    return text_.text();
  }

 private:
  struct Material {
    std::string name;
    PosedPart part;
  };

  void add_subset(const PosedPart& part, const Skin& rest, std::set<std::string>& names) {
    text_.line("def GeomSubset \"{}\" (", name_in_usd(part.name, names));
    text_.line("    prepend apiSchemas = [\"MaterialBindingAPI\"]");
    text_.line(")");
    text_.open();
    text_.line("uniform token elementType = \"face\"");
    text_.line("uniform token familyName = \"materialBind\"");
    text_.rows("int[] indices", Counts::LinSpaced(part.triangle_count, part.first_triangle,
                                                  part.first_triangle + part.triangle_count - 1)
                                    .eval());
    bind(part, rest);
    text_.close();
  }

  /// Where vertices have colours, programs show these if there is no material; a texture needs one.
  void bind(const PosedPart& part, const Skin& rest) {
    const bool has_texture = part.source != nullptr && !texture_extension(*part.source).empty();
    if (rest.colors.rows() > 0 && !has_texture) return;
    auto known = std::find_if(materials_.begin(), materials_.end(),
                              [&](const Material& other) { return other.part.material == part.material; });
    if (known == materials_.end()) {
      materials_.push_back({name_in_usd(part.material, material_names_), part});
      known = std::prev(materials_.end());
    }
    text_.line("rel material:binding = </film/materials/{}>", known->name);
  }

  void describe(const Material& material) {
    const std::string place = fmt::format("/film/materials/{}", material.name);
    const Eigen::Vector3f color = material.part.color.head<3>().unaryExpr(&linear_from_srgb);
    const float opacity = material.part.color[3];
    const std::string texture = write_texture(material.part, file_);
    text_.line("def Material \"{}\"", material.name);
    text_.open();
    text_.line("token outputs:surface.connect = <{}/surface.outputs:surface>", place);
    text_.line("def Shader \"surface\"");
    text_.open();
    text_.line("uniform token info:id = \"UsdPreviewSurface\"");
    if (!texture.empty()) {
      text_.line("color3f inputs:diffuseColor.connect = <{}/texture.outputs:rgb>", place);
    } else {
      text_.line("color3f inputs:diffuseColor = ({}, {}, {})", color[0], color[1], color[2]);
    }
    text_.line("float inputs:roughness = {}", kExportedRoughness);
    text_.line("float inputs:metallic = 0");
    text_.line("float inputs:opacity = {}", opacity);
    text_.line("token outputs:surface");
    text_.close();
    if (!texture.empty()) {
      text_.line("def Shader \"coordinates\"");
      text_.open();
      text_.line("uniform token info:id = \"UsdPrimvarReader_float2\"");
      text_.line("string inputs:varname = \"st\"");
      text_.line("float2 outputs:result");
      text_.close();
      text_.line("def Shader \"texture\"");
      text_.open();
      text_.line("uniform token info:id = \"UsdUVTexture\"");
      text_.line("asset inputs:file = @{}@", texture);
      text_.line("token inputs:sourceColorSpace = \"sRGB\"");
      text_.line("token inputs:wrapS = \"repeat\"");
      text_.line("token inputs:wrapT = \"repeat\"");
      text_.line("float4 inputs:scale = ({}, {}, {}, 1)", color[0], color[1], color[2]);
      text_.line("float2 inputs:st.connect = <{}/coordinates.outputs:result>", place);
      text_.line("float3 outputs:rgb");
      text_.close();
    }
    text_.close();
  }

  std::span<const double> codes_;
  std::filesystem::path file_;
  UsdText text_;
  std::set<std::string> mesh_names_{"materials"};
  std::set<std::string> material_names_;
  std::vector<Material> materials_;
};

}  // namespace

void write_usda(const std::vector<AnimatedMesh>& meshes, std::span<const double> times, double fps,
                const std::filesystem::path& file) {
  std::vector<double> codes;
  constexpr double kFine = 1e6;  // so that frame 7 is not 7.000000001
  for (const double time : times) codes.push_back(std::round((time * fps + 1) * kFine) / kFine);
  UsdStage stage(codes, fps, file);
  for (const AnimatedMesh& mesh : meshes) stage.add(mesh);
  write_file(file, stage.finish());
}

}  // namespace sprung
