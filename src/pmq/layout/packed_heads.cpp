#include "pmq/layout/packed_heads.hpp"

#include <algorithm>

namespace locus::pmq {

Heads::Heads(size_t segments) {
    for (size_t size = segments; size > 0; size = size > step ? (size + step - 1) / step : 0)
        levels_.emplace_back(size);
}

size_t Heads::bytes(size_t segments) noexcept {
    size_t keys = segments;
    for (size_t size = segments; size > step; keys += size)
        size = (size + step - 1) / step;
    return keys * sizeof(uint64_t);
}

void Heads::renew(size_t first, size_t segments) noexcept {
    size_t end = first + segments;
    for (size_t level = 1; level < levels_.size(); ++level) {
        first = (first + step - 1) / step;
        end = (end + step - 1) / step;
        for (size_t i = first; i < end; ++i)
            levels_[level][i] = levels_[level - 1][i * step];
    }
}

size_t Heads::find_below(uint64_t key) const noexcept {
    size_t found = 0; // of a level: the last key below `key`
    for (size_t level = levels_.size(); level-- > 0;) {
        const std::vector<uint64_t> &keys = levels_[level];
        const size_t from = level + 1 < levels_.size() ? found * step : 0;
        const size_t count = std::min(step, keys.size() - from);
        size_t below = 0;
        for (size_t i = 0; i < count; ++i)
            below += keys[from + i] < key;
        found = from + (below > 0 ? below - 1 : 0);
    }
    return found;
}

bool Heads::consistent() const noexcept {
    for (size_t level = 1; level < levels_.size(); ++level)
        for (size_t i = 0; i < levels_[level].size(); ++i)
            if (levels_[level][i] != levels_[level - 1][i * step])
                return false;
    return true;
}

} // namespace locus::pmq
