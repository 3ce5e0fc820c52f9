#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "prohull/progress.h"

namespace prohull::robot {

/// How many of `count` items are worked on at once: up to `threads` (0: no limit), and no more than there are cores.
std::size_t workers_for(std::size_t count, unsigned threads);

/// Calls work(i, ...) once for each name, as many at once as workers_for says, on threads of their own. They begin in
/// the order of the names. The calling thread tells `progress` meanwhile: the stage is the name that was begun
/// last, the fraction is that of all names. The Progress that `work` gets asks only whether to go on.
///
/// Throws Cancelled if `progress` returns false. Once a call has thrown, no other one begins, and those under way
/// finish; then throws the exception of the first name that has one, which is the same for any number of threads.
void side_by_side(std::span<const std::string> names, unsigned threads, const Progress& progress,
                  const std::function<void(std::size_t i, const Progress& go_on)>& work);

}  // namespace prohull::robot
