// A graph in the form the plain engines walk: one layer of impassable voxels around it, so that a neighbour is an
// addition away, and the words of impassable voxels 0, so that no path ever improves them.
#pragma once

#include "graph/engine.hpp"

#include <chrono>
#include <utility>
#include <vector>

namespace locus::graph {

class Stopwatch {
public:
    // Seconds since the last call (or the beginning).
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - last_).count();
        last_ = now;
        return seconds;
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// A neighbour in the lattice.
struct Hop {
    int64_t step;
    unsigned kind;
    unsigned number;
};

// Places of lattice voxels: 32 bits where they suffice, to halve the queues.
template <typename Word, typename Place>
class Lattice {
public:
    using R = Real<Word>;

    explicit Lattice(const Graph &graph)
        : graph_(graph), row_(graph.grid().nx() + 2), plane_(row_ * (graph.grid().ny() + 2)),
          operands_(plane_ * (graph.grid().nz() + 2)), words_(operands_.size()) {
        for (const Neighbour &to : graph.grid().neighbours())
            hops_.push_back({to.dx + to.dy * static_cast<int64_t>(row_) + to.dz * static_cast<int64_t>(plane_), to.kind,
                             to.number});
        const auto unreached = static_cast<Word>(graph.layout().unreached());
        for_rows([&](uint64_t inner, uint64_t padded) {
            for (uint64_t x = 0; x < graph.grid().nx(); ++x) {
                const float value = graph.materials()[inner + x];
                if (!(value == value))
                    continue;
                operands_[padded + x] = graph.operand().of<R>(value);
                words_[padded + x] = unreached;
            }
        });
    }

    const Graph &graph() const { return graph_; }
    const std::vector<Hop> &hops() const { return hops_; }
    const R *operands() const { return operands_.data(); }
    std::vector<Word> &words() { return words_; }

    Place place(uint64_t voxel) const {
        const auto [x, y, z] = graph_.grid().place(voxel);
        return static_cast<Place>((x + 1) + row_ * (y + 1) + plane_ * (z + 1));
    }
    uint64_t voxel(Place place) const {
        const uint64_t row = place / row_ % (graph_.grid().ny() + 2);
        return graph_.grid().index(place % row_ - 1, row - 1, place / plane_ - 1);
    }

    // Copy the words back; `out` takes its memory before it changes.
    void give(Words &out) const {
        std::vector<Word> kept = memory_of<Word>(out, graph_.grid().voxels());
        const auto unreached = static_cast<Word>(graph_.layout().unreached());
        for_rows([&](uint64_t inner, uint64_t padded) {
            for (uint64_t x = 0; x < graph_.grid().nx(); ++x) {
                const float value = graph_.materials()[inner + x];
                kept[inner + x] = value == value ? words_[padded + x] : unreached;
            }
        });
        out = std::move(kept);
    }

private:
    // visit(first voxel of a row, its place)
    template <typename Visit>
    void for_rows(Visit &&visit) const {
        const Grid &grid = graph_.grid();
        for (uint64_t z = 0; z < grid.nz(); ++z)
            for (uint64_t y = 0; y < grid.ny(); ++y)
                visit(grid.index(0, y, z), 1 + row_ * (y + 1) + plane_ * (z + 1));
    }

    const Graph &graph_;
    uint64_t row_;
    uint64_t plane_;
    std::vector<Hop> hops_;
    std::vector<R> operands_;
    std::vector<Word> words_;
};

// The weights from one voxel to its neighbours; 0 where there is no edge. One of these per rule: what depends on the
// voxel alone is computed once.
template <typename Word>
struct FromHalfSum {
    const HalfSum<Word> &rule;
    const Real<Word> *operands;
    unsigned kinds;
    std::array<Word, 7> own{};

    void leave(uint64_t place) {
        for (unsigned kind = 0; kind < kinds; ++kind)
            own[kind] = rule.half(operands[place], kind);
    }
    Word to(uint64_t place, const Hop &hop) const { return own[hop.kind] + rule.half(operands[place], hop.kind); }
};

template <typename Word, typename Rule>
struct FromPair {
    const Rule &rule;
    const Real<Word> *operands;
    Real<Word> own{};

