#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "render/frame.h"
#include "render/image/cryptomatte.h"
#include "render/image/exr.h"
#include "tests/support/error_message.h"
#include "tests/support/still_life.h"
#include "tests/support/temp_folder.h"

namespace sprung {
namespace {

constexpr double kRadius = 0.05;
const Vec3 kMiddle(0.02, 0.08, -0.01);

StillLife two_balls() {
  StillLife scene;
  scene.add(make_sphere_skin(kMiddle, kRadius), {1, 0, 0});
  scene.add(make_sphere_skin(kMiddle + Vec3(0.3, 0, 0), kRadius), {0, 0, 1});
  return scene;
}

/// Looks at the first ball.
Camera camera_at(const Vec3& eye) {
  Camera camera;
  camera.eye = eye;
  camera.target = kMiddle;
  return camera;
}

Passes passes_of(const StillLife& scene, const Camera& camera) {
  const Stage stage = scene.stage();
  Renderer renderer(stage, {.width = 161, .height = 91});
  const std::vector<SkinShape> shapes = scene.shapes();
  return renderer.draw_passes({shapes, camera}, {shapes, camera}, {shapes, camera});
}

struct Pixel {
  const Passes& passes;
  std::size_t at;
  [[nodiscard]] Vec3 position() const {
    return {passes.position[0][at], passes.position[1][at], passes.position[2][at]};
  }
  [[nodiscard]] Vec3 normal() const { return {passes.normal[0][at], passes.normal[1][at], passes.normal[2][at]}; }
};

constexpr std::size_t kCentre = 45 * 161 + 80;

TEST(Passes, SayWhereWhatWhichWayAndHowFar) {
  const Vec3 eye = kMiddle + Vec3(0.1, 0.2, 0.4);
  const Passes passes = passes_of(two_balls(), camera_at(eye));
  const Vec3 back = (eye - kMiddle).normalized();
  const Pixel centre{passes, kCentre};
  EXPECT_NEAR(passes.depth[kCentre], (eye - kMiddle).norm() - kRadius, 3e-4);  // the ball has flat triangles
  EXPECT_LT((centre.position() - kMiddle - kRadius * back).norm(), 1e-3);
  EXPECT_LT((centre.normal() - back).norm(), 0.03);
  EXPECT_EQ(passes.id[kCentre], 1);
}

TEST(Passes, HoldTogetherInEveryPixel) {
  const Vec3 eye = kMiddle + Vec3(0.3, 0.35, 0.6);
  const Camera camera = camera_at(eye);
  const Passes passes = passes_of(two_balls(), camera);
  const Vec3 ahead = (camera.target - eye).normalized();
  std::array<int, 3> count{};
  for (std::size_t i = 0; i < passes.depth.size(); ++i) {
    const Pixel pixel{passes, i};
    const auto id = std::size_t(passes.id[i]);
    ASSERT_LT(id, count.size());
    ++count[id];
    ASSERT_LT(passes.depth[i], 100);  // the camera looks down: ground everywhere
    EXPECT_NEAR(pixel.normal().norm(), 1, 1e-5);
    EXPECT_LT(pixel.normal().dot(pixel.position() - eye), 0.01);
    EXPECT_NEAR(passes.depth[i], ahead.dot(pixel.position() - eye), 1e-4 * passes.depth[i]);
    if (id == 0) {
      EXPECT_NEAR(pixel.position().y(), 0, 1e-6);
    }
    EXPECT_EQ(passes.uv[2][i], id > 0 ? 1 : 0);
    if (id > 0) {
      const Vec3 middle = kMiddle + (id == 2 ? Vec3(0.3, 0, 0) : Vec3(0, 0, 0));
      EXPECT_NEAR((pixel.position() - middle).norm(), kRadius, 6e-4);
      const Vec3 out = (pixel.position() - middle) / kRadius;
      EXPECT_NEAR(-std::cos(std::numbers::pi * passes.uv[1][i]), out.y(), 0.02);
      if (std::hypot(out.x(), out.z()) > 0.3) {
        const double turn = passes.uv[0][i] - std::atan2(out.x(), out.z()) / (2 * std::numbers::pi);
        EXPECT_NEAR(turn, std::round(turn), 0.01);
      }
    }
  }
  for (const int pixels : count) EXPECT_GT(pixels, 100);
}

/// The offset from the picture's middle, to the right and up, of a position seen by a camera with its target there.
Eigen::Vector2d seen_by(const Camera& camera, const Vec3& position) {
  const Vec3 ahead = (camera.target - camera.eye).normalized();
  const Vec3 right = ahead.cross(Vec3::UnitY()).normalized();
  const Vec3 way = position - camera.eye;
  const double scale = 0.5 * 91 / std::tan(camera.vertical_field_of_view * std::numbers::pi / 360) / ahead.dot(way);
  return {scale * right.dot(way), scale * right.cross(ahead).dot(way)};
}

TEST(Passes, SayHowFarEverythingMovesInThePicture) {
  const StillLife scene = two_balls();
  const Stage stage = scene.stage();
  Renderer renderer(stage, {.width = 161, .height = 91});
  const std::vector<SkinShape> now = scene.shapes();
  std::vector<SkinShape> before = now;
  std::vector<SkinShape> after = now;
  const Vec3 step(0.012, 0.004, -0.007);
  before[0].positions.rowwise() -= step.cast<float>().transpose();
  after[0].positions.rowwise() += 2 * step.cast<float>().transpose();
  const Camera camera = camera_at(kMiddle + Vec3(0.3, 0.35, 0.6));
  Camera later = camera;
  later.eye += Vec3(0.02, 0, 0.01);
  const Passes passes = renderer.draw_passes({now, camera}, {before, camera}, {after, later});
  std::array<int, 3> count{};
  for (std::size_t i = 0; i < passes.id.size(); ++i) {
    const Vec3 position = Pixel{passes, i}.position();
    const auto id = std::size_t(passes.id[i]);
    ++count[id];
    const Vec3 way = id == 1 ? step : Vec3(0, 0, 0);
    const Eigen::Vector2d here = seen_by(camera, position);
    const Eigen::Vector2d from = seen_by(camera, position - way) - here;
    const Eigen::Vector2d to = here - seen_by(later, position + 2 * way);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(passes.motion[k][i], from[k], 2e-3) << i;
      EXPECT_NEAR(passes.motion[k + 2][i], to[k], 2e-3) << i;
    }
  }
  for (const int pixels : count) EXPECT_GT(pixels, 100);
}

TEST(Passes, SayHowMuchOfEveryPixelIsWhose) {
  const Camera camera = camera_at(kMiddle + Vec3(0.3, 0.35, 0.6));
  const Passes passes = passes_of(two_balls(), camera);
  double ball = 0;  // pixels
  int mixed = 0;
  for (std::size_t i = 0; i < passes.id.size(); ++i) {
    float sum = 0;
    for (std::size_t rank = 0; rank < Passes::kRanks; ++rank) {
      sum += passes.coverage[rank][i];
      EXPECT_EQ(passes.matte[rank][i] >= 0, passes.coverage[rank][i] > 0);
      const std::size_t before = rank == 0 ? 0 : rank - 1;
      EXPECT_LE(passes.coverage[rank][i], passes.coverage[before][i]);
      if (passes.matte[rank][i] == 1) ball += passes.coverage[rank][i];
    }
    EXPECT_EQ(sum, 1);  // ground everywhere
    if (passes.coverage[0][i] == 1) {
      EXPECT_EQ(passes.matte[0][i], passes.id[i]);
    }
    mixed += passes.coverage[0][i] < 1 ? 1 : 0;
  }
  EXPECT_GT(mixed, 20);
  // The outline of a ball in the middle of the picture is a circle.
  const double away = (camera.eye - kMiddle).norm();
  const double tangent = kRadius / std::sqrt(away * away - kRadius * kRadius);
  const double radius = 0.5 * 91 * tangent / std::tan(camera.vertical_field_of_view * std::numbers::pi / 360);
  EXPECT_NEAR(ball, std::numbers::pi * radius * radius, 0.01 * ball);
}

/// Khronos PBR Neutral with the softer toe of picture.glsl, then sRGB, as levels of 255.
Eigen::Vector3d developed(Eigen::Vector3d light) {
  const double low = light.minCoeff();
  light.array() -= low < 0.04 ? low - 12.5 * low * low : 0.02;
  const double peak = light.maxCoeff();
  const double shoulder = 0.78;
  if (peak >= shoulder) {
    const double room = 1 - shoulder;
    const double rolled = 1 - room * room / (peak + room - shoulder);
    light *= rolled / peak;
    const double white = 1 - 1 / (0.15 * (peak - rolled) + 1);
    light += white * (Eigen::Vector3d::Constant(rolled) - light);
  }
  return light.unaryExpr([](double c) {
    return 255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(std::max(c, 0.0), 1 / 2.4) - 0.055);
  });
}

