#pragma once
#include <string>
#include <string_view>

#include "core/types.h"

namespace sprung {

/// JSON values. A number that is not finite becomes null.
[[nodiscard]] std::string json_text(double value);
[[nodiscard]] std::string json_text(const Vec3& value);
[[nodiscard]] std::string json_text(std::string_view value);

}  // namespace sprung
