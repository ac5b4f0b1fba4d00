#include "core/contact/contact_states.h"

namespace sprung {

void ContactStates::begin_frame(World& world, const std::vector<std::vector<std::size_t>>& groups) {
  std::map<std::vector<std::size_t>, std::shared_ptr<SkinContacts>> kept;
  for (const std::vector<std::size_t>& rows : groups) {
    Group group;
    for (const std::size_t row : rows) group.push_back(&world.bodies[row]);
    const auto known = by_group_.find(rows);
    std::shared_ptr<SkinContacts>& contacts = kept[rows];
    if (known != by_group_.end() && known->second->is_of(group)) {
      contacts = known->second;
      contacts->begin_frame();
    } else {
      contacts = std::make_shared<SkinContacts>(group, ContactSearch::kFronts);
    }
  }
  by_group_ = std::move(kept);
}

std::shared_ptr<SkinContacts> ContactStates::of(const std::vector<std::size_t>& group) const {
  const auto known = by_group_.find(group);
  return known == by_group_.end() ? nullptr : known->second;
}

}  // namespace sprung
