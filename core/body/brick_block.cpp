#include "core/body/brick_block.h"

#include "core/body/body.h"

namespace sprung {

BlockInput block_input(const Body& body) {
  return {.law = &body.law,
          .brick_size = body.grid.brick_size,
          .brick_count = body.grid.brick_count(),
          .nodes = body.grid.nodes.data(),
          .stiffness_scale = body.stiffness_scale.data(),
          .positions = body.positions.data()};
}

}  // namespace sprung
