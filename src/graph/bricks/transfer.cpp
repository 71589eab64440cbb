// Between a graph's dense arrays and bricks.
#include "graph/bricks/transfer.hpp"

#include "graph/bricks/visit.hpp"

#include <cstring>

namespace locus::bricks {
namespace {

// What Operand::of<float> gives for a graph's materials, in a form that compilers turn into vector code.
enum class Form { same, inverse, one };

Form form_of(const graph::Operand &operand) {
    const float probe = operand.of<float>(2.0f);
    return probe == 2.0f ? Form::same : probe == 0.5f ? Form::inverse : Form::one;
}

template <Form form>
void import_row(const float *values, unsigned count, float impassable, float *operands) {
    for (unsigned i = 0; i < count; ++i) {
        const float v = values[i];
        const float operand = form == Form::same ? v : form == Form::inverse ? 1.0f / v : 1.0f;
        operands[i] = v == v ? operand : impassable;
    }
}

// The voxels a brick covers along one axis.
struct Range {
    uint64_t begin, end;
};
Range range(int32_t brick, unsigned size, uint64_t dim) {
    const uint64_t begin = static_cast<uint64_t>(brick) * size;
    return {begin, std::min<uint64_t>(begin + size, dim)};
}

template <Form form, typename Word>
void import_brick(const graph::Graph &graph, const Place &place, float impassable, Brick<Word> &brick) {
    const auto &dims = graph.grid().dims();
    const Range x = range(place.x, kWidth, dims[0]);
    const unsigned first = x.begin == 0 ? 1 : 0; // lane 0 is the voxel before the brick
    const auto lanes = static_cast<unsigned>(std::min<uint64_t>(kLanes, dims[0] - x.begin + 1));
    for (unsigned row = 0; row < kRows; ++row) {
        const uint64_t y = static_cast<uint64_t>(place.y) * kSide + row % kSide;
        const uint64_t z = static_cast<uint64_t>(place.z) * kSide + row / kSide;
        float *to = brick.row[row].operand;
        if (y >= dims[1] || z >= dims[2] || lanes < kLanes || first > 0)
            std::fill_n(to, kLanes, impassable);
        if (y >= dims[1] || z >= dims[2])
            continue;
        const float *from = graph.materials() + graph.grid().index(x.begin, y, z) + first - 1;
        if (first == 0 && lanes == kLanes)
            import_row<form>(from, kLanes, impassable, to);
        else
            import_row<form>(from, lanes - first, impassable, to + first);
    }
}

} // namespace

template <typename Word>
void import_operands(const graph::Graph &graph, const Place &place, float impassable, Brick<Word> &brick) {
    switch (form_of(graph.operand())) {
    case Form::same:
        return import_brick<Form::same>(graph, place, impassable, brick);
    case Form::inverse:
        return import_brick<Form::inverse>(graph, place, impassable, brick);
    case Form::one:
        return import_brick<Form::one>(graph, place, impassable, brick);
    }
}

template <typename Word>
void fill_words(Word word, Brick<Word> &brick) {
    for (BrickRow<Word> &row : brick.row)
        std::fill_n(row.word, kLanes, word);
}

void Exported::add(const Exported &other) {
    reached += other.reached;
    changed += other.changed;
    gained += other.gained;
    lost += other.lost;
    for (size_t axis = 0; axis < 3; ++axis) {
        first[axis] = std::min(first[axis], other.first[axis]);
        last[axis] = std::max(last[axis], other.last[axis]);
    }
}

graph::Change change_of(const Exported &exported) {
    graph::Change change;
    change.voxels = exported.changed;
    for (size_t axis = 0; axis < 3 && change.voxels > 0; ++axis) {
        change.box.origin[axis] = exported.first[axis];
        change.box.extent[axis] = exported.last[axis] - exported.first[axis] + 1;
    }
    return change;
}

namespace {

// Call row(x, y, z, own words, count) for the rows of a brick inside the grid.
template <typename Word, typename Row>
void for_rows(const graph::Graph &graph, const Place &place, const Brick<Word> &brick, Row &&row) {
    const auto &dims = graph.grid().dims();
    const Range x = range(place.x, kWidth, dims[0]), y = range(place.y, kSide, dims[1]),
                z = range(place.z, kSide, dims[2]);
    const auto count = static_cast<unsigned>(x.end - x.begin);
    for (uint64_t vz = z.begin; vz < z.end; ++vz)
        for (uint64_t vy = y.begin; vy < y.end; ++vy)
            row(x.begin, vy, vz, brick.row[vy - y.begin + kSide * (vz - z.begin)].word + 1, count);
}

} // namespace

template <typename Word>
Exported export_words(const graph::Graph &graph, const Place &place, const Brick<Word> &brick, Word unreached,
                      Word *words) {
    const auto none = static_cast<Word>(graph.layout().unreached());
    Word reached = 0;
    for_rows(graph, place, brick, [&](uint64_t x, uint64_t y, uint64_t z, const Word *from, unsigned count) {
        Word *to = words + graph.grid().index(x, y, z);
        const auto copy = [&](unsigned n) {
            for (unsigned i = 0; i < n; ++i) {
                reached += from[i] < unreached ? 1 : 0;
                to[i] = from[i] < unreached ? from[i] : none;
            }
        };
        count == kWidth ? copy(kWidth) : copy(count); // a constant length makes vector code
    });
    Exported exported;
    exported.reached = reached;
    return exported;
}

template <typename Word>
Exported export_changes(const graph::Graph &graph, const Place &place, const Brick<Word> &brick, Word unreached,
                        Word *words) {
    const auto none = static_cast<Word>(graph.layout().unreached());
    Exported exported;
    for_rows(graph, place, brick, [&](uint64_t x, uint64_t y, uint64_t z, const Word *from, unsigned count) {
        Word *to = words + graph.grid().index(x, y, z);
        Word now[kWidth];
        Word reached = 0, changed = 0, gained = 0, lost = 0;
        const auto compare = [&](unsigned n) {
            for (unsigned i = 0; i < n; ++i) {
                const Word word = from[i] < unreached ? from[i] : none;
                const Word before = to[i] != none ? 1 : 0, after = word != none ? 1 : 0;
                now[i] = word;
                reached += after;
                changed += to[i] != word ? 1 : 0;
                gained += after & (before ^ 1);
                lost += before & (after ^ 1);
            }
        };
        count == kWidth ? compare(kWidth) : compare(count);
        exported.reached += reached;
        if (changed == 0)
            return;
        uint64_t first = 0, last = count - 1;
        while (to[first] == now[first])
            ++first;
        while (to[last] == now[last])
            --last;
        exported.add({0, changed, gained, lost, {x + first, y, z}, {x + last, y, z}});
        std::copy_n(now, count, to);
    });
    return exported;
}

std::unique_ptr<Blocked> blocked_edges(const graph::Graph &graph, const Place &place) {
    const uint16_t *cuts = graph.cuts();
    std::unique_ptr<Blocked> blocked;
    if (cuts == nullptr)
        return blocked;
    const graph::Grid &grid = graph.grid();
    // Lane 0 is included, so that two bricks agree about the edges between them: else they would wake each other for
    // ever.
    const auto block = [&](const std::array<uint64_t, 3> &v, unsigned number) {
        const uint64_t lane = v[0] + 1 - static_cast<uint64_t>(place.x) * kWidth; // huge before the brick
        const uint64_t y = v[1] - static_cast<uint64_t>(place.y) * kSide;
        const uint64_t z = v[2] - static_cast<uint64_t>(place.z) * kSide;
        if (lane >= kLanes || y >= kSide || z >= kSide)
            return;
        if (!blocked)
            blocked = std::make_unique<Blocked>();
        uint16_t &lanes = blocked->lanes[y + kSide * z][number < 13 ? number : number + 1];
        lanes = static_cast<uint16_t>(lanes | 1u << lane);
    };
    // Voxels whose forward edges may end in the brick: one before it on every axis, with lane 0 two in x.
    const auto before = [](int32_t brick, unsigned size, uint64_t margin) {
        const uint64_t begin = static_cast<uint64_t>(brick) * size;
        return begin - std::min(begin, margin);
    };
    const auto after = [](int32_t brick, unsigned size, uint64_t dim) {
        return std::min<uint64_t>((static_cast<uint64_t>(brick) + 1) * size + 2, dim);
    };
    const uint64_t x_begin = before(place.x, kWidth, 2), x_end = after(place.x, kWidth, grid.nx());
    for (uint64_t z = before(place.z, kSide, 1); z < after(place.z, kSide, grid.nz()); ++z)
        for (uint64_t y = before(place.y, kSide, 1); y < after(place.y, kSide, grid.ny()); ++y)
            for (uint64_t x = x_begin; x < x_end; ++x) {
                const uint64_t v = grid.index(x, y, z);
                if (cuts[v] == 0)
                    continue;
                const uint32_t inside = grid.inside({x, y, z});
                for (unsigned bit = 0; bit < 13; ++bit) {
                    const graph::Neighbour &to = grid.neighbour(graph::first_forward + bit);
                    if ((cuts[v] >> bit & 1) == 0 || (inside >> to.number & 1) == 0)
                        continue;
                    block({x, y, z}, to.number);
                    block(grid.place(v + static_cast<uint64_t>(to.step)), 25 - to.number);
                }
            }
    return blocked;
}

template void import_operands(const graph::Graph &, const Place &, float, Brick<uint32_t> &);
template void import_operands(const graph::Graph &, const Place &, float, Brick<uint64_t> &);
template void fill_words(uint32_t, Brick<uint32_t> &);
template void fill_words(uint64_t, Brick<uint64_t> &);
template Exported export_words(const graph::Graph &, const Place &, const Brick<uint32_t> &, uint32_t, uint32_t *);
template Exported export_words(const graph::Graph &, const Place &, const Brick<uint64_t> &, uint64_t, uint64_t *);
template Exported export_changes(const graph::Graph &, const Place &, const Brick<uint32_t> &, uint32_t, uint32_t *);
template Exported export_changes(const graph::Graph &, const Place &, const Brick<uint64_t> &, uint64_t, uint64_t *);

} // namespace locus::bricks
