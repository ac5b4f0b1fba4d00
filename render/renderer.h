#pragma once
#include <memory>
#include <string>
#include <vector>

#include "render/image/image.h"
#include "render/stage/stage.h"

namespace sprung {

/// Returns whether qualities other than kFinal support that many samples per pixel: 1, 4 and 16.
[[nodiscard]] bool is_raster_samples(int samples);

/// Throws Error(kFailed) if this program was built without what Quality::kFinal needs.
void require_path_tracer();

/// Draws a stage off-screen with OSMesa, in final quality with Embree: no display, no GPU. Deterministic on one machine
/// for any number of threads.
class Renderer {
 public:
  /// Throws Error(kFailed) if no OpenGL 3.3 context can be made.
  Renderer(const Stage& stage, const RenderOptions& options);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// One shape for each skin of the stage, in order.
  [[nodiscard]] Image draw(const std::vector<SkinShape>& shapes, const Camera& camera);

  /// The mean light of some exposures; needs RenderOptions::exposes.
  [[nodiscard]] Image draw(const std::vector<Exposure>& exposures);

  /// The layers that a compositor needs in addition to the picture of `now`; `before` and `after`: one frame earlier
  /// and later. With RenderOptions::exposes the beauty is of the exposures drawn last, which should be those of `now`.
  [[nodiscard]] Passes draw_passes(const Moment& now, const Moment& before, const Moment& after);

  /// The time of each pass over all pictures so far; empty unless measured.
  [[nodiscard]] const std::vector<DrawTime>& draw_times() const;

  /// Name and version of the driver, for reports.
  [[nodiscard]] std::string driver() const;

 private:
  struct Device;
  struct Tracing;
  std::unique_ptr<Device> device_;
};

}  // namespace sprung
