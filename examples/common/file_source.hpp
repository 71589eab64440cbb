// A stream read from a file or standard input.
#pragma once

#include "common/source.hpp"

#include <locus/records.h>

#include <memory>

namespace demo {

class FileSource : public Source {
public:
    // `path` may be "-" for standard input. `options` need no callback.
    FileSource(const std::string &path, locus_records_options options);

    void next(std::vector<locus_text156> &batch, size_t count) override;
    double fraction() const override;
    std::vector<std::string> remarks() const override;

private:
    struct Close {
        void operator()(locus_records *reader) const { locus_records_close(reader); }
    };
    struct BadLines {
        std::vector<std::string> first; // a few of them, as text
        static void keep(uint64_t line, const char *reason, void *user);
    };

    locus_records_stats stats() const;

    BadLines bad_lines_;
    std::unique_ptr<locus_records, Close> reader_;
};

} // namespace demo