TEST(Passes, HaveTheLightOfThePicture) {
  const StillLife scene = two_balls();
  const Camera camera = camera_at(kMiddle + Vec3(0.3, 0.35, 0.6));
  const Stage stage = scene.stage();
  const std::vector<SkinShape> shapes = scene.shapes();
  Renderer renderer(stage, {.width = 161, .height = 91});
  const Image before = renderer.draw(shapes, camera);
  const Passes passes = renderer.draw_passes({shapes, camera}, {shapes, camera}, {shapes, camera});
  EXPECT_EQ(renderer.draw(shapes, camera).pixels, before.pixels);
  double far_off = 0;
  for (std::size_t i = 0; i < passes.id.size(); ++i) {
    EXPECT_EQ(passes.beauty[3][i], 1);
    if (passes.coverage[0][i] < 1) continue;  // mixed after the tone curve in the picture, before it in the pass
    const Eigen::Vector3d made = developed({passes.beauty[0][i], passes.beauty[1][i], passes.beauty[2][i]});
    for (int k = 0; k < 3; ++k) far_off = std::max(far_off, std::abs(made[k] - before.pixels[3 * i + std::size_t(k)]));
  }
  EXPECT_LT(far_off, 4) << "levels";
  EXPECT_GT(*std::max_element(passes.beauty[0].begin(), passes.beauty[0].end()), 0.5F);
}

