#pragma once
#include <span>
#include <string>
#include <string_view>

namespace sprung {

/// An option for a key of the scene; its help is that of the key.
struct KeyOption {
  const char* option;
  std::string_view key;
  const char* example;
  struct Use {
    bool is_of_pictures = false;  // of no use where none are drawn
    bool is_common = false;       // named by --help; the others by sprung help COMMAND
  } use{};
};

/// Every such option, in the order of its help.
[[nodiscard]] std::span<const KeyOption> key_options();

/// What the key does.
[[nodiscard]] std::string help_of(const KeyOption& option);

}  // namespace sprung
