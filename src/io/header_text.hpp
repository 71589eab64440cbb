// Text headers: bounded, locale-free parsing of lines and numbers, with errors that quote what is wrong.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace locus::io {

std::string_view trim(std::string_view text);
bool equal_ignoring_case(std::string_view a, std::string_view b);

// The next line of `rest` without its end (LF or CR LF), which is taken off; false at the end of the text.
bool next_line(std::string_view &rest, std::string_view &line);

// The fields of one header by name.
class HeaderFields {
public:
    explicit HeaderFields(std::string path) : path_(std::move(path)) {}

    void add(std::string_view name, std::string_view value); // a second one of the name is an error
    bool has(std::string_view name) const { return values_.contains(name); }
    // The value of the first of these names that is there; "" when none is.
    std::string_view optional(std::initializer_list<std::string_view> names) const;
    std::string_view required(std::string_view name) const;

    // Words, numbers and truth values of a field's text; `name` is for the error alone.
    uint64_t whole(std::string_view name, std::string_view text) const;
    double number(std::string_view name, std::string_view text) const;
    bool truth(std::string_view name, std::string_view text) const;
    std::vector<uint64_t> wholes(std::string_view name, std::string_view text, size_t count) const;
    std::vector<double> numbers(std::string_view name, std::string_view text, size_t count) const;

    // LOCUS_E_FORMAT or LOCUS_E_UNSUPPORTED: "path: name is "value", why".
    [[noreturn]] void refuse(std::string_view name, std::string_view value, const char *why) const;
    [[noreturn]] void unsupported(std::string_view name, std::string_view value, const char *why) const;

private:
    std::string path_;
    std::map<std::string, std::string, std::less<>> values_;
};

std::vector<std::string_view> words(std::string_view text);

} // namespace locus::io
