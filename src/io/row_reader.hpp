// Rows of a text in bounded memory: lines, or CSV rows whose quoted fields may hold line ends.
#pragma once

#include "io/byte_source.hpp"

#include <string_view>

namespace locus::io {

struct Row {
    std::string_view text; // without its line end; valid until skip(). Of a bad row, its beginning
    uint64_t line = 0;     // number of its first line, from 1
    std::string bad;       // why the row cannot be used; empty: it can
};

class RowReader {
public:
    // Rows longer than `max_row` bytes are bad ones.
    RowReader(ByteSource source, size_t max_row);

    // From the next row on, double quotes protect separators and line ends (CSV); at first they do not.
    void set_separator(char separator);

    // The next row, which stays the next one until skip(); null at the end.
    const Row *peek();
    void skip();

    // False: the next row may have to wait for a pipe.
    bool ready() const;

    const ByteSource &source() const { return source_; }
    uint64_t lines() const { return lines_; }

private:
    // Where the scan of a row with quotes stands.
    enum class Place { field_start, plain, quoted, after_quote };

    bool fill();
    void skip_mark();
    void skip_cut_off();
    bool find_end();
    bool scan_quoted();
    void take(size_t length, size_t with_end);
    void refuse(std::string reason, size_t with_end);
    void refuse_long();
    void refuse_open_quote(const char *where);
    void restart();
    std::string_view rest() const { return {buffer_.data() + begin_, end_ - begin_}; }

    ByteSource source_;
    size_t max_row_;
    char separator_ = 0;
    std::vector<char> buffer_; // buffer_[begin_, end_) is not consumed yet
    size_t begin_ = 0;
    size_t end_ = 0;
    bool begun_ = false;
    bool at_end_ = false; // of the source
    uint64_t lines_ = 0;
    bool cut_off_ = false; // the line goes on behind what is to be skipped

    // The row that was found, or the search for it.
    bool found_ = false;
    Row row_;
    size_t row_size_ = 0; // with its line end
    size_t scanned_ = 0;  // bytes that were searched
    bool quotes_ = false; // scan_quoted() is at work, at `place_`
    Place place_ = Place::field_start;
};

} // namespace locus::io
