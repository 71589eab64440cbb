// Dijkstra with buckets (Dial 1969) as wide as the smallest edge weight allows: nothing in a bucket can then improve
// anything in the same bucket, so its voxels may be settled in any order (Denardo and Fox 1979).
#pragma once

#include "graph/bucket_queue.hpp"
#include "graph/lattice.hpp"

#include <bit>

namespace locus::graph {

// Lower the words of the lattice to what they are with these sources added. Only voxels that the new sources come
// closest to are visited; on a fresh lattice that is all of them. On a fresh lattice a voxel whose word falls within
// its bucket needs no new entry, as the one that brought it there is still queued; later the old word may stem from an
// earlier call.
template <typename Word, typename Place>
Report spread(const Problem &problem, Lattice<Word, Place> &lattice, Progress &progress, bool fresh) {
    const WordLayout &layout = problem.graph.layout();
    const auto limit = static_cast<Word>(layout.pack(problem.limit(), layout.labels() - 1));
    const auto all = static_cast<double>(problem.graph.passable_voxels());
    const auto shift = layout.label_bits + static_cast<uint32_t>(std::bit_width(problem.graph.smallest_weight()) - 1);
    Report report;
    Word *words = lattice.words().data();
    const auto key_of = [&](Place place) { return static_cast<uint64_t>(words[place] >> shift); };
    BucketQueue<Place> queue;
    for (const Source &source : problem.sources) {
        const Place place = lattice.place(source.voxel);
        const auto word = static_cast<Word>(layout.pack(source.distance, source.label));
        if (word >= words[place] || word > limit)
            continue;
        words[place] = word;
        queue.push(key_of(place), place);
    }
    uint64_t settled = 0;
    with_weights(lattice, [&](auto from) {
        std::vector<Place> bucket;
        while (queue.pop(bucket, key_of)) {
            const uint64_t before = settled;
            for (const Place place : bucket) {
                if (key_of(place) != queue.last())
                    continue; // it was improved into an earlier bucket
                ++settled;
                relax(words[place], place, words, lattice.hops(), from, layout.label_bits, limit, report.clipped,
                      [&](uint64_t next, Word old, Word word) {
                          if (!fresh || old >> shift != word >> shift)
                              queue.push(word >> shift, static_cast<Place>(next));
                      });
            }
            if (settled == before)
                continue;
            ++report.iterations;
            if (problem.trace)
                report.trace.push_back(settled - before);
            progress.report(static_cast<double>(settled) / all);
        }
    });
    report.relaxations = settled * lattice.hops().size();
    return report;
}

} // namespace locus::graph
