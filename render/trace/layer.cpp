#include "render/trace/layer.h"

namespace sprung {

Layer::Layer(const Eigen::Vector3f& base, float thickness) {
  const Eigen::Array3f thick = (base.array() / (1 - kInner + kInner * base.array())).max(0.004F).min(0.998F);
  const Eigen::Array3f a = 0.5F * (1 / thick + thick);
  const Eigen::Array3f b = 0.5F * (1 / thick - thick);
  const Eigen::Array3f e = (-b * thickness).exp();
  const Eigen::Array3f tangent = (1 - e * e) / (1 + e * e);
  const Eigen::Array3f below = a * tangent + b;
  const Eigen::Array3f r = tangent / below;
  const Eigen::Array3f t = 2 * b * e / (1 + e * e) / below;
  const Eigen::Array3f once = 1 / (1 - kInner * r);
  const Eigen::Array3f back = r + kInner * t * t * once;
  const Eigen::Array3f out_of_it = (1 - kInner) / (1 - kInner * back);
  reflected = out_of_it * back;
  let_through = out_of_it * t * once;
}

}  // namespace sprung
