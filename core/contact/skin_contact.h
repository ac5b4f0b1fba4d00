#pragma once
#include <array>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "core/contact/contact_surface.h"
#include "core/contact/contacts.h"
#include "core/contact/narrow_phase.h"

namespace sprung {

/// Finds where the skins of two bodies of a group touch each other, or where one touches itself: contact points against
/// triangles, both ways. Pairs of them (skin_pairs.h) are looked for every few steps only, and then watched in every
/// step. Limits: edges that cross between their points are held by those points only; what lies deeper in another body
/// than 0.7 bricks is not found.
class SkinContact {
 public:
  /// Of two bodies of the group, or of one with itself.
  SkinContact(const std::vector<const ContactSurface*>& skins, std::size_t actor, std::size_t other)
      : skins_(skins), actors_{actor, other}, pairs_(skins, actor, other) {}

  /// Appends, ordered by key, the points that moving by dt would leave inside another skin, at most one near each
  /// corner of a brick and for each body that it touches: the one that is held hardest.
  void find(const World& world, double dt, const Group& group, ContactList& touches);

 private:
  /// What a point needs that has to be held.
  struct Held {
    PointTriangleContact stance;
    std::uint64_t key = 0;
    double least_speed = 0;
    double pull = 0;  // along the normal, that meeting its limit takes, m/s
  };

  /// What is due of seeking and looking.
  void look(const Group& group, double gravity, double dt);
  /// Of what stands near the same corner of the same brick, that which is held hardest.
  void keep_hardest();
  /// Whether the point of a stance that is deep is inside the surface of the other body, of its own where it is the
  /// same. It stays so for as long as it is deep.
  [[nodiscard]] bool is_inside(const Group& group, const PointTriangleContact& stance);
  /// By the winding number of the whole surface.
  [[nodiscard]] bool find_inside(const Group& group, const PointTriangleContact& stance) const;
  /// Least of both sides: volume of a brick over that at rest.
  [[nodiscard]] double room_of(const Group& group, const CandidatePair& pair) const;
  /// Whether moving by dt would leave it inside; then what it needs.
  [[nodiscard]] bool has_to_be_held(const World& world, double dt, const Group& group, Held& held) const;
  void add(const Group& group, const Held& held, ContactList& touches) const;

  const std::vector<const ContactSurface*>& skins_;  // by actor of the group
  std::array<std::size_t, 2> actors_;
  ContactCandidates pairs_;
  double depth_ = 0;  // m, below which what is inside came from the other side
  std::vector<SkinRun> runs_;
  std::vector<Held> held_;  // of this step
  /// By actor, point of its skin and other actor: whether it is inside; of what was deep in the last step, and in this.
  std::map<std::tuple<std::size_t, int, std::size_t>, bool> insides_before_;
  std::map<std::tuple<std::size_t, int, std::size_t>, bool> insides_;
  int steps_to_seek_ = 0;
  int steps_to_update_ = 0;
};

/// Where the skins of a group's bodies touch each other and themselves: looks after which bodies are near each other,
/// each pair of them at its own pace.
class SkinContacts {
 public:
  /// By actor of the group; the list has to outlive it.
  explicit SkinContacts(const std::vector<const ContactSurface*>& skins) : skins_(skins) {}

  /// Appends what SkinContact finds, ordered by pair, itself by key.
  void find(const World& world, double dt, const Group& group, ContactList& touches);

 private:
  /// Bodies that may come to touch before the next time.
  void seek(const World& world, const Group& group, double dt);

  const std::vector<const ContactSurface*>& skins_;
  std::map<std::pair<std::size_t, std::size_t>, SkinContact> contacts_;  // bodies of the group; twice the same: itself
  std::vector<ContactList> found_;                                       // by pair
  int steps_to_seek_ = 0;
};

}  // namespace sprung
