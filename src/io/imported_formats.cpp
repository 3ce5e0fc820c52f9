#include <algorithm>
#include <array>

#include "io/imported_mesh.h"
#include "prohull/detail/extension.h"

namespace prohull {
namespace {

/// Those of assimp 5.2 that hold meshes, without those that are read here and those that are mere animations.
constexpr std::array<std::string_view, 33> kExtensions = {
    ".3ds",     ".3mf",  ".ac",  ".ac3d", ".amf", ".ase", ".b3d", ".blend", ".bsp", ".cob", ".dae",
    ".dxf",     ".fbx",  ".hmp", ".ifc",  ".iqm", ".irr", ".lwo", ".lws",   ".lxo", ".md2", ".md3",
    ".md5mesh", ".ms3d", ".nff", ".ogex", ".q3o", ".smd", ".ter", ".x",     ".x3d", ".xgl", ".zae"};

}  // namespace

std::span<const std::string_view> imported_extensions() { return kExtensions; }

bool is_imported(const std::filesystem::path& name) {
  return std::find(kExtensions.begin(), kExtensions.end(), lower_case_extension(without_gz(name))) != kExtensions.end();
}

}  // namespace prohull
