#include "core/io/xdmf.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

#include "core/body/brick_measures.h"
#include "core/body/stress.h"
#include "core/skin/skin.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

/// The order of VTK's hexahedron in our corners, of which x runs fastest.
constexpr std::array<int, 8> kVtkCorners{0, 1, 3, 2, 4, 5, 7, 6};

using Hexahedra = Eigen::Matrix<int, Eigen::Dynamic, 8, Eigen::RowMajor>;

/// XDMF's Tensor6: xx, xy, xz, yy, yz, zz.
Eigen::Matrix<float, Eigen::Dynamic, 6, Eigen::RowMajor> tensor6(const StressTensors& stresses) {
  return stresses(Eigen::all, std::array<int, 6>{0, 3, 5, 1, 4, 2}).cast<float>();
}

/// One scalar per brick.
struct CellField {
  std::string name;
  const std::string& folder;
  bool is_integer = false;
};

}  // namespace

/// A dataset of the HDF5 file.
struct XdmfWriter::Item {
  std::string name;
  ArrayShape shape;
  bool is_integer = false;
};

XdmfWriter::XdmfWriter(fs::path file, const World& world, const std::vector<std::vector<int>>& regions,
                       StrainMeasure measure)
    : file_(std::move(file)),
      arrays_(fs::path(file_) += ".h5"),
      world_(world),
      measure_(measure),
      hdf5_(arrays_.path()) {
  for (std::size_t row = 0; row < world_.bodies.size(); ++row) {
    const SoftBody& body = world_.bodies[row];
    write_bricks(fmt::format("/bricks_{}", row + 1), body, regions[row]);
    write_matrix(hdf5_, fmt::format("/skin_{}/triangles", row + 1), body.drawn.skin.triangles);
  }
}

std::string XdmfWriter::item_text(const Item& item) const {
  return fmt::format("<DataItem Format=\"HDF\" Dimensions=\"{}\" NumberType=\"{}\" Precision=\"4\">{}:{}</DataItem>",
                     fmt::join(item.shape, " "), item.is_integer ? "Int" : "Float",
                     arrays_.final_path().filename().string(), item.name);
}

void XdmfWriter::write_bricks(const std::string& folder, const Body& body, const std::vector<int>& regions) {
  Hexahedra hexahedra(body.grid.brick_count(), 8);
  Eigen::VectorXf fill(body.grid.brick_count());
  for (Eigen::Index brick = 0; brick < hexahedra.rows(); ++brick) {
    const std::size_t row = brick;
    for (std::size_t k = 0; k < 8; ++k) {
      hexahedra(brick, k) = body.grid.nodes[row][kVtkCorners[k]];
    }
    fill[brick] = float(body.grid.fill[row]);
  }
  write_matrix(hdf5_, folder + "/hexahedra", hexahedra);
  write_matrix(hdf5_, folder + "/fill", fill);
  write_matrix(hdf5_, folder + "/young", Eigen::VectorXf(brick_youngs(body).cast<float>()));
  hdf5_.write(folder + "/region", std::span<const int>(regions), {regions.size()});
}

std::string XdmfWriter::brick_grid(std::size_t row, const std::string& folder, const Points& nodes,
                                   const Points& velocities) {
  const Body& body = world_.bodies[row];
  const std::size_t bricks = body.grid.brick_count();
  const std::size_t count = nodes.rows();
  const std::string fixed = fmt::format("/bricks_{}", row + 1);
  const std::string moving = folder + fixed;
  const auto measured = [&](BrickMeasure measure) {
    return Eigen::VectorXf(measure_bricks(body, measure, nodes).cast<float>());
  };
  write_matrix(hdf5_, moving + "/nodes", Floats3(nodes.cast<float>()));
  write_matrix(hdf5_, moving + "/velocity", Floats3(velocities.cast<float>()));
  write_matrix(hdf5_, moving + "/stretch", measured(BrickMeasure::kStretch));
  write_matrix(hdf5_, moving + "/stress", measured(BrickMeasure::kStress));
  write_matrix(hdf5_, moving + "/stress_tensor", tensor6(recover_stress(body, nodes, measure_)));
  std::string text = fmt::format(
      "<Grid Name=\"bricks {}\" GridType=\"Uniform\">\n<Topology TopologyType=\"Hexahedron\" NumberOfElements=\"{}\">"
      "{}</Topology>\n<Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
      row + 1, bricks, item_text({fixed + "/hexahedra", {bricks, 8}, true}),
      item_text({moving + "/nodes", {count, 3}}));
  for (const CellField& field :
       {CellField{"region", fixed, true}, {"young", fixed}, {"fill", fixed}, {"stretch", moving}, {"stress", moving}}) {
    text += fmt::format("<Attribute Name=\"{}\" AttributeType=\"Scalar\" Center=\"Cell\">{}</Attribute>\n", field.name,
                        item_text({field.folder + "/" + field.name, {bricks, 1}, field.is_integer}));
  }
  return text +
         fmt::format(
             "<Attribute Name=\"velocity\" AttributeType=\"Vector\" Center=\"Node\">{}</Attribute>\n"
             "<Attribute Name=\"stress_tensor\" AttributeType=\"Tensor6\" Center=\"Node\">{}</Attribute>\n</Grid>\n",
             item_text({moving + "/velocity", {count, 3}}), item_text({moving + "/stress_tensor", {count, 6}}));
}

std::string XdmfWriter::skin_grid(std::size_t row, const std::string& folder, const Points& nodes) {
  const SoftBody& body = world_.bodies[row];
  const Points skin = body.skin_positions(nodes);
  const std::size_t triangles = body.drawn.skin.triangles.rows();
  const std::string name = fmt::format("/skin_{}", row + 1);
  write_matrix(hdf5_, folder + name + "/positions", Floats3(skin.cast<float>()));
  return fmt::format(
      "<Grid Name=\"skin {}\" GridType=\"Uniform\">\n<Topology TopologyType=\"Triangle\" NumberOfElements=\"{}\">{}"
      "</Topology>\n<Geometry GeometryType=\"XYZ\">{}</Geometry>\n</Grid>\n",
      row + 1, triangles, item_text({name + "/triangles", {triangles, 3}, true}),
      item_text({folder + name + "/positions", {std::size_t(skin.rows()), 3}}));
}

void XdmfWriter::add_frame(double time, const std::vector<Points>& nodes, const std::vector<Points>& velocities) {
  const std::string folder = fmt::format("/frame_{}", ++frame_count_);
  frames_ += fmt::format(
      "<Grid Name=\"frame {}\" GridType=\"Collection\" CollectionType=\"Spatial\">\n<Time Value=\"{:.9g}\"/>\n",
      frame_count_, time);
  for (std::size_t row = 0; row < nodes.size(); ++row) {
    frames_ += brick_grid(row, folder, nodes[row], velocities[row]) + skin_grid(row, folder, nodes[row]);
  }
  frames_ += "</Grid>\n";
}

void XdmfWriter::close() {
  hdf5_.close();
  arrays_.publish();
  write_file(file_, fmt::format("<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n<Grid Name=\"film\" "
                                "GridType=\"Collection\" CollectionType=\"Temporal\">\n{}</Grid>\n</Domain>\n</Xdmf>\n",
                                frames_));
}

}  // namespace sprung
