// A thread that does in the background what somebody will want soon.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace explorer {

class Renewer {
public:
    Renewer();
    ~Renewer(); // what has not begun is dropped
    Renewer(const Renewer &) = delete;
    Renewer &operator=(const Renewer &) = delete;

    // Jobs are done one after the other, and do not throw. Any thread.
    void add(std::function<void()> job);

private:
    void run();

    std::mutex mutex_; // of what follows
    std::condition_variable more_;
    std::deque<std::function<void()>> jobs_;
    bool stopping_ = false;
    std::thread thread_;
};

} // namespace explorer
