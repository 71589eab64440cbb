// Lines, words and numbers of text headers.
#include "io/header_text.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace locus::io {
namespace {

constexpr std::string_view blanks = " \t\r\v\f";

// A value as an error text shows it: bounded, control bytes replaced.
std::string shown(std::string_view value) {
    constexpr size_t most = 80;
    std::string text(value.substr(0, most));
    std::ranges::replace_if(
        text, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
    return '"' + text + (value.size() > most ? "...\"" : "\"");
}

template <typename T>
bool parse_all(std::string_view text, T &value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
}

} // namespace

std::string_view trim(std::string_view text) {
    const size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos)
        return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

bool equal_ignoring_case(std::string_view a, std::string_view b) {
    const auto same = [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); };
    return std::ranges::equal(a, b, same);
}

bool next_line(std::string_view &rest, std::string_view &line) {
    if (rest.empty())
        return false;
    const size_t end = std::min(rest.find('\n'), rest.size());
    line = rest.substr(0, end);
    if (line.ends_with('\r'))
        line.remove_suffix(1);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    return true;
}

std::vector<std::string_view> words(std::string_view text) {
    std::vector<std::string_view> found;
    while (!(text = trim(text)).empty()) {
        const size_t end = std::min(text.find_first_of(blanks), text.size());
        found.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    return found;
}

void HeaderFields::add(std::string_view name, std::string_view value) {
    if (!values_.emplace(name, value).second)
        refuse(name, value, "a second value for the field");
}

std::string_view HeaderFields::optional(std::initializer_list<std::string_view> names) const {
    for (const std::string_view name : names)
        if (const auto found = values_.find(name); found != values_.end())
            return found->second;
    return {};
}

std::string_view HeaderFields::required(std::string_view name) const {
    if (!has(name))
        fail(LOCUS_E_FORMAT, path_, ": the header has no field \"", std::string(name), '"');
    return optional({name});
}

uint64_t HeaderFields::whole(std::string_view name, std::string_view text) const {
    uint64_t value = 0;
    if (!parse_all(text, value))
        refuse(name, text, "not a whole number");
    return value;
}

double HeaderFields::number(std::string_view name, std::string_view text) const {
    double value = 0;
    if (!parse_all(text.starts_with('+') ? text.substr(1) : text, value))
        refuse(name, text, "not a number");
    return value;
}

bool HeaderFields::truth(std::string_view name, std::string_view text) const {
    if (equal_ignoring_case(text, "true") || text == "1")
        return true;
    if (!equal_ignoring_case(text, "false") && text != "0")
        refuse(name, text, "neither True nor False");
    return false;
}

std::vector<uint64_t> HeaderFields::wholes(std::string_view name, std::string_view text, size_t count) const {
    const auto parts = words(text);
    if (parts.size() != count)
        refuse(name, text, "the wrong count of numbers");
    std::vector<uint64_t> values;
    for (const auto part : parts)
        values.push_back(whole(name, part));
    return values;
}

std::vector<double> HeaderFields::numbers(std::string_view name, std::string_view text, size_t count) const {
    const auto parts = words(text);
    if (parts.size() != count)
        refuse(name, text, "the wrong count of numbers");
    std::vector<double> values;
    for (const auto part : parts)
        values.push_back(number(name, part));
    return values;
}

void HeaderFields::refuse(std::string_view name, std::string_view value, const char *why) const {
    fail(LOCUS_E_FORMAT, path_, ": ", std::string(name), " is ", shown(value), ", ", why);
}

void HeaderFields::unsupported(std::string_view name, std::string_view value, const char *why) const {
    fail(LOCUS_E_UNSUPPORTED, path_, ": ", std::string(name), " is ", shown(value), ", ", why);
}

} // namespace locus::io
