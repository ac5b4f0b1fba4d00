#pragma once
#include <cstddef>
#include <stdexcept>
#include <string>

namespace sprung {

/// The kind of an error, as far as callers distinguish it; the value is the program's exit code.
enum class ErrorKind { kFailed = 1, kUsage = 2, kBadInput = 3, kDiverged = 4 };

/// The one exception that sprung throws at its interfaces. The message names the location, the value and what to do.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  [[nodiscard]] ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

/// The simulation of a body diverged. The world is left in its last valid state.
class Diverged : public Error {
 public:
  Diverged(std::size_t body, const std::string& message) : Error(ErrorKind::kDiverged, message), body_(body) {}
  /// In World::bodies.
  [[nodiscard]] std::size_t body() const { return body_; }

 private:
  std::size_t body_;
};

}  // namespace sprung
