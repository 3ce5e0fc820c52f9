#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <span>
#include <sstream>
#include <string>
#include <string_view>

#include "prohull/certificate.h"
#include "prohull/detail/shapes.h"
#include "prohull/triangle_mesh.h"

namespace prohull::oracle {

/// Of any mesh, which write_mesh would refuse if it is not finite.
inline std::string off(const TriangleMesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.vertex_count(), mesh.face_count());
  for (const Vec3& p : mesh.positions) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  for (const auto& [a, b, c] : mesh.triangles) text += fmt::format("3 {} {} {}\n", index(a), index(b), index(c));
  return text;
}

inline std::string yaml(std::span<const Ball> balls) {
  std::string text = "link:\n";
  for (const auto& [c, radius] : balls)
    text += fmt::format("- {{center: [{}, {}, {}], radius: {}}}\n", c.x, c.y, c.z, radius);
  return text;
}

inline std::string write(const std::string& name, const std::string& bytes) {
  std::ofstream(name, std::ios::binary) << bytes;
  return name;
}

/// What checker/prohull_check.c, which shares nothing with the library, says of a certificate.
struct Checked {
  bool is_proven = false;
  /// If it is neither, it is left undecided, for a reason that docs/certificate.md gives under "Limits".
  bool is_denied = false;
  std::string line;
};

/// `hull` is the text of a file whose name ends in `suffix`.
inline Checked checked(const Certificate& certificate, const std::string& hull, std::string_view suffix,
                       const std::string& original) {
  const std::string name = fmt::format("{}checked_{}", testing::TempDir(), getpid());
  const std::string said = name + ".txt";
  const int code = std::system(
      fmt::format("{} {} {} {} >{} 2>&1", PROHULL_CHECK, write(name + ".phcert", certificate.bytes),
                  write(fmt::format("{}{}", name, suffix), hull), write(name + "_original.off", original), said)
          .c_str());
  std::ostringstream line;
  line << std::ifstream(said).rdbuf();
  Checked found{.is_proven = code == 0, .line = line.str()};
  found.is_denied = !found.is_proven;
  for (const std::string_view undecided : {" may be ", "has no area", "crossed too often", "take too long"})
    if (found.line.starts_with("not proven") && found.line.find(undecided) != std::string::npos)
      found.is_denied = false;
  return found;
}

}  // namespace prohull::oracle
