#include "app/film/film_cameras.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/film/film_stage.h"
#include "core/bricks/brick_topology.h"

namespace sprung {
namespace {

constexpr double kNear = 0.25;  // of the motion's size: parts of obstacles further away may be out of view
constexpr double kSway = 0.12;  // of the size: how far a body that falls upright is expected to move sideways ...
constexpr double kRise = 0.02;  // ... and to rise
constexpr int kStops = 16;      // along the camera's path, from which everything has to be in view

/// Rows: directions to the faces, edges and corners of a cube.
Eigen::Matrix<double, 26, 3> directions() {
  Eigen::Matrix<int, 26, 3> rows;
  int row = 0;
  for (int i = 0; i < 27; ++i) {
    if (i == 13) continue;
    rows.row(row++) << i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1;
  }
  return rows.cast<double>();
}

Points corners_of(const AlignedBox& bounds) {
  Points corners(8, 3);
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      corners(corner, axis) = on_high_side(corner, axis) ? bounds.max()[axis] : bounds.min()[axis];
    }
  }
  return corners;
}

/// The parts of obstacles that are near the bodies.
void add_obstacles(const Simulation& simulation, const Recording& recording, Reach& reach) {
  const double near = kNear * reach.bounds.sizes().maxCoeff();
  const Vec3 low = reach.bounds.min().array() - near;
  const Vec3 high = reach.bounds.max().array() + near;
  AlignedBox seen = reach.bounds;
  for (const StageObstacle& obstacle : simulation.obstacles) {
    if (obstacle.skin.positions.rows() == 0) continue;
    for (const double time : recording.progress) {
      const Points skin = skin_positions(obstacle, time);
      const Vec3 from = skin.colwise().minCoeff().transpose().cwiseMax(low);
      const Vec3 to = skin.colwise().maxCoeff().transpose().cwiseMin(high);
      if ((from.array() > to.array()).any()) continue;
      seen.extend(AlignedBox(from, to));
      if (obstacle.movement.is_still()) break;
    }
  }
  if (seen.min() == reach.bounds.min() && seen.max() == reach.bounds.max()) return;
  reach.bounds = seen;
  reach.around = corners_of(seen);
}

Points stacked(const std::vector<Points>& parts) {
  Eigen::Index rows = 0;
  for (const Points& part : parts) rows += part.rows();
  Points all(rows, 3);
  rows = 0;
  for (const Points& part : parts) {
    all.middleRows(rows, part.rows()) = part;
    rows += part.rows();
  }
  return all;
}

/// Adds the projections of the points onto the ground, if any.
Points with_ground(const Points& points, const std::optional<double>& ground) {
  if (!ground) return points;
  Points below = points;
  below.col(1).setConstant(*ground);
  return stacked({points, below});
}

Points flipped(const Points& points, const Vec3& center, double degrees) {
  const Mat3 turn = Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Vec3::UnitY()).toRotationMatrix();
  return ((points.rowwise() - center.transpose()) * turn.transpose()).rowwise() + center.transpose();
}

/// All points that have to be in view, relative to the followed centroid if the camera follows.
Points points_to_see(const Film& film, const Reach& reach, const Vec3& center) {
  if (!film.camera.follow) return with_ground(stacked({stacked(reach.bodies), reach.around}), reach.ground);
  std::vector<Points> parts;
  for (std::size_t frame = 0; frame < reach.bodies.size(); ++frame) {
    parts.push_back(reach.bodies[frame].rowwise() + (center - reach.middles[frame]).transpose());
  }
  return stacked(parts);
}

/// Interpolates between two keyframes, at rest at both.
CameraKeyframe placed(const std::vector<CameraKeyframe>& keyframes, double time) {
  const auto later = std::find_if(keyframes.begin(), keyframes.end(),
                                  [&](const CameraKeyframe& keyframe) { return keyframe.time >= time; });
  if (later == keyframes.begin()) return keyframes.front();
  if (later == keyframes.end()) return keyframes.back();
  const CameraKeyframe& from = *(later - 1);
  const double way = (time - from.time) / (later->time - from.time);
  const double share = way * way * (3 - 2 * way);
  return {.time = time,
          .azimuth = std::lerp(from.azimuth, later->azimuth, share),
          .elevation = std::lerp(from.elevation, later->elevation, share),
          .zoom = from.zoom * std::pow(later->zoom / from.zoom, share)};
}

