#pragma once

#include <functional>
#include <string_view>

namespace prohull {

/// Is told now and then, while a function works, what it is doing and how much of that is done, in [0, 1]. It is called
/// on the thread that called the function, at most some 50 times a second. Within a stage the fraction never runs back;
/// a function that does the same thing several times tells each as a stage of its own. If the Progress returns false,
/// the function stops and throws Cancelled; nothing was written or changed.
///
///     build_hull(mesh, {.progress = [&](std::string_view stage, double fraction) {
///       show(stage, fraction);
///       return !interrupted;
///     }});
using Progress = std::function<bool(std::string_view stage, double fraction)>;

}  // namespace prohull
