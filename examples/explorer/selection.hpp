// Which records a request asks for: region and time window.
#pragma once

#include "explorer/arguments.hpp"

#include <locus/pmq.h>

#include <string>
#include <vector>

namespace explorer {

class Selection {
public:
    // Reads from, to, last, and, where `regions`, box, circle, polygon. `now` is what `last` counts back from.
    Selection(Arguments &arguments, int64_t now, bool regions);
    Selection(const Selection &) = delete; // the query points into it
    Selection &operator=(const Selection &) = delete;

    const locus_pmq_query &query() const { return query_; }
    locus_pmq_query &query() { return query_; }

private:
    void read_window(Arguments &arguments, int64_t now);
    void read_region(Arguments &arguments);
    void read_polygon(Arguments &arguments, const std::string &text);

    locus_pmq_query query_;
    std::vector<locus_position> vertices_;
    std::vector<uint64_t> ring_sizes_;
};

// A status of liblocus, or of liblocus_cold, as an exception: a wrong argument is the client's, anything else ours.
void check(locus_status status);
void check_cold(locus_status status);

} // namespace explorer
