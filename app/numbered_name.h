#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace sprung {

/// Names of files that differ in a number.
struct NumberedName {
  std::filesystem::path folder{};
  std::string before{};  // a name is before + number + after
  std::string after{};
  int digits = 0;  // leading zeros up to that many digits; more where the number has more

  [[nodiscard]] std::filesystem::path file(int number) const;
};

/// True where the words have a place for a number.
[[nodiscard]] bool has_number(std::string_view words);

/// "folder/frame_{:04}.png", "{:04d}.obj", "{}.ply". Throws Error(kUsage) with a reason that ends in `examples`.
[[nodiscard]] NumberedName parse_numbered_name(std::string_view words, std::string_view examples);

}  // namespace sprung
