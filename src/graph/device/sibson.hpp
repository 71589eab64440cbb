// Sibson's weights on a device (thesis section 2.5.3): a block per query spreads from it, level by level, over the
// voxels that are nearer to it than to their seed, in a window of its own, counts them by label, and hands over the
// finished row. Windows lie in shared memory, those that do not fit there in scratch memory. A block whose window turns
// out too small widens it where that is, and begins the next query with what the last one needed.
#pragma once

#include "graph/device/atomics.hpp"
#include "graph/device/block.hpp"
#include "graph/device/bricks.hpp"
#include "graph/device/neighbours.hpp"
#include "graph/device/rules.hpp"
#include "graph/weights/rows.hpp"

namespace locus::device {

// What becomes of a query.
struct Answer {
    static constexpr uint32_t small_window = 0xFFFFFFFF; // what it steals found no place in its window
    static constexpr uint32_t few_slots = 0xFFFFFFFE;    // nor the labels it steals from in their table
    static constexpr uint32_t no_room = 0xFFFFFFFD;      // nor its row among the others
    uint64_t first;                                      // in the rows
    uint32_t length;                                     // of its row, or one of the above
    uint32_t unused = 0;                                 // no byte that comes back is rubbish
};

// Numbers of cells below 2^16 divided by one of them, without a division.
struct Divider {
    uint32_t by, inverse;
    LOCUS_HD static Divider of(uint32_t by) { return {by, 0xFFFFFFFFu / by + 1}; } // by > 1
    LOCUS_HD uint32_t quotient(uint32_t n) const { return static_cast<uint32_t>((uint64_t{n} * inverse) >> 32); }
};

// A cell of the front, as those who look at its neighbours want it.
template <typename Word, typename Cell, typename Address>
struct alignas(sizeof(Address) == 4 && sizeof(Word) == 4 ? 16 : 8) Step {
    Word reach;
    Address address;
    float operand;
    Cell cell;
    Cell borders; // of its brick that it lies at: a bit for each, as the faces of a window
};

// What a block works in.
template <typename Word, typename Cell, typename Address>
struct SibsonMemory {
    Step<Word, Cell, Address> *steps; // the front
    Word *reach;                      // of the window's cells
    uint32_t *labels, *stolen;        // a table of labels and how many voxels were stolen from each
    Cell *cells;                      // whose distance fell, in two halves by level modulo 2
};

// `large`: windows in scratch memory.
template <typename Word, typename Rule, bool large>
struct Sibson {
#ifdef __CUDACC__
    static constexpr unsigned threads = 1024;
#else
    static constexpr unsigned threads = 128; // on the host each of them costs
#endif
    static constexpr unsigned side_by_side = 2; // cells that a thread looks at together
    using Cell = std::conditional_t<large, uint32_t, uint16_t>;
    using Address = std::conditional_t<large, uint64_t, uint32_t>;
    using Front = Step<Word, Cell, Address>;
    using Memory = SibsonMemory<Word, Cell, Address>;

    // A cell holds the distance below which it is stolen, which falls to that from the query, above two bits: that it
    // waits in no front, and that nothing has reached it. All three fall by one atomic minimum.
    static constexpr Word kAtRest = 1, kUntouched = 2;
    static constexpr unsigned kFlags = 2;
    static constexpr uint32_t kNoLabel = std::numeric_limits<uint32_t>::max();
    static constexpr uint32_t kCrowded = 1u << 6; // in `left`, beside a bit for each face

    LOCUS_HD static uint64_t bytes(uint64_t cells, uint64_t front, uint64_t slots) {
        const uint64_t all =
            front * (sizeof(Front) + 2 * sizeof(Cell)) + cells * sizeof(Word) + slots * 2 * sizeof(uint32_t);
        return (all + 15) / 16 * 16;
    }

