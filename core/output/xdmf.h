#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/output/hdf5_file.h"
#include "core/world/world.h"

namespace sprung {

/// A film for ParaView: `run.xdmf` says what is where in `run.xdmf.h5`. In every frame, for every actor, its bricks as
/// hexahedra with their fill, Young's modulus (what tells regions apart), stretch and stress (brick_measures.h) and the
/// velocity of their nodes, and its skin as triangles. Floats.
class XdmfWriter {
 public:
  /// The world must outlive it. Throws Error(kFailed), like all else here.
  XdmfWriter(std::filesystem::path file, const World& world);
  ~XdmfWriter();
  XdmfWriter(const XdmfWriter&) = delete;
  XdmfWriter& operator=(const XdmfWriter&) = delete;

  /// Of the next actor; for all of them before the first frame.
  void add_skin(const Triangles& triangles);
  /// By actor: nodes (m) and their velocities (m/s), skin vertices (m).
  void add_frame(double time, const std::vector<Points>& nodes, const std::vector<Points>& velocities,
                 const std::vector<Points>& skins);
  /// Gives the files their names.
  void close();

 private:
  struct Item;
  [[nodiscard]] std::string item_text(const Item& item) const;
  void write_bricks(std::size_t actor);
  [[nodiscard]] std::string brick_grid(std::size_t actor, const std::string& folder, const Points& nodes,
                                       const Points& velocities);
  [[nodiscard]] std::string skin_grid(std::size_t actor, const std::string& folder, const Points& skin);

  std::filesystem::path file_;
  std::filesystem::path numbers_;  // beside it
  const World& world_;
  std::vector<Eigen::Index> triangle_counts_;
  Hdf5Writer hdf5_;
  std::string frames_;
  std::size_t frame_count_ = 0;
};

}  // namespace sprung
