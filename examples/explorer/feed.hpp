// The source of the stream: a thread that reads records and hands them to the live window in time.
#pragma once

#include "common/source.hpp"
#include "explorer/live.hpp"

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace explorer {

// The time of the stream: none (that of its records), the wall clock, or a replay's, `speed` times as fast as the
// wall's from its first record on. Any thread.
class Pace {
public:
    enum class Kind { records, wall, replay };
    Pace(Kind kind, double speed) : kind_(kind), speed_(speed) {}

    Kind kind() const { return kind_; }
    void begin(int64_t first); // of a replay
    void end();                // the replay's clock stands still from now on
    int64_t due() const;       // records up to this time may come; INT64_MIN: not known
    // What time it is for the window; INT64_MIN: the records tell. So it is until a stream with the wall's clock has
    // caught up with it: to the window its past is then no different from a present.
    int64_t now() const;
    void caught_up() { caught_up_.store(true); }

private:
    Kind kind_;
    double speed_;
    std::atomic<int64_t> first_{INT64_MIN};
    std::atomic<int64_t> begun_{0}; // wall clock
    std::atomic<int64_t> ended_{INT64_MAX};
    std::atomic<bool> caught_up_{false};
};

struct FeedState {
    std::string name;
    std::string state;   // filling, live, ended, failed
    double fraction = 0; // of the source, negative: unknown
    std::vector<std::string> remarks;
};

class Feed {
public:
    // `open` makes the source, on the feed's thread. Null: no source, the feed is live from the start.
    using Open = std::function<std::unique_ptr<demo::Source>()>;

    Feed(std::string name, Open open, Pace &pace, int64_t horizon);
    ~Feed();
    Feed(const Feed &) = delete;
    Feed &operator=(const Feed &) = delete;

    void start(Live &live);
    // False: the source waits for its input and cannot be woken; its thread goes on until the program ends.
    bool stop();
    FeedState state() const;

private:
    void run(Live &live);
    void read(demo::Source &source, Live &live);
    bool paced(const Batch &chunk, Live &live);
    void tell(const std::string &state, const demo::Source *source);

    Open open_;
    Pace &pace_;
    std::atomic<bool> stopping_{false};
    std::thread thread_;
    std::future<void> ended_;
    bool abandoned_ = false;
    demo::StreamClock stream_clock_; // the feed's own, like
    bool live_ = false;              // whether it has caught up
    mutable std::mutex mutex_;
    FeedState state_;
};

} // namespace explorer
