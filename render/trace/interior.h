#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "render/trace/medium.h"
#include "render/trace/traced_skins.h"

namespace sprung {

/// The media inside the bodies of a stage.
class Media {
 public:
  Media(const Stage& stage, const StageSpace& space);

  /// Returns whether light enters any body, or that of a skin.
  [[nodiscard]] bool any() const { return any_; }
  [[nodiscard]] bool is_entered(int skin) const { return scatterings_[std::size_t(skin)] > 0; }
  /// Per unit of length in stage space; 0 if no light enters.
  [[nodiscard]] float scattering(int skin) const { return scatterings_[std::size_t(skin)]; }
  /// The medium behind a point of a translucent skin, of the colour there.
  [[nodiscard]] Medium behind(const SurfacePoint& point) const {
    return {point.color, scatterings_[std::size_t(point.skin)]};
  }
  /// The size of its bounding box at rest.
  [[nodiscard]] float size(int skin) const { return sizes_[std::size_t(skin)]; }

 private:
  std::vector<float> scatterings_;  // by skin: one over the mean free path, in stage space; 0: no light enters
  std::vector<float> sizes_;        // by skin
  bool any_ = false;
};

/// The bodies that a ray is inside. Where some overlap, the smallest counts: a cherry in a jelly; within one skin the
/// part that was entered last.
class Interior {
 public:
  explicit Interior(const Media& media) : media_(media) {}

  [[nodiscard]] bool is_empty() const { return count_ == 0; }
  /// Returns whether leaving that skin leads outside.
  [[nodiscard]] bool is_only(int skin) const { return count_ == 1 && layers_[0].skin == skin; }
  /// Precondition: not empty.
  [[nodiscard]] const Medium& medium() const { return layers_[top_].medium; }
  void enter(const SurfacePoint& point);
  /// Does nothing if the ray is not inside that skin.
  void leave(int skin);

 private:
  struct Layer {
    int skin = -1;
    Medium medium{Eigen::Vector3f::Ones(), 1};
  };
  void find_top();

  const Media& media_;
  std::array<Layer, 8> layers_{};  // as they were entered; deeper ones are left out
  std::size_t count_ = 0;
  std::size_t top_ = 0;
};

}  // namespace sprung
