#include "render/trace/layer.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

using Eigen::Vector3f;

const Vector3f kBase(0.8F, 0.4F, 0.05F);

TEST(Layer, ThickOnesReflectTheirColour) {
  const Layer thick(kBase, 1e3F);
  EXPECT_LT((thick.reflected - kBase).norm(), 1e-4F);
  EXPECT_LT(thick.let_through.maxCoeff(), 1e-6F);
}

// Two surfaces and nothing between them: light bounces to and fro, and half of it leaves at each bounce.
TEST(Layer, OneOfNoThicknessIsItsTwoSurfaces) {
  const Layer thin(kBase, 1e-6F);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(thin.reflected[k], Layer::kInner / (1 + Layer::kInner), 1e-4);
    EXPECT_NEAR(thin.let_through[k], 1 / (1 + Layer::kInner), 1e-4);
  }
}

TEST(Layer, NoLightIsMade) {
  float before = 1;
  for (const float thickness : {0.1F, 0.5F, 1.0F, 3.0F, 10.0F}) {
    const Layer layer(kBase, thickness);
    EXPECT_LT((layer.reflected + layer.let_through).maxCoeff(), 1);
    EXPECT_LT(layer.let_through.y(), before);  // the thicker, the less comes through
    before = layer.let_through.y();
    const Layer white(Vector3f::Ones(), thickness);  // absorbs next to nothing
    EXPECT_GT((white.reflected + white.let_through).minCoeff(), 0.93F) << thickness;
  }
}

}  // namespace
}  // namespace sprung
