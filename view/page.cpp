#include "view/page.h"

#include <zlib.h>

#include <new>

#include "prohull/detail/base64.h"
#include "prohull/error.h"
#include "view/scene.h"
#include "view/template.h"

namespace prohull::view {
namespace {

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string result(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                bytes.size(), Z_BEST_COMPRESSION) != Z_OK)
    throw std::bad_alloc();  // the only other failure, too small a buffer, cannot occur
  result.resize(size);
  return result;
}

/// What stands in the page in place of kScenePlace. No byte of it can end an element of the page or begin one.
std::string elements_of(const Scene& scene) {
  std::string escaped;
  for (const char c : scene.facts_as_text()) c == '<' ? escaped += "\\u003c" : escaped += c;
  return "<script type=\"application/json\" id=\"scene\">" + escaped +
         "</script>\n<script type=\"text/plain\" id=\"blocks\">" + to_base64(deflated(scene.blocks.bytes())) +
         "</script>";
}

}  // namespace

bool has_page() { return !page_template().empty(); }

std::string page(const std::vector<Shown>& shown, const std::optional<Original>& original, const PageOptions& options) {
  if (!has_page()) throw InputError(Defect::CannotRead, std::string(kNoPage));
  const std::string scene = elements_of(scene_of(shown, original, options));
  std::string text;
  for (const std::string_view part : page_template()) text += part;
  const std::size_t place = text.find(kScenePlace);
  return text.replace(place, kScenePlace.size(), scene);
}

}  // namespace prohull::view
