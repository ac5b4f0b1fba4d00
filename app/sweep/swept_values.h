#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace sprung {

/// The values in "A,B,C" and in ranges "10kPa:40kPa:10kPa" (first, last, step; all in one unit), but commas within
/// brackets or braces do not separate. Throws Error(kUsage) for a range without end.
[[nodiscard]] std::vector<std::string> values_in(std::string_view text);

}  // namespace sprung
