#include "render/trace/gathered_light.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>

#include "core/appearance.h"
#include "render/trace/directions.h"
#include "tests/support/still_life.h"

namespace sprung {
namespace {

using Eigen::Vector3f;
using Eigen::Vector4f;

const Vector3f kEye(0, 0, 20);  // stage space
constexpr int kRaysOfProbe = 64;
constexpr int kMaxProbes = 20000;

/// A square with two triangles for each of side x side parts, at a height, that looks up or down.
Skin plate(double half, double height, int side, bool looks_up) {
  Skin skin;
  const int count = side + 1;
  skin.positions.resize(count * count, 3);
  skin.normals.resize(count * count, 3);
  skin.triangles.resize(2 * side * side, 3);
  for (int i = 0; i < count * count; ++i) {
    skin.positions.row(i) << half * (2.0 * (i % count) / side - 1), height, half * (2.0 * (i / count) / side - 1);
    skin.normals.row(i) << 0, looks_up ? 1 : -1, 0;
  }
  for (int i = 0; i < side * side; ++i) {
    const int corner = i / side * count + i % side;
    const int right = looks_up ? corner + 1 : corner + count;
    const int down = looks_up ? corner + count : corner + 1;
    skin.triangles.row(2 * i) << corner, down, right;
    skin.triangles.row(2 * i + 1) << right, down, corner + count + 1;
  }
  return skin;
}

/// Level ground under the open sky.
GroundLight open_ground(const Stage& stage) {
  const StageLight light(stage);
  const StageSpace space(stage.bounds);
  const Vector3f open = light.on_facing_key() * light.to_key().y() + light.sky_on_ground();
  return {-space.center.y() * space.scale, {-1, -1}, {2, 2}, 2, std::vector(4, open)};
}

class Gathering {
 public:
  explicit Gathering(const StillLife& scene)
      : stage_(scene.stage()), shapes_(scene.shapes()), light_(stage_, kRaysOfProbe, kMaxProbes) {}

  /// Light and openness at a vertex.
  Vector4f at(std::size_t skin, int vertex, const Vector3f& eye = kEye) {
    light_.update(shapes_, eye, open_ground(stage_));
    Vector4f value = light_.of_vertices(skin).row(vertex).cast<float>().transpose() / 65535;
    value.head<3>() = kBrightestVertexLight * value.head<3>().cwiseAbs2();
    return value;
  }
  VertexLight all(const std::vector<SkinShape>& shapes) {
    light_.update(shapes, kEye, open_ground(stage_));
    return light_.of_vertices(0);
  }
  [[nodiscard]] const std::vector<SkinShape>& shapes() const { return shapes_; }
  /// The light in the middle of the ground.
  Vector4f onto_ground() {
    light_.update(shapes_, kEye, open_ground(stage_));
    const GroundGlow& glow = light_.onto_ground(open_ground(stage_));
    return glow.texels[std::size_t(glow.size / 2) * std::size_t(glow.size + 1)];
  }

 private:
  Stage stage_;
  std::vector<SkinShape> shapes_;
  GatheredLight light_;
};

int nearest(const Skin& skin, const Vec3& point) {
  Eigen::Index vertex = 0;
  (skin.positions.rowwise() - point.transpose()).rowwise().squaredNorm().minCoeff(&vertex);
  return int(vertex);
}

/// Irradiance over pi of an unoccluded surface.
Vector3f unhidden(const Vector3f& normal) {
  const StageLight light(lighting_of(LightPreset::kStudio), std::nullopt);
  const TangentFrame frame(normal);
  constexpr int kSide = 100;
  Vector3f sum = Vector3f::Zero();
  for (int i = 0; i < kSide * kSide; ++i) sum += light.around(frame.to_world(on_cosine_hemisphere(on_grid(i, kSide))));
  return sum / (kSide * kSide);
}

TEST(GatheredLight, OfAConvexBodyIsAllLightAroundIt) {
  StillLife scene;
  scene.add(make_sphere_skin({0, 3, 0}, 0.5), kCream);
  Gathering gathering(scene);
  for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(0.6, 0.8, 0), Vec3(0, 1, 0), Vec3(0, -0.8, 0.6)}) {
    const int vertex = nearest(scene.skins[0], Vec3(0, 3, 0) + 0.5 * normal);
    const Vector4f found = gathering.at(0, vertex, 20 * normal.cast<float>());
    const Vector3f expected = unhidden(scene.skins[0].normals.row(vertex).cast<float>());
    EXPECT_NEAR(found.w(), 1, 1e-4);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], 0.01 * expected[k]) << normal.transpose();
  }
}

