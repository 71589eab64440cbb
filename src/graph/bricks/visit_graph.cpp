// The kernel that asks the graph for every weight: callers' functions, tabled powers, their cut edges.
#include "graph/bricks/lanes_scalar.hpp"
#include "graph/bricks/metric.hpp"

#include "graph/bricks/pull-inl.hpp"

namespace locus::bricks {
namespace scalar {

template <typename Word>
class GraphVisit : public PullVisit<Word, GraphVisit<Word>> {
    using Base = PullVisit<Word, GraphVisit<Word>>;
    using Row = typename Lanes<Word>::Row;

public:
    explicit GraphVisit(Visit<Word> &visit) : Base(visit), graph_(*visit.metric->graph) {}
    void prepare(unsigned) {}
    void stored(unsigned, const Row &) {}

    Row pull(unsigned row) const {
        return offers(padded(row), [](const graph::Neighbour &) { return true; });
    }
    // Only what this brick's rows offer: those on the other side of the border.
    Row offer(const BrickRow<Word> &, unsigned row, int dy, int dz) const {
        const int across = dy + static_cast<int>(kPadded) * dz;
        const auto s = static_cast<unsigned>(static_cast<int>(padded(row)) + static_cast<int>(kSide) * across);
        return offers(
            s, [=](const graph::Neighbour &to) { return (dy == 0 || to.dy == -dy) && (dz == 0 || to.dz == -dz); });
    }

private:
    template <typename Wanted>
    Row offers(unsigned s, Wanted &&wanted) const {
        const auto &place = this->v_.place;
        const auto y = static_cast<uint64_t>(int64_t{place.y} * kSide + int64_t{s % kPadded} - 1);
        const auto z = static_cast<uint64_t>(int64_t{place.z} * kSide + int64_t{s / kPadded} - 1);
        Row best = this->fill_;
        for (unsigned lane = 0; lane < kLanes; ++lane) {
            const auto x = static_cast<uint64_t>(int64_t{place.x} * kWidth + int64_t{lane} - 1);
            if (graph_.grid().holds(x, y, z))
                best.lane[lane] = offered({x, y, z}, s, lane, wanted);
        }
        return best;
    }

    template <typename Wanted>
    Word offered(const std::array<uint64_t, 3> &voxel, unsigned s, unsigned lane, Wanted &&wanted) const {
        const uint64_t index = graph_.grid().index(voxel[0], voxel[1], voxel[2]);
        const uint32_t inside = graph_.grid().inside(voxel);
        Word best = this->m_.infinity;
        for (const graph::Neighbour &to : graph_.grid().neighbours()) {
            const auto from = static_cast<unsigned>(static_cast<int>(lane) + to.dx);
            if (from >= kLanes || (inside >> to.number & 1) == 0 || !wanted(to))
                continue;
            const auto n = static_cast<unsigned>(static_cast<int>(s) + to.dy + static_cast<int>(kPadded) * to.dz);
            const Word word = this->row_at(n % kPadded, n / kPadded).word[from];
            if (word >= best)
                continue; // the weight could only add to it
            const uint64_t weight = graph_.weight(index, to);
            if (weight == 0)
                continue;
            best = std::min(best, static_cast<Word>(word + static_cast<Word>(weight << this->m_.label_bits)));
        }
        return best;
    }

    const graph::Graph &graph_;
};

} // namespace scalar

template <typename Word>
void visit_by_graph(Visit<Word> &visit) {
    scalar::GraphVisit<Word>(visit).run();
}

template void visit_by_graph(Visit<uint32_t> &);
template void visit_by_graph(Visit<uint64_t> &);

} // namespace locus::bricks
