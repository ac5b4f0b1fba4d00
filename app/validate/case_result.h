#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/validate/check.h"
#include "app/validate/node_errors.h"
#include "core/law/brick_law.h"

namespace sprung {

/// What a person wants instead of what a case varies.
struct Choice {
  std::optional<Model> model;
  std::optional<double> poisson;
  std::optional<int> bricks;
};

/// Numbers and words in rows, each as long as the head.
struct TextTable {
  std::vector<std::string> head{};
  std::vector<std::vector<std::string>> rows{};
};

/// What a case of `sprung validate` found.
struct CaseResult {
  std::vector<Check> checks{};
  std::vector<NodeErrors> node_errors{};  // of the runs whose solution is known node by node
  TextTable table{};                      // empty: none
};

}  // namespace sprung
