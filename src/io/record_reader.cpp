// Rows to records.
#include "io/record_reader.hpp"

#include "io/csv.hpp"
#include "io/ndjson.hpp"
#include "io/utf8.hpp"

#include <algorithm>
#include <cstring>

namespace locus::io {
namespace {

std::vector<std::string> names(const char *wanted, std::initializer_list<const char *> usual) {
    if (wanted != nullptr)
        return {wanted};
    return {usual.begin(), usual.end()};
}

bool blank(std::string_view text) { return text.find_first_not_of(" \t") == std::string_view::npos; }

} // namespace

RecordReader::RecordReader(ByteSource source, const locus_records_options &options)
    : rows_(std::move(source), options.max_line), record_(options.record), format_(options.format),
      time_unit_(options.time_unit), refuse_(options.bad_lines == LOCUS_BAD_LINES_REFUSE),
      separator_(static_cast<char>(options.separator)), bad_line_(options.bad_line),
      bad_line_user_(options.bad_line_user) {
    columns_[time_role] = names(options.time_column, {"time", "timestamp", "datetime", "date", "created_at"});
    columns_[latitude_role] = names(options.latitude_column, {"lat", "latitude", "y"});
    columns_[longitude_role] = names(options.longitude_column, {"lon", "lng", "long", "longitude", "x"});
    if (record_ == LOCUS_RECORD_TEXT156)
        columns_[text_role] = names(options.text_column, {"text", "message", "name"});
}

std::string RecordReader::place(uint64_t line) const {
    return rows_.source().name() + ", line " + std::to_string(line) + ": ";
}

// Find out the format and read the column names.
void RecordReader::begin() {
    const Row *first = rows_.peek();
    for (; first != nullptr && first->bad.empty() && blank(first->text); first = rows_.peek())
        rows_.skip();
    if (first == nullptr)
        return;
    if (format_ == LOCUS_RECORDS_AUTO) {
        const size_t begin = first->text.find_first_not_of(" \t");
        const bool object = begin != std::string_view::npos && first->text[begin] == '{';
        format_ = object ? LOCUS_RECORDS_NDJSON : LOCUS_RECORDS_CSV;
    }
    for (size_t role = 0; role < text_role; ++role)
        names_[role] = columns_[role].front();
    if (format_ == LOCUS_RECORDS_NDJSON) {
        parser_ = std::make_unique<JsonParser>(columns_);
        return;
    }
    rows_.set_separator(separator_);
    first = rows_.peek();
    if (!first->bad.empty())
        fail(LOCUS_E_FORMAT, place(first->line), "the column names: ", first->bad);
    auto parser = std::make_unique<CsvParser>(first->text, separator_, columns_);
    for (size_t role = 0; role < text_role; ++role)
        names_[role] = parser->name(static_cast<Role>(role));
    parser_ = std::move(parser);
    rows_.skip();
}

void RecordReader::tell(uint64_t line, const std::string &reason) {
    if (refuse_)
        fail(LOCUS_E_FORMAT, place(line), reason);
    ++bad_;
    if (bad_line_ != nullptr)
        bad_line_(line, reason.c_str(), bad_line_user_);
}

void RecordReader::store_text(locus_text156 &record) {
    const auto *value = std::get_if<std::string_view>(&values_[text_role]);
    if (value == nullptr)
        return;
    std::string_view text = *value;
    std::string storage;
    if (!valid_utf8(text)) {
        text = storage = repaired_utf8(text);
        ++repaired_;
    }
    const std::string_view kept = cut_utf8(text, sizeof record.text);
    if (kept.size() < text.size())
        ++cut_;
    std::replace_copy(kept.begin(), kept.end(), record.text, '\0', ' ');
}

void RecordReader::store(void *record, double latitude, double longitude, int64_t time) {
    if (record_ == LOCUS_RECORD_POINT32) {
        const locus_point32 point{latitude, longitude, time, 0, 0, 0, 0};
        std::memcpy(record, &point, sizeof point);
        return;
    }
    locus_text156 text{static_cast<float>(latitude), static_cast<float>(longitude), time, {}};
    store_text(text);
    std::memcpy(record, &text, sizeof text);
}

// False: the row is a bad line, and has been told.
bool RecordReader::read_row(const Row &row, void *record) {
    std::string reason = row.bad;
    if (reason.empty()) {
        try {
            const bool repaired = parser_->parse(row.text, values_);
            const double latitude = coordinate(values_[latitude_role], names_[latitude_role], 90);
            const double longitude = coordinate(values_[longitude_role], names_[longitude_role], 180);
            const int64_t time = microseconds(values_[time_role], names_[time_role], time_unit_);
            store(record, latitude, longitude, time);
            if (repaired)
                ++repaired_;
            return true;
        } catch (const BadRow &bad) {
            reason = bad.what();
        }
    }
    tell(row.line, reason);
    return false;
}

// False: there is no further record.
bool RecordReader::read_one(void *record) {
    while (const Row *row = rows_.peek()) {
        const bool good = (!row->bad.empty() || !blank(row->text)) && read_row(*row, record);
        rows_.skip();
        if (good)
            return true;
    }
    return false;
}

size_t RecordReader::next(void *records, size_t capacity) {
    if (error_)
        throw *error_;
    size_t count = 0;
    try {
        if (!parser_)
            begin();
        auto *place = static_cast<char *>(records);
        while (parser_ && count < capacity && (count == 0 || rows_.ready()) && read_one(place + count * record_)) {
            ++count;
            ++records_;
        }
    } catch (const Error &error) {
        error_ = error;
        if (count == 0)
            throw;
    } catch (const std::bad_alloc &) {
        if (count == 0)
            throw;
    }
    return count;
}

locus_records_stats RecordReader::stats() const {
    return {sizeof(locus_records_stats), records_, bad_, cut_, repaired_, rows_.lines(), rows_.source().bytes_read(),
            rows_.source().size()};
}

} // namespace locus::io
