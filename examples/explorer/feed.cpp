// Reading in time.
#include "explorer/feed.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace explorer {
namespace {

constexpr size_t chunk_records = 1000;
constexpr auto step = std::chrono::milliseconds(50);
constexpr auto patience = std::chrono::milliseconds(500);

} // namespace

void Pace::begin(int64_t first) {
    if (kind_ != Kind::replay || first_.load() != INT64_MIN)
        return;
    begun_.store(wall_clock());
    first_.store(first, std::memory_order_release);
}

void Pace::end() {
    if (kind_ == Kind::replay)
        ended_.store(due());
}

int64_t Pace::now() const { return kind_ == Kind::wall && !caught_up_.load() ? INT64_MIN : due(); }

int64_t Pace::due() const {
    if (kind_ == Kind::wall)
        return wall_clock();
    const int64_t first = first_.load(std::memory_order_acquire);
    if (kind_ == Kind::records || first == INT64_MIN)
        return INT64_MIN;
    const double gone = static_cast<double>(wall_clock() - begun_.load()) * speed_;
    return std::min(first + static_cast<int64_t>(gone), ended_.load());
}

Feed::Feed(std::string name, Open open, Pace &pace, int64_t horizon)
    : open_(std::move(open)), pace_(pace), stream_clock_(horizon) {
    state_ = {std::move(name), open_ ? "filling" : "live", -1, {}};
    if (!open_)
        pace_.caught_up();
}

Feed::~Feed() { stop(); }

void Feed::start(Live &live) {
    if (!open_)
        return;
    std::packaged_task<void()> task([this, &live] { run(live); });
    ended_ = task.get_future();
    thread_ = std::thread(std::move(task));
}

bool Feed::stop() {
    stopping_.store(true);
    if (!thread_.joinable())
        return !abandoned_;
    if (ended_.wait_for(patience) == std::future_status::ready) {
        thread_.join();
        return true;
    }
    thread_.detach();
    abandoned_ = true;
    return false;
}

FeedState Feed::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

void Feed::tell(const std::string &state, const demo::Source *source) {
    const double fraction = source == nullptr ? -1 : source->fraction();
    std::vector<std::string> remarks = source == nullptr ? std::vector<std::string>() : source->remarks();
    const std::lock_guard lock(mutex_);
    state_.state = state;
    state_.fraction = fraction;
    state_.remarks = std::move(remarks);
}

void Feed::run(Live &live) {
    std::unique_ptr<demo::Source> source;
    try {
        source = open_();
        read(*source, live);
        if (!stopping_.load())
            tell("ended", source.get());
    } catch (const std::exception &error) {
        std::fprintf(stderr, "explorer: the source failed: %s\n", error.what());
        tell("failed", source.get());
        const std::lock_guard lock(mutex_);
        state_.remarks.emplace_back(error.what());
    }
    pace_.end();
}

void Feed::read(demo::Source &source, Live &live) {
    Batch chunk;
    while (!stopping_.load()) {
        source.next(chunk, chunk_records);
        if (chunk.empty())
            return;
        if (pace_.kind() == Pace::Kind::records) {
            tell("live", &source);
            if (!live.offer(chunk))
                return;
        } else {
            pace_.begin(int64_t{chunk.front().time});
            if (!paced(chunk, live))
                return;
            tell(live_ ? "live" : "filling", &source);
        }
    }
}

// Hands the chunk over piece by piece: what is due, then a pause. Times far ahead of the others are not waited for.
bool Feed::paced(const Batch &chunk, Live &live) {
    const int64_t latest = stream_clock_.advance(chunk);
    Batch due;
    for (size_t next = 0; next < chunk.size() && !stopping_.load();) {
        const int64_t now = pace_.due();
        due.clear();
        for (; next < chunk.size() && (chunk[next].time <= now || chunk[next].time > latest); ++next)
            due.push_back(chunk[next]);
        if (!due.empty() && !live.offer(due))
            return false;
        if (next == chunk.size())
            break;
        if (!live_) {
            live_ = true;
            pace_.caught_up();
            const std::lock_guard lock(mutex_);
            state_.state = "live";
        }
        std::this_thread::sleep_for(step);
    }
    return true;
}

} // namespace explorer