    struct Shared {
        uint32_t next, end;    // queries that the block has taken
        uint32_t done;         // there are no more
        uint32_t size[3];      // of the front, by level modulo 3
        uint32_t left[2];      // faces at which the window was left, by level modulo 2
        uint32_t failed;       // what to answer, 0: a row
        uint32_t trivial;      // nothing is to be searched
        uint32_t cells, start; // of the window, and the query's
        uint32_t met, few_slots;
        uint32_t low[3], high[3];   // voxels around the query that its window holds,
        uint32_t first[3], last[3]; // cells between which all stolen ones lie
        uint32_t extent[3];         // of the window, with a border of one cell
        Divider row, plane;
        uint64_t at[3], origin[3]; // of the query, and of the window's first cell, which may be -1
        uint64_t sum;              // of the voxels in the row
        uint64_t base;             // of the row among the others
    };
    struct Local {};

    Bricks<Word> bricks;
    Rule rule;
    Word least; // no edge is shorter
    uint32_t label_bits;
    uint32_t most;           // entries of a row; 0: all
    const uint64_t *queries; // voxels
    uint32_t query_count;
    uint32_t at_once;       // queries that a block takes
    uint32_t *taken;        // 0 before
    uint32_t margin;        // voxels around a block's first query that its window holds
    uint32_t room;          // cells of a window
    uint32_t front;         // and of a front
    uint32_t slots;         // of the table of labels, a power of 2
    unsigned char *scratch; // large: of block 0; the others' follow
    Answer *answers;
    graph::Share *rows;
    uint64_t *counted; // entries of rows, 0 before
    uint64_t counted_room;

    template <typename Block>
    LOCUS_HD void operator()(Block &block) const {
        Shared &s = block.shared;
        const Memory own = memory_of(block);
        block.each([&](unsigned thread, Local &) {
            if (thread == 0)
                start(s);
        });
        for (;;) {
            block.each([&](unsigned thread, Local &) {
                if (thread == 0)
                    begin(s);
            });
            if (s.done != 0)
                break;
            search(block, own);
            if (s.trivial == 0 && s.failed == 0)
                finish(block, own);
            block.each([&](unsigned thread, Local &) {
                if (thread == 0)
                    end(s);
            });
        }
    }

private:
    template <typename Block>
    LOCUS_HD void search(Block &block, const Memory &own) const {
        Shared &s = block.shared;
        while (s.trivial == 0 && s.failed == 0) {
            block.each([&](unsigned thread, Local &) { open(s, own, thread); });
            for (uint32_t level = 0; s.size[level % 3] != 0 && s.left[(level + 1) % 2] == 0; ++level) {
                block.each([&](unsigned thread, Local &) { settle(s, own, thread, level); });
                block.each([&](unsigned thread, Local &) { spread(s, own, thread, level); });
            }
            if ((s.left[0] | s.left[1]) == 0)
                break;
            block.each([&](unsigned thread, Local &) {
                if (thread == 0)
                    widen(s);
            });
        }
    }
    template <typename Block>
    LOCUS_HD void finish(Block &block, const Memory &own) const {
        Shared &s = block.shared;
        block.each([&](unsigned thread, Local &) { count(s, own, thread); });
        block.each([&](unsigned thread, Local &) { list(s, own, thread); });
        block.each([&](unsigned thread, Local &) { rank(s, own, thread); });
        block.each([&](unsigned thread, Local &) { write(s, own, thread); });
    }

    template <typename Block>
    LOCUS_HD Memory memory_of(Block &block) const {
        unsigned char *at;
        if constexpr (large)
            at = scratch + block.index() * bytes(room, front, slots);
        else
            at = block.memory();
        Memory own;
        own.steps = reinterpret_cast<Front *>(at);
        own.reach = reinterpret_cast<Word *>(own.steps + front);
        own.labels = reinterpret_cast<uint32_t *>(own.reach + room);
        own.stolen = own.labels + slots;
        own.cells = reinterpret_cast<Cell *>(own.stolen + slots);
        return own;
    }

    LOCUS_HD void start(Shared &s) const {
        s.next = s.end = 0;
        start_margins(s);
    }

