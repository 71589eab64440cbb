// Carrying requests and replies by cpp-httplib, over connections of our own.
#include "explorer/server.hpp"

#include "explorer/connection.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <sys/socket.h>
#include <unistd.h>

namespace explorer {
namespace {

constexpr auto keep_alive = std::chrono::seconds(2);
constexpr int most_requests = 1000; // of one connection
constexpr int backlog = 512;        // connections the system keeps for us

// The connection that this thread serves, and what was said of its request before the body was read.
thread_local Connection *current = nullptr;

Request request_of(const httplib::Request &from) {
    Request request;
    request.method = from.method;
    request.path = from.path;
    request.params = from.params;
    for (const auto &[name, value] : from.headers) {
        std::string lower = name;
        std::transform(lower.begin(), lower.end(), lower.begin(),
                       [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
        request.headers.emplace(lower, value);
    }
    request.body = from.body;
    return request;
}

void send_reply(const Reply &reply, httplib::Response &to) {
    to.status = reply.status;
    for (const auto &[name, value] : reply.headers)
        to.set_header(name, value);
    if (reply.stream) {
        current->no_deadline();
        to.set_chunked_content_provider(reply.type, [stream = reply.stream](size_t, httplib::DataSink &sink) {
            const bool more = stream(
                [&](const std::string &text) { return sink.is_writable() && sink.write(text.data(), text.size()); });
            if (!more)
                sink.done();
            return more;
        });
    } else if (reply.status != 304) {
        // Not as a body, which httplib would compress: Brotli at its best takes seconds for the map of the world.
        const auto write = [body = reply.body](size_t offset, size_t length, httplib::DataSink &sink) {
            return sink.write(body->data() + offset, length);
        };
        to.set_content_provider(reply.body->size(), reply.type, write);
    }
}

} // namespace

class Server::Listener : public httplib::Server {
public:
    Listener(const ServerSettings &settings, Refusal refusal, Answer answer)
        : settings_(settings), refusal_(std::move(refusal)), answer_(std::move(answer)) {
        new_task_queue = [threads = settings.threads] { return new httplib::ThreadPool(threads); };
        set_keep_alive_timeout(std::chrono::seconds(keep_alive).count());
        set_keep_alive_max_count(most_requests);
        set_payload_max_length(settings.max_body);
        set_socket_options([this](socket_t socket) {
            const int on = 1;
            setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
            listening_ = socket;
        });
        set_pre_routing_handler(
            [this](const httplib::Request &from, httplib::Response &to) { return before(from, to); });
        const auto handle = [this](const httplib::Request &from, httplib::Response &to) {
            send_reply(answer_(request_of(from)), to);
        };
        Get(".*", handle);
        Post(".*", handle);
        set_error_handler([](const httplib::Request &, httplib::Response &to) { wrong(to); });
        errno = 0;
        port_ = settings.port == 0 ? bind_to_any_port(settings.bind) : settings.port;
        if (port_ < 0 || (settings.port != 0 && !bind_to_port(settings.bind, settings.port)))
            throw std::runtime_error("cannot listen at " + settings.bind + ":" + std::to_string(settings.port) + ": " +
                                     (errno != 0 ? std::strerror(errno) : "no such address"));
        ::listen(listening_, backlog);
    }

    int port() const { return port_; }

private:
    // The loop of httplib's own, with our connection in it.
    bool process_and_close_socket(socket_t socket) override {
        Connection connection(socket, settings_.wait_seconds, settings_.request_seconds);
        current = &connection;
        bool closed = false;
        for (int left = most_requests; left > 0 && !closed && !connection.cut() && svr_sock_ != INVALID_SOCKET;
             --left) {
            if (!wait_for_request(connection))
                break;
            connection.begin_request();
            if (!process_request(connection, left == 1, closed, nullptr))
                break;
        }
        current = nullptr;
        shutdown(socket, SHUT_RDWR);
        close(socket);
        return true;
    }

    // In steps, so that the end of the server is noticed.
    bool wait_for_request(const Connection &connection) const {
        constexpr auto step = std::chrono::milliseconds(100);
        for (auto waited = std::chrono::milliseconds(0); waited < keep_alive; waited += step)
            if (connection.idle(step))
                return true;
            else if (svr_sock_ == INVALID_SOCKET)
                return false;
        return false;
    }

    HandlerResponse before(const httplib::Request &from, httplib::Response &to) {
        const auto refused = refusal_(request_of(from));
        if (!refused)
            return HandlerResponse::Unhandled;
        send_reply(*refused, to);
        current->cut_after_answer(); // its body may lie unread
        return HandlerResponse::Handled;
    }

    // What httplib itself refuses: requests it cannot read, bodies too large. Answers of ours carry a policy.
    static void wrong(httplib::Response &to) {
        if (to.has_header("Content-Security-Policy"))
            return;
        const char *text = to.status == 413   ? "body: too large"
                           : to.status == 414 ? "url: too long"
                           : to.status == 416 ? "range: outside the answer"
                                              : "the request cannot be read";
        current->cut_after_answer();
        Reply reply = error_reply(to.status, text);
        reply.headers = {{"X-Content-Type-Options", "nosniff"}, {"Cache-Control", "no-store"}};
        send_reply(reply, to);
    }

    ServerSettings settings_;
    Refusal refusal_;
    Answer answer_;
    socket_t listening_ = INVALID_SOCKET;
    int port_ = 0;
};

Server::Server(const ServerSettings &settings, Refusal refusal, Answer answer)
    : listener_(std::make_unique<Listener>(settings, std::move(refusal), std::move(answer))) {}

Server::~Server() { stop(); }

int Server::port() const { return listener_->port(); }

void Server::start() {
    thread_ = std::thread([this] { listener_->listen_after_bind(); });
}

void Server::stop() {
    if (!thread_.joinable())
        return;
    listener_->stop();
    thread_.join();
}

bool loopback(const std::string &address) {
    in_addr four{};
    in6_addr six{};
    if (inet_pton(AF_INET, address.c_str(), &four) == 1)
        return ntohl(four.s_addr) >> 24 == 127;
    if (inet_pton(AF_INET6, address.c_str(), &six) == 1)
        return IN6_IS_ADDR_LOOPBACK(&six);
    return address == "localhost";
}

} // namespace explorer
