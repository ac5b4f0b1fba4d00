#include "core/contact/contact_states.h"

#include "core/contact/glue.h"

namespace sprung {

void ContactStates::begin_frame(World& world, const std::vector<std::vector<std::size_t>>& groups,
                                ContactSearch search) {
  std::map<std::vector<std::size_t>, GroupContacts> kept;
  for (const std::vector<std::size_t>& rows : groups) {
    Group group;
    for (const std::size_t row : rows) group.push_back(&world.bodies[row]);
    GroupContacts& contacts = kept[rows];
    const auto known = by_group_.find(rows);
    if (world.guards_crossings) {
      const bool is_known = known != by_group_.end() && known->second.swept && known->second.swept->is_of(group, world);
      std::vector<GluedPoint> glue = glue_within(world, rows);
      contacts.swept = is_known
                           ? std::make_shared<SweptContacts>(std::move(*known->second.swept), world, std::move(glue))
                           : std::make_shared<SweptContacts>(group, world, std::move(glue));
    }
    if (search == ContactSearch::kInTime) continue;
    if (known != by_group_.end() && known->second.skins && known->second.skins->is_of(group)) {
      contacts.skins = known->second.skins;
      contacts.skins->begin_frame();
    } else {
      contacts.skins = std::make_shared<SkinContacts>(group, search);
    }
  }
  by_group_ = std::move(kept);
}

GroupContacts ContactStates::of(const std::vector<std::size_t>& group) const {
  const auto known = by_group_.find(group);
  return known == by_group_.end() ? GroupContacts{} : known->second;
}

GuardCounts ContactStates::guard_counts() const {
  GuardCounts sum;
  for (const auto& [rows, contacts] : by_group_) {
    if (contacts.swept) sum += contacts.swept->guard_counts();
  }
  return sum;
}

}  // namespace sprung