// Below a square of half side a at a height h, of which a quarter is seen under the form factor of two parallel
// rectangles with a corner above a point: J. Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", B-3.
TEST(GatheredLight, UnderAPlateIsHiddenByItsFormFactor) {
  StillLife scene;
  scene.add(plate(0.5, 0.4, 40, false), kRed);
  scene.add(plate(0.2, 0, 20, true), kCream);
  const double x = 0.5 / 0.4;
  const double quarter = x / std::sqrt(1 + x * x) * std::atan(x / std::sqrt(1 + x * x)) / M_PI;
  const Vector4f found = Gathering(scene).at(1, nearest(scene.skins[1], {0, 0, 0}), {0, 5, 20});
  EXPECT_NEAR(found.w(), 1 - 4 * quarter, 0.02);
}

// The same plate, which is in its own shadow and lit by the open floor alone.
TEST(GatheredLight, OntoTheGroundComesFromWhatHidesTheSky) {
  StillLife scene;
  scene.add(plate(0.5, 0.4, 40, false), kRed);
  const double x = 0.5 / 0.4;
  const double quarter = x / std::sqrt(1 + x * x) * std::atan(x / std::sqrt(1 + x * x)) / M_PI;
  const Vector4f found = Gathering(scene).onto_ground();
  EXPECT_NEAR(found.w(), 4 * quarter, 0.02);
  EXPECT_GT(found.x(), 3 * found.z());
  const float red = linear_from_srgb(kRed.x());
  const float open = open_ground(scene.stage()).texels[0].x() * lighting_of(LightPreset::kStudio).floor.x();
  EXPECT_LT(found.x(), found.w() * red * open);
  EXPECT_GT(found.x(), 0.5F * found.w() * red * open);
}

TEST(GatheredLight, OntoTheGroundComesNothingWithoutBodies) {
  StillLife scene;
  scene.add(make_sphere_skin({0, 300, 0}, 0.1), kRed);
  const GroundLight below{-1e4, {-1, -1}, {2, 2}, 2, std::vector(4, Vector3f::Ones().eval())};
  GatheredLight light(scene.stage(), kRaysOfProbe, kMaxProbes);
  light.update(scene.shapes(), kEye, below);
  for (const Vector4f& texel : light.onto_ground(below).texels) EXPECT_TRUE(texel.isZero(0));
}

TEST(GatheredLight, BleedsTheColourOfANeighbour) {
  StillLife scene;
  scene.add(make_sphere_skin({0, 0.5, 0}, 0.4), kCream);
  scene.add(make_box_skin({0.5, 0, -1}, {0.6, 1.5, 1}), kRed);
  Gathering gathering(scene);
  const Vector4f near = gathering.at(0, nearest(scene.skins[0], {0.4, 0.5, 0}), {20, 2, 20});
  const Vector4f far = gathering.at(0, nearest(scene.skins[0], {-0.4, 0.5, 0}), {-20, 2, 20});
  EXPECT_GT(near.x() / near.z(), 1.3F * far.x() / far.z());
  EXPECT_LT(near.w(), 0.6F);
  EXPECT_GT(far.w(), 0.99F);
}

TEST(GatheredLight, InsideABodyIsDark) {
  StillLife scene;
  scene.add(make_sphere_skin({0, 1, 0}, 0.2), kCream);
  scene.add(make_sphere_skin({0, 1, 0}, 0.6), kCream);
  const Vector4f found = Gathering(scene).at(0, nearest(scene.skins[0], {0, 1, 0.2}));
  EXPECT_EQ(found, Vector4f::Zero().eval());
}

TEST(GatheredLight, OfASheetIsOfTheSideThatIsSeen) {
  StillLife scene;
  scene.add(plate(0.5, 1, 20, true), kCream);
  scene.add(plate(0.5, 1.1, 20, false), kRed);  // a lid
  Gathering gathering(scene);
  const int middle = nearest(scene.skins[0], {0, 1, 0});
  EXPECT_LT(gathering.at(0, middle, {0, 1, 20}).w(), 0.2F);
  EXPECT_GT(gathering.at(0, middle, {0, -20, 20}).w(), 0.99F);
}

