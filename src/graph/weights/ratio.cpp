#include "graph/weights/ratio.hpp"

#include "graph/weights/tasks.hpp"
#include "graph/weights/window.hpp"

#include <algorithm>
#include <numeric>

namespace locus::graph {
namespace {

constexpr uint64_t first_margin = 8;

// What one seed weighs at one voxel, before normalising.
struct Part {
    uint32_t voxel; // its number among the wanted ones
    uint32_t label;
    float weight;
};

// The voxels that rows are wanted for, numbered.
class Wanted {
public:
    static constexpr uint32_t none = UINT32_MAX;

    explicit Wanted(const RatioJob &job) : number_(job.field.grid().voxels(), none) {
        for (const uint64_t voxel : job.voxels) {
            uint32_t &number = number_[voxel];
            if (number == none)
                number = count_++;
        }
    }
    uint32_t number(uint64_t voxel) const { return number_[voxel]; }
    uint32_t count() const { return count_; }

private:
    std::vector<uint32_t> number_;
    uint32_t count_ = 0;
};

// Seeds in the order of 3-D blocks, so that sixteen in a row lie near each other: 3-D Morton codes of their voxels.
std::vector<Source> by_place(const Grid &grid, std::span<const Source> seeds, std::span<const Cell> cells) {
    const auto code = [&](uint64_t voxel) {
        const auto place = grid.place(voxel);
        uint64_t code = 0;
        for (unsigned bit = 0; bit < 21; ++bit)
            for (unsigned a = 0; a < 3; ++a)
                code |= (place[a] >> bit & 1) << (3 * bit + a);
        return code;
    };
    std::vector<Source> sorted;
    for (const Source &seed : seeds)
        if (!cells[seed.label].empty())
            sorted.push_back(seed);
    std::sort(sorted.begin(), sorted.end(), [&](const Source &a, const Source &b) {
        const uint64_t first = code(a.voxel), second = code(b.voxel);
        return first != second ? first < second : a.label < b.label;
    });
    return sorted;
}

// The weight at a voxel (see locus/weights.h): dp to the seed, db to the border of its cell; `inside` the cell.
double weigh(bool inside, uint64_t to_seed, uint64_t to_border) {
    const auto dp = static_cast<double>(to_seed), db = static_cast<double>(to_border);
    double weight = 0;
    if (inside)
        weight = to_seed == 0 ? 1 : (1 + db / (dp + db)) / 2;
    else if (to_seed > to_border)
        weight = (1 - db / (dp - db)) / 2;
    constexpr double smallest = 1e-4;
    return weight < smallest ? 0 : (weight > 1 - smallest ? 1 : weight);
}

// Sixteen seeds at a time: one search for the distances to them, a second one from the borders of their cells.
template <typename Word>
class RatioWorker {
public:
    RatioWorker(const RatioJob &job, const std::vector<Source> &seeds, const Wanted &wanted, Tasks &tasks,
                uint64_t bytes, bool on_callers_thread)
        : job_(job), grid_(job.field.grid()), seeds_(seeds), wanted_(wanted), tasks_(tasks), bytes_(bytes),
          on_callers_thread_(on_callers_thread), kernels_(settle_kernels(job.simd).of<Word>()),
          lane_of_label_(job.cells.size(), batch_lanes) {}

    std::vector<Part> run() {
        while (const auto batch = tasks_.take(0)) {
            lanes_ = std::span(seeds_).subspan(batch->number * batch_lanes);
            lanes_ = lanes_.first(std::min<size_t>(lanes_.size(), batch_lanes));
            if (search_batch(*batch))
                tasks_.done(on_callers_thread_);
        }
        return std::move(parts_);
    }

private:
    const Cell &cell(unsigned lane) const { return job_.cells[lanes_[lane].label]; }

    bool search_batch(const Tasks::Task &batch) {
        Box box = cell(0).box;
        for (unsigned lane = 1; lane < lanes_.size(); ++lane)
            join(box, cell(lane).box);
        for (uint64_t margin = first_margin;; margin *= 2) {
            const Box wide = widen(grid_, box, margin);
            const uint64_t bytes =
                Window<Word>::bytes(wide) * 2; // less than twice: the second search keeps the words of the first
            if (bytes > bytes_) {
                tasks_.give_back(batch, bytes);
                return false;
            }
            if (!window_.holds(wide))
                window_.open(job_.field, wide);
            if (search_seeds() && search_borders())
                break;
            window_.restore(kernels_);
        }
        collect();
        window_.restore(kernels_);
        return true;
    }

