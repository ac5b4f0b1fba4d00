#pragma once
#include <string>
#include <string_view>

#include "core/simulation/recorder.h"

namespace sprung {

/// The column name of a number with a unit: "position.x_m", "torque_Nm", "max_strain".
[[nodiscard]] std::string column_name(std::string_view name, std::string_view unit);

/// Calls visit(quantity, number) for each number that a probe of a kind measures, in the order of the columns.
template <class Visit>
void each_column(ProbeKind kind, const Visit& visit) {
  for (const ProbeQuantity& quantity : kProbeQuantities) {
    for (std::size_t number = 0; quantity.is_of(kind) && number < quantity.size(); ++number) visit(quantity, number);
  }
}

}  // namespace sprung