    LOCUS_HD void begin(Shared &s) const {
        if (s.next == s.end) {
            s.next = atomic_add(taken, at_once);
            s.end = s.next + at_once;
        }
        s.failed = s.trivial = 0;
        s.done = s.next >= query_count ? 1 : 0;
        if (s.done != 0)
            return;
        const uint64_t voxel = queries[s.next], nx = bricks.layout.dims[0], row = voxel / nx;
        s.at[0] = voxel % nx;
        s.at[1] = row % bricks.layout.dims[1];
        s.at[2] = row / bricks.layout.dims[1];
        const Word word = bricks.words[address(s.at)];
        if (nearest(word) != 0)
            return place_window(s);
        s.trivial = 1;
        if (word < bricks.beyond)
            reserve(s, 1);
        else
            answers[s.next] = {0, 0};
        if (word < bricks.beyond && s.base < counted_room)
            rows[s.base] = {label_of(word), 1.0f};
    }

    // Window's cells: those within the margins, and a border of one.
    LOCUS_HD void place_window(Shared &s) const {
        uint64_t cells = 1;
        for (unsigned a = 0; a < 3; ++a) {
            const uint64_t low = s.at[a] < s.low[a] ? s.at[a] : s.low[a];
            const uint64_t most_high = bricks.layout.dims[a] - 1 - s.at[a];
            const uint64_t high = most_high < s.high[a] ? most_high : s.high[a];
            s.origin[a] = s.at[a] - low - 1;
            s.extent[a] = static_cast<uint32_t>(low + high + 3);
            cells = cells <= room ? cells * s.extent[a] : cells;
        }
        if (cells > room)
            s.failed = Answer::small_window;
        s.cells = static_cast<uint32_t>(cells);
        s.row = Divider::of(s.extent[0]);
        s.plane = Divider::of(s.extent[1]);
        s.start = static_cast<uint32_t>(s.at[0] - s.origin[0] +
                                        s.extent[0] * (s.at[1] - s.origin[1] + s.extent[1] * (s.at[2] - s.origin[2])));
    }

    LOCUS_HD void widen(Shared &s) const {
        const uint32_t left = s.left[0] | s.left[1];
        if ((left & kCrowded) != 0)
            s.failed = Answer::small_window;
        for (unsigned a = 0; a < 3; ++a) {
            if ((left >> (2 * a) & 1) != 0)
                s.low[a] += s.low[a] / 2 + 2;
            if ((left >> (2 * a + 1) & 1) != 0)
                s.high[a] += s.high[a] / 2 + 2;
        }
        if (s.failed == 0)
            place_window(s);
    }

    LOCUS_HD void place(const Shared &s, uint32_t cell, uint32_t (&at)[3]) const {
        uint32_t row, plane;
        if constexpr (large) {
            row = cell / s.extent[0];
            plane = row / s.extent[1];
        } else {
            row = s.row.quotient(cell);
            plane = s.plane.quotient(row);
        }
        at[0] = cell - row * s.extent[0];
        at[1] = row - plane * s.extent[1];
        at[2] = plane;
    }
    // Layout::address, of numbers that fit.
    template <typename T>
    LOCUS_HD Address address(const T (&at)[3]) const {
        const Address x = static_cast<Address>(at[0]), y = static_cast<Address>(at[1]), z = static_cast<Address>(at[2]);
        const Address row = Address{bricks.layout.bricks[0]} * kVoxels, plane = row * bricks.layout.bricks[1];
        return x % kSide + kSide * (y % kSide + kSide * (z % kSide)) + x / kSide * kVoxels + y / kSide * row +
               z / kSide * plane;
    }
    LOCUS_HD Address address_in(const Shared &s, const uint32_t (&at)[3]) const {
        const Address global[3] = {static_cast<Address>(s.origin[0]) + at[0], static_cast<Address>(s.origin[1]) + at[1],
                                   static_cast<Address>(s.origin[2]) + at[2]};
        return address(global);
    }

    // A voxel that nothing reaches is never stolen.
    LOCUS_HD Word nearest(Word word) const { return word < bricks.beyond ? word >> label_bits : 0; }
    LOCUS_HD uint32_t label_of(Word word) const { return static_cast<uint32_t>(word & ((Word{1} << label_bits) - 1)); }

