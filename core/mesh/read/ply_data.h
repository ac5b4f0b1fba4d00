#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/read/ply_header.h"
#include "core/mesh/read/text_scanner.h"

namespace sprung {

/// The values of one vertex, face or the like, by property: a number or a list.
struct PlyEntry {
  std::vector<double> numbers;
  std::vector<std::vector<double>> lists;
};

/// The data of a PLY file after its header, entry by entry.
class PlyData {
 public:
  /// `bytes`: of the whole file, which must outlive this.
  PlyData(std::string_view bytes, const PlyHeader& header, const std::string& name);

  /// Reads the next entry of an element; `what` names it in messages. Throws Error(kBadInput) where the data end, or
  /// hold no number or a list of no possible length.
  void read(const PlyElement& element, const Named& what, PlyEntry& entry);

  /// Throws Error(kBadInput), with the line in a text.
  [[noreturn]] void refuse(const std::string& reason) const;

 private:
  double take(PlyType type, const Named& what);
  double take_binary(PlyType type, const Named& what);

  PlyFormat format_;
  std::string name_;
  std::string_view left_;  // of binary data
  TextScanner scanner_;
};

}  // namespace sprung
