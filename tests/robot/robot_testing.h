#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "io/io_testing.h"
#include "prohull/error.h"

namespace prohull::robot {

/// Writes a file, and the folders above it.
inline void write_file(const std::filesystem::path& path, std::string_view bytes = "x") {
  std::filesystem::create_directories(path.parent_path());
  write_bytes(path, bytes);
}

/// What an environment variable has while the object lives.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* const old = std::getenv(name)) was_set_ = true, old_ = old;
    setenv(name, value.c_str(), 1);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  ~Variable() { was_set_ ? setenv(name_, old_.c_str(), 1) : unsetenv(name_); }

 private:
  const char* name_;
  bool was_set_ = false;
  std::string old_;
};

/// The message of the InputError that a call throws; "" if it throws none.
template <class Call>
std::string refusal_of(Call call, Defect expected = Defect::Malformed) {
  try {
    call();
  } catch (const InputError& error) {
    EXPECT_EQ(error.defect(), expected) << error.what();
    return error.what();
  }
  return "";
}

inline bool has(std::string_view text, std::string_view part) { return text.find(part) != text.npos; }

}  // namespace prohull::robot
