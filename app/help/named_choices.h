#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class Option;
}

namespace sprung {

/// The names that an option takes; empty where it takes no names, or any.
[[nodiscard]] std::vector<std::string> named_choices(const CLI::Option& option);

}  // namespace sprung