    void leave(uint64_t place) { own = operands[place]; }
    Word to(uint64_t place, const Hop &hop) const { return rule(own, operands[place], hop.kind); }
};

// Any rule and graphs with cut edges, edge by edge.
template <typename Word, typename Place>
struct FromGraph {
    const Lattice<Word, Place> &lattice;
    uint64_t own = 0;

    void leave(uint64_t place) { own = lattice.voxel(static_cast<Place>(place)); }
    Word to(uint64_t, const Hop &hop) const {
        return static_cast<Word>(lattice.graph().weight(own, lattice.graph().grid().neighbour(hop.number)));
    }
};

// Call run(from) with the weights of the lattice's graph.
template <typename Word, typename Place, typename Run>
void with_weights(const Lattice<Word, Place> &lattice, Run &&run) {
    const Graph &graph = lattice.graph();
    if (graph.cuts() == nullptr) {
        if (const auto *sum = std::get_if<HalfSum<Word>>(&graph.weights()))
            return run(FromHalfSum<Word>{*sum, lattice.operands(), graph.grid().kinds()});
        if (const auto *larger = std::get_if<Larger<Word>>(&graph.weights()))
            return run(FromPair<Word, Larger<Word>>{*larger, lattice.operands()});
        if (const auto *mean = std::get_if<MeanStiffness<Word>>(&graph.weights()))
            return run(FromPair<Word, MeanStiffness<Word>>{*mean, lattice.operands()});
    }
    run(FromGraph<Word, Place>{lattice});
}

// Lower the words of the neighbours of `place`, whose own is `word`, by the paths through it; lowered(neighbour, old
// word, new word) is called before each change. A neighbour that is not above us is left without computing the weight:
// that cannot help it.
template <typename Word, typename From, typename Lowered>
inline void relax(Word word, uint64_t place, Word *words, const std::vector<Hop> &hops, From &from, uint32_t label_bits,
                  Word limit, bool &clipped, Lowered &&lowered) {
    from.leave(place);
    for (const Hop &hop : hops) {
        const uint64_t next = place + static_cast<uint64_t>(hop.step);
        const Word old = words[next];
        if (old <= word)
            continue;
        const Word weight = from.to(next, hop);
        if (weight == 0)
            continue;
        const Word longer = word + static_cast<Word>(weight << label_bits);
        if (longer > limit) {
            clipped = true;
            continue;
        }
        if (longer >= old)
            continue;
        lowered(next, old, longer);
        words[next] = longer;
    }
}

// Build the lattice of the right types for a graph and return run(lattice).
template <typename Run>
auto with_lattice(const Graph &graph, Run &&run) {
    const Grid &grid = graph.grid();
    const double places =
        static_cast<double>(grid.nx() + 2) * static_cast<double>(grid.ny() + 2) * static_cast<double>(grid.nz() + 2);
    const auto build = [&]<typename Word, typename Place>(Word, Place) {
        Lattice<Word, Place> lattice(graph);
        return run(lattice);
    };
    if (places < 0x1p32)
        return graph.layout().bits == 32 ? build(uint32_t{}, uint32_t{}) : build(uint64_t{}, uint32_t{});
    return graph.layout().bits == 32 ? build(uint32_t{}, uint64_t{}) : build(uint64_t{}, uint64_t{});
}

// What a plain engine does: build the lattice, run method(problem, lattice, progress) on it, copy the words back.
template <typename Method>
Report solve_on_lattice(const Problem &problem, Words &words, Progress &progress, Method &&method) {
    Stopwatch watch;
    return with_lattice(problem.graph, [&](auto &lattice) {
        const double imported = watch.lap();
        Report report = method(problem, lattice, progress);
        report.seconds_import = imported;
        report.seconds_solve = watch.lap();
        lattice.give(words);
        report.seconds_export = watch.lap();
        return report;
    });
}

} // namespace locus::graph
