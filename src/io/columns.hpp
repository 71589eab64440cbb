// The columns a record is made of, and the values that one row has in them.
#pragma once

#include "io/values.hpp"

#include <array>
#include <string>
#include <vector>

namespace locus::io {

enum Role : size_t { time_role, latitude_role, longitude_role, text_role, role_count };

// For every role the names that are accepted, the preferred ones first.
using Columns = std::array<std::vector<std::string>, role_count>;

using Values = std::array<Value, role_count>;

// Turns one row into values, valid until the next row.
class RowParser {
public:
    virtual ~RowParser() = default;
    // True: the row held bytes that are not UTF-8, and they were replaced. Throws BadRow.
    virtual bool parse(std::string_view row, Values &values) = 0;
};

} // namespace locus::io
