#include "core/simulation/skin_pieces.h"

namespace sprung {
namespace {

class Cutter {
 public:
  Cutter(Mat3 places, const std::function<bool(const Vec3&)>& test, std::vector<SkinPiece>& pieces)
      : places_(std::move(places)), test_(test), pieces_(pieces) {}

  void add(const SkinPiece& piece, int cuts) {
    const bool middle = test_(places_ * piece.corners.rowwise().mean());
    if (cuts > 0 && is_crossed(piece, middle)) {
      const Mat3& c = piece.corners;
      Mat3 edges;  // their middles, each opposite to its corner
      edges << (c.col(1) + c.col(2)) / 2, (c.col(2) + c.col(0)) / 2, (c.col(0) + c.col(1)) / 2;
      for (int corner = 0; corner < 3; ++corner) {
        Mat3 quarter = edges;
        quarter.col(corner) = c.col(corner);
        add({piece.triangle, quarter}, cuts - 1);
      }
      add({piece.triangle, edges}, cuts - 1);
    } else if (middle) {
      pieces_.push_back(piece);
    }
  }

 private:
  [[nodiscard]] bool is_crossed(const SkinPiece& piece, bool middle) const {
    for (int corner = 0; corner < 3; ++corner) {
      if (test_(places_ * piece.corners.col(corner)) != middle) return true;
    }
    return false;
  }

  Mat3 places_;  // of the triangle's corners, m, a column each
  const std::function<bool(const Vec3&)>& test_;
  std::vector<SkinPiece>& pieces_;
};

}  // namespace

std::vector<SkinPiece> pieces_where(const Points& points, const Triangles& triangles, int cuts,
                                    const std::function<bool(const Vec3& position)>& test) {
  std::vector<SkinPiece> pieces;
  for (int row = 0; row < triangles.rows(); ++row) {
    Mat3 places;
    for (int corner = 0; corner < 3; ++corner) places.col(corner) = points.row(triangles(row, corner)).transpose();
    Cutter(places, test, pieces).add({row, Mat3::Identity()}, cuts);
  }
  return pieces;
}

}  // namespace sprung
