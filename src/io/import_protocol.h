#pragma once

#include <string_view>

namespace prohull {

// What prohull-import, a program of its own because the library behind it may crash, writes to its standard output, in
// the byte order of the machine: the magic, the numbers of vertices and of polygons (uint64), x y z of each vertex
// (double), the number of corners and the corners of each polygon (uint32), the end mark. Arguments: the name of the
// file, of which the content is on standard input; seconds of processor time; bytes of address space, or 0 for no
// limit; kImportAlone, or nothing if other files that this one names may be read.

constexpr std::string_view kImportMagic = "prohull import 1";
constexpr std::string_view kImportEnd = "end of import";
constexpr const char* kImportAlone = "alone";

/// Exit codes besides 0. Refused: the output is the reason, as text.
constexpr int kImportMisused = 2, kImportRefused = 3, kImportOutOfMemory = 4;

}  // namespace prohull
