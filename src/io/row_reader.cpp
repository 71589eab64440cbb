// Finding the ends of rows.
#include "io/row_reader.hpp"

#include <algorithm>
#include <cstring>

namespace locus::io {

constexpr size_t chunk = size_t{1} << 18;

RowReader::RowReader(ByteSource source, size_t max_row)
    : source_(std::move(source)), max_row_(max_row), buffer_(max_row + chunk) {}

void RowReader::restart() {
    found_ = quotes_ = false;
    scanned_ = 0;
    place_ = Place::field_start;
}

void RowReader::set_separator(char separator) {
    separator_ = separator;
    cut_off_ = false; // the row that was seen is still in the buffer
    restart();
}

// More bytes behind those of the buffer, which has room for a chunk beside the longest row. False: there are none.
bool RowReader::fill() {
    if (at_end_)
        return false;
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
    const size_t got = source_.read(buffer_.data() + end_, buffer_.size() - end_);
    at_end_ = got == 0;
    end_ += got;
    return got != 0;
}

// The byte order mark of UTF-8.
void RowReader::skip_mark() {
    begun_ = true;
    while (rest().size() < 3 && fill()) {
    }
    if (rest().starts_with("\xef\xbb\xbf"))
        begin_ += 3;
}

// Drop what is left of a line that was too long.
void RowReader::skip_cut_off() {
    while (cut_off_) {
        const size_t line_end = rest().find('\n');
        if (line_end == std::string_view::npos) {
            begin_ = end_;
            if (fill())
                continue;
        } else {
            begin_ += line_end + 1;
        }
        cut_off_ = false;
        ++lines_;
    }
}

const Row *RowReader::peek() {
    if (found_)
        return &row_;
    if (!begun_)
        skip_mark();
    skip_cut_off();
    while (!found_) {
        if (find_end())
            break;
        if (rest().size() > max_row_) {
            quotes_ &&place_ == Place::quoted ? refuse_open_quote("this length") : refuse_long();
        } else if (!fill()) {
            if (rest().empty())
                return nullptr;
            if (separator_ != 0 && !quotes_) {
                restart();
                scan_quoted();
            }
            place_ == Place::quoted ? refuse_open_quote("the input") : take(rest().size(), rest().size());
        }
    }
    return &row_;
}

// Look for the end of the row in the buffer; the common row without quotes needs no look at every byte.
bool RowReader::find_end() {
    const std::string_view text = rest();
    if (!quotes_) {
        const size_t line_end = text.find('\n', scanned_);
        if (line_end == std::string_view::npos) {
            scanned_ = text.size();
            return false;
        }
        if (separator_ == 0 || text.substr(0, line_end).find('"') == std::string_view::npos) {
            take(line_end, line_end + 1);
            return true;
        }
        restart();
        quotes_ = true;
    }
    return scan_quoted();
}

bool RowReader::scan_quoted() {
    const std::string_view text = rest();
    for (; scanned_ < text.size(); ++scanned_) {
        const char c = text[scanned_];
        if (place_ == Place::quoted) {
            if (c == '"')
                place_ = Place::after_quote;
        } else if (c == '\n') {
            take(scanned_, scanned_ + 1);
            return true;
        } else if (c == separator_) {
            place_ = Place::field_start;
        } else if (c == '"' && place_ != Place::plain) {
            place_ = Place::quoted;
        } else {
            place_ = Place::plain;
        }
    }
    return false;
}

void RowReader::take(size_t length, size_t with_end) {
    if (length > max_row_)
        return refuse("longer than " + std::to_string(max_row_) + " bytes", with_end);
    std::string_view text = rest().substr(0, length);
    if (text.ends_with('\r'))
        text.remove_suffix(1);
    row_ = {text, lines_ + 1, {}};
    row_size_ = with_end;
    found_ = true;
}

void RowReader::refuse(std::string reason, size_t with_end) {
    row_ = {rest().substr(0, std::min<size_t>(with_end, 64)), lines_ + 1, std::move(reason)};
    row_size_ = with_end;
    found_ = true;
}

void RowReader::refuse_long() {
    refuse("longer than " + std::to_string(max_row_) + " bytes", rest().size());
    cut_off_ = true;
}

// The quote is taken for a slip: only the line that opens the row is lost, and the next one is a row again.
void RowReader::refuse_open_quote(const char *where) {
    const size_t line_end = rest().find('\n');
    refuse(std::string("a double quote is not closed before the end of ") + where,
           line_end == std::string_view::npos ? rest().size() : line_end + 1);
}

void RowReader::skip() {
    const std::string_view consumed = rest().substr(0, row_size_);
    const auto line_ends = static_cast<uint64_t>(std::count(consumed.begin(), consumed.end(), '\n'));
    const bool last = !consumed.empty() && !consumed.ends_with('\n') && !cut_off_;
    lines_ += line_ends + (last ? 1 : 0);
    begin_ += row_size_;
    row_size_ = 0;
    restart();
}

bool RowReader::ready() const {
    return found_ || at_end_ || rest().find('\n', scanned_) != std::string_view::npos || source_.ready();
}

} // namespace locus::io