TEST(Passes, OfBlurredPicturesHaveTheirLight) {
  const StillLife scene = two_balls();
  const Camera camera = camera_at(kMiddle + Vec3(0.3, 0.35, 0.6));
  const Stage stage = scene.stage();
  const std::vector<SkinShape> shapes = scene.shapes();
  Renderer renderer(stage, {.width = 161, .height = 91, .exposes = true});
  static_cast<void>(renderer.draw(std::vector<Exposure>(2, {shapes, shapes, camera})));
  const Passes blurred = renderer.draw_passes({shapes, camera}, {shapes, camera}, {shapes, camera});
  const Passes sharp = passes_of(scene, camera);
  for (std::size_t i = 0; i < sharp.id.size(); ++i) {
    if (sharp.id[i] > 0 && sharp.coverage[0][i] == 1) {
      EXPECT_NEAR(blurred.beauty[0][i], sharp.beauty[0][i], 1e-4);
    }
    EXPECT_NEAR(blurred.beauty[1][i], sharp.beauty[1][i], 0.02);  // the floor's tint is stored coarsely
    EXPECT_EQ(blurred.shadow[i], sharp.shadow[i]);
  }
}

TEST(Passes, SayWhereTheKeyLightAndTheSkyReach) {
  const Camera camera = camera_at(kMiddle + Vec3(0.3, 0.35, 0.6));
  const Passes passes = passes_of(two_balls(), camera);
  double darkest = 1;
  double closest = 1;
  for (std::size_t i = 0; i < passes.id.size(); ++i) {
    ASSERT_GE(passes.shadow[i], 0);
    ASSERT_LE(passes.shadow[i], 1);
    const Pixel pixel{passes, i};
    const double to_first = (pixel.position() - Vec3(kMiddle.x(), 0, kMiddle.z())).norm();
    if (passes.coverage[0][i] < 1) continue;
    if (passes.id[i] == 0) {
      darkest = std::min<double>(darkest, passes.shadow[i]);
      if (to_first < 0.5 * kRadius) closest = std::min<double>(closest, passes.occlusion[i]);
      if (to_first > 20 * kRadius) {
        EXPECT_GT(passes.shadow[i], 0.99);
        EXPECT_GT(passes.occlusion[i], 0.99);
      }
    } else {
      const double facing = pixel.normal().dot(lighting_of(LightPreset::kStudio).to_key());
      if (facing < -0.5) {
        EXPECT_LT(passes.shadow[i], 0.05);
      } else if (facing > 0.9) {
        EXPECT_GT(passes.shadow[i], 0.95);
      }
      if (pixel.normal().y() > 0.9) {
        EXPECT_GT(passes.occlusion[i], 0.8);
      }
    }
  }
  EXPECT_LT(darkest, 0.1) << "in the middle of a ball's shadow";
  EXPECT_LT(closest, 0.9) << "below a ball that floats above the ground";
}

