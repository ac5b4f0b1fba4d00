#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/bricks/embedding.h"
#include "core/skin/skin.h"
#include "render/image/legend.h"
#include "render/stage/camera.h"

namespace sprung {

/// A field at the nodes of a take.
struct ViewerField {
  Legend legend;                    // its title names the unit of `low` and `high`
  std::vector<std::uint8_t> steps;  // nodes of the first frame, then of the next, ...; 0: low, 255: high. A single
                                    // frame holds for all

  /// Appends nodes: 0 is low, 1 high; values beyond are clamped.
  void add(const Eigen::VectorXd& coordinates);
};

/// A mesh of a take: vertices embedded in bricks, or those of an obstacle.
struct ViewerMesh {
  std::vector<int> brick;         // rows of the take's bricks; none for an obstacle
  Floats3 local;                  // coordinates in the brick, see Embedding
  std::vector<Floats3> obstacle;  // by frame, m; a single one: it does not move
};

/// A film as the page shows it.
struct ViewerTake {
  std::string name;
  double fps = 24;
  int first_frame = 1;  // number of the first frame in the film, and the increment to the next
  int frame_step = 1;
  std::string progress = "time_s";  // of a frame: time_s, load or mode
  std::vector<double> at;           // by frame: time (s), fraction of the load or number of the mode
  Camera camera;                    // at the start
  double aspect = 16.0 / 9;         // width / height that the camera is made for
  std::optional<double> ground;     // m, height
  std::string model;                // the first frame as glTF, with a node for each mesh
  std::vector<ViewerMesh> meshes;
  std::vector<Floats3> nodes;              // by frame: of all bodies, one after the other, m
  std::vector<std::array<int, 8>> bricks;  // nodes by corner
  std::vector<std::array<int, 2>> springs;
  Eigen::VectorXf rest_lengths;          // of the springs, m
  std::optional<Legend> spring_stretch;  // legend, percent
  std::vector<ViewerField> fields;
  int shown_field = -1;  // index of the one shown at the start; -1: the skin's own colours

  /// Adds the bricks of a grid whose nodes come next, and returns the index of the first.
  int add_bricks(const BrickGrid& grid, int first_node);
  /// Adds a frame: the nodes of each body, m.
  void add_frame(const std::vector<Floats3>& bodies);
};

/// Embeds these rows of a take's vertices in a grid whose bricks start at row `first_brick` of the take's bricks.
void place_vertices(ViewerMesh& mesh, const std::vector<int>& rows, const Embedding& embedding, int first_brick);

/// A page that shows films in 3D in any browser with WebGL: playback, rotation, colours by field, bricks, springs,
/// wireframe, axes. It contains three.js and its licence and needs no other file. Positions are rounded to 1/65535 of a
/// take's longest side.
[[nodiscard]] std::string viewer_page(std::span<const ViewerTake> takes);

/// The page without films; as a JavaScript array they replace kViewerTakes.
inline constexpr std::string_view kViewerTakes = "/*TAKES*/";
[[nodiscard]] std::string_view viewer_template();

}  // namespace sprung
