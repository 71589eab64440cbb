// One value of a row, as CSV or JSON gives it, and what is made of it.
#pragma once

#include <locus/records.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

namespace locus::io {

// Why a row cannot be used.
class BadRow : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

struct Missing {};
struct Unusable {}; // true, false, null, an array or an object
using Value = std::variant<Missing, Unusable, int64_t, double, std::string_view>;

// Degrees, -limit..limit. Throws BadRow, which names the column.
double coordinate(const Value &value, std::string_view column, double limit);

// Microseconds since 1970-01-01 UTC. LOCUS_TIME_AUTO becomes the unit that the first number has. Throws BadRow.
int64_t microseconds(const Value &value, std::string_view column, uint32_t &unit);

} // namespace locus::io