TEST(Cryptomatte, HashesAsItsSpecificationSays) {
  EXPECT_EQ(murmur_hash(""), 0U);
  EXPECT_EQ(murmur_hash("hello"), 0x248bfa47U);
  EXPECT_EQ(murmur_hash("hello, world"), 0x149bbb7fU);
  EXPECT_EQ(murmur_hash("The quick brown fox jumps over the lazy dog"), 0x2e4ff723U);
  EXPECT_TRUE(std::isnormal(matte_number("")));  // whose hash is the float 0
  const std::vector<std::string> names{"ground", "a \"ball\" \\ 2", "\u00f6l"};
  const auto metadata = matte_metadata(names);
  EXPECT_EQ(names_in_manifest(metadata.back().second), names) << metadata.back().second;
}

TEST(Passes, AreTheSameInMillimetresAndKilometres) {
  const Passes small = passes_of(two_balls().scaled(1e-3), [] {
    Camera camera = camera_at(kMiddle + Vec3(0.1, 0.2, 0.4));
    camera.eye *= 1e-3;
    camera.target *= 1e-3;
    return camera;
  }());
  const Passes large = passes_of(two_balls(), camera_at(kMiddle + Vec3(0.1, 0.2, 0.4)));
  EXPECT_EQ(small.id, large.id);
  EXPECT_NEAR(1e3 * small.depth[kCentre], large.depth[kCentre], 1e-5);
}

TEST(Passes, HaveNothingWhereNothingIs) {
  StillLife scene = two_balls();
  scene.has_ground = false;
  const Passes passes = passes_of(scene, camera_at(kMiddle + Vec3(0, 0, 0.5)));
  EXPECT_EQ(passes.depth.front(), Passes::kNothing);
  EXPECT_EQ(passes.id.front(), 0);
  EXPECT_EQ(passes.normal[1].front(), 0);
  EXPECT_EQ(passes.shadow.front(), 1);
  EXPECT_EQ(passes.occlusion.front(), 1);
}

TEST(Exr, ReadsBackWhatWasWritten) {
  const TempFolder folder;
  Passes passes(5, 3);
  for (std::size_t i = 0; i < 15; ++i) {
    const auto number = float(i);
    passes.depth[i] = 0.1F * number;
    passes.id[i] = number;
    for (std::size_t k = 0; k < 4; ++k) passes.motion[k][i] = number + 7 * float(k);
    for (std::size_t k = 0; k < 4; ++k) passes.beauty[k][i] = 0.2F * number + 3 * float(k);
    passes.shadow[i] = 0.05F * number;
    passes.occlusion[i] = 0.04F * number;
    passes.matte[1][i] = float(i % 3) - 1;
    passes.coverage[1][i] = 0.25F * float(i % 3);
    for (std::size_t k = 0; k < 3; ++k) passes.uv[k][i] = 0.3F * number + float(k);
    for (std::size_t k = 0; k < 3; ++k) {
      passes.normal[k][i] = number - float(k);
      passes.position[k][i] = 1e-3F * number + float(k);
    }
  }
  passes.names = {"ground", "ball"};
  write_exr(passes, folder.path() / "p.exr");
  const Passes back = read_exr(folder.path() / "p.exr");
  EXPECT_EQ(back.width, 5);
  EXPECT_EQ(back.height, 3);
  EXPECT_EQ(back.beauty, passes.beauty);
  EXPECT_EQ(back.shadow, passes.shadow);
  EXPECT_EQ(back.occlusion, passes.occlusion);
  EXPECT_EQ(back.depth, passes.depth);
  EXPECT_EQ(back.id, passes.id);
  EXPECT_EQ(back.normal, passes.normal);
  EXPECT_EQ(back.position, passes.position);
  EXPECT_EQ(back.uv, passes.uv);
  EXPECT_EQ(back.motion, passes.motion);
  EXPECT_EQ(back.names, passes.names);
  EXPECT_EQ(back.matte, passes.matte);
  EXPECT_EQ(back.coverage, passes.coverage);
}

TEST(Exr, SaysWhatIsWrong) {
  const TempFolder folder;
  EXPECT_NE(error_message([&] { write_exr(Passes(2, 2), folder.path() / "no" / "p.exr"); }).find("p.exr"),
            std::string::npos);
  const std::filesystem::path file = folder.write("text.exr", "no picture");
  EXPECT_NE(error_message([&] { static_cast<void>(read_exr(file)); }).find("no OpenEXR file"), std::string::npos);
}

}  // namespace
}  // namespace sprung
