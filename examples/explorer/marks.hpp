// How far the cold tier of a folder was when each saved file of the store was: one line of older.marks a file, its
// number and the records that the tier had taken over.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace explorer {

class Marks {
public:
    explicit Marks(const std::string &folder); // throws std::runtime_error where older.marks is no such file

    std::optional<uint64_t> find(uint64_t number) const;
    // Keep it, on the disk when this returns; of the numbers below `least` nothing is told any more. Throws
    // std::runtime_error.
    void keep(uint64_t number, uint64_t received, uint64_t least);
    const std::string &path() const { return path_; }

private:
    std::string folder_, path_;
    std::map<uint64_t, uint64_t> marks_;
};

} // namespace explorer
