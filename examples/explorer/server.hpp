// The server: connections, limits, time limits. The only part that knows cpp-httplib is server.cpp.
#pragma once

#include "explorer/http.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

namespace explorer {

struct ServerSettings {
    std::string bind = "127.0.0.1";
    int port = 8080; // 0: any free one
    size_t threads = 160;
    size_t max_body = 16u << 20; // bytes
    double request_seconds = 30; // for a request and its answer
    double wait_seconds = 10;    // for any one wait
};

class Server {
public:
    using Refusal = std::function<std::optional<Reply>(const Request &)>; // before the body is read
    using Answer = std::function<Reply(const Request &)>;

    // Binds; throws std::runtime_error.
    Server(const ServerSettings &settings, Refusal refusal, Answer answer);
    ~Server();
    Server(const Server &) = delete;
    Server &operator=(const Server &) = delete;

    int port() const;
    void start();
    void stop(); // waits for the answers at work

private:
    class Listener;
    std::unique_ptr<Listener> listener_;
    std::thread thread_;
};

// Is this address one that only this machine reaches?
bool loopback(const std::string &address);

} // namespace explorer