    static void join(Box &box, const Box &other) {
        for (unsigned a = 0; a < 3; ++a) {
            const uint64_t end = std::max(box.origin[a] + box.extent[a], other.origin[a] + other.extent[a]);
            box.origin[a] = std::min(box.origin[a], other.origin[a]);
            box.extent[a] = end - box.origin[a];
        }
    }

    // One beyond the farthest distance a lane has to know: words that stay there were not reached.
    std::array<Word, batch_lanes> bounds(uint64_t (*limit)(const Cell &)) const {
        std::array<Word, batch_lanes> bounds{};
        for (unsigned lane = 0; lane < lanes_.size(); ++lane)
            bounds[lane] = static_cast<Word>(limit(cell(lane)) + 1);
        return bounds;
    }

    // False where the window is too small.
    bool search_seeds() {
        window_.bound(bounds([](const Cell &c) { return std::max(c.support(), c.crossing); }));
        for (unsigned lane = 0; lane < lanes_.size(); ++lane)
            window_.start(window_.local(grid_.place(lanes_[lane].voxel)), lane,
                          static_cast<Word>(lanes_[lane].distance));
        window_.settle(kernels_);
        return !window_.too_small(grid_);
    }

    bool search_borders() {
        to_seed_.resize(window_.voxels() * batch_lanes);
        window_.for_touched(0, [&](size_t first, size_t last) {
            std::copy(window_.reach(first), window_.reach(last) + batch_lanes, &to_seed_[first * batch_lanes]);
        });
        touched_.clear();
        window_.for_touched(0, [&](size_t first, size_t last) { touched_.push_back({first, last}); });
        window_.restore(kernels_);
        // From the border a voxel of the cell is no farther than through the seed.
        window_.bound(bounds([](const Cell &c) { return 2 * std::max(c.support(), c.crossing); }));
        for (unsigned lane = 0; lane < lanes_.size(); ++lane)
            lane_of_label_[lanes_[lane].label] = lane;
        for (const auto &[first, last] : touched_)
            for (size_t v = first; v <= last; ++v)
                for (unsigned axis = 0; axis < 3; ++axis)
                    start_border(v - window_.steps()[axis], v, window_.back(v, backward_face[axis]));
        for (const Source &seed : lanes_)
            lane_of_label_[seed.label] = batch_lanes;
        window_.settle(kernels_);
        return !window_.too_small(grid_);
    }

    // Two voxels that share a face, and the weight of the edge between them.
    void start_border(size_t a, size_t b, Word weight) {
        if (weight >= far_away<Word> || window_.label(a) == window_.label(b))
            return;
        cross(a, b);
        cross(b, a);
    }
    void cross(size_t inside, size_t outside) {
        const unsigned lane = lane_of_label_[window_.label(inside)];
        if (lane == batch_lanes)
            return;
        const Word to_seed = to_seed_[outside * batch_lanes + lane], own = window_.nearest(outside);
        const Word middle = (own + to_seed) / 2; // the distance at which the two cells meet
        window_.start(outside, lane, (to_seed - own) / 2);
        window_.start(inside, lane, middle - std::min(middle, window_.nearest(inside)));
    }

    void collect() {
        for (const auto &[first, last] : touched_)
            for (size_t v = first; v <= last; ++v) {
                const uint32_t number = wanted_.number(window_.voxel(grid_, v));
                if (number == Wanted::none)
                    continue;
                for (unsigned lane = 0; lane < lanes_.size(); ++lane)
                    collect(v, number, lane);
            }
    }
    void collect(size_t v, uint32_t number, unsigned lane) {
        const Word to_seed = to_seed_[v * batch_lanes + lane];
        const bool inside = window_.label(v) == lanes_[lane].label;
        if (to_seed > cell(lane).support() && !inside)
            return;
        const double weight = inside && cell(lane).alone ? 1 : weigh(inside, to_seed, window_.reach(v)[lane]);
        if (weight > 0)
            parts_.push_back({number, lanes_[lane].label, static_cast<float>(weight)});
    }

