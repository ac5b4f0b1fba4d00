#pragma once
#include <map>
#include <memory>
#include <vector>

#include "core/contact/skin_contact.h"
#include "core/contact/swept_contacts.h"

namespace sprung {

/// Contact data of a group kept from one chunk of steps to the next.
struct GroupContacts {
  std::shared_ptr<SkinContacts> skins{};   // none: found anew in every chunk
  std::shared_ptr<SweptContacts> swept{};  // none: ContactSolver
};

/// The contacts of each group of bodies, which live as long as the group does. Results of a frame depend on that frame
/// only, so that a motion can be resumed without them.
class ContactStates {
 public:
  /// Groups are rows of the world's bodies. Those that existed in the last frame keep their contacts; a repeated frame
  /// also starts afresh.
  void begin_frame(World& world, const std::vector<std::vector<std::size_t>>& groups, ContactSearch search);

  /// Empty if begin_frame() had no such group.
  [[nodiscard]] GroupContacts of(const std::vector<std::size_t>& group) const;

  /// Of all groups since begin_frame().
  [[nodiscard]] GuardCounts guard_counts() const;

 private:
  std::map<std::vector<std::size_t>, GroupContacts> by_group_;
};

}  // namespace sprung
