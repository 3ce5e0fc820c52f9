#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "robot/files/xml.h"

namespace prohull::robot {

/// Whether a document has macros: elements xacro:..., or attributes with ${...} or $(...).
bool is_xacro(const XmlDocument& document);

/// What the program xacro makes of a file: its standard output. It is found by PATH, and stopped after
/// `time`.
/// Throws InputError: UnknownFormat that says how to install xacro, where it is not installed; Malformed with the
/// words of xacro, if it fails. Throws Cancelled if it ends by Ctrl-C.
std::string expanded_by_xacro(const std::filesystem::path& file, std::chrono::seconds time = std::chrono::seconds(60));

/// UnknownFormat: how to expand the file.
[[noreturn]] void refuse_xacro(const std::filesystem::path& file);

}  // namespace prohull::robot
