#include <gtest/gtest.h>

#include <cstring>
#include <numbers>

#include "core/io/animation.h"
#include "core/io/glb_buffer.h"
#include "tests/support/temp_folder.h"

namespace sprung {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// A ball of 400 points with their normals, that is translated, stretched and rotated about z, by that angle in all.
AnimatedMesh turning_ball(const Skin& ball, double degrees) {
  AnimatedMesh film{.first = {.name = "ball", .rest = &ball, .positions = ball.positions, .normals = ball.normals},
                    .positions = {},
                    .normals = {}};
  for (int frame = 0; frame <= 4; ++frame) {
    const double share = frame / 4.0;
    const Mat3 turn = Eigen::AngleAxisd(share * degrees * kDegree, Vec3::UnitZ()).toRotationMatrix();
    const Vec3 stretch(1 + share, 1, 1);
    const Points moved = (ball.positions * stretch.asDiagonal() * turn.transpose()).array() + share * 0.7;
    const Points normals = ball.normals * stretch.cwiseInverse().asDiagonal() * turn.transpose();
    film.positions.emplace_back(moved.cast<float>());
    film.normals.emplace_back(normals.rowwise().normalized().cast<float>());
  }
  return film;
}

Skin ball_of_points() {
  Skin ball;
  ball.normals = Points::Random(400, 3).rowwise().normalized();
  ball.normals.topRows(6) << Mat3::Identity(), -Mat3::Identity();
  ball.positions = 0.3 * ball.normals;
  ball.triangles = Triangles{{0, 1, 2}};
  return ball;
}

/// The animation as viewers decode it: rows of its buffer, later ones added to the first.
class DecodedAnimation {
 public:
  explicit DecodedAnimation(const AnimatedMesh& film) : vertices_(add_quantized(buffer_, film)) {
    buffer_.describe(document_);
    count_ = film.first.positions.rows();
    for (int axis = 0; axis < 3; ++axis) origin_[axis] = vertices_.transform["translation"][axis].get<float>();
    scale_ = vertices_.transform["scale"][0].get<float>();
  }
  [[nodiscard]] double error() const { return vertices_.error; }
  [[nodiscard]] Floats3 positions(std::size_t frame) const {
    return (scale_ * sum(vertices_.positions, frame)).rowwise() + origin_;
  }
  [[nodiscard]] Floats3 normals(std::size_t frame) const {
    return sum(vertices_.normals, frame).rowwise().normalized();
  }
  [[nodiscard]] bool has_float_normals(std::size_t frame) const {
    return accessor(vertices_.normals[frame])["componentType"] == 5126;
  }

 private:
  [[nodiscard]] Floats3 sum(const std::vector<int>& accessors, std::size_t frame) const {
    return frame == 0 ? rows(accessors[0]) : rows(accessors[0]) + rows(accessors[frame]);
  }
  [[nodiscard]] const GltfJson& accessor(int row) const { return document_["accessors"][row]; }
  template <class Value>
  [[nodiscard]] Floats3 rows_of(int row, Eigen::Index columns, float unit) const {
    using Rows = Eigen::Matrix<Value, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Rows rows(count_, columns);
    const auto size = std::size_t(rows.size()) * sizeof(Value);
    const GltfJson& view = document_["bufferViews"][accessor(row)["bufferView"].get<int>()];
    EXPECT_EQ(view["byteLength"], size);
    std::memcpy(rows.data(), &buffer_.bytes()[view["byteOffset"].get<std::size_t>()], size);
    return unit * rows.leftCols(3).template cast<float>();
  }
  [[nodiscard]] Floats3 rows(int row) const {
    switch (accessor(row)["componentType"].get<int>()) {
      case 5120:
        return rows_of<std::int8_t>(row, 4, 1 / 127.0F);
      case 5122:
        return rows_of<std::int16_t>(row, 4, 1);
      default:
        return rows_of<float>(row, 3, 1);
    }
  }

  GlbBuffer buffer_;
  GlbVertices vertices_;
  GltfJson document_;
  Eigen::Index count_ = 0;
  Eigen::RowVector3f origin_;
  float scale_ = 0;
};

double largest_angle(const Floats3& a, const Floats3& b) {
  const Eigen::VectorXf half = 0.5F * (a - b).rowwise().norm();
  return 2 * std::asin(std::min(1.0F, half.maxCoeff()));
}

TEST(QuantizedGlb, KeepsPositionsWithinItsErrorAndNormalsWithinADegreeOrTwo) {
  const Skin ball = ball_of_points();
  for (const double degrees : {20.0, 180.0}) {
    SCOPED_TRACE(degrees);
    const AnimatedMesh film = turning_ball(ball, degrees);
    const DecodedAnimation player(film);
    double way = 0.3;
    double error = 0;
    int float_frames = 0;
    for (std::size_t frame = 0; frame < film.positions.size(); ++frame) {
      way = std::max<double>(way, (film.positions[frame] - film.positions[0]).cwiseAbs().maxCoeff());
      error = std::max<double>(error, (player.positions(frame) - film.positions[frame]).cwiseAbs().maxCoeff());
      EXPECT_LT(largest_angle(player.normals(frame), film.normals[frame]), 1.6 * kDegree) << frame;
      float_frames += player.has_float_normals(frame) ? 1 : 0;
    }
    EXPECT_NEAR(player.error(), way / 65534, 0.01 * way / 65534);
    EXPECT_LE(error, 1.02 * player.error()) << "2 % for the rounding of floats";
    EXPECT_GT(error, 0.9 * player.error()) << "the error that is named is the one that there is";
    EXPECT_EQ(float_frames > 0, degrees > 90) << float_frames;
  }
}

TEST(QuantizedGlb, HasHalfTheSize) {
  const TempFolder folder;
  const Skin ball = ball_of_points();
  const AnimatedMesh film = turning_ball(ball, 20);
  const auto size_of = [&](GlbPrecision numbers) {
    const double error = write_animated_glb({film}, {0, 1, 2, 3, 4}, folder.path() / "film.glb", numbers);
    EXPECT_EQ(error > 0, numbers == GlbPrecision::kQuantized);
    return double(std::filesystem::file_size(folder.path() / "film.glb"));
  };
  EXPECT_LT(size_of(GlbPrecision::kQuantized), 0.6 * size_of(GlbPrecision::kFloat));
}

}  // namespace
}  // namespace sprung
