// The words of texts, counted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace explorer {

// Words of four letters and more, in lower case where they are ASCII; each counts once a text.
class Words {
public:
    void add(std::string_view text);
    std::vector<std::pair<std::string, uint64_t>> most(size_t count) const; // by number, then by letters

private:
    std::unordered_map<std::string, uint64_t> counts_;
};

} // namespace explorer
