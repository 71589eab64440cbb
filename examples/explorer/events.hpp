// Server-sent events: what happens, told to every listener.
#pragma once

#include "explorer/statistics.hpp"

#include <condition_variable>
#include <mutex>
#include <thread>

namespace explorer {

class Events {
public:
    Events(const Live &live, const Statistics &statistics, AlertLog &alerts, Counters &counters, size_t most);
    ~Events() { stop(); }
    Events(const Events &) = delete;
    Events &operator=(const Events &) = delete;

    // An endless answer. Throws a Failure of status 503 where there are as many listeners as there may be.
    Reply listen(const Request &request);
    void stop(); // ends every answer

private:
    class Listener;
    // The latest news of a kind; the number rises with each.
    struct News {
        uint64_t number = 0;
        std::string text;
    };

    void run();
    void tell(News &news, std::string text);

    const Live &live_;
    const Statistics &statistics_;
    AlertLog &alerts_;
    Counters &counters_;
    size_t most_;
    std::mutex mutex_; // of what follows
    std::condition_variable news_;
    News stats_, version_;
    bool stopping_ = false;
    std::thread teller_;
};

} // namespace explorer
