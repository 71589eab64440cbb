// Which request gets which answer.
#pragma once

#include "explorer/assets.hpp"
#include "explorer/events.hpp"
#include "explorer/ingest.hpp"

namespace explorer {

struct RouteSettings {
    bool loopback = true;     // bound to it: other names are refused
    std::string allow_origin; // another site that may read; empty: none
};

class Routes {
public:
    Routes(RouteSettings settings, Answers &answers, Events &events, const AlertLog &alerts,
           const Statistics &statistics, Ingest &ingest, const Assets &assets, Counters &counters);

    // Before the body is read: nothing, or why it need not be.
    std::optional<Reply> refusal(const Request &request) const;
    // Never throws.
    Reply answer(const Request &request);

private:
    Reply dispatch(const Request &request);
    Reply get(const Request &request);
    Reply alerts(const Request &request) const;
    void add_headers(const Request &request, Reply &reply) const;

    RouteSettings settings_;
    Answers &answers_;
    Events &events_;
    const AlertLog &alerts_;
    const Statistics &statistics_;
    Ingest &ingest_;
    const Assets &assets_;
    Counters &counters_;
};

} // namespace explorer