    LOCUS_HD Word bound_of(const Shared &s, uint32_t cell) const {
        uint32_t at[3];
        place(s, cell, at);
        bool inside = cell < s.cells;
        LOCUS_UNROLL
        for (unsigned a = 0; a < 3; ++a)
            inside = inside && s.origin[a] + at[a] < bricks.layout.dims[a]; // -1 is huge
        return inside ? nearest(bricks.words[address_in(s, at)]) : 0;
    }
    LOCUS_HD void open(Shared &s, const Memory &own, unsigned thread) const {
        constexpr unsigned together = 4; // cells whose words are on their way
        for (uint32_t first = thread; first < s.cells; first += together * threads) {
            Word bound[together];
            LOCUS_UNROLL
            for (unsigned k = 0; k < together; ++k)
                bound[k] = bound_of(s, first + k * threads);
            LOCUS_UNROLL
            for (unsigned k = 0; k < together; ++k) {
                const uint32_t cell = first + k * threads;
                if (cell < s.cells)
                    own.reach[cell] = cell == s.start ? 0 : bound[k] << kFlags | kUntouched | kAtRest;
            }
        }
        for (uint32_t slot = thread; slot < slots; slot += threads) {
            own.labels[slot] = kNoLabel;
            own.stolen[slot] = 0;
        }
        if (thread != 0)
            return;
        own.cells[0] = static_cast<Cell>(s.start);
        s.size[0] = 1;
        s.size[1] = s.size[2] = s.left[0] = s.left[1] = 0;
        s.met = s.few_slots = 0;
        s.sum = 0;
        for (unsigned a = 0; a < 3; ++a) {
            s.first[a] = kNoLabel;
            s.last[a] = kNoLabel;
        }
    }

    // The cells of a front wait no more: whatever falls from here on enters the next.
    LOCUS_HD void settle(Shared &s, const Memory &own, unsigned thread, uint32_t level) const {
        const uint32_t size = s.size[level % 3];
        for (uint32_t i = thread; i < size; i += threads) {
            const Cell cell = own.cells[level % 2 * front + i];
            const Word reach = own.reach[cell];
            own.reach[cell] = reach | kAtRest;
            uint32_t at[3], faces = 0;
            place(s, cell, at);
            Address global[3];
            unsigned borders = 0;
            LOCUS_UNROLL
            for (unsigned a = 0; a < 3; ++a) {
                global[a] = static_cast<Address>(s.origin[a]) + at[a];
                faces |= bits_at(a, at[a] == 0, at[a] == s.extent[a] - 1);
                borders |= bits_at(a, global[a] % kSide == 0, global[a] % kSide == kSide - 1);
            }
            if (faces != 0)
                atomic_or(&s.left[level % 2], faces);
            const Address there = address(global);
            own.steps[i] = {reach >> kFlags, there, bricks.operands[there], cell, static_cast<Cell>(borders)};
        }
    }
    LOCUS_HD static uint32_t bits_at(unsigned axis, bool low, bool high) {
        return (low ? 1u << (2 * axis) : 0) | (high ? 2u << (2 * axis) : 0);
    }

    // From a voxel's address to that of its neighbour.
    struct Way {
        Address along;      // within a brick,
        unsigned border[3]; // and where it leads out of one
        Address across[3];
        LOCUS_HD Address from(const Front &step) const {
            Address address = step.address + along;
            LOCUS_UNROLL
            for (unsigned a = 0; a < 3; ++a)
                address += (step.borders & border[a]) != 0 ? across[a] : 0;
            return address;
        }
    };
    LOCUS_HD Way way(int dx, int dy, int dz) const {
        const int d[3] = {dx, dy, dz};
        const Address row = Address{bricks.layout.bricks[0]} * kVoxels;
        const Address side[3] = {kVoxels, row, row * bricks.layout.bricks[1]};
        Way way{0, {}, {}};
        Address pitch = 1;
        LOCUS_UNROLL
        for (unsigned a = 0; a < 3; ++a, pitch *= kSide) {
            const auto sign = static_cast<Address>(static_cast<int64_t>(d[a]));
            way.along += sign * pitch;
            way.border[a] = bits_at(a, d[a]<0, d[a]> 0);
            way.across[a] = sign * (side[a] - pitch * kSide);
        }
        return way;
    }

