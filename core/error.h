#pragma once
#include <cstddef>
#include <stdexcept>
#include <string>

namespace sprung {

/// What went wrong, as far as the caller has to tell; the value is the exit code of the program.
enum class ErrorKind { kFailed = 1, kUsage = 2, kBadInput = 3, kDiverged = 4 };

/// The one exception that sprung throws at its borders. The message names the place, the value and what to do.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  [[nodiscard]] ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

/// The motion of an actor came to no good end. The world stands where it was right for the last time.
class Diverged : public Error {
 public:
  Diverged(std::size_t actor, const std::string& message) : Error(ErrorKind::kDiverged, message), actor_(actor) {}
  /// In World::bodies.
  [[nodiscard]] std::size_t actor() const { return actor_; }

 private:
  std::size_t actor_;
};

}  // namespace sprung
