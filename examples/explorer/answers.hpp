// The answers to requests that read: each turns parameters into calls of the library, and results into a reply.
#pragma once

#include "explorer/cache.hpp"
#include "explorer/heat.hpp"
#include "explorer/http.hpp"
#include "explorer/live.hpp"

#include <nlohmann/json.hpp>

#include <atomic>
#include <string>

namespace explorer {

using Json = nlohmann::ordered_json;

// JSON as a reply; bytes that are not UTF-8 become U+FFFD.
Reply json_reply(const Json &json);
std::string json_text(const Json &json);

// At most so many queries that read many records at once; more get a Failure of status 503.
class Turns {
public:
    explicit Turns(int most) : left_(most) {}
    class Turn {
    public:
        explicit Turn(Turns &turns);
        ~Turn() { left_.fetch_add(1); }
        Turn(const Turn &) = delete;
        Turn &operator=(const Turn &) = delete;

    private:
        std::atomic<int> &left_;
    };

private:
    std::atomic<int> left_;
};

class Answers {
public:
    Answers(const Live &live, size_t max_results);

    Reply tile(const Request &request, const TilePlace &place, bool drawn); // as a picture, or as numbers
    Reply scale(const Request &request);
    Reply count(const Request &request);
    Reply records(const Request &request);
    Reply topk(const Request &request);
    Reply nearest(const Request &request);
    Reply aggregate(const Request &request);
    Json head() const { return head(live_.version()); } // version and now

private:
    struct Look; // how a tile looks: what its parameters say

    Json head(uint64_t version) const;
    // What is asked of tiles: a window of time, and the version of now.
    struct Ask {
        locus_pmq_query query;
        std::string window; // as the parameters tell it
        uint64_t version;
    };

    Cache<std::vector<uint32_t>>::Found counts(const TilePlace &place, uint32_t log2_bins, const Ask &ask);
    std::vector<float> heat(const std::vector<uint32_t> &counts, const TilePlace &place, const Grain &grain,
                            const Ask &ask) const;
    Reference reference(const Look &look, uint32_t zoom, const Ask &ask);
    Cache<std::string>::Made picture(const Look &look, const TilePlace &place, const Ask &ask);

    const Live &live_;
    size_t max_results_;
    std::string boot_; // tells the versions of this run from those of another
    Turns turns_;
    Cache<std::string> pictures_;
    Cache<std::vector<uint32_t>> counts_;
    Cache<Peaks> peaks_; // by time window
    Cache<Reference> references_;
    Cache<std::string> groups_;
    Renewer renewer_; // of the above; ends before they do
};

extern const std::vector<std::string> map_names, scale_names;

} // namespace explorer
