// Waiting for what another thread does within microseconds: to ask again for a while before one sleeps. A sleeping
// thread costs both sides a system call, and on a virtual machine its core may be given away meanwhile.
#pragma once

#include <mutex>

namespace locus {

// Ask done() until it is true or some tens of microseconds have gone by; its last answer.
template <typename Done>
bool spin_until(Done &&done) {
    constexpr unsigned turns = 1000;
    for (unsigned turn = 0; turn < turns; ++turn) {
        if (done())
            return true;
#if defined(__x86_64__) || defined(__i386__)
        __builtin_ia32_pause();
#elif defined(__aarch64__)
        __asm__ __volatile__("yield");
#endif
    }
    return done();
}

// Lock a mutex that is never held for long.
inline std::unique_lock<std::mutex> lock_soon(std::mutex &mutex) {
    std::unique_lock lock(mutex, std::defer_lock);
    if (!spin_until([&] { return lock.try_lock(); }))
        lock.lock();
    return lock;
}

} // namespace locus
