#pragma once
#include <filesystem>

namespace sprung {

/// What `sprung compare` was asked to do.
struct CompareOptions {
  std::filesystem::path first;
  std::filesystem::path second;
  std::filesystem::path difference;  // empty: none is written
  double mean = 0.4;                 // levels of 255 that the pictures may differ by on average ...
  double worst_block = 6;            // ... and in the worst 8 x 8 block
  bool overwrite = false;
};

/// Prints how two pictures differ, and writes a picture of it where one is wanted; whether they are near enough. Those
/// of different size never are. Throws Error(kBadInput), Error(kUsage), Error(kFailed).
[[nodiscard]] bool compare(const CompareOptions& options);

}  // namespace sprung
