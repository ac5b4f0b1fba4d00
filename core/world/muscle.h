#pragma once
#include "core/law/material.h"
#include "core/types.h"
#include "core/world/loads.h"

namespace sprung {

/// What a muscle pulls with along its direction and two across it. Tensions of constant size along the brick's own
/// directions have the energy V sum_i stress_i |F e_i|. Together with the springs' they are zero in the muscle's shape.
struct MuscleTension {
  Mat3 frame;   // columns: e_i, unit, in the frame of the grid
  Vec3 stress;  // Pa
};

[[nodiscard]] MuscleTension tension_of(const Muscle& muscle, const Material& material);

}  // namespace sprung
