// Waiting with limits.
#include "explorer/connection.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

namespace explorer {
namespace {

std::chrono::steady_clock::duration seconds(double number) {
    return std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(number));
}

int poll_for(int socket, short events, std::chrono::steady_clock::duration most) {
    pollfd entry{socket, events, 0};
    const auto ms = std::chrono::ceil<std::chrono::milliseconds>(most).count();
    int result = 0;
    do
        result = poll(&entry, 1, static_cast<int>(std::max<int64_t>(ms, 0)));
    while (result < 0 && errno == EINTR);
    return result > 0 && (entry.revents & (events | POLLHUP | POLLERR)) != 0;
}

void address_of(const sockaddr_storage &storage, socklen_t size, std::string &address, int &port) {
    char host[NI_MAXHOST] = "", service[NI_MAXSERV] = "";
    getnameinfo(reinterpret_cast<const sockaddr *>(&storage), size, host, sizeof host, service, sizeof service,
                NI_NUMERICHOST | NI_NUMERICSERV);
    address = host;
    port = std::atoi(service);
}

} // namespace

Connection::Connection(socket_t socket, double wait_seconds, double request_seconds)
    : socket_(socket), wait_(seconds(wait_seconds)), request_(seconds(request_seconds)) {
    const int on = 1;
    setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    begin_request();
}

void Connection::begin_request() { deadline_ = Clock::now() + request_; }
void Connection::no_deadline() { deadline_ = Clock::time_point::max(); }

bool Connection::idle(std::chrono::milliseconds most) const {
    return begin_ < end_ || poll_for(socket_, POLLIN, most) > 0;
}

bool Connection::wait(short events) const {
    const auto now = Clock::now();
    const bool endless = deadline_ == Clock::time_point::max();
    return (endless || now < deadline_) &&
           poll_for(socket_, events, endless ? wait_ : std::min(wait_, deadline_ - now));
}

bool Connection::is_readable() const { return begin_ < end_ || wait(POLLIN); }

// A client that has closed its side is gone.
bool Connection::is_writable() const {
    char byte = 0;
    return wait(POLLOUT) && recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT) != 0;
}

ssize_t Connection::read(char *bytes, size_t size) {
    if (begin_ == end_) {
        if (!wait(POLLIN))
            return -1;
        const ssize_t count = recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
        if (count <= 0)
            return count;
        begin_ = 0;
        end_ = static_cast<size_t>(count);
    }
    const size_t count = std::min(size, end_ - begin_);
    std::memcpy(bytes, buffer_.data() + begin_, count);
    begin_ += count;
    return static_cast<ssize_t>(count);
}

ssize_t Connection::write(const char *bytes, size_t size) {
    if (!wait(POLLOUT))
        return -1;
    return send(socket_, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT);
}

void Connection::get_remote_ip_and_port(std::string &address, int &port) const {
    sockaddr_storage storage{};
    socklen_t size = sizeof storage;
    if (getpeername(socket_, reinterpret_cast<sockaddr *>(&storage), &size) == 0)
        address_of(storage, size, address, port);
}

void Connection::get_local_ip_and_port(std::string &address, int &port) const {
    sockaddr_storage storage{};
    socklen_t size = sizeof storage;
    if (getsockname(socket_, reinterpret_cast<sockaddr *>(&storage), &size) == 0)
        address_of(storage, size, address, port);
}

} // namespace explorer
