// Requests and replies, apart from the library that carries them.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace explorer {

struct Request {
    std::string method;
    std::string path;                               // decoded
    std::multimap<std::string, std::string> params; // of the query, decoded
    std::map<std::string, std::string> headers;     // names in lower case
    std::string body;
    std::string header(const std::string &name) const {
        const auto found = headers.find(name);
        return found == headers.end() ? "" : found->second;
    }
};

// Writes the next piece of an endless answer with `send`, which returns false once the client is gone. False: the end.
using Send = std::function<bool(const std::string &)>;
using Stream = std::function<bool(const Send &send)>;

struct Reply {
    int status = 200;
    std::string type;
    std::shared_ptr<const std::string> body = std::make_shared<const std::string>();
    std::vector<std::pair<std::string, std::string>> headers;
    Stream stream; // instead of the body
};

// What went wrong, as the client gets it.
class Failure : public std::runtime_error {
public:
    Failure(int status, const std::string &text) : std::runtime_error(text), status_(status) {}
    int status() const { return status_; }

private:
    int status_;
};

Reply text_reply(std::string type, std::string body);
Reply error_reply(int status, const std::string &text);

} // namespace explorer
