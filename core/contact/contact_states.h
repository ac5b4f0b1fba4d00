#pragma once
#include <map>
#include <memory>
#include <vector>

#include "core/contact/swept_contacts.h"

namespace sprung {

/// The contacts of each group of bodies, which live as long as the group does. Results of a frame depend on that frame
/// only, so that a motion can be resumed without them.
class ContactStates {
 public:
  /// Groups are rows of the world's bodies. Those that existed in the last frame keep their surfaces; a repeated frame
  /// also starts afresh.
  void begin_frame(World& world, const std::vector<std::vector<std::size_t>>& groups);

  /// The contacts of a group of begin_frame().
  [[nodiscard]] SweptContacts& of(const std::vector<std::size_t>& group) const { return *by_group_.at(group); }

  /// Covers the steps of all groups since begin_frame().
  [[nodiscard]] StepReport report() const;

 private:
  std::map<std::vector<std::size_t>, std::unique_ptr<SweptContacts>> by_group_;
};

}  // namespace sprung
