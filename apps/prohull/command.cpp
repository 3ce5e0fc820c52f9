#include "command.h"

#include <cmath>

namespace prohull::cli {

nlohmann::json facts(const MeshReport& report) {
  nlohmann::json defects;
  for (const DefectCount& defect : defect_counts(report)) defects[std::string(defect.name)] = defect.count;
  return {{"faces", report.faces},           {"vertices", report.vertices},
          {"components", report.components}, {"euler_characteristic", report.euler_characteristic},
          {"volume", report.volume},         {"defects", defects}};
}

nlohmann::json facts(const MeshQuality& quality) {
  const auto percentiles = [](const Percentiles& p, double unit) -> nlohmann::json {
    return {{"worst", p.worst / unit}, {"p1", p.p1 / unit}, {"p10", p.p10 / unit}, {"median", p.median / unit}};
  };
  return {{"compactness", percentiles(quality.compactness, 1)},
          {"dihedral_degrees", quality.edges > 0 ? percentiles(quality.dihedral_angle, kDegree) : nlohmann::json()},
          {"edges", quality.edges},
          {"sharp_edges", quality.sharp_edges},
          {"sharp_below_degrees", kSharpDihedralAngle / kDegree}};
}

nlohmann::json finite_or_null(double value) { return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(); }

}  // namespace prohull::cli
