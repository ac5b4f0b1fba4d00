#pragma once
#include <string>

#include "app/load_body.h"
#include "core/bricks/embedding.h"
#include "core/bricks/pieces.h"

namespace sprung {

/// Gathers what came of filling the solids of one body with bricks, to tell it at once.
class FillReport {
 public:
  /// The body and its density (kg/m^3). It has to outlive this.
  FillReport(const LoadedBody& body, double density) : body_(body), density_(density) {}

  void add(const PieceReport& pieces, int slivers);
  void add(const Embedding& skin);
  /// How well bricks hold a solid's volume. Largest solids first.
  void add_volume(const BrickGrid& grid, const Solid& solid);

  void tell(const Console& console) const;

 private:
  void tell_pieces(const Console& console) const;

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
