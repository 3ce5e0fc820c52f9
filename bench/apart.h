#pragma once

#include <cstddef>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>

#include "prohull/triangle_mesh.h"

namespace prohull::bench {

// Work in a process of its own, which may fail, crash or never end, and whose memory can be told from that of others.

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// Has no name, and is shared with the processes that run_apart starts.
File temporary_file();

/// All of it.
std::string text_of(std::FILE* file);

// Throw std::runtime_error if the file is full, or ends too early. A mesh begins at the file's begin.
void put_bytes(std::FILE* file, const void* bytes, std::size_t count);
void get_bytes(std::FILE* file, void* bytes, std::size_t count);
void put_mesh(std::FILE* file, const TriangleMesh& mesh);
TriangleMesh get_mesh(std::FILE* file);

struct MeshSize {
  std::size_t vertices, faces;
};
MeshSize get_mesh_size(std::FILE* file);

struct Ended {
  std::string failure;     ///< what was thrown, "more than 120 s" or "signal 11"; empty if the work was done
  std::size_t peak_bytes;  ///< of resident memory, also what the program had before
};

/// Runs `work` in a process of its own; it sees the memory as it is and changes nothing there. It is ended after
/// `limit_seconds` of processor time; 0 is no limit.
Ended run_apart(const std::function<void()>& work, unsigned limit_seconds = 0);

}  // namespace prohull::bench
