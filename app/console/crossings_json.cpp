#include "app/console/crossings_json.h"

namespace sprung {

nlohmann::ordered_json json_of(const Crossings& crossings) {
  nlohmann::ordered_json json{
      {"frame", crossings.frame + 1},      {"time_s", crossings.time},
      {"crossing_pairs", crossings.pairs}, {"crossing_pairs_at_start", crossings.pairs_at_start},
      {"depth_m", crossings.depth},        {"depth_percent", 100 * crossings.share}};
  if (crossings.pairs > 0) {
    json["between"] = crossings.names;
    json["place_m"] = {crossings.position.x(), crossings.position.y(), crossings.position.z()};
  }
  return json;
}

nlohmann::ordered_json json_of(const std::vector<Crossings>& frames) {
  nlohmann::ordered_json array = nlohmann::ordered_json::array();
  for (const Crossings& crossings : frames) array.push_back(json_of(crossings));
  return array;
}

}  // namespace sprung
