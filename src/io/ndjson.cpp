// The top-level members of one JSON object, without building the rest of it.
#include "io/ndjson.hpp"

#include "io/utf8.hpp"

#include <algorithm>
#define JSON_ASSERT(condition) static_cast<void>(0) // nothing in the library ends the process
#include <nlohmann/json.hpp>
#include <optional>

namespace locus::io {
namespace {

using nlohmann::json;

// Events of the parser. Nested arrays and objects are counted and passed over; nesting needs no stack of its own.
class Members : public nlohmann::json_sax<json> {
public:
    Members(const Columns &columns, Values &values, std::array<std::string, role_count> &texts)
        : columns_(columns), values_(values), texts_(texts) {
        rank_.fill(SIZE_MAX);
    }

    bool null() override { return store(Unusable{}); }
    bool boolean(bool) override { return store(Unusable{}); }
    bool number_integer(number_integer_t value) override { return store(int64_t{value}); }
    bool number_unsigned(number_unsigned_t value) override {
        return value > INT64_MAX ? store(static_cast<double>(value)) : store(static_cast<int64_t>(value));
    }
    bool number_float(number_float_t value, const string_t &) override { return store(value); }
    bool binary(binary_t &) override { return store(Unusable{}); }
    bool string(string_t &value) override {
        if (depth_ == 1 && role_)
            texts_[*role_] = std::move(value);
        return store(role_ ? std::string_view(texts_[*role_]) : std::string_view{});
    }
    bool start_object(size_t) override { return open(); }
    bool start_array(size_t) override { return depth_ == 0 ? refuse() : open(); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t &name) override {
        if (depth_ == 1)
            choose(name);
        return true;
    }
    bool parse_error(size_t position, const std::string &, const nlohmann::detail::exception &error) override {
        reason_ = error.what();
        reason_.erase(0, std::min(reason_.size(), reason_.find("] ") + 2)); // [json.exception.parse_error.101]
        if (reason_.starts_with("parse error"))
            reason_.erase(0, std::min(reason_.size(), reason_.find(": ") + 2));
        reason_ = "not JSON at byte " + std::to_string(position) + ": " + reason_;
        return false;
    }

    const std::string &reason() const { return reason_; }

private:
    bool refuse() {
        reason_ = "not a JSON object";
        return false;
    }
    bool store(const Value &value) {
        if (depth_ == 0)
            return refuse();
        if (depth_ == 1 && role_)
            values_[*role_] = value;
        return true;
    }
    bool open() {
        if (depth_ == 1 && role_)
            values_[*role_] = Unusable{};
        ++depth_;
        return true;
    }
    bool close() {
        --depth_;
        return true;
    }
    // The role of a member: one of a preferred name, or the later of two with the same name, wins.
    void choose(const std::string &name) {
        role_.reset();
        for (size_t role = 0; role < role_count; ++role) {
            const auto found = std::find(columns_[role].begin(), columns_[role].end(), name);
            const auto rank = static_cast<size_t>(found - columns_[role].begin());
            if (found == columns_[role].end() || rank > rank_[role])
                continue;
            rank_[role] = rank;
            role_ = role;
        }
    }

    const Columns &columns_;
    Values &values_;
    std::array<std::string, role_count> &texts_;
    std::array<size_t, role_count> rank_;
    std::optional<size_t> role_; // of the member that is being read
    size_t depth_ = 0;
    std::string reason_;
};

} // namespace

bool JsonParser::parse(std::string_view row, Values &values) {
    std::string storage;
    const bool repaired = !valid_utf8(row);
    if (repaired)
        row = storage = repaired_utf8(row);
    values.fill(Missing{});
    Members members(columns_, values, texts_);
    if (!json::sax_parse(row.begin(), row.end(), &members))
        throw BadRow(members.reason());
    return repaired;
}

} // namespace locus::io
