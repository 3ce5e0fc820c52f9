#include "solid_notes.h"

#include <utility>

#include "console.h"
#include "inputs.h"
#include "prohull/detail/inside_out.h"

namespace prohull::cli {

SolidNotes SolidNotes::turning(TriangleMesh& closed, const std::filesystem::path& path) {
  OutwardSolid solid = outward_solid(std::move(closed), input_name(path));
  closed = std::move(solid.mesh);
  return {std::move(solid.turned), {}};
}

SolidNotes SolidNotes::not_closed(const std::filesystem::path& path) {
  return {{},
          input_name(path) + " is not closed: only its faces count, not what lies inside (`prohull repair` closes it)"};
}

std::vector<std::string> SolidNotes::all() const {
  std::vector<std::string> sentences{turned, open};
  std::erase(sentences, "");
  return sentences;
}

void SolidNotes::say_them() const {
  for (const std::string& sentence : all())
    if (console().quiet && sentence != turned)
      tell_error(sentence);
    else
      say("  {}\n", sentence);
}

}  // namespace prohull::cli
