#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace sprung {

/// The number after the last of the keys, each looked for behind the one before.
inline double number_at(const std::string& json, const std::vector<std::string>& keys) {
  std::size_t at = 0;
  for (const std::string& key : keys) {
    at = json.find("\"" + key + "\":", at);
    if (at == std::string::npos) {
      ADD_FAILURE() << "no " << key << " in " << json;
      return std::nan("");
    }
    at += key.size() + 3;
  }
  return std::stod(json.substr(at));
}

}  // namespace sprung
