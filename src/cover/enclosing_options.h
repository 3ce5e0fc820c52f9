#pragma once

#include "prohull/enclosing_hull.h"

namespace prohull::cover {

inline EnclosingOptions enclosing_options(unsigned threads, const Progress& progress) {
  EnclosingOptions options;
  options.hull.threads = threads;
  options.progress = progress;
  return options;
}

}  // namespace prohull::cover
