#pragma once

#include "prohull/enclosing_hull.h"

namespace prohull::cover {

inline EnclosingOptions enclosing_options(unsigned threads, const Progress& progress) {
  return {.hull = {.threads = threads}, .progress = progress};
}

}  // namespace prohull::cover
