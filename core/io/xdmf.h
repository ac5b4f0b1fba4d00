#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/io/hdf5_file.h"
#include "core/world/world.h"

namespace sprung {

/// A film for ParaView: `run.xdmf` says what is where in `run.xdmf.h5`. In every frame, for every body, its bricks as
/// hexahedra with their region, Young's modulus, fill, stretch and stress (brick_measures.h) and the velocity of their
/// nodes, and its skin as triangles. Floats, but for the regions.
class XdmfWriter {
 public:
  /// The world must outlive it. Throws Error(kFailed), like all else here.
  XdmfWriter(std::filesystem::path file, const World& world);
  ~XdmfWriter();
  XdmfWriter(const XdmfWriter&) = delete;
  XdmfWriter& operator=(const XdmfWriter&) = delete;

  /// By body: nodes (m) and their velocities (m/s).
  void add_frame(double time, const std::vector<Points>& nodes, const std::vector<Points>& velocities);
  /// Gives the files their names.
  void close();

 private:
  struct Item;
  [[nodiscard]] std::string item_text(const Item& item) const;
  void write_bricks(const std::string& folder, const SoftBody& body);
  [[nodiscard]] std::string brick_grid(std::size_t row, const std::string& folder, const Points& nodes,
                                       const Points& velocities);
  [[nodiscard]] std::string skin_grid(std::size_t row, const std::string& folder, const Points& nodes);

  std::filesystem::path file_;
  std::filesystem::path numbers_;  // beside it
  const World& world_;
  Hdf5Writer hdf5_;
  std::string frames_;
  std::size_t frame_count_ = 0;
};

}  // namespace sprung
