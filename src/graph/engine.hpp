// What every engine does: from a graph and sources, the packed word of every voxel. All engines give the same words.
#pragma once

#include "core/pages.hpp"
#include "core/progress.hpp"
#include "graph/graph.hpp"
#include "graph/reading.hpp"

#include <locus/diagram.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace locus::graph {

// Where a label starts. Several sources may share a voxel; the smallest (distance, label) wins.
struct Source {
    uint64_t voxel;    // passable
    uint64_t distance; // in steps, at most max_exact
    uint32_t label;    // below layout().labels(); of equal distances the smaller label wins
    bool operator==(const Source &) const = default;
};

struct Problem {
    const Graph &graph;
    std::span<const Source> sources;
    uint64_t cutoff = UINT64_MAX; // in steps: voxels farther than this stay unreached; may exceed what the words hold
    bool trace = false;
    bool anew = false; // an update: there is no result before it, all that is reached has changed

    // The largest distance that is kept.
    uint64_t limit() const { return std::min(cutoff, graph.layout().max_exact()); }
    // Whether some path may be longer than the words hold. Where not, no engine needs to look.
    bool may_overflow() const {
        Wide longest = 0;
        for (const Source &source : sources)
            longest = std::max<Wide>(longest, source.distance);
        return cutoff > graph.layout().max_exact() && longest + graph.longest_path() > graph.layout().max_exact();
    }
};

// What is known of words that stayed on an engine's device.
struct Kept {
    uint64_t reached;   // voxels
    uint64_t max_exact; // the largest of their distances
};

// What a solve did.
struct Report {
    uint64_t relaxations = 0;
    uint64_t iterations = 0;
    double seconds_import = 0;
    double seconds_solve = 0;
    double seconds_export = 0;
    uint32_t threads = 1;
    bool clipped = false;        // some path was longer than limit(); may be true without need
    std::optional<Kept> kept;    // the words are on the engine's device alone, what stands in `words` is no result
    std::vector<uint64_t> trace; // active voxels per iteration, where Problem::trace asks and the engine has iterations
};

// A word per voxel, x fastest; unreached() where no source reaches within the limit, and on impassable voxels.
using Words = std::variant<std::vector<uint32_t>, std::vector<uint64_t>>;

// Memory for `voxels` words: that of `words`, which are left empty then, where it has the size.
template <typename Word>
std::vector<Word> memory_of(Words &words, uint64_t voxels) {
    if (auto *same = std::get_if<std::vector<Word>>(&words); same != nullptr && same->size() == voxels)
        return std::exchange(*same, {});
    std::vector<Word> memory;
    memory.reserve(voxels);
    prefer_large_pages(memory.data(), voxels * sizeof(Word));
    memory.resize(voxels);
    return memory;
}
inline bool has_memory_gone(const Words &words) {
    return std::visit([](const auto &each) { return each.empty(); }, words);
}

// The voxels whose words an update changed, and the smallest box around them; its extents are 0 where there are none.
struct Change {
    uint64_t voxels = 0;
    Box box{};
};

// Of so many voxels, the lowest and highest places of which are `first` and `last` along each axis.
template <typename Place>
Change change_between(uint64_t voxels, const Place &first, const Place &last) {
    Change change{voxels, {}};
    for (size_t axis = 0; axis < 3 && voxels > 0; ++axis) {
        change.box.origin[axis] = first[axis];
        change.box.extent[axis] = last[axis] - first[axis] + 1;
    }
    return change;
}

struct NaturalJob;
struct RowPile;

class Engine {
public:
    virtual ~Engine() = default;
    virtual uint32_t kind() const = 0; // LOCUS_ENGINE_
    virtual uint32_t backend() const { return LOCUS_BACKEND_CPU; }
    // Whatever is thrown (out of memory, stopped, a caller's weight out of range), `words` is as before then; or empty,
    // where a device failed while the new ones were written into their memory.
    virtual Report solve(const Problem &problem, Words &words, Progress &progress) = 0;
    // The same words, where `words` are still those of this engine's latest solve or update, of the same graph; engines
    // that can do so look only at what was edited since. The plain way: solve and compare.
    virtual Report update(const Problem &problem, Words &words, Progress &progress, Change &change);
    // The words of the latest solve or update that stayed on the device, for as often as they are asked for: a failure
    // loses nothing.
    virtual void fetch(Words &) {}
    // Write what is asked into memory of the device that holds the words of the latest solve or update, and wait for it
    // unless the stream is the caller's. Throws where there is no such device.
    virtual void write(const Reading &reading, void *to);
    // Rows of weights of this engine's latest solve or update, whose words are the job's, from what it keeps of it;
    // false where it cannot make them. At the same time as others of the same.
    virtual bool natural_rows(const NaturalJob &, std::vector<RowPile> &, Progress &) { return false; }
    // Memory kept from one call to the next.
    virtual size_t bytes() const { return 0; }
};

// The CPU's engine for a LOCUS_ENGINE_ constant; throws LOCUS_E_ARGUMENT for others.
std::unique_ptr<Engine> make_engine(uint32_t kind);
// The engine for a diagram of a graph, on the graph's backend.
std::unique_ptr<Engine> make_engine(const Graph &graph, const locus_diagram_options &options);

// The distance of the nearest voxel left unreached, or UINT64_MAX where no edge leads from a reached to an unreached
// one: whether words that came out of a solve missed anything, by the edges across their frontier.
uint64_t next_distance(const Graph &graph, const Words &words);

} // namespace locus::graph
