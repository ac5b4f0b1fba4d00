#pragma once
#include <cstddef>
#include <string>

#include "core/error.h"

namespace sprung {

/// The motion of an actor came to no good end. The world stands where it was right for the last time.
class Diverged : public Error {
 public:
  Diverged(std::size_t actor, const std::string& message) : Error(ErrorKind::kDiverged, message), actor_(actor) {}
  /// In World::actors.
  [[nodiscard]] std::size_t actor() const { return actor_; }

 private:
  std::size_t actor_;
};

}  // namespace sprung
