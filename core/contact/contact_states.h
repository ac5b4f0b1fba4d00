#pragma once
#include <map>
#include <memory>
#include <vector>

#include "core/contact/skin_contact.h"
#include "core/contact/swept_contacts.h"

namespace sprung {

/// What is kept of a group's contacts from one chunk of steps to the next.
struct GroupContacts {
  std::shared_ptr<SkinContacts> skins{};   // none: found anew in every chunk
  std::shared_ptr<SweptContacts> swept{};  // none: ContactSolver
};

/// The contacts of each group of bodies, which live as long as the group does. What is found in a frame depends on that
/// frame only, so that a motion can go on without them.
class ContactStates {
 public:
  /// Groups are rows of the world's bodies. Those that were there in the last frame keep what they have; a frame that
  /// is done again begins anew too.
  void begin_frame(World& world, const std::vector<std::vector<std::size_t>>& groups, ContactSearch search);

  /// Nothing where begin_frame() had no such group.
  [[nodiscard]] GroupContacts of(const std::vector<std::size_t>& group) const;

 private:
  std::map<std::vector<std::size_t>, GroupContacts> by_group_;
};

}  // namespace sprung
