// Threads that wait for loops.
#include "core/crew.hpp"

#include <algorithm>
#include <system_error>

namespace locus {

Crew::Crew(uint32_t threads) {
    if (threads <= 1)
        return;
    try {
        helpers_.reserve(threads - 1);
        while (helpers_.size() + 1 < threads)
            helpers_.emplace_back([this] { help(); });
    } catch (const std::system_error &) { // these do
    } catch (...) {
        end();
        throw;
    }
}

Crew::~Crew() { end(); }

void Crew::end() noexcept {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    begun_.notify_all();
    for (std::thread &helper : helpers_)
        helper.join();
}

void Crew::for_each(uint64_t count, uint64_t grain, Body body) {
    const Loop loop{&body, count, grain};
    {
        const std::lock_guard lock(mutex_);
        next_ = 0;
        loop_ = loop;
        ++loops_;
    }
    begun_.notify_all();
    work(loop);
    std::unique_lock lock(mutex_);
    loop_.body = nullptr; // who comes now is late
    done_.wait(lock, [this] { return busy_ == 0; });
}

void Crew::work(const Loop &loop) noexcept {
    const uint64_t pieces = loop.count / loop.grain + (loop.count % loop.grain != 0);
    for (uint64_t piece; (piece = next_.fetch_add(1, std::memory_order_relaxed)) < pieces;)
        (*loop.body)(piece * loop.grain, std::min(loop.count, (piece + 1) * loop.grain));
}

void Crew::help() {
    std::unique_lock lock(mutex_);
    for (uint64_t seen = 0;;) {
        begun_.wait(lock, [&] { return ending_ || (loop_.body && loops_ != seen); });
        if (ending_)
            return;
        seen = loops_;
        const Loop loop = loop_;
        ++busy_;
        lock.unlock();
        work(loop);
        lock.lock();
        if (--busy_ == 0)
            done_.notify_all();
    }
}

} // namespace locus
