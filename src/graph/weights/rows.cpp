#include "graph/weights/rows.hpp"

#include <algorithm>

namespace locus::graph {

void finish_row(std::vector<RawShare> &row, uint32_t most, std::vector<Share> &out) {
    std::erase_if(row, [](const RawShare &share) { return !(share.weight > 0); });
    std::sort(row.begin(), row.end(), [](const RawShare &a, const RawShare &b) {
        return a.weight != b.weight ? a.weight > b.weight : a.label < b.label;
    });
    if (most != 0 && row.size() > most)
        row.resize(most);
    double sum = 0;
    for (const RawShare &share : row)
        sum += share.weight;
    for (const RawShare &share : row)
        out.push_back({share.label, static_cast<float>(share.weight / sum)});
}

Rows assemble(uint64_t count, std::span<const RowPile> piles, const Rows *base) {
    std::vector<std::span<const Share>> found(count);
    if (base != nullptr)
        for (uint64_t i = 0; i < count; ++i)
            found[i] = base->row(i);
    uint64_t entries = 0;
    for (const RowPile &pile : piles) {
        uint64_t first = 0;
        for (size_t i = 0; i < pile.place.size(); first = pile.end[i++]) {
            first = pile.begin.empty() ? first : pile.begin[i];
            found[pile.place[i]] = {pile.shares.data() + first, pile.shares.data() + pile.end[i]};
        }
    }
    for (const auto &row : found)
        entries += row.size();
    Rows rows;
    rows.offsets.reserve(count + 1);
    rows.shares.reserve(entries);
    for (const auto &row : found)
        add_row(rows, row);
    return rows;
}

} // namespace locus::graph
