// One handle at a time: a file beside the database, locked as long as the handle lives.
#pragma once

#include <string>

namespace locus::cold {

class LockFile {
public:
    explicit LockFile(std::string path); // throws Error(LOCUS_E_BUSY) when another one holds it
    ~LockFile();
    LockFile(const LockFile &) = delete;
    LockFile &operator=(const LockFile &) = delete;

private:
    bool take();
    const std::string path_;
    int descriptor_ = -1;
};

} // namespace locus::cold
