#include "machine.h"

#include <fmt/format.h>

#include <fstream>
#include <thread>

namespace prohull::bench {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name"))
      if (const auto colon = line.find(": "); colon != std::string::npos) return line.substr(colon + 2);
  return "unknown processor";
}

}  // namespace

std::string machine() {
  return fmt::format("prohull {}, {}, {}, {} cores", PROHULL_VERSION, PROHULL_COMPILER, processor(),
                     std::thread::hardware_concurrency());
}

}  // namespace prohull::bench
