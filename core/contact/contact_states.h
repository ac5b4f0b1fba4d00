#pragma once
#include <map>
#include <memory>
#include <vector>

#include "core/contact/skin_contact.h"

namespace sprung {

/// The search for contacts between skins in each group of bodies, which lives as long as the group does. What contacts
/// it finds in a frame depends on that frame only, so that a motion can go on without it.
class ContactStates {
 public:
  /// Groups are rows of the world's bodies. Those that were there in the last frame keep what they have; a frame that
  /// is done again begins anew too.
  void begin_frame(World& world, const std::vector<std::vector<std::size_t>>& groups);

  /// Null where begin_frame() had no such group.
  [[nodiscard]] std::shared_ptr<SkinContacts> of(const std::vector<std::size_t>& group) const;

 private:
  std::map<std::vector<std::size_t>, std::shared_ptr<SkinContacts>> by_group_;
};

}  // namespace sprung
