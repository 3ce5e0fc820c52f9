#include "parallel/arena.h"

#include "prohull/detail/threads.h"

namespace prohull {

void give_up_idle_arenas() { ArenaPool::of_process().give_up_idle(); }

}  // namespace prohull
