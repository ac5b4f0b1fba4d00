#pragma once
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "core/contact/contacts.h"
#include "core/contact/narrow_phase.h"
#include "core/contact/search/contact_surface.h"

namespace sprung {

/// Finds where the skins of two bodies of a group touch each other, or where one touches itself: contact points against
/// triangles, both ways. Pairs of them are looked for every few steps only, or where a front through their trees says
/// so, and then watched in every step. Limits: edges that cross between their points are held by those points only;
/// what lies deeper in another body than 0.7 bricks is not found.
class SkinContact {
 public:
  /// Of two bodies of the group, or of one with itself.
  SkinContact(const std::vector<const ContactSurface*>& skins, const Group& group, std::size_t body, std::size_t other);

  /// Lets a front through their trees, which have to outlive it, list its pairs.
  void add_front(SurfaceTree& tree, SurfaceTree& other_tree);
  /// Brings the lists up to date with where the trees are.
  void look(const Group& group);

  /// Appends, ordered by key, the points that moving by dt would leave inside another skin, at most one near each
  /// corner of a brick and for each body that it touches: the one that is held hardest.
  void find(const World& world, double dt, const Group& group, ContactList& contacts);

 private:
  /// What a point needs that has to be held.
  struct ActiveContact {
    PointTriangleContact stance;
    std::uint64_t key = 0;
    double least_speed = 0;
    double urgency = 0;  // along the normal, that meeting its limit takes, m/s
  };

  /// Without a front: what is due of seeking and looking.
  void look_in_time(const Group& group, double gravity, double dt);
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
  [[nodiscard]] bool is_active(const World& world, double dt, const Group& group, ActiveContact& active) const;
  void add(const Group& group, const ActiveContact& active, ContactList& contacts) const;

  const std::vector<const ContactSurface*>& skins_;  // by body of the group
  std::array<std::size_t, 2> bodies_;
  ContactCandidates pairs_;
  double brick_;  // m, of the finer of the two
  std::optional<FacingLists> facing_;
  std::optional<ContactFront> front_;
  std::vector<SkinRun> runs_;
  std::vector<ActiveContact> active_;  // of this step
  /// By body, point of its skin and other body: whether it is inside; of what was deep in the last step, and in this.
  std::map<std::tuple<std::size_t, int, std::size_t>, bool> insides_before_;
  std::map<std::tuple<std::size_t, int, std::size_t>, bool> insides_;
  int steps_to_seek_ = 0;
  int steps_to_update_ = 0;
};

/// How pairs of points and triangles are sought. Fronts miss none that is near (see ContactFront), and are faster where
/// bodies lie on each other, slower where they roll: an experiment.
enum class ContactSearch { kInTime, kFronts };

/// Where the skins of a group's bodies touch each other and themselves: looks after which bodies are near each other,
/// each pair of them at its own pace.
class SkinContacts {
 public:
  /// The bodies have to outlive it.
  SkinContacts(const Group& group, ContactSearch search);
  SkinContacts(const SkinContacts&) = delete;
  SkinContacts& operator=(const SkinContacts&) = delete;

  /// Whether it was made for these bodies, as they are.
  [[nodiscard]] bool is_of(const Group& group) const;

  /// What it finds from now on does not depend on what came before.
  void begin_frame();

  /// Appends what SkinContact finds, ordered by pair, itself by key.
  void find(const World& world, double dt, const Group& group, ContactList& contacts);

 private:
  /// Brings all lists up to date, for as many steps as speeds allow.
  void look(const std::vector<SkinContact*>& contacts, double gravity, double dt);
  /// Bodies that may come to touch before the next time.
  void seek(const World& world, const Group& group, double dt);

  Group group_;
  std::vector<const ContactSurface*> skins_;                             // by body of the group
  std::vector<std::unique_ptr<SurfaceTree>> trees_;                      // likewise; none without fronts
  std::map<std::pair<std::size_t, std::size_t>, SkinContact> contacts_;  // bodies of the group; twice the same: itself
  std::vector<ContactList> found_;                                       // by pair
  int steps_to_seek_ = 0;
  int steps_to_look_ = 0;
};

}  // namespace sprung