    const RatioJob &job_;
    const Grid &grid_;
    const std::vector<Source> &seeds_;
    const Wanted &wanted_;
    Tasks &tasks_;
    uint64_t bytes_;
    bool on_callers_thread_;
    const SettleKernels<Word> &kernels_;
    std::vector<unsigned> lane_of_label_; // batch_lanes: none
    std::span<const Source> lanes_;
    Window<Word> window_;
    std::vector<Word, PageAllocator<Word>> to_seed_;
    std::vector<std::pair<size_t, size_t>> touched_; // by the search from the seeds
    std::vector<Part> parts_;
};

// The parts of each row together, by counting.
Rows by_row(const RatioJob &job, const Wanted &wanted, const std::vector<std::vector<Part>> &piles) {
    Rows rows; // of the wanted voxels
    rows.offsets.assign(size_t{wanted.count()} + 1, 0);
    for (const auto &parts : piles)
        for (const Part &part : parts)
            ++rows.offsets[part.voxel + 1];
    std::partial_sum(rows.offsets.begin(), rows.offsets.end(), rows.offsets.begin());
    rows.shares.resize(rows.offsets.back());
    std::vector<uint64_t> next(rows.offsets.begin(), rows.offsets.end() - 1);
    for (const auto &parts : piles)
        for (const Part &part : parts)
            rows.shares[next[part.voxel]++] = {part.label, part.weight};
    if (wanted.count() == job.voxels.size())
        return rows; // numbered in the order of the rows
    Rows several;
    for (const uint64_t voxel : job.voxels)
        add_row(several, rows.row(wanted.number(voxel)));
    return several;
}

template <typename Word>
Rows run(const RatioJob &job, Progress &progress) {
    const std::vector<Source> seeds = by_place(job.field.grid(), job.seeds, job.cells);
    const Wanted wanted(job);
    const size_t batches = (seeds.size() + batch_lanes - 1) / batch_lanes;
    Tasks tasks({&batches, 1}, batches, progress);
    std::vector<std::vector<Part>> piles;
    std::mutex mutex;
    tasks.run(job.threads, job.bytes, [&](uint32_t rank, uint64_t bytes) {
        auto parts = RatioWorker<Word>(job, seeds, wanted, tasks, bytes, rank == 0).run();
        const std::lock_guard lock(mutex);
        piles.push_back(std::move(parts));
    });
    return by_row(job, wanted, piles);
}

// Whether the concerned labels weigh in one row what they weighed; mostly they stand in the same order.
bool same_parts(std::span<const Share> old, std::span<const Share> now, const std::vector<bool> &concerned) {
    size_t met = 0;
    for (const Share &share : old) {
        if (!concerned[share.label])
            continue;
        const bool same = met < now.size() && now[met] == share;
        if (!same && std::ranges::find(now, share) == now.end())
            return false;
        ++met;
    }
    return met == now.size();
}

void finish(std::span<const Share> parts, uint32_t most, std::vector<RawShare> &row, Rows &rows) {
    row.clear();
    for (const Share &part : parts)
        row.push_back({part.label, double{part.weight}});
    finish_row(row, most, rows.shares);
    rows.offsets.push_back(rows.shares.size());
}

} // namespace

Rows ratio_parts(const RatioJob &job, Progress &progress) {
    uint64_t most = 0;
    for (const Cell &cell : job.cells)
        most = std::max(most, 2 * std::max(cell.support(), cell.crossing));
    return most + 1 < far_away<uint32_t> ? run<uint32_t>(job, progress) : run<uint64_t>(job, progress);
}

Rows ratio_rows(const Rows &parts, uint32_t most) {
    Rows rows;
    rows.offsets.reserve(parts.offsets.size());
    std::vector<RawShare> row;
    for (uint64_t i = 0; i < parts.count(); ++i)
        finish(parts.row(i), most, row, rows);
    return rows;
}

Renewed renew_rows(const Rows &parts, const Rows &rows, const Rows &fresh, const std::vector<bool> &concerned,
                   uint32_t most) {
    Renewed renewed;
    std::vector<RawShare> scratch;
    for (uint64_t i = 0; i < parts.count(); ++i) {
        const auto old = parts.row(i), now = fresh.row(i);
        if (same_parts(old, now, concerned)) {
            add_row(renewed.parts, old);
            add_row(renewed.rows, rows.row(i));
            continue;
        }
        for (const Share &share : old)
            if (!concerned[share.label])
                renewed.parts.shares.push_back(share);
        add_row(renewed.parts, now);
        finish(renewed.parts.row(i), most, scratch, renewed.rows);
        if (!std::ranges::equal(renewed.rows.row(i), rows.row(i)))
            renewed.changed.push_back(i);
    }
    return renewed;
}

} // namespace locus::graph
