/* locus/records.hpp - locus::records, the owner of a locus_records (liblocus_io): see locus/records.h. */
#ifndef LOCUS_RECORDS_HPP
#define LOCUS_RECORDS_HPP

#include <locus/io.hpp>
#include <locus/pmq.hpp>
#include <locus/records.h>

namespace locus {

/* The C options with their defaults; an empty column name takes the usual ones. */
template <class Record = locus_text156>
struct records_options : locus_records_options {
    records_options() noexcept {
        locus_records_options_init(this, sizeof(locus_records_options));
        record = record_layout<Record>::value;
    }
    std::string time_column, latitude_column, longitude_column, text_column;
    callback<void(std::uint64_t line, std::string_view reason)> bad_line;
};

template <class Record = locus_text156>
class records {
public:
    explicit records(const std::string &path, const records_options<Record> &options = {}, status *result = nullptr) {
        open(options, result, [&](const locus_records_options &plain, locus_records **made) {
            return locus_records_open(path.c_str(), &plain, made);
        });
    }
    /* From an open descriptor, which stays the caller's; `name` stands for it in error texts. */
    records(int fd, const std::string &name, const records_options<Record> &options = {}, status *result = nullptr) {
        open(options, result, [&](const locus_records_options &plain, locus_records **made) {
            return locus_records_open_fd(fd, name.c_str(), &plain, made);
        });
    }

    explicit operator bool() const noexcept { return handle_ != nullptr; }
    /* The C handle; it stays this object's. */
    locus_records *get() const noexcept { return handle_.get(); }

    /* Read into memory of yours; returns how many records, 0 at the end. */
    std::size_t next(span<Record> into, status *result = nullptr) {
        std::size_t count = 0;
        const locus_status code = locus_records_next(get(), into.data(), into.size(), &count);
        if (kept_ != nullptr)
            kept_->thrown.rethrow();
        detail::settle_io(code, result);
        return count;
    }
    /* Read at most `most` records into a new vector, which is empty at the end. */
    std::vector<Record> next(std::size_t most, status *result = nullptr) {
        std::vector<Record> read(most);
        read.resize(next(read, result));
        return read;
    }
    locus_records_stats stats(status *result = nullptr) const {
        locus_records_stats stats{};
        stats.struct_size = sizeof stats;
        detail::settle_io(locus_records_get_stats(get(), &stats), result);
        return stats;
    }

private:
    struct kept {
        callback<void(std::uint64_t, std::string_view)> bad_line;
        detail::thrown thrown;
        static void on_bad_line(std::uint64_t line, const char *reason, void *user) noexcept {
            auto &self = *static_cast<kept *>(user);
            self.thrown.guard(0, [&] { return self.bad_line(line, reason), 0; });
        }
    };
    template <class Open>
    void open(const records_options<Record> &options, status *result, Open &&open) {
        kept_ = std::make_unique<kept>();
        kept_->bad_line = options.bad_line;
        locus_records_options plain = options;
        const auto name = [](const std::string &text) { return text.empty() ? nullptr : text.c_str(); };
        plain.time_column = name(options.time_column);
        plain.latitude_column = name(options.latitude_column);
        plain.longitude_column = name(options.longitude_column);
        plain.text_column = name(options.text_column);
        plain.bad_line = options.bad_line ? kept::on_bad_line : nullptr;
        plain.bad_line_user = kept_.get();
        locus_records *made = nullptr;
        const locus_status code = open(plain, &made);
        handle_.reset(made);
        detail::settle_io(code, result);
    }

    /* In this order: the handle ends before what its callbacks use. */
    std::unique_ptr<kept> kept_;
    std::unique_ptr<locus_records, detail::ended_by<locus_records_close>> handle_;
};

} // namespace locus
#endif
