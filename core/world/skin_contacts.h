#pragma once
#include <map>
#include <utility>
#include <vector>

#include "core/world/skin_contact.h"

namespace sprung {

/// Where the skins of a group's bodies touch each other and themselves: looks after which bodies are near each other,
/// each pair of them at its own pace.
class SkinContacts {
 public:
  /// By actor of the group; the list has to outlive it.
  explicit SkinContacts(const std::vector<const ContactSkin*>& skins) : skins_(skins) {}

  /// Appends what SkinContact finds, ordered by pair, itself by key.
  void find(const World& world, double dt, const Group& group, Touches& touches);

 private:
  /// Bodies that may come to touch before the next time.
  void seek(const World& world, const Group& group, double dt);

  const std::vector<const ContactSkin*>& skins_;
  std::map<std::pair<std::size_t, std::size_t>, SkinContact> contacts_;  // actors of the group; twice the same: itself
  std::vector<Touches> found_;                                           // by pair
  int steps_to_seek_ = 0;
};

}  // namespace sprung