    // Threads side by side take the neighbours of one cell.
    LOCUS_HD void spread(Shared &s, const Memory &own, unsigned thread, uint32_t level) const {
        if (thread == 0)
            s.size[(level + 2) % 3] = 0;
        const unsigned group = bricks.classes == 1 ? 8 : 32;
        const unsigned position = position_of(thread % group);
        const int dx = static_cast<int>(position % 3) - 1, dy = static_cast<int>(position / 3 % 3) - 1,
                  dz = static_cast<int>(position / 9) - 1;
        const unsigned axes = axes_of(dx, dy, dz), number = number_of(dx, dy, dz);
        if (position > 26 || axes == 0 || moves(axes) > bricks.classes || load_shared(&s.left[level % 2]) != 0)
            return;
        const auto offset =
            static_cast<uint32_t>(dx + static_cast<int>(s.extent[0]) * (dy + static_cast<int>(s.extent[1]) * dz));
        const Way way = this->way(dx, dy, dz);
        const uint32_t size = s.size[level % 3], stride = threads / group;
        for (uint32_t i = thread / group; i < size; i += side_by_side * stride) {
            Front step[side_by_side];
            Word bound[side_by_side];
            float operand[side_by_side];
            bool nearer[side_by_side];
            LOCUS_UNROLL
            for (unsigned k = 0; k < side_by_side; ++k) {
                step[k] = own.steps[i + k * stride < size ? i + k * stride : i]; // twice does no harm
                bound[k] = load_shared(&own.reach[step[k].cell + offset]) >> kFlags;
                nearer[k] = step[k].reach + least < bound[k];
            }
            LOCUS_UNROLL
            for (unsigned k = 0; k < side_by_side; ++k) {
                operand[k] = nearer[k] ? bricks.operands[way.from(step[k])] : 0;
                if (bricks.open != nullptr)
                    nearer[k] = nearer[k] && (bricks.open[step[k].address] >> number & 1) != 0;
            }
            LOCUS_UNROLL
            for (unsigned k = 0; k < side_by_side; ++k) {
                const Word longer = step[k].reach + rule(step[k].operand, operand[k], axes);
                if (nearer[k] && longer < bound[k])
                    lower(s, own, step[k].cell + offset, longer << kFlags, level);
            }
        }
    }
    // Where a thread of a group finds its neighbour, in a cube of 3 x 3 x 3; beyond it: none.
    LOCUS_HD unsigned position_of(unsigned thread) const {
        if (bricks.classes != 1)
            return thread;
        constexpr uint32_t faces = 4 | 10 << 5 | 12 << 10 | 14 << 15 | 16 << 20 | 22 << 25;
        return thread < 6 ? faces >> (5 * thread) & 31 : 27;
    }
    LOCUS_HD void lower(Shared &s, const Memory &own, uint32_t cell, Word to, uint32_t level) const {
        const Word old = atomic_min(&own.reach[cell], to);
        if (to >= old || (old & kAtRest) == 0)
            return;
        const uint32_t place = atomic_add(&s.size[(level + 1) % 3], 1u);
        if (place >= front) {
            atomic_or(&s.left[level % 2], kCrowded);
            return;
        }
        own.cells[(level + 1) % 2 * front + place] = static_cast<Cell>(cell);
    }

