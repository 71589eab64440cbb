// Checking parameters.
#include "explorer/arguments.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace explorer {
namespace {

constexpr size_t shown_bytes = 60;

template <typename Number>
std::optional<Number> parsed(const std::string &text) {
    Number number{};
    const char *end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || stop != end)
        return std::nullopt;
    return number;
}

std::string plain(double number) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, number).ptr;
    return std::string(text, end);
}

template <typename Number>
[[noreturn]] void out_of_range(const std::string &name, const std::string &value, Number least, Number most) {
    const auto show = [](Number number) {
        if constexpr (std::is_integral_v<Number>)
            return std::to_string(number);
        else
            return plain(number);
    };
    throw Failure(400, name + ": " + shown(value) + " is outside " + show(least) + ".." + show(most));
}

} // namespace

std::string shown(const std::string &text) {
    std::string result = text.substr(0, shown_bytes);
    for (char &c : result)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            c = '?';
    return result.empty() ? "''" : result + (text.size() > shown_bytes ? "..." : "");
}

Arguments::Arguments(const Request &request) : params_(request.params) {
    for (const auto &[name, value] : params_)
        if (params_.count(name) > 1)
            throw Failure(400, shown(name) + ": given " + std::to_string(params_.count(name)) + " times");
}

const std::string *Arguments::find(const std::string &name) {
    known_.insert(name);
    const auto found = params_.find(name);
    return found == params_.end() ? nullptr : &found->second;
}

std::string Arguments::text(const std::string &name, const std::string &otherwise) {
    const std::string *value = find(name);
    return value == nullptr ? otherwise : *value;
}

std::optional<double> Arguments::number(const std::string &name, double least, double most) {
    const std::string *value = find(name);
    if (value == nullptr)
        return std::nullopt;
    const auto number = parsed<double>(*value);
    if (!number || !std::isfinite(*number))
        throw Failure(400, name + ": " + shown(*value) + " is not a number");
    if (*number < least || *number > most)
        out_of_range(name, *value, least, most);
    return number;
}

std::optional<int64_t> Arguments::integer(const std::string &name, int64_t least, int64_t most) {
    const std::string *value = find(name);
    if (value == nullptr)
        return std::nullopt;
    const auto number = parsed<int64_t>(*value);
    if (!number)
        throw Failure(400, name + ": " + shown(*value) + " is not a whole number");
    if (*number < least || *number > most)
        out_of_range(name, *value, least, most);
    return number;
}

double Arguments::needed_number(const std::string &name, double least, double most) {
    const auto value = number(name, least, most);
    if (!value)
        throw Failure(400, name + ": missing");
    return *value;
}

int64_t Arguments::needed_integer(const std::string &name, int64_t least, int64_t most) {
    const auto value = integer(name, least, most);
    if (!value)
        throw Failure(400, name + ": missing");
    return *value;
}

size_t Arguments::word(const std::string &name, const std::vector<std::string> &words) {
    const std::string *value = find(name);
    if (value == nullptr)
        return 0;
    const auto found = std::find(words.begin(), words.end(), *value);
    if (found != words.end())
        return static_cast<size_t>(found - words.begin());
    std::string list;
    for (const std::string &word : words)
        list += (list.empty() ? "" : ", ") + word;
    throw Failure(400, name + ": " + shown(*value) + " is none of " + list);
}

std::vector<double> Arguments::numbers(const std::string &name, const std::string &text) {
    std::vector<double> result;
    for (size_t begin = 0; begin <= text.size();) {
        const size_t end = std::min(text.find(',', begin), text.size());
        const std::string part = text.substr(begin, end - begin);
        const auto number = parsed<double>(part);
        if (!number || !std::isfinite(*number))
            throw Failure(400, name + ": " + shown(part) + " is not a number");
        result.push_back(*number);
        begin = end + 1;
    }
    return result;
}

void Arguments::done() const {
    for (const auto &[name, value] : params_)
        if (known_.count(name) == 0)
            throw Failure(400, shown(name) + ": no such parameter");
}

} // namespace explorer
