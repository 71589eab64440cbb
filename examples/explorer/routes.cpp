// Finding the answer, and what every answer carries.
#include "explorer/routes.hpp"

#include "explorer/arguments.hpp"

#include <algorithm>
#include <charconv>
#include <map>

namespace explorer {
namespace {

constexpr const char *ingest_path = "/ingest";
constexpr const char *content_policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; "
    "font-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

// The part of a path up to `end`, a number below `bound`, taken off its front.
std::optional<uint32_t> take_number(std::string_view &path, char end, uint64_t bound) {
    uint32_t number = 0;
    const auto [stop, wrong] = std::from_chars(path.data(), path.data() + path.size(), number);
    if (wrong != std::errc() || stop == path.data() + path.size() || *stop != end || number >= bound)
        return std::nullopt;
    path.remove_prefix(static_cast<size_t>(stop + 1 - path.data()));
    return number;
}

// /tiles/z/x/y. and what stands behind the dot.
std::pair<TilePlace, std::string> parse_tile(std::string_view path) {
    const std::string whole(path);
    path.remove_prefix(std::string_view("/tiles/").size());
    const auto zoom = take_number(path, '/', 26);
    const auto x = zoom ? take_number(path, '/', uint64_t{1} << *zoom) : std::nullopt;
    const auto y = x ? take_number(path, '.', uint64_t{1} << *zoom) : std::nullopt;
    if (!y || (path != "png" && path != "json"))
        throw Failure(404, shown(whole) + ": no tile (/tiles/z/x/y.png or .json, z 0..25, x and y below 2^z)");
    return {{*zoom, *x, *y}, std::string(path)};
}

// Host without its port.
std::string host_name(const std::string &host) {
    const size_t bracket = host.find(']');
    const size_t colon = host.find(':', bracket == std::string::npos ? 0 : bracket);
    return host.substr(0, colon);
}

bool our_name(const std::string &host) {
    const std::string name = host_name(host);
    return name == "localhost" || name == "127.0.0.1" || name == "[::1]";
}

} // namespace

Routes::Routes(RouteSettings settings, Answers &answers, Events &events, const AlertLog &alerts,
               const Statistics &statistics, Ingest &ingest, const Assets &assets, Counters &counters)
    : settings_(std::move(settings)), answers_(answers), events_(events), alerts_(alerts), statistics_(statistics),
      ingest_(ingest), assets_(assets), counters_(counters) {}

std::optional<Reply> Routes::refusal(const Request &request) const {
    try {
        if (settings_.loopback && !our_name(request.header("host")))
            throw Failure(421, "host: " + shown(request.header("host")) + " is not localhost, 127.0.0.1 or [::1]");
        if (request.header("range").find(',') != std::string::npos)
            throw Failure(400, "range: more than one");
        const bool known = request.path == ingest_path;
        const bool reads = request.method == "GET" || request.method == "HEAD";
        if (known ? request.method != "POST" : !reads) {
            Reply reply = error_reply(405, shown(request.method) + " " + shown(request.path) + ": no such method");
            reply.headers = {{"Allow", known ? "POST" : "GET, HEAD"}};
            add_headers(request, reply);
            return reply;
        }
        if (known)
            ingest_.admit(request);
    } catch (const Failure &failure) {
        Reply reply = error_reply(failure.status(), failure.what());
        if (failure.status() == 401)
            reply.headers = {{"WWW-Authenticate", "Bearer"}};
        add_headers(request, reply);
        return reply;
    }
    return std::nullopt;
}

Reply Routes::answer(const Request &request) {
    Reply reply;
    try {
        reply = dispatch(request);
    } catch (const Failure &failure) {
        reply = error_reply(failure.status(), failure.what());
    } catch (const std::bad_alloc &) {
        reply = error_reply(503, "out of memory");
    } catch (const std::exception &error) {
        reply = error_reply(500, error.what());
    }
    if (reply.status == 503)
        reply.headers.emplace_back("Retry-After", "1");
    add_headers(request, reply);
    counters_.requests.fetch_add(1);
    if (reply.status >= 400)
        counters_.failures.fetch_add(1);
    return reply;
}

Reply Routes::dispatch(const Request &request) {
    if (request.path == ingest_path)
        return ingest_.take(request);
    if (request.path.starts_with("/tiles/")) {
        const auto begin = Latency::Clock::now();
        const auto [place, kind] = parse_tile(request.path);
        Reply reply = answers_.tile(request, place, kind == "png");
        counters_.tiles.add(static_cast<uint64_t>(std::chrono::nanoseconds(Latency::Clock::now() - begin).count()));
        return reply;
    }
    if (const Reply *file = assets_.find(request.path)) {
        Reply reply = *file;
        if (request.header("if-none-match") == reply.headers.back().second) {
            reply.status = 304;
            reply.body = std::make_shared<const std::string>();
        }
        return reply;
    }
    return get(request);
}

Reply Routes::get(const Request &request) {
    using Handler = Reply (*)(Routes &, const Request &);
    static const std::map<std::string, Handler> handlers{
        {"/scale", [](Routes &self, const Request &request) { return self.answers_.scale(request); }},
        {"/count", [](Routes &self, const Request &request) { return self.answers_.count(request); }},
        {"/records", [](Routes &self, const Request &request) { return self.answers_.records(request); }},
        {"/topk", [](Routes &self, const Request &request) { return self.answers_.topk(request); }},
        {"/nearest", [](Routes &self, const Request &request) { return self.answers_.nearest(request); }},
        {"/aggregate", [](Routes &self, const Request &request) { return self.answers_.aggregate(request); }},
        {"/alerts", [](Routes &self, const Request &request) { return self.alerts(request); }},
        {"/events", [](Routes &self, const Request &request) { return self.events_.listen(request); }},
        {"/stats", [](Routes &self, const Request &) { return json_reply(self.statistics_.stats()); }},
        {"/info", [](Routes &self, const Request &) { return json_reply(self.statistics_.info()); }},
        {"/metrics", [](Routes &self, const Request &) { return self.statistics_.metrics(); }},
        {"/healthz", [](Routes &self, const Request &) { return self.statistics_.health(); }},
    };
    const auto found = handlers.find(request.path);
    if (found == handlers.end())
        throw Failure(404, shown(request.path) + ": no such path");
    return found->second(*this, request);
}

Reply Routes::alerts(const Request &request) const {
    Arguments arguments(request);
    const auto since = arguments.integer("since", 0, INT64_MAX).value_or(0);
    const auto limit = arguments.integer("limit", 1, 1000).value_or(100);
    arguments.done();
    auto alerts = alerts_.since(static_cast<uint64_t>(since), static_cast<size_t>(limit));
    std::reverse(alerts.begin(), alerts.end());
    Json json = answers_.head();
    json["last"] = alerts_.last();
    json["alerts"] = std::move(alerts);
    return json_reply(json);
}

void Routes::add_headers(const Request &request, Reply &reply) const {
    const std::string &origin = settings_.allow_origin;
    const bool theirs = !origin.empty() && (origin == "*" || request.header("origin") == origin);
    reply.headers.insert(reply.headers.end(),
                         {{"Content-Security-Policy", content_policy},
                          {"X-Content-Type-Options", "nosniff"},
                          {"X-Frame-Options", "DENY"},
                          {"Referrer-Policy", "no-referrer"},
                          {"Cross-Origin-Resource-Policy", origin.empty() ? "same-origin" : "cross-origin"}});
    if (theirs)
        reply.headers.emplace_back("Access-Control-Allow-Origin", origin);
    if (!origin.empty())
        reply.headers.emplace_back("Vary", "Origin");
    bool cached = false;
    for (const auto &[name, value] : reply.headers)
        cached = cached || name == "Cache-Control";
    if (!cached)
        reply.headers.emplace_back("Cache-Control", "no-store");
}

} // namespace explorer