    // What was touched is what is stolen: the bound was there from the beginning.
    LOCUS_HD void count(Shared &s, const Memory &own, unsigned thread) const {
        uint32_t first[3] = {kNoLabel, kNoLabel, kNoLabel}, last[3] = {kNoLabel, kNoLabel, kNoLabel};
        for (uint32_t cell = thread; cell < s.cells; cell += threads) {
            if ((own.reach[cell] & kUntouched) != 0)
                continue;
            uint32_t at[3];
            place(s, cell, at);
            add(s, own, label_of(bricks.words[address_in(s, at)]));
            LOCUS_UNROLL
            for (unsigned a = 0; a < 3; ++a) {
                const uint32_t from_end = s.extent[a] - 1 - at[a];
                first[a] = at[a] < first[a] ? at[a] : first[a];
                last[a] = from_end < last[a] ? from_end : last[a];
            }
        }
        LOCUS_UNROLL
        for (unsigned a = 0; a < 3; ++a)
            if (first[a] != kNoLabel) {
                atomic_min(&s.first[a], first[a]);
                atomic_min(&s.last[a], last[a]);
            }
    }
    LOCUS_HD void add(Shared &s, const Memory &own, uint32_t label) const {
        uint32_t slot = label * 0x9E3779B1u >> 8 & (slots - 1);
        for (uint32_t tries = 0; tries < slots; ++tries) {
            uint32_t there = load_shared(&own.labels[slot]);
            if (there == kNoLabel) {
                there = atomic_replace(&own.labels[slot], kNoLabel, label);
                there = there == kNoLabel ? label : there;
            }
            if (there == label) {
                atomic_add(&own.stolen[slot], 1u);
                return;
            }
            slot = (slot + 1) & (slots - 1);
        }
        atomic_or(&s.few_slots, 1u);
    }

    // The slots in use, where the fronts were.
    LOCUS_HD void list(Shared &s, const Memory &own, unsigned thread) const {
        for (uint32_t slot = thread; slot < slots; slot += threads)
            if (own.labels[slot] != kNoLabel)
                own.cells[atomic_add(&s.met, 1u)] = static_cast<Cell>(slot);
    }
    LOCUS_HD uint32_t kept(const Shared &s) const { return most != 0 && most < s.met ? most : s.met; }

    // By falling number of voxels, then by label. The sum is one of whole numbers, in whatever order.
    LOCUS_HD void rank(Shared &s, const Memory &own, unsigned thread) const {
        for (uint32_t i = thread; i < s.met; i += threads) {
            const uint32_t slot = own.cells[i], voxels = own.stolen[slot], label = own.labels[slot];
            uint32_t before = 0;
            for (uint32_t k = 0; k < s.met; ++k) {
                const uint32_t other = own.cells[k], theirs = own.stolen[other];
                before += theirs > voxels || (theirs == voxels && own.labels[other] < label) ? 1 : 0;
            }
            own.cells[front + i] = static_cast<Cell>(before);
            if (before < kept(s))
                atomic_add(&s.sum, uint64_t{voxels});
        }
        if (thread == 0)
            reserve(s, kept(s));
    }
    LOCUS_HD void reserve(Shared &s, uint32_t length) const {
        Answer &answer = answers[s.next];
        s.base = counted_room;
        answer = {0, Answer::few_slots};
        if (s.few_slots != 0 && s.trivial == 0)
            return;
        s.base = atomic_add(counted, uint64_t{length});
        answer = {s.base, length};
        if (s.base + length <= counted_room)
            return;
        s.base = counted_room;
        answer = {0, Answer::no_room};
    }
    LOCUS_HD void write(Shared &s, const Memory &own, unsigned thread) const {
        if (s.base == counted_room)
            return;
        for (uint32_t i = thread; i < s.met; i += threads) {
            const uint32_t slot = own.cells[i], place = own.cells[front + i];
            if (place < kept(s))
                rows[s.base + place] = {own.labels[slot], static_cast<float>(static_cast<double>(own.stolen[slot]) /
                                                                             static_cast<double>(s.sum))};
        }
    }

    // The next query's window is as large as this one's should have been, and a little more.
    LOCUS_HD void end(Shared &s) const {
        constexpr uint32_t more = 2;
        if (s.failed != 0)
            answers[s.next] = {0, s.failed};
        if (s.failed != 0)
            start_margins(s);
        else if (s.trivial == 0)
            for (unsigned a = 0; a < 3; ++a) {
                const auto at = static_cast<uint32_t>(s.at[a] - s.origin[a]);
                s.low[a] = at - s.first[a] + more;
                s.high[a] = s.extent[a] - 1 - s.last[a] - at + more;
            }
        ++s.next;
    }
    LOCUS_HD void start_margins(Shared &s) const {
        for (unsigned a = 0; a < 3; ++a)
            s.low[a] = s.high[a] = margin;
    }
};

} // namespace locus::device
