// Rows of CSV (RFC 4180).
#pragma once

#include "io/columns.hpp"

namespace locus::io {

class CsvParser : public RowParser {
public:
    // `header` is the row of column names. Throws LOCUS_E_FORMAT if one that is needed is not there.
    CsvParser(std::string_view header, char separator, const Columns &columns);

    bool parse(std::string_view row, Values &values) override;

    // The name of a role's column.
    const std::string &name(Role role) const { return names_[role]; }

private:
    static constexpr size_t none = SIZE_MAX;

    char separator_;
    std::array<size_t, role_count> place_; // of the role's column
    std::array<std::string, role_count> names_;
    size_t needed_ = 0;                            // columns to look at
    std::array<std::string, role_count> unquoted_; // storage of values with doubled quotes
};

} // namespace locus::io