// The mean over a cosine-weighted hemisphere of exp(-x / cosine) is twice the third exponential integral of x.
TEST(GatheredLight, ComesThroughALayerAsFarAsItScatters) {
  StillLife scene;
  scene.add(refined(make_box_skin({-5, 2, -5}, {5, 2.1, 5}), 0.5), kCream);
  Stage stage = scene.stage();
  stage.mean_free_paths = {0.1};
  GatheredLight gathered(stage, kRaysOfProbe, kMaxProbes);
  gathered.update(scene.shapes(), {0, 20, 5}, open_ground(stage));
  ASSERT_TRUE(gathered.has_through());
  double expected = 0;
  constexpr int kSteps = 10000;
  for (int i = 0; i < kSteps; ++i) {
    const double cosine = (i + 0.5) / kSteps;
    expected += 2 * cosine * std::exp(-0.5 / cosine) / kSteps;
  }
  const auto through = gathered.through_to_vertices(0).row(nearest(scene.skins[0], {0, 2.1, 0})).cast<float>() / 65535;
  EXPECT_NEAR(through.w(), expected, 0.05 * expected);
  // Below it there is only the floor.
  const Vector3f below = unhidden(-Vector3f::UnitY());
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(kBrightestVertexLight * through[k] * through[k], below[k], 0.05 * below[k]);
  }
}

TEST(GatheredLight, DoesNotComeThroughOtherBodies) {
  StillLife scene;
  scene.add(make_sphere_skin({0, 1, 0}, 0.2), kCream);
  EXPECT_FALSE(GatheredLight(scene.stage(), kRaysOfProbe, kMaxProbes).has_through());
  scene.add(make_sphere_skin({1, 1, 0}, 0.2), kCream);
  Stage stage = scene.stage();
  stage.mean_free_paths = {0, 0.1};
  GatheredLight gathered(stage, kRaysOfProbe, kMaxProbes);
  gathered.update(scene.shapes(), kEye, open_ground(stage));
  EXPECT_TRUE(gathered.through_to_vertices(0).isZero(0));
  EXPECT_FALSE(gathered.through_to_vertices(1).isZero(0));
}

TEST(GatheredLight, OfAMetalHasItsMirroredNeighbours) {
  StillLife scene;
  scene.add(make_sphere_skin({0, 1, 0}, 0.4), kCream);
  scene.add(make_box_skin({1, 0, -2}, {1.1, 3, 2}), kRed);  // a wall on the right
  Stage stage = scene.stage();
  stage.looks = {Look::kSteel, Look::kPlastic};
  GatheredLight gathered(stage, kRaysOfProbe, kMaxProbes);
  gathered.update(scene.shapes(), kEye, open_ground(stage));
  ASSERT_TRUE(gathered.has_through());
  const auto mirrored = [&](const Vec3& normal) -> Vector4f {
    return gathered.through_to_vertices(0).row(nearest(scene.skins[0], Vec3(0, 1, 0) + 0.4 * normal)).cast<float>() /
           65535;
  };
  const Vector4f right = mirrored(Vec3(1, 0, 1).normalized());
  EXPECT_GT(right.w(), 0.95F);
  EXPECT_GT(right.x(), 1.5F * right.z());
  EXPECT_LT(mirrored({0, 0, 1}).w(), 0.05F);
  EXPECT_LT(mirrored(Vec3(-1, 0, 1).normalized()).w(), 0.05F);
}

// Such normals may come from a file or a flattened triangle.
TEST(GatheredLight, NormalsThatAreNoNumbersHaveNoLight) {
  StillLife scene;
  scene.add(make_sphere_skin({0, 1, 0}, 0.4), kCream);
  scene.skins[0].normals.row(0).setConstant(std::numeric_limits<double>::quiet_NaN());
  scene.skins[0].normals.row(1).setZero();
  Gathering gathering(scene);
  EXPECT_EQ(gathering.at(0, 0, {0, 20, 0}), Vector4f::Zero().eval());
  EXPECT_GT(gathering.at(0, nearest(scene.skins[0], {0, 1, 0.4})).x(), 0.1F);
}

TEST(GatheredLight, DependsNeitherOnThreadsNorOnEarlierPictures) {
  StillLife scene;
  scene.add(make_ring_skin({0, 0.2, 0}, 0.5, 0.2), kCream);
  scene.add(make_sphere_skin({0, 0.5, 0}, 0.3), kRed);
  std::vector<SkinShape> moved = Gathering(scene).shapes();
  moved[1].positions.col(1).array() += 0.5F;
  Gathering fresh(scene);
  const VertexLight expected = fresh.all(fresh.shapes());
  EXPECT_EQ(fresh.all(fresh.shapes()), expected);
  EXPECT_NE(fresh.all(moved), expected);
  EXPECT_EQ(fresh.all(fresh.shapes()), expected);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(Gathering(scene).all(moved), fresh.all(moved));
}

}  // namespace
}  // namespace sprung
