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

template <typename Word>
uint64_t export_words(const graph::Graph &graph, const Place &place, const Brick<Word> &brick, Word unreached,
                      Word *words) {
    const auto &dims = graph.grid().dims();
    const Range x = range(place.x, kWidth, dims[0]), y = range(place.y, kSide, dims[1]),
                z = range(place.z, kSide, dims[2]);
    const auto none = static_cast<Word>(graph.layout().unreached());
    const auto count = static_cast<unsigned>(x.end - x.begin);
    Word reached = 0;
    for (uint64_t vz = z.begin; vz < z.end; ++vz)
        for (uint64_t vy = y.begin; vy < y.end; ++vy) {
            const Word *from = brick.row[vy - y.begin + kSide * (vz - z.begin)].word + 1;
            Word *to = words + graph.grid().index(x.begin, vy, vz);
            const auto copy = [&](unsigned n) {
                for (unsigned i = 0; i < n; ++i) {
                    reached += from[i] < unreached ? 1 : 0;
                    to[i] = from[i] < unreached ? from[i] : none;
                }
            };
            count == kWidth ? copy(kWidth) : copy(count);
        }
    return reached;
}

std::vector<std::unique_ptr<Blocked>> blocked_edges(const graph::Graph &graph, const Layout &layout) {
    std::vector<std::unique_ptr<Blocked>> blocked;
    const uint16_t *cuts = graph.cuts();
    if (cuts == nullptr)
        return blocked;
    blocked.resize(layout.count());
    const auto block_lane = [&](uint64_t bx, const std::array<uint64_t, 3> &v, uint64_t lane, unsigned number) {
        auto &brick = blocked[layout.index(static_cast<uint32_t>(bx), static_cast<uint32_t>(v[1] / kSide),
                                           static_cast<uint32_t>(v[2] / kSide))];
        if (!brick)
            brick = std::make_unique<Blocked>();
        uint16_t &lanes = brick->lanes[v[1] % kSide + kSide * (v[2] % kSide)][number < 13 ? number : number + 1];
        lanes = static_cast<uint16_t>(lanes | 1u << lane);
    };
    // A voxel on the edge of its brick is a lane of the x-neighbour too: two bricks that disagreed about an edge
    // between them would wake each other for ever.
    const auto block = [&](const std::array<uint64_t, 3> &v, unsigned number) {
        const uint64_t bx = v[0] / kWidth, lane = v[0] % kWidth + 1;
        block_lane(bx, v, lane, number);
        if (lane == 1 && bx > 0)
            block_lane(bx - 1, v, kLanes - 1, number);
        if (lane == kWidth && bx + 1 < layout.bricks[0])
            block_lane(bx + 1, v, 0, number);
    };
    const uint64_t voxels = graph.grid().voxels();
    for (uint64_t v = 0; v < voxels; ++v) {
        if (cuts[v] == 0)
            continue;
        const auto place = graph.grid().place(v);
        const uint32_t inside = graph.grid().inside(place);
        for (unsigned bit = 0; bit < 13; ++bit) {
            const graph::Neighbour &to = graph.grid().neighbour(graph::first_forward + bit);
            if ((cuts[v] >> bit & 1) == 0 || (inside >> to.number & 1) == 0)
                continue;
            block(place, to.number);
            block(graph.grid().place(v + static_cast<uint64_t>(to.step)), 25 - to.number);
        }
    }
    return blocked;
}

template void import_operands(const graph::Graph &, const Place &, float, Brick<uint32_t> &);
template void import_operands(const graph::Graph &, const Place &, float, Brick<uint64_t> &);
template void fill_words(uint32_t, Brick<uint32_t> &);
template void fill_words(uint64_t, Brick<uint64_t> &);
template uint64_t export_words(const graph::Graph &, const Place &, const Brick<uint32_t> &, uint32_t, uint32_t *);
template uint64_t export_words(const graph::Graph &, const Place &, const Brick<uint64_t> &, uint64_t, uint64_t *);

} // namespace locus::bricks
