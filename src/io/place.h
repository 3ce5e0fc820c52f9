#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "prohull/error.h"

namespace prohull {

/// A spot in a file as error messages name it: lines are counted from 1, bytes and the rows of an array from 0; None if
/// the message alone says where.
struct Place {
  enum class Unit { Line, Byte, Row, None };
  Unit unit = Unit::Line;
  std::size_t number = 0;
};
constexpr Place kNowhere{Place::Unit::None, 0};

/// Throws InputError "file: line 14: message", or "file: message" without a unit.
[[noreturn]] void fail(std::string_view file, Place place, std::string_view message, Defect defect = Defect::Malformed);

/// A word of a hostile file, fit for a message: shortened, on one line. "\\x1b" stands for the control character
/// 0x1b, and so on.
std::string printable(std::string_view word, std::size_t longest = 40);
/// The same in quotes.
std::string in_quotes(std::string_view word);

}  // namespace prohull
