// Threads that give way to others.
#pragma once

#include <sys/resource.h>

namespace explorer {

// The calling thread gives way to those of a lower number, of 0..19; 0 is what a thread begins with. In Linux a thread
// has such a number of its own.
inline void give_way(int number) { setpriority(PRIO_PROCESS, 0, number); }

} // namespace explorer
