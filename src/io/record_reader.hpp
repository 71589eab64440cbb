// Records from rows: the reader behind locus/records.h.
#pragma once

#include "core/error.hpp"
#include "io/columns.hpp"
#include "io/row_reader.hpp"

#include <memory>
#include <optional>

namespace locus::io {

class RecordReader {
public:
    // The options are checked and whole.
    RecordReader(ByteSource source, const locus_records_options &options);

    // See locus_records_next.
    size_t next(void *records, size_t capacity);
    locus_records_stats stats() const;

private:
    void begin();
    bool read_row(const Row &row, void *record);
    bool read_one(void *record);
    void store(void *record, double latitude, double longitude, int64_t time);
    void store_text(locus_text156 &record);
    void tell(uint64_t line, const std::string &reason);
    std::string place(uint64_t line) const;

    RowReader rows_;
    uint32_t record_;
    uint32_t format_;
    uint32_t time_unit_;
    bool refuse_;
    char separator_;
    Columns columns_;
    locus_bad_line_fn bad_line_;
    void *bad_line_user_;

    std::unique_ptr<RowParser> parser_;        // null before the first row
    std::array<std::string, text_role> names_; // of the columns, for error texts
    Values values_;
    uint64_t records_ = 0;
    uint64_t bad_ = 0;
    uint64_t cut_ = 0;
    uint64_t repaired_ = 0;
    std::optional<Error> error_; // what every call from now on results in
};

} // namespace locus::io
