// Words and numbers of small text files.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <vector>

namespace volume {

// The words of a line, up to a '#'.
std::vector<std::string> words(const std::string &line);

// The whole word as a number, or nothing.
template <typename T>
std::optional<T> number(const std::string &word) {
    T value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size())
        return std::nullopt;
    return value;
}

// A number in few digits, for people.
std::string short_number(double value);

// A round step (1, 2 or 5 times a power of ten) that divides `range` into about `parts`.
double round_step(double range, int parts);

} // namespace volume
