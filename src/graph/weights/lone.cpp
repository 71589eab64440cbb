// The search of one query: Dijkstra's algorithm by buckets, on pages of voxels that are copied as it gets to them.
#include "graph/weights/lone.hpp"

#include "graph/weights/edges.hpp"

#include <algorithm>
#include <bit>

namespace locus::graph {
namespace {

constexpr size_t first_slots = 256;

} // namespace

template <typename Word>
LoneSearch<Word>::LoneSearch(const Field &field)
    : field_(field), smallest_(field.graph().smallest_weight()),
      shift_(static_cast<uint32_t>(std::bit_width(smallest_) - 1)),
      pages_along_x_((field.grid().nx() + page_size - 1) / page_size), pages_(1), table_(first_slots) {
    pages_.reserve(first_slots / 2);
    for (unsigned n = 0; n < hops_.size(); ++n) {
        const Neighbour &to = field.grid().neighbour(n);
        hops_[n] = {to.dx, static_cast<unsigned>(3 * (to.dy + 1) + 9 * (to.dz + 1))};
    }
}

template <typename Word>
uint64_t LoneSearch<Word>::bytes() const {
    return pages_.capacity() * sizeof(Page) + table_.size() * sizeof(Slot) + stolen_.capacity() * sizeof(Stolen);
}

template <typename Word>
bool LoneSearch<Word>::steal(uint64_t query, uint64_t most_bytes) {
    clear();
    const uint64_t row = query / field_.grid().nx(), along_row = query % field_.grid().nx();
    const auto x = static_cast<uint32_t>(along_row % page_size);
    const uint32_t first = place_of(page_at(along_row / page_size + row * pages_along_x_), x);
    pages_[first >> page_bits].reach[x] = 0;
    queue_.push(0, first);
    bool fits = true;
    while (queue_.pop(bucket_, [&](uint32_t place) { return key_of(place); })) {
        if (!fits)
            continue; // empty the queue
        for (const uint32_t place : bucket_)
            settle(place);
        fits = bytes() <= most_bytes;
    }
    if (!fits) {
        needed_ = bytes();
        pages_ = std::vector<Page>(1);
        stolen_ = {};
    }
    return fits;
}

// 0, which no voxel but the query is queued with, once it was settled.
template <typename Word>
uint64_t LoneSearch<Word>::key_of(uint32_t place) const {
    const Page &page = pages_[place >> page_bits];
    const unsigned x = place % page_size;
    return (page.settled >> x & 1) != 0 ? 0 : page.reach[x] >> shift_;
}

// A voxel of the bucket that came out; it may have been improved into an earlier one, or be there twice.
template <typename Word>
void LoneSearch<Word>::settle(uint32_t place) {
    Page &page = pages_[place >> page_bits];
    const unsigned x = place % page_size;
    if ((page.settled >> x & 1) != 0)
        return;
    page.settled = static_cast<uint16_t>(page.settled | 1u << x);
    stolen_.push_back({first_voxel(page.number) + x, page.reach[x], place});
    meet_pages(place >> page_bits, 1);
    if (x == 0)
        meet_pages(place >> page_bits, 0);
    if (x == page_size - 1)
        meet_pages(place >> page_bits, 2);
    relax(stolen_.back());
}

// Everything that the voxel reaches before the nearest seed does.
template <typename Word>
void LoneSearch<Word>::relax(const Stolen &from) {
    const Graph &graph = field_.graph();
    const uint64_t distance = from.distance;
    const uint32_t open = graph.cuts() == nullptr ? graph.grid().neighbour_mask() : graph.open_edges(from.voxel);
    uint32_t joined = 0;
    for (unsigned n = 0; n < hops_.size(); ++n)
        joined |= uint32_t{reach(beside(from.place, n)) > distance + smallest_} << n;
    for_weights(graph, from.voxel, joined & open, [&](unsigned n, uint64_t weight) {
        const uint32_t next = beside(from.place, n);
        Word &reach = pages_[next >> page_bits].reach[next % page_size];
        if (weight == 0 || distance + weight >= reach)
            return;
        const Word old = reach;
        reach = static_cast<Word>(distance + weight);
        const bool queued = old < field_.distance(from.voxel + static_cast<uint64_t>(graph.grid().neighbour(n).step));
        if (!queued || old >> shift_ != reach >> shift_)
            queue_.push(reach >> shift_, next);
    });
}

template <typename Word>
uint32_t LoneSearch<Word>::beside(uint32_t place, unsigned number) const {
    const Page &page = pages_[place >> page_bits];
    const Hop &hop = hops_[number];
    const unsigned x = place % page_size + static_cast<unsigned>(hop.dx);
    const unsigned side = x < page_size ? 1 : (hop.dx < 0 ? 0 : 2);
    return place_of(page.around[hop.row + side], x % page_size);
}

// Make sure of the nine pages around one that lie before it (side 0), at the same x (1) or after it (2).
template <typename Word>
void LoneSearch<Word>::meet_pages(uint32_t page, unsigned side) {
    if (pages_[page].around[side] != unknown)
        return;
    const Grid &grid = field_.grid();
    const uint64_t number = pages_[page].number, row = number / pages_along_x_;
    const uint64_t x = number % pages_along_x_ + side - 1, y = row % grid.ny(), z = row / grid.ny();
    for (unsigned i = 0; i < 9; ++i) {
        const uint64_t other_y = y + i % 3 - 1, other_z = z + i / 3 - 1;
        const bool inside = x < pages_along_x_ && other_y < grid.ny() && other_z < grid.nz();
        const uint32_t found = inside ? page_at(x + pages_along_x_ * (other_y + grid.ny() * other_z)) : outside;
        pages_[page].around[3 * i + side] = found; // page_at may have moved the pages
    }
}

// The page of that number, made where the search has not been there yet.
template <typename Word>
uint32_t LoneSearch<Word>::page_at(uint64_t number) {
    Slot &slot = table_[slot_of(number)];
    if (slot.search == search_)
        return slot.page;
    slot = {search_, static_cast<uint32_t>(pages_.size())};
    Page &page = pages_.emplace_back();
    page.around.fill(unknown);
    page.number = number;
    const uint64_t voxel = first_voxel(number), x = number % pages_along_x_ * page_size;
    const auto size = static_cast<unsigned>(std::min<uint64_t>(page_size, field_.grid().nx() - x));
    for (unsigned i = 0; i < size; ++i)
        if (field_.reached(voxel + i))
            page.reach[i] = static_cast<Word>(field_.distance(voxel + i));
    if (pages_.size() > table_.size() / 2)
        grow_table();
    return static_cast<uint32_t>(pages_.size() - 1);
}

// Where that page stands, or the empty slot where it would.
template <typename Word>
size_t LoneSearch<Word>::slot_of(uint64_t number) const {
    const size_t last = table_.size() - 1;
    size_t slot = (number * 0x9e3779b97f4a7c15u >> 32) & last;
    while (table_[slot].search == search_ && pages_[table_[slot].page].number != number)
        slot = (slot + 1) & last;
    return slot;
}

template <typename Word>
void LoneSearch<Word>::grow_table() {
    table_.assign(table_.size() * 2, Slot{});
    for (uint32_t page = outside + 1; page < pages_.size(); ++page)
        table_[slot_of(pages_[page].number)] = {search_, page};
}

template <typename Word>
void LoneSearch<Word>::clear() {
    pages_.resize(1);
    stolen_.clear();
    queue_.rewind();
    if (++search_ != 0)
        return;
    table_.assign(table_.size(), Slot{});
    search_ = 1;
}

template <typename Word>
Box LoneSearch<Word>::box() const {
    std::array<uint64_t, 3> low{UINT64_MAX, UINT64_MAX, UINT64_MAX}, high{};
    for (const Stolen &stolen : stolen_) {
        const auto place = field_.grid().place(stolen.voxel);
        for (unsigned a = 0; a < 3; ++a) {
            low[a] = std::min(low[a], place[a]);
            high[a] = std::max(high[a], place[a]);
        }
    }
    Box box{};
    for (unsigned a = 0; a < 3; ++a) {
        box.origin[a] = low[a];
        box.extent[a] = high[a] - low[a] + 1;
    }
    return box;
}

template class LoneSearch<uint32_t>;
template class LoneSearch<uint64_t>;

} // namespace locus::graph
