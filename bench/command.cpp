#include "command.h"

#include <fmt/format.h>

#include "io/file.h"

namespace prohull::bench {
namespace {

CLI::Option* in_range_of_faces(CLI::Option* option) {
  return option->check(CLI::Range(4, 1000000000))->capture_default_str();
}

}  // namespace

void add_faces_option(CLI::App& command, std::size_t& faces) {
  in_range_of_faces(command.add_option("--faces", faces, "Size of the hulls"));
}

void add_faces_option(CLI::App& command, std::vector<std::size_t>& faces, const std::string& description) {
  in_range_of_faces(command.add_option("--faces", faces, description)->delimiter(','));
}

void add_rounds_option(CLI::App& command, std::size_t& rounds) {
  command.add_option("--repeat", rounds, "Rounds, of which the best time counts")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

void add_out_option(CLI::App& command, std::filesystem::path& out, const std::string& files) {
  command.add_option("--out", out, fmt::format("Also write {} here", files))->type_name("DIR");
}

void publish(const std::filesystem::path& out, const std::string& name, const std::string& text) {
  fmt::print("{}", text);
  if (out.empty()) return;
  std::filesystem::create_directories(out);
  write_file(out / (name + ".md"), text);
}

void publish(const std::filesystem::path& out, const std::string& name, const std::string& text,
             const std::string& csv) {
  publish(out, name, text);
  if (!out.empty()) write_file(out / (name + ".csv"), csv);
}

}  // namespace prohull::bench
