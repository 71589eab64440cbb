// Telling what happens.
#include "explorer/events.hpp"

#include "explorer/arguments.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>

namespace explorer {
namespace {

constexpr auto step = std::chrono::milliseconds(500);
constexpr size_t most_alerts = 100;             // told at once
constexpr auto quiet = std::chrono::seconds(5); // a listener that is gone is noticed in that time

std::string event_text(const std::string &kind, const Json &data) {
    return "event: " + kind + "\ndata: " + json_text(data) + "\n\n";
}

} // namespace

// One answer, written by the thread that serves it.
class Events::Listener {
public:
    Listener(Events &events, uint64_t alert) : events_(events), alert_(alert) {
        if (events_.counters_.listeners.fetch_add(1) < events_.most_)
            return;
        events_.counters_.listeners.fetch_sub(1);
        throw Failure(503, "events: " + std::to_string(events_.most_) + " listeners are there already");
    }
    ~Listener() { events_.counters_.listeners.fetch_sub(1); }
    Listener(const Listener &) = delete;
    Listener &operator=(const Listener &) = delete;

    // Waits for news and sends them.
    bool next(const Send &send) {
        std::string text = begun_ ? "" : "retry: 2000\n\n";
        begun_ = true;
        {
            std::unique_lock lock(events_.mutex_);
            const auto due = [&] {
                return events_.stopping_ || stats_ < events_.stats_.number || version_ < events_.version_.number ||
                       alert_ < events_.alerts_.last();
            };
            if (text.empty())
                events_.news_.wait_for(lock, quiet, due);
            if (events_.stopping_)
                return false;
            add(text, stats_, events_.stats_);
            add(text, version_, events_.version_);
        }
        for (const Json &alert : events_.alerts_.since(alert_, most_alerts)) {
            alert_ = alert["id"];
            text += "id: " + std::to_string(alert_) + "\n" + event_text("alert", alert);
        }
        return send(text.empty() ? ":\n\n" : text);
    }

private:
    static void add(std::string &text, uint64_t &told, const News &news) {
        if (told < news.number)
            text += news.text;
        told = news.number;
    }

    Events &events_;
    bool begun_ = false;
    uint64_t alert_;                   // what has been told
    uint64_t stats_ = 0, version_ = 0; // likewise
};

Events::Events(const Live &live, const Statistics &statistics, AlertLog &alerts, Counters &counters, size_t most)
    : live_(live), statistics_(statistics), alerts_(alerts), counters_(counters), most_(most),
      teller_([this] { run(); }) {}

void Events::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    news_.notify_all();
    if (teller_.joinable())
        teller_.join();
}

// A listener that comes back says which alert it has seen last; a new one is told those to come.
Reply Events::listen(const Request &request) {
    Arguments(request).done();
    const std::string seen = request.header("last-event-id");
    uint64_t alert = alerts_.last();
    std::from_chars(seen.data(), seen.data() + seen.size(), alert);
    Reply reply;
    reply.type = "text/event-stream";
    reply.headers = {{"Cache-Control", "no-store"}};
    reply.stream = [listener = std::make_shared<Listener>(*this, std::min(alert, alerts_.last()))](const Send &send) {
        return listener->next(send);
    };
    return reply;
}

void Events::tell(News &news, std::string text) {
    {
        const std::lock_guard lock(mutex_);
        news.text = std::move(text);
        ++news.number;
    }
    news_.notify_all();
}

// Statistics every second step, the version where it has changed.
void Events::run() {
    uint64_t told = 0;
    for (uint64_t round = 0;; ++round) {
        alerts_.describe(live_.store());
        const uint64_t version = live_.version();
        if (version != told) {
            const Json stats = statistics_.stats();
            tell(version_,
                 event_text("version", {{"version", version}, {"now", stats["now"]}, {"records", stats["records"]}}));
            told = version;
        }
        if (round % 2 == 0)
            tell(stats_, event_text("stats", statistics_.stats()));
        std::unique_lock lock(mutex_);
        if (news_.wait_for(lock, step, [&] { return stopping_; }))
            return;
    }
}

} // namespace explorer
