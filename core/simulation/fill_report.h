#pragma once
#include <string>

#include "core/bricks/embedding.h"
#include "core/bricks/pieces.h"
#include "core/simulation/body_source.h"
#include "core/simulation/observer.h"

namespace sprung {

/// Collects the results of filling the solids of one body with bricks, for a single report.
class FillReport {
 public:
  /// The body, which must outlive this, and its density (kg/m^3).
  FillReport(const LoadedBody& body, double density) : body_(body), density_(density) {}

  void add(const PieceReport& pieces, int slivers);
  void add(const Embedding& skin);
  /// How well the bricks represent a solid's volume. Largest solids first.
  void add_volume(const BrickGrid& grid, const Solid& solid);

  void tell(const Observer& observer) const;

 private:
  void tell_pieces(const Observer& observer) const;

  const LoadedBody& body_;
  double density_;
  int outside_ = 0;              // vertices of the skin
  double furthest_outside_ = 0;  // bricks
  int slivers_ = 0;
  PieceReport pieces_;
  int wrong_volumes_ = 0;       // solids
  std::string volume_warning_;  // of the first of them
};

}  // namespace sprung
