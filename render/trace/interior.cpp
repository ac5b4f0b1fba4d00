#include "render/trace/interior.h"

#include <algorithm>

#include "render/stage/visible_sides.h"

namespace sprung {

Media::Media(const Stage& stage, const StageSpace& space) : scatterings_(stage.skins.size(), 0) {
  for (const Skin* const skin : stage.skins) {
    const AlignedBox box = bounding_box(skin->positions);
    sizes_.push_back(box.isEmpty() ? 0 : float(box.diagonal().norm()));
  }
  for (std::size_t i = 0; i < stage.mean_free_paths.size(); ++i) {
    if (stage.mean_free_paths[i] <= 0 || visible_sides(*stage.skins[i]) == Sides::kBoth) continue;
    scatterings_[i] = float(1 / (stage.mean_free_paths[i] * space.scale));
    any_ = true;
  }
}

void Interior::enter(const SurfacePoint& point) {
  if (count_ == layers_.size()) return;
  layers_[count_++] = {point.skin, media_.behind(point)};
  find_top();
}

void Interior::leave(int skin) {
  for (std::size_t i = count_; i-- > 0;) {
    if (layers_[i].skin != skin) continue;
    std::move(layers_.begin() + std::ptrdiff_t(i) + 1, layers_.begin() + std::ptrdiff_t(count_),
              layers_.begin() + std::ptrdiff_t(i));
    --count_;
    return find_top();
  }
}

void Interior::find_top() {
  top_ = 0;
  for (std::size_t i = 1; i < count_; ++i) {
    if (media_.size(layers_[i].skin) <= media_.size(layers_[top_].skin)) top_ = i;
  }
}

}  // namespace sprung
