#pragma once
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "core/contact/contacts.h"
#include "core/contact/countdown.h"
#include "core/contact/narrow_phase.h"
#include "core/contact/search/contact_surface.h"

namespace sprung {

/// Finds contacts between the skins of two bodies of a group, or of one with itself: contact points against triangles,
/// both ways. Pairs are searched for every few steps only, or when a front through their trees requires it, and then
/// checked in every step. Limits: edges that cross between their points are resisted by those points only; what lies
/// deeper in another body than 0.7 bricks is not found.
class SkinContact {
 public:
  /// For two bodies of the group, or of one with itself.
  SkinContact(const std::vector<const ContactSurface*>& skins, const Group& group, std::size_t body, std::size_t other);

  /// Takes its pairs from a front through their trees, which must outlive it.
  void add_front(SurfaceTree& tree, SurfaceTree& other_tree);
  /// Updates the lists to the current state of the trees.
  void look(const Group& group);

  /// Appends, ordered by key, the points that would be inside another skin after a step of dt, at most one near each
  /// corner of a brick and for each body that it touches: the one with the largest `pull`.
  void find(const World& world, double dt, const Group& group, ContactList& contacts);

 private:
  /// The data of a point that must be supported.
  struct ActiveContact {
    PointTriangleContact stance;
    std::uint64_t key = 0;
    double min_speed = 0;
    double urgency = 0;  // along the normal, to satisfy its constraint, m/s
  };

  /// Without a front: updates the candidates when due.
  void look_in_time(const Group& group, double gravity, double dt);
  /// Of the points near the same corner of the same brick, keeps the one with the largest `pull`.
  void keep_largest_correction();
  /// Whether a deep point is inside the surface of the other body, or of its own for self-contact. It stays so for as
  /// long as it is deep.
  [[nodiscard]] bool is_inside(const Group& group, const PointTriangleContact& stance);
  /// By the winding number of the whole surface.
  [[nodiscard]] bool find_inside(const Group& group, const PointTriangleContact& stance) const;
  /// The smaller of both sides' ratios of a brick's volume to that at rest.
  [[nodiscard]] double volume_ratio_of(const Group& group, const CandidatePair& pair) const;
  /// Whether it would be inside after a step of dt; then fills in its data.
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
  /// By body, point of its skin and other body: whether it is inside; of points that were deep in the last step, and in
  /// this one.
  std::map<std::tuple<std::size_t, int, std::size_t>, bool> insides_before_;
  std::map<std::tuple<std::size_t, int, std::size_t>, bool> insides_;
  Countdown to_seek_;
  Countdown to_update_;
};

/// How pairs of points and triangles are found. Fronts miss none that is near (see ContactFront), and are faster for
/// bodies at rest on each other, slower for rolling ones: an experiment.
enum class ContactSearch { kInTime, kFronts };

/// Finds the contacts of the skins of a group's bodies with each other and themselves: tracks which bodies are near
/// each other, each pair of them at its own rate.
class SkinContacts {
 public:
  /// The bodies must outlive it.
  SkinContacts(const Group& group, ContactSearch search);
  SkinContacts(const SkinContacts&) = delete;
  SkinContacts& operator=(const SkinContacts&) = delete;

  /// Whether it was made for these bodies, as they are.
  [[nodiscard]] bool is_of(const Group& group) const;

  /// Makes further results independent of earlier ones.
  void begin_frame();

  /// Appends the results of SkinContact, ordered by pair, then by key.
  void find(const World& world, double dt, const Group& group, ContactList& contacts);

 private:
  /// Updates all lists, for as many steps as speeds allow.
  void look(const std::vector<SkinContact*>& contacts, double gravity, double dt);
  /// Finds the bodies that may come into contact before the next time.
  void seek(const World& world, const Group& group, double dt);

  Group group_;
  std::vector<const ContactSurface*> skins_;                             // by body of the group
  std::vector<std::unique_ptr<SurfaceTree>> trees_;                      // likewise; none without fronts
  std::map<std::pair<std::size_t, std::size_t>, SkinContact> contacts_;  // bodies of the group; twice the same: itself
  std::vector<ContactList> found_;                                       // by pair
  Countdown to_seek_;
  Countdown to_look_;
};

}  // namespace sprung
