#include "figure.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string>

namespace prohull::bench {

void draw_figure(const std::filesystem::path& csv) {
  const auto beside = [&](const char* extension) { return std::filesystem::path(csv).replace_extension(extension); };
  const std::filesystem::path script = PROHULL_FIGURE_SCRIPTS / csv.filename().replace_extension(".py");
  std::array<std::string, 5> words{PROHULL_PYTHON, script.string(), csv.string(), beside(".svg").string(),
                                   beside(".png").string()};
  std::array<char*, 6> arguments{};
  std::ranges::transform(words, arguments.begin(), [](std::string& word) { return word.data(); });
  pid_t child = 0;
  int status = 1;
  const bool drawn = posix_spawn(&child, words[0].c_str(), nullptr, nullptr, arguments.data(), environ) == 0 &&
                     waitpid(child, &status, 0) == child && status == 0;
  if (!drawn)
    fmt::print(stderr, "prohull-bench: {} is not drawn, which takes {} with matplotlib\n", csv.stem().string(),
               PROHULL_PYTHON);
}

}  // namespace prohull::bench
