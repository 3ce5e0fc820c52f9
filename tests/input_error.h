#pragma once

#include <gtest/gtest.h>

#include "prohull/error.h"

namespace prohull {

/// What a call is refused with.
template <class Call>
InputError error_of(Call call) {
  try {
    call();
  } catch (const InputError& error) {
    return error;
  }
  ADD_FAILURE() << "accepted";
  return {Defect::CannotRead, ""};
}

}  // namespace prohull
