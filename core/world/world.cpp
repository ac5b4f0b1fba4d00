#include "core/world/world.h"

namespace sprung {

Points SoftBody::skin_positions(const Points& nodes) const { return deform_points(grid, drawn.embedding, nodes); }

}  // namespace sprung
