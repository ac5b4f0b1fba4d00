#include "core/contact/contact_states.h"

#include "core/contact/glue.h"

namespace sprung {

void ContactStates::begin_frame(World& world, const std::vector<std::vector<std::size_t>>& groups) {
  std::map<std::vector<std::size_t>, std::unique_ptr<SweptContacts>> kept;
  for (const std::vector<std::size_t>& rows : groups) {
    Group group;
    for (const std::size_t row : rows) group.push_back(&world.bodies[row]);
    std::vector<GluedPoint> glue = glue_within(world, rows);
    const auto known = by_group_.find(rows);
    const bool is_known = known != by_group_.end() && known->second->is_of(group, world);
    kept[rows] = is_known ? std::make_unique<SweptContacts>(std::move(*known->second), world, std::move(glue))
                          : std::make_unique<SweptContacts>(group, world, std::move(glue));
  }
  by_group_ = std::move(kept);
}

StepReport ContactStates::report() const {
  StepReport sum;
  for (const auto& [rows, contacts] : by_group_) sum += contacts->report();
  return sum;
}

}  // namespace sprung
