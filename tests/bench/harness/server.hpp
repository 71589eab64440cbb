// A server process of a peer: it ends with the object, and with this program however that ends.
#ifndef LOCUS_BENCH_SERVER_HPP
#define LOCUS_BENCH_SERVER_HPP

#include <string>
#include <sys/types.h>
#include <vector>

namespace bench {

/// The words in front of a command that must not run as root and must not outlive us.
std::vector<std::string> as_user(const std::string &user);

class Server {
public:
    /// Start a command; its output is dropped.
    explicit Server(const std::vector<std::string> &command);
    Server(const Server &) = delete;
    Server &operator=(const Server &) = delete;
    /// Ask it to end with SIGINT and wait for it.
    ~Server();

private:
    pid_t pid_;
};

} // namespace bench
#endif
