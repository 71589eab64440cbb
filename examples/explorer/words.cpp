// Splitting texts into words.
#include "explorer/words.hpp"

#include <algorithm>
#include <set>

namespace explorer {
namespace {

constexpr size_t least_letters = 4;

// Bytes beyond ASCII are letters of other alphabets, as far as it matters here.
bool letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
}

size_t letters(std::string_view word) {
    const auto first_byte = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; };
    return static_cast<size_t>(std::count_if(word.begin(), word.end(), first_byte));
}

} // namespace

void Words::add(std::string_view text) {
    std::set<std::string> found;
    for (size_t i = 0; i < text.size();) {
        if (!letter(text[i])) {
            ++i;
            continue;
        }
        std::string word;
        for (; i < text.size() && letter(text[i]); ++i)
            word += text[i] >= 'A' && text[i] <= 'Z' ? static_cast<char>(text[i] + 32) : text[i];
        if (letters(word) >= least_letters)
            found.insert(std::move(word));
    }
    for (const std::string &word : found)
        ++counts_[word];
}

std::vector<std::pair<std::string, uint64_t>> Words::most(size_t count) const {
    std::vector<std::pair<std::string, uint64_t>> result(counts_.begin(), counts_.end());
    const auto before = [](const auto &a, const auto &b) {
        return a.second != b.second ? a.second > b.second : a.first < b.first;
    };
    const size_t kept = std::min(count, result.size());
    std::partial_sort(result.begin(), result.begin() + static_cast<std::ptrdiff_t>(kept), result.end(), before);
    result.resize(kept);
    return result;
}

} // namespace explorer