void zoom_in(Camera& camera, double zoom) { camera.eye = camera.target + (camera.eye - camera.target) / zoom; }

/// The fraction of the picture's height that the points take.
double height_in_picture(const Camera& camera, const Points& points) {
  const Vec3 ahead = camera.target - camera.eye;
  const Vec3 forward = ahead.normalized();
  const Vec3 up = (camera.up - camera.up.dot(forward) * forward).normalized();
  const Points from_eye = points.rowwise() - camera.eye.transpose();
  const Eigen::ArrayXd height = from_eye * up;
  const Eigen::ArrayXd depth =
      camera.orthographic ? Eigen::ArrayXd::Constant(points.rows(), ahead.norm()) : Eigen::ArrayXd(from_eye * forward);
  const Eigen::ArrayXd place = height / depth;
  const double half = std::tan(camera.vertical_field_of_view * std::numbers::pi / 360);
  return (place.maxCoeff() - place.minCoeff()) / (2 * half);
}

/// Moves the camera away until the points take at most that fraction of the picture's height.
void step_back(Camera& camera, const Points& points, double most) {
  constexpr int kIterations = 12;  // perspective: the height does not fall quite as the distance grows
  if (height_in_picture(camera, points) <= most) return;
  for (int i = 0; i < kIterations; ++i) zoom_in(camera, most / height_in_picture(camera, points));
}

}  // namespace

Reach reach_of(const Simulation& simulation, const Recording& recording) {
  const Eigen::Matrix<double, 26, 3> ways = directions();
  Reach reach;
  for (const std::vector<Floats3>& frame : recording.frames) {
    Points& furthest = reach.bodies.emplace_back(26 * frame.size(), 3);
    Vec3 sum = Vec3::Zero();
    Eigen::Index nodes = 0;
    Eigen::Index next = 0;
    for (std::size_t body = 0; body < frame.size(); ++body) {
      const Points skin = simulation.world.bodies[body].skin_positions(frame[body].cast<double>());
      reach.bounds.extend(bounding_box(skin));
      sum += frame[body].cast<double>().colwise().sum().transpose();
      nodes += frame[body].rows();
      for (int way = 0; way < 26; ++way) {
        Eigen::Index row = 0;
        (skin * ways.row(way).transpose()).maxCoeff(&row);
        furthest.row(next++) = skin.row(row);
      }
    }
    reach.middles.emplace_back(sum / double(std::max<Eigen::Index>(nodes, 1)));
  }
  reach.lowest = reach.bounds.min().y();
  add_obstacles(simulation, recording, reach);
  reach.ground = ground_height(simulation.world.obstacles);
  return reach;
}

namespace {

/// Whether the bodies fall onto the ground from rest and nothing else moves them.
bool is_plain_fall(const Film& film) {
  const auto is_left_alone = [](const SceneBody& body) {
    return body.velocity.isZero() && body.spin.isZero() && body.pins.empty() && body.forces.empty() &&
           body.muscles.empty();
  };
  return is_motion(film) && film.gravity_keyframes.empty() && film.gravity.x() == 0 && film.gravity.z() == 0 &&
         film.gravity.y() < 0 && !film.wind && film.obstacles.size() == 1 &&
         std::all_of(film.bodies.begin(), film.bodies.end(), is_left_alone);
}

bool stands_still(const SceneCamera& camera) {
  return camera.body_height && camera.orbit == 0 && !camera.follow && camera.keyframes.empty();
}

}  // namespace

