#include "apart.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <exception>
#include <stdexcept>

namespace prohull::bench {
namespace {

void end_after(unsigned seconds) {
  const rlimit processor_time{seconds, seconds + 1}, no_core{0, 0};
  setrlimit(RLIMIT_CPU, &processor_time);
  setrlimit(RLIMIT_CORE, &no_core);
}

std::string failure(int status, std::FILE* thrown, unsigned limit_seconds) {
  if (WIFEXITED(status))
    return WEXITSTATUS(status) == 0 ? text_of(thrown) : fmt::format("exit code {}", WEXITSTATUS(status));
  if (WTERMSIG(status) == SIGXCPU) return fmt::format("more than {} s", limit_seconds);
  return fmt::format("signal {}", WTERMSIG(status));
}

}  // namespace

File temporary_file() {
  File file(std::tmpfile());
  if (!file) throw std::runtime_error("no temporary file can be made");
  return file;
}

std::string text_of(std::FILE* file) {
  std::rewind(file);
  std::string text;
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) text += static_cast<char>(c);
  return text;
}

void put_bytes(std::FILE* file, const void* bytes, std::size_t count) {
  if (std::fwrite(bytes, 1, count, file) != count || std::fflush(file) != 0)
    throw std::runtime_error("the temporary file is full");
}

void get_bytes(std::FILE* file, void* bytes, std::size_t count) {
  if (std::fread(bytes, 1, count, file) != count) throw std::runtime_error("the temporary file is incomplete");
}

void put_mesh(std::FILE* file, const TriangleMesh& mesh) {
  const MeshSize size{mesh.vertex_count(), mesh.face_count()};
  std::rewind(file);
  put_bytes(file, &size, sizeof size);
  put_bytes(file, mesh.positions.data(), size.vertices * sizeof(Vec3));
  put_bytes(file, mesh.triangles.data(), size.faces * sizeof(std::array<VertexId, 3>));
}

MeshSize get_mesh_size(std::FILE* file) {
  MeshSize size{};
  std::rewind(file);
  get_bytes(file, &size, sizeof size);
  return size;
}

TriangleMesh get_mesh(std::FILE* file) {
  const MeshSize size = get_mesh_size(file);
  TriangleMesh mesh;
  mesh.positions.resize(size.vertices);
  mesh.triangles.resize(size.faces);
  get_bytes(file, mesh.positions.data(), size.vertices * sizeof(Vec3));
  get_bytes(file, mesh.triangles.data(), size.faces * sizeof(std::array<VertexId, 3>));
  return mesh;
}

Ended run_apart(const std::function<void()>& work, unsigned limit_seconds) {
  const File thrown = temporary_file();
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process can be started");
  if (child == 0) {
    if (limit_seconds > 0) end_after(limit_seconds);
    try {
      work();
    } catch (const std::exception& error) {
      std::fputs(error.what(), thrown.get());
      std::fflush(thrown.get());
    }
    _exit(0);
  }
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child) throw std::runtime_error("a process was lost");
  return {failure(status, thrown.get(), limit_seconds), std::size_t(usage.ru_maxrss) * 1024};
}

}  // namespace prohull::bench
