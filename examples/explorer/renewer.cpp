// Jobs in the background.
#include "explorer/renewer.hpp"

#include "explorer/priority.hpp"

namespace explorer {

Renewer::Renewer() : thread_([this] { run(); }) {}

Renewer::~Renewer() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    more_.notify_all();
    thread_.join();
}

void Renewer::add(std::function<void()> job) {
    {
        const std::lock_guard lock(mutex_);
        jobs_.push_back(std::move(job));
    }
    more_.notify_one();
}

void Renewer::run() {
    give_way(10);
    for (;;) {
        std::function<void()> job;
        {
            std::unique_lock lock(mutex_);
            more_.wait(lock, [this] { return stopping_ || !jobs_.empty(); });
            if (stopping_)
                return;
            job = std::move(jobs_.front());
            jobs_.pop_front();
        }
        job();
    }
}

} // namespace explorer
