#pragma once
#include "core/body/brick_measures.h"
#include "core/simulation/origin.h"
#include "core/simulation/probe_sample.h"
#include "core/world/world.h"

namespace sprung {

/// Adds up what a probe measures of parts of bodies.
class PartMeasures {
 public:
  /// With small strains, energy and volume are also those of small displacements.
  void add(const SoftBody& body, const ProbedPart& part, StrainMeasure strain);

  /// The measures of all parts added. A brick counts by its fill, a node by how much of the fill around it is in the
  /// part.
  [[nodiscard]] ProbeSample sample() const;

 private:
  ProbeSample sums_;   // means: times volume
  double volume_ = 0;  // at rest, m^3
};

}  // namespace sprung
