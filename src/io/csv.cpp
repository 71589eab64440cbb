// Splitting CSV rows. The rules of quotes are those of RowReader::scan_quoted.
#include "io/csv.hpp"

#include "core/error.hpp"
#include "io/utf8.hpp"

#include <algorithm>

namespace locus::io {
namespace {

// Take the field at the front off `row`, up to the separator; `last` tells that there was none. `storage` holds the
// field if quotes have to be taken out of it.
std::string_view take_field(std::string_view &row, char separator, std::string &storage, bool &last) {
    if (!row.starts_with('"')) {
        const size_t end = row.find(separator);
        last = end == std::string_view::npos;
        const std::string_view field = row.substr(0, end);
        row.remove_prefix(last ? row.size() : end + 1);
        return field;
    }
    storage.clear();
    size_t at = 0;
    while (at < row.size() && row[at] == '"') {
        if (at > 0)
            storage += '"'; // a doubled quote
        const size_t close = std::min(row.find('"', at + 1), row.size());
        storage += row.substr(at + 1, close - at - 1);
        at = close + 1;
    }
    at = std::min(at, row.size());
    const size_t end = row.find(separator, at);
    last = end == std::string_view::npos;
    storage += row.substr(at, last ? end : end - at); // anything between the closing quote and the separator
    row.remove_prefix(last ? row.size() : end + 1);
    return storage;
}

std::string_view trimmed(std::string_view name) {
    while (name.starts_with(' '))
        name.remove_prefix(1);
    while (name.ends_with(' '))
        name.remove_suffix(1);
    return name;
}

constexpr const char *role_names[] = {"time", "latitude", "longitude", "text"};

} // namespace

CsvParser::CsvParser(std::string_view header, char separator, const Columns &columns) : separator_(separator) {
    std::vector<std::string> found;
    std::string storage;
    std::string_view rest = header;
    for (bool last = false; !last;)
        found.emplace_back(trimmed(take_field(rest, separator, storage, last)));
    for (size_t role = 0; role < role_count; ++role) {
        place_[role] = none;
        for (const std::string &name : columns[role]) {
            const auto column = std::find(found.begin(), found.end(), name);
            if (column == found.end())
                continue;
            place_[role] = static_cast<size_t>(column - found.begin());
            names_[role] = name;
            needed_ = std::max(needed_, place_[role] + 1);
            break;
        }
        // Only the text may be missing, where no column was asked for.
        if (place_[role] != none || columns[role].empty() || (role == text_role && columns[role].size() > 1))
            continue;
        std::string wanted;
        for (const std::string &name : columns[role])
            wanted += (wanted.empty() ? "'" : ", '") + name + "'";
        fail(LOCUS_E_FORMAT, "no column ", wanted, " for the ", role_names[role],
             " in the first row: ", excerpt(header));
    }
}

bool CsvParser::parse(std::string_view row, Values &values) {
    values.fill(Missing{});
    std::string storage;
    bool last = false;
    for (size_t column = 0; column < needed_; ++column) {
        if (last) {
            throw BadRow("only " + std::to_string(column) + " of the " + std::to_string(needed_) +
                         " fields that are needed");
        }
        const std::string_view field = take_field(row, separator_, storage, last);
        for (size_t role = 0; role < role_count; ++role) {
            if (place_[role] != column)
                continue;
            const bool stored = field.data() == storage.data();
            if (stored)
                unquoted_[role] = storage;
            values[role] = stored ? std::string_view(unquoted_[role]) : field;
        }
    }
    return false;
}

} // namespace locus::io
