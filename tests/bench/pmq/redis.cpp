// Peer: Redis GEO, a server of its own on a socket in a scratch folder, without persistence.
#include "tests/bench/harness/cases.hpp"
#include "tests/bench/pmq/databases.hpp"

#if __has_include(<hiredis/hiredis.h>)
#include "tests/bench/harness/scratch.hpp"
#include "tests/bench/harness/server.hpp"

#include <hiredis/hiredis.h>

#include <chrono>
#include <cstring>
#include <thread>

namespace bench {
namespace {

class RedisGeo final : public Database {
public:
    RedisGeo()
        : server_({"redis-server", "--port", "0", "--unixsocket", socket(), "--save", "", "--appendonly", "no", "--dir",
                   scratch_.path().string()}),
          context_(connect()) {}

    /// One GEOADD a batch; a member is the record and its number, which tells equal records apart.
    void insert(std::span<const locus_point32> batch) override {
        std::vector<std::string> words{"GEOADD", "posts"};
        for (const locus_point32 &record : batch) {
            words.push_back(text(record.longitude));
            words.push_back(text(record.latitude));
            std::string member(sizeof record + sizeof next_, '\0');
            std::memcpy(member.data(), &record, sizeof record);
            std::memcpy(member.data() + sizeof record, &next_, sizeof next_);
            ++next_;
            words.push_back(std::move(member));
        }
        std::vector<const char *> parts;
        std::vector<std::size_t> sizes;
        for (const std::string &word : words) {
            parts.push_back(word.data());
            sizes.push_back(word.size());
        }
        take(redisCommandArgv(context_.get(), static_cast<int>(parts.size()), parts.data(), sizes.data()));
    }

    std::size_t read_all(std::span<locus_point32> out) override {
        const Reply reply = take(redisCommand(context_.get(), "ZRANGE posts 0 -1"));
        for (std::size_t i = 0; i < reply->elements; ++i) {
            std::memcpy(&out[i], reply->element[i]->str, sizeof(locus_point32));
        }
        return reply->elements;
    }

private:
    struct Free {
        void operator()(redisReply *reply) const { freeReplyObject(reply); }
        void operator()(redisContext *context) const { redisFree(context); }
    };
    using Reply = std::unique_ptr<redisReply, Free>;

    std::string socket() const { return scratch_.file("redis.sock"); }

    redisContext *connect() const {
        for (int attempt = 0; attempt < 100; ++attempt) {
            redisContext *context = redisConnectUnix(socket().c_str());
            if (context != nullptr && context->err == 0) {
                return context;
            }
            redisFree(context);
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
        throw Missing("redis-server does not start");
    }

    static std::string text(double degrees) {
        char digits[40];
        std::snprintf(digits, sizeof digits, "%.9f", degrees);
        return digits;
    }
    Reply take(void *answer) {
        Reply reply(static_cast<redisReply *>(answer));
        if (!reply || reply->type == REDIS_REPLY_ERROR) {
            throw std::runtime_error(std::string("Redis: ") + (reply ? reply->str : context_->errstr));
        }
        return reply;
    }

    Scratch scratch_;
    Server server_;
    std::unique_ptr<redisContext, Free> context_;
    uint64_t next_ = 0;
};

} // namespace

std::unique_ptr<Database> make_redis_geo() {
    if (std::system("command -v redis-server >/dev/null") != 0) {
        throw Missing("redis-server is not there");
    }
    return std::make_unique<RedisGeo>();
}

} // namespace bench
#else
namespace bench {
std::unique_ptr<Database> make_redis_geo() { throw Missing("built without hiredis.h"); }
} // namespace bench
#endif
