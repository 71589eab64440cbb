// A client's connection, which is cut off when the client is too slow.
#pragma once

#include <httplib.h>

#include <array>
#include <chrono>

namespace explorer {

class Connection : public httplib::Stream {
public:
    Connection(socket_t socket, double wait_seconds, double request_seconds);

    // Wait for a request, at most so long. False: none came.
    bool idle(std::chrono::milliseconds most) const;
    void begin_request(); // the time for a request and its answer runs from here
    void no_deadline();   // an endless answer: each wait is bounded all the same
    bool cut() const { return cut_; }
    void cut_after_answer() { cut_ = true; } // a body was not read

    bool is_readable() const override;
    bool is_writable() const override;
    ssize_t read(char *bytes, size_t size) override;
    ssize_t write(const char *bytes, size_t size) override;
    void get_remote_ip_and_port(std::string &address, int &port) const override;
    void get_local_ip_and_port(std::string &address, int &port) const override;
    socket_t socket() const override { return socket_; }

private:
    using Clock = std::chrono::steady_clock;

    bool wait(short events) const;

    socket_t socket_;
    Clock::duration wait_, request_;
    Clock::time_point deadline_;
    bool cut_ = false;
    std::array<char, 4096> buffer_; // bytes read ahead: requests are read by single bytes
    size_t begin_ = 0, end_ = 0;
};

} // namespace explorer
