// Numbers and times.
#include "io/values.hpp"

#include "io/utf8.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <optional>
#include <sstream>

namespace locus::io {
namespace {

template <typename... Parts>
[[noreturn]] void bad(const Parts &...parts) {
    std::ostringstream text;
    text.precision(17);
    (text << ... << parts);
    throw BadRow(text.str());
}

std::string_view trimmed(std::string_view text) {
    const size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos)
        return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// The whole of `text` as a number, without a plus sign's help from from_chars.
template <typename Number>
std::optional<Number> number(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-"))
        text.remove_prefix(1);
    Number result{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result);
    if (error != std::errc{} || end != text.data() + text.size())
        return std::nullopt;
    return result;
}

[[noreturn]] void bad_kind(const Value &value, std::string_view column, const char *wanted) {
    if (std::holds_alternative<Missing>(value))
        bad("'", column, "' is missing");
    if (std::holds_alternative<Unusable>(value))
        bad("'", column, "' is not ", wanted);
    const std::string_view text = trimmed(std::get<std::string_view>(value));
    if (text.empty())
        bad("'", column, "' is empty");
    bad("'", column, "' is '", excerpt(text), "', not ", wanted);
}

// Take exactly `digits` digits off the front.
std::optional<int> digits(std::string_view &text, size_t count) {
    if (text.size() < count)
        return std::nullopt;
    int value = 0;
    for (const char c : text.substr(0, count)) {
        if (c < '0' || c > '9')
            return std::nullopt;
        value = 10 * value + (c - '0');
    }
    text.remove_prefix(count);
    return value;
}

bool take(std::string_view &text, std::string_view any) {
    if (text.empty() || any.find(text.front()) == std::string_view::npos)
        return false;
    text.remove_prefix(1);
    return true;
}

// hh:mm, hh:mm:ss or hh:mm:ss.fraction
std::optional<int64_t> time_of_day(std::string_view &text) {
    const auto hour = digits(text, 2);
    if (!hour || *hour > 24 || !take(text, ":"))
        return std::nullopt;
    const auto minute = digits(text, 2);
    if (!minute || *minute > 59)
        return std::nullopt;
    std::optional<int> second = 0;
    int64_t fraction = 0;
    if (take(text, ":")) {
        second = digits(text, 2);
        if (!second || *second > 60)
            return std::nullopt;
        if (take(text, ".,")) {
            int64_t place = 100'000;
            size_t count = 0;
            for (; !text.empty() && text.front() >= '0' && text.front() <= '9'; ++count, place /= 10) {
                fraction += place * (text.front() - '0');
                text.remove_prefix(1);
            }
            if (count == 0)
                return std::nullopt;
        }
    }
    return ((*hour * int64_t{60} + *minute) * 60 + *second) * 1'000'000 + fraction;
}

// Z, +hh, +hhmm or +hh:mm; nothing means UTC.
std::optional<int64_t> zone(std::string_view &text) {
    if (text.empty() || take(text, "Zz"))
        return 0;
    const int64_t sign = text.front() == '-' ? -1 : 1;
    if (!take(text, "+-"))
        return std::nullopt;
    const auto hours = digits(text, 2);
    if (!hours || *hours > 23)
        return std::nullopt;
    std::optional<int> minutes = 0;
    if (!text.empty()) {
        take(text, ":");
        minutes = digits(text, 2);
        if (!minutes || *minutes > 59)
            return std::nullopt;
    }
    return sign * (*hours * int64_t{60} + *minutes) * 60'000'000;
}

std::optional<int64_t> iso_8601(std::string_view text) {
    const auto year = digits(text, 4);
    if (!year || !take(text, "-"))
        return std::nullopt;
    const auto month = digits(text, 2);
    if (!month || !take(text, "-"))
        return std::nullopt;
    const auto day = digits(text, 2);
    if (!day)
        return std::nullopt;
    const std::chrono::year_month_day date{std::chrono::year(*year), std::chrono::month(static_cast<unsigned>(*month)),
                                           std::chrono::day(static_cast<unsigned>(*day))};
    if (!date.ok())
        return std::nullopt;
    int64_t result = std::chrono::sys_days(date).time_since_epoch().count() * int64_t{86'400'000'000};
    if (take(text, "Tt ")) {
        const auto time = time_of_day(text);
        if (!time)
            return std::nullopt;
        take(text, " ");
        const auto offset = zone(text);
        if (!offset)
            return std::nullopt;
        result += *time - *offset;
    }
    if (!text.empty())
        return std::nullopt;
    return result;
}

uint32_t unit_of(double number) {
    const double size = std::abs(number);
    return size < 1e11   ? LOCUS_TIME_SECONDS
           : size < 1e14 ? LOCUS_TIME_MILLISECONDS
           : size < 1e17 ? LOCUS_TIME_MICROSECONDS
                         : LOCUS_TIME_NANOSECONDS;
}

// A number of `unit`s; nothing where 64 bits do not hold the microseconds.
std::optional<int64_t> scaled(int64_t number, uint32_t unit) {
    if (unit == LOCUS_TIME_NANOSECONDS)
        return number / 1000 - (number % 1000 < 0 ? 1 : 0);
    const int64_t factor = unit == LOCUS_TIME_SECONDS ? 1'000'000 : unit == LOCUS_TIME_MILLISECONDS ? 1000 : 1;
    int64_t result = 0;
    if (__builtin_mul_overflow(number, factor, &result))
        return std::nullopt;
    return result;
}

std::optional<int64_t> scaled(double number, uint32_t unit) {
    const double factor = unit == LOCUS_TIME_SECONDS        ? 1e6
                          : unit == LOCUS_TIME_MILLISECONDS ? 1e3
                          : unit == LOCUS_TIME_MICROSECONDS ? 1
                                                            : 1e-3;
    const double result = std::floor(number * factor + (factor > 1 ? 0.5 : 0));
    if (!(std::abs(result) < 9.2e18))
        return std::nullopt;
    return static_cast<int64_t>(result);
}

} // namespace

double coordinate(const Value &value, std::string_view column, double limit) {
    std::optional<double> found;
    if (const auto *whole = std::get_if<int64_t>(&value))
        found = static_cast<double>(*whole);
    if (const auto *real = std::get_if<double>(&value))
        found = *real;
    if (const auto *text = std::get_if<std::string_view>(&value))
        found = number<double>(trimmed(*text));
    if (!found)
        bad_kind(value, column, "a number");
    if (!(std::abs(*found) <= limit))
        bad("'", column, "' is ", *found, ", outside -", limit, "..", limit);
    return *found;
}

int64_t microseconds(const Value &value, std::string_view column, uint32_t &unit) {
    const auto of = [&](auto number) {
        if (unit == LOCUS_TIME_AUTO && std::isfinite(static_cast<double>(number)))
            unit = unit_of(static_cast<double>(number));
        const auto result = scaled(number, unit);
        if (!result)
            bad("'", column, "' is ", number, ", which no 64-bit number of microseconds holds");
        return *result;
    };
    if (const auto *whole = std::get_if<int64_t>(&value))
        return of(*whole);
    if (const auto *real = std::get_if<double>(&value))
        return of(*real);
    if (const auto *raw = std::get_if<std::string_view>(&value)) {
        const std::string_view text = trimmed(*raw);
        if (const auto whole = number<int64_t>(text))
            return of(*whole);
        if (const auto real = number<double>(text))
            return of(*real);
        if (const auto date = iso_8601(text))
            return *date;
    }
    bad_kind(value, column, "a time");
}

} // namespace locus::io
