#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/body/stress.h"
#include "core/files.h"
#include "core/io/hdf5_file.h"
#include "core/world/world.h"

namespace sprung {

/// Writes an animation for ParaView: `run.xdmf` describes the arrays in `run.xdmf.h5`. Per frame and body: the bricks
/// as hexahedra with region, Young's modulus, fill, stretch and stress (brick_measures.h), nodal velocities and stress
/// tensors (stress.h), and the skin as triangles. Floats, except for the regions.
class XdmfWriter {
 public:
  /// The world must outlive it; `regions`: of each body's bricks. All functions throw Error(kFailed).
  XdmfWriter(std::filesystem::path file, const World& world, const std::vector<std::vector<int>>& regions,
             StrainMeasure measure = StrainMeasure::kFinite);

  /// Nodes (m) and their velocities (m/s), by body.
  void add_frame(double time, const std::vector<Points>& nodes, const std::vector<Points>& velocities);
  /// Gives the files their final names.
  void close();

 private:
  struct Item;
  [[nodiscard]] std::string item_text(const Item& item) const;
  void write_bricks(const std::string& folder, const Body& body, const std::vector<int>& regions);
  [[nodiscard]] std::string brick_grid(std::size_t row, const std::string& folder, const Points& nodes,
                                       const Points& velocities);
  [[nodiscard]] std::string skin_grid(std::size_t row, const std::string& folder, const Points& nodes);

  std::filesystem::path file_;
  PartialFile arrays_;
  const World& world_;
  StrainMeasure measure_;
  Hdf5Writer hdf5_;
  std::string frames_;
  std::size_t frame_count_ = 0;
};

}  // namespace sprung
