#pragma once
#include <fmt/format.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace sprung {

/// "1 triangle", "2 triangles"; `things` if the plural is not the thing with an s.
[[nodiscard]] inline std::string count_of(long count, std::string_view thing, std::string_view things = "") {
  if (count == 1) return fmt::format("1 {}", thing);
  if (things.empty()) return fmt::format("{} {}s", count, thing);
  return fmt::format("{} {}", count, things);
}

/// The known word closest to a mistyped one by edit distance, or empty if none is close.
[[nodiscard]] std::string_view nearest_word(std::string_view word, std::span<const std::string_view> known);

/// "; did you mean 'rubber'?" if a known word is close, else "; known are: a, b, c".
[[nodiscard]] std::string did_you_mean(std::string_view word, std::span<const std::string_view> known);

/// Base64 (RFC 4648, padded).
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

/// In single quotes, for any shell.
[[nodiscard]] std::string shell_quoted(std::string_view text);

/// The same, but unquoted if no character of the text is special to a shell.
[[nodiscard]] std::string shell_word(std::string_view text);

}  // namespace sprung
