#pragma once
#include <string>

#include "app/recording.h"

namespace sprung {

/// One line a frame under a line of names: "time_s,tip.position.x_m,...,end.torque.z_Nm".
[[nodiscard]] std::string probes_csv(const Recording& recording);

/// The same by probe, with the frequencies of modes and the state hash.
[[nodiscard]] std::string probes_json(const Recording& recording);

}  // namespace sprung
