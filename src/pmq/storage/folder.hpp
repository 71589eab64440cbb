// The folder of a store: store-NUMBER, saved files, and log-NUMBER, what happened since that save (or since the log
// began, while the save is still being written).
#pragma once

#include "core/file.hpp"

#include <vector>

namespace locus::pmq {

class Folder {
public:
    // Open it, make it if it is not there, and keep every other store out while this lives.
    explicit Folder(const std::string &path);

    const std::string &path() const noexcept { return path_; }
    std::string saved(uint64_t number) const { return name("store-", number); }
    std::string log(uint64_t number) const { return name("log-", number); }

    struct Content {
        std::vector<uint64_t> saved, logs; // numbers, ascending
        bool empty() const noexcept { return saved.empty() && logs.empty(); }
    };
    Content content() const;
    // Remove saved files and logs with a smaller number, and what interrupted saves have left. Failures can wait.
    void tidy(uint64_t least) const noexcept;

private:
    std::string name(const char *kind, uint64_t number) const;

    std::string path_;
    Descriptor lock_;
};

} // namespace locus::pmq
