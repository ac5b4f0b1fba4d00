#include "app/film/field_values.h"

#include "core/body/brick_measures.h"

namespace sprung {
namespace {

Eigen::VectorXd measured(BrickMeasure measure, const Body& body, const Points& positions) {
  return node_means(body.grid, measure_bricks(body, measure, positions));
}

/// Between the frames before and after; at the ends of the film one-sided.
Eigen::VectorXd speeds(const Recording& recording, std::size_t frame, std::size_t actor, double fps) {
  const std::size_t last = recording.frames.size() - 1;
  const std::size_t from = frame > 0 ? frame - 1 : 0;
  const std::size_t to = std::min(frame + 1, last);
  const auto& frames = recording.frames;
  if (from == to) return Eigen::VectorXd::Zero(frames[frame][actor].rows());
  const Floats3 way = frames[to][actor] - frames[from][actor];
  return way.rowwise().norm().cast<double>() * (fps / double(to - from));
}

}  // namespace

Eigen::VectorXd field_values(Field field, const Production& production, const Recording& recording, std::size_t frame,
                             std::size_t actor, double fps) {
  const Body& body = production.world.actors[actor].body;
  const Points positions = recording.frames[frame][actor].cast<double>();
  switch (field) {
    case Field::kSkin:
      break;
    case Field::kDisplacement:
      return (positions - body.rest_positions).rowwise().norm();
    case Field::kSpeed:
      return speeds(recording, frame, actor, fps);
    case Field::kStretch:
      return measured(BrickMeasure::kStretch, body, positions);
    case Field::kStrain:
      return measured(BrickMeasure::kStrain, body, positions);
    case Field::kStress:
      return measured(BrickMeasure::kStress, body, positions);
    case Field::kVolume:
      return measured(BrickMeasure::kVolume, body, positions);
    case Field::kFill:
      return node_means(body.grid, Eigen::Map<const Eigen::VectorXd>(body.grid.fill.data(), body.grid.brick_count()));
    case Field::kRegion:
      return node_means(body.grid, brick_youngs(body));
  }
  return Eigen::VectorXd::Zero(positions.rows());
}

bool is_moving(Field field) { return field != Field::kSkin && field != Field::kFill && field != Field::kRegion; }

}  // namespace sprung
