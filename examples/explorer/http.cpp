// Replies.
#include "explorer/http.hpp"

#include <nlohmann/json.hpp>

namespace explorer {

Reply text_reply(std::string type, std::string body) {
    Reply reply;
    reply.type = std::move(type);
    reply.body = std::make_shared<const std::string>(std::move(body));
    return reply;
}

Reply error_reply(int status, const std::string &text) {
    const nlohmann::ordered_json json{{"status", status}, {"error", text}};
    constexpr auto replace = nlohmann::ordered_json::error_handler_t::replace;
    Reply reply = text_reply("application/json", json.dump(-1, ' ', false, replace));
    reply.status = status;
    return reply;
}

} // namespace explorer
