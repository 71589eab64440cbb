// Rows of newline-delimited JSON.
#pragma once

#include "io/columns.hpp"

namespace locus::io {

class JsonParser : public RowParser {
public:
    explicit JsonParser(const Columns &columns) : columns_(columns) {}

    bool parse(std::string_view row, Values &values) override;

private:
    Columns columns_;
    std::array<std::string, role_count> texts_; // storage of the values that are strings
};

} // namespace locus::io
