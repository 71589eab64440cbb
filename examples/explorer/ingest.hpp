// Records that come by POST /ingest.
#pragma once

#include "explorer/answers.hpp"

#include <string>

namespace explorer {

class Ingest {
public:
    // `token`: what a client must show; empty: nothing, and nobody is let in unless `open`.
    Ingest(Live &live, std::string token, bool open);

    // May this request's body come? Throws a Failure.
    void admit(const Request &request) const;
    // Stores the body's records.
    Reply take(const Request &request);

private:
    Live &live_;
    std::string token_;
    bool open_;
};

} // namespace explorer