std::optional<Reach> foreseen_reach(const Film& film, const Simulation& simulation, const Recording& recording) {
  const std::optional<double> ground = ground_height(simulation.world.obstacles);
  if (!ground || !is_plain_fall(film) || !stands_still(film.camera)) return std::nullopt;
  Recording start;
  start.frames.push_back(recording.frames.front());
  start.progress.push_back(recording.progress.front());
  Reach reach = reach_of(simulation, start);
  const double size = reach.bounds.sizes().maxCoeff();
  const Vec3 room(kSway * size, kRise * size, kSway * size);
  Points landed = reach.bodies.front();
  landed.col(1).array() -= reach.bounds.min().y() - *ground;
  Vec3 low = reach.bounds.min() - room;
  low.y() = std::min(low.y(), *ground);
  reach.bounds = AlignedBox(low, reach.bounds.max() + room);
  reach.around = corners_of(reach.bounds);
  reach.bodies.assign(recording.progress.size(), landed);
  reach.middles.assign(recording.progress.size(), reach.middles.front());
  return reach;
}

bool is_foreseen(const Reach& foreseen, const AlignedBox& bounds) {
  return (bounds.min().x() >= foreseen.bounds.min().x()) && (bounds.min().z() >= foreseen.bounds.min().z()) &&
         (bounds.max().array() <= foreseen.bounds.max().array()).all();
}

Reach joined(const std::vector<Reach>& runs) {
  if (runs.size() == 1) return runs.front();
  Reach all = runs.front();
  std::size_t frames = 0;
  for (const Reach& run : runs) {
    frames = std::max(frames, run.bodies.size());
    all.bounds.extend(run.bounds);
    all.lowest = std::min(all.lowest, run.lowest);
    if (!all.ground) all.ground = run.ground;
    if (&run != &runs.front()) all.around = stacked({all.around, run.around});
  }
  all.bodies.resize(frames);
  all.middles.assign(frames, Vec3::Zero());
  for (std::size_t frame = 0; frame < frames; ++frame) {
    std::vector<Points> parts;
    for (const Reach& run : runs) {
      const std::size_t at = std::min(frame, run.bodies.size() - 1);
      parts.push_back(run.bodies[at]);
      all.middles[frame] += run.middles[at] / double(runs.size());
    }
    all.bodies[frame] = stacked(parts);
  }
  return all;
}

std::vector<Camera> cameras_of(const Film& film, const Reach& reach, double reserved) {
  const SceneCamera& chosen = film.camera;
  const std::size_t frames = reach.bodies.size();
  const Vec3 center = reach.bounds.center();
  const Points seen = points_to_see(film, reach, center);
  const double aspect = (1 - reserved) * film.render.resolution[0] / film.render.resolution[1];
  std::vector<Points> stops;
  const int count = chosen.orbit == 0 ? 1 : kStops;
  stops.reserve(count);
  for (int stop = 0; stop < count; ++stop)
    stops.push_back(flipped(seen, center, -chosen.orbit * stop / std::max(1, count - 1)));
  const Points at_end = chosen.follow
                            ? Points(reach.bodies.back().rowwise() + (center - reach.middles.back()).transpose())
                            : reach.bodies.back();
  const auto framed = [&](const Points& points, double azimuth, double elevation) {
    Camera camera = frame_points(points, aspect, azimuth, elevation, chosen.orthographic);
    if (chosen.body_height) step_back(camera, at_end, *chosen.body_height);
    return camera;
  };
  const Camera first = framed(stacked(stops), chosen.azimuth, chosen.elevation);
  std::vector<Camera> cameras;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const double way = frames > 1 ? double(frame) / double(frames - 1) : 0;
    Camera camera = carried_around(first, center, way * chosen.orbit);
    double zoom = chosen.zoom;
    if (!chosen.keyframes.empty()) {
      const CameraKeyframe at = placed(chosen.keyframes, time_of(film, int(frame)));
      camera = framed(seen, at.azimuth, at.elevation);
      zoom = at.zoom;
    }
    zoom_in(camera, zoom);
    const Vec3 follow = chosen.follow ? Vec3(reach.middles[frame] - center) : Vec3::Zero();
    camera.eye += follow;
    camera.target += follow;
    camera.shift = -reserved;
    cameras.push_back(camera);
  }
  return cameras;
}

double pixels_per_metre(const Camera& camera, int height) {
  const double half = std::tan(camera.vertical_field_of_view * std::numbers::pi / 360);
  return height / (2 * half * (camera.eye - camera.target).norm());
}

}  // namespace sprung
