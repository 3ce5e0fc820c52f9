#pragma once

namespace prohull {

/// Gives up what threads that wait for work are kept for, so that oneTBB's `finalize` can end them.
void give_up_idle_arenas();

}  // namespace prohull
