#pragma once
#include <span>
#include <string>
#include <string_view>

namespace sprung {

/// The known word closest to a mistyped one by edit distance, or empty where none is close.
[[nodiscard]] std::string_view nearest_word(std::string_view word, std::span<const std::string_view> known);

/// "; did you mean 'rubber'?" where a known word is close, else "; known are: a, b, c".
[[nodiscard]] std::string did_you_mean(std::string_view word, std::span<const std::string_view> known);

}  // namespace sprung
