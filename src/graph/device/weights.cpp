#include "graph/device/weights.hpp"

#include "graph/device/sibson.hpp"

#include <algorithm>
#include <bit>

namespace locus::device {
namespace {

using graph::Graph;
using graph::NaturalJob;
using graph::RowPile;
using graph::Share;

constexpr uint64_t queries_at_once = 1 << 17; // of a launch
constexpr uint64_t entries_expected = 16;     // of a row, on average
constexpr uint32_t first_margin = 8;          // voxels around a block's first query that its window holds
constexpr uint64_t most_taken = 32;           // queries that a block takes, neighbours mostly
constexpr uint64_t first_large_room = 1 << 17;
constexpr uint64_t small_slots = 256, first_large_slots = 1 << 12;
constexpr uint64_t cells_of_large_front = 4;
constexpr uint64_t least_room = 512, cells_of_front = 20; // a cell of a front for so many of a small window
constexpr uint64_t block_overhead = 512;                  // shared memory of a block that is not its window's

struct Query {
    uint64_t voxel, row;
};

// How windows are held.
struct Form {
    bool large = false;
    uint64_t room = 0, front = 0, slots = 0; // cells of a window, of a front, labels
    uint64_t memory = 0;                     // bytes that a block shares
};

template <typename Word>
class Batches {
public:
    Batches(Device &device, const Field<Word> &field, Memory<uint64_t> &kept, const NaturalJob &job)
        : device_(device), field_(field), kept_(kept), job_(job), graph_(job.field.graph()), whole_(1) {
        for (const uint64_t dim : graph_.grid().dims())
            whole_ = std::min<uint64_t>(whole_ * (dim + 2), uint64_t{1} << 40);
    }

    std::vector<RowPile> run(Progress &progress) {
        std::vector<Query> left = queries();
        const auto all = static_cast<double>(left.size());
        with_rule_of<Word>(graph_, field_.tables(), [&](const auto &rule, const Launch &launch) {
            Form form;
            for (bool first = true; !left.empty(); first = false) {
                form = first ? first_form() : next_form(form);
                prepare(rule, launch, form, left.size());
                std::vector<Query> failed;
                while (!left.empty()) {
                    form.large ? answer<true>(rule, launch, form, left, failed)
                               : answer<false>(rule, launch, form, left, failed);
                    progress.report(1 - static_cast<double>(left.size() + failed.size()) / all);
                }
                std::reverse(failed.begin(), failed.end());
                left = std::move(failed);
            }
        });
        return std::move(piles_);
    }

private:
    // They are taken from the end.
    std::vector<Query> queries() const {
        std::vector<Query> queries;
        queries.reserve(job_.rows.empty() ? job_.voxels.size() : job_.rows.size());
        if (job_.rows.empty())
            for (uint64_t row = job_.voxels.size(); row-- > 0;)
                queries.push_back({job_.voxels[row], row});
        else
            for (size_t i = job_.rows.size(); i-- > 0;)
                queries.push_back({job_.voxels[job_.rows[i]], job_.rows[i]});
        return queries;
    }

    // Windows in shared memory, as large as they can be there.
    Form first_form() const {
        if (uint64_t{graph_.grid().voxels()} > UINT32_MAX / 8) // the bricks of a thin grid hold up to 64 times as many
            if (field_.bricks_in_grid() > UINT32_MAX / kVoxels)
                return large_form(first_large_room, first_large_slots);
        const Form form = small_form(device_.machine().block_memory);
        return form.room != 0 ? form : large_form(first_large_room, first_large_slots);
    }
    Form next_form(const Form &form) const {
        if (!form.large)
            return large_form(first_large_room, first_large_slots);
        if (form.room == whole_ && form.slots >= labels())
            fail(LOCUS_E_INTERNAL, "a query found no place in a window of the whole grid");
        return large_form(4 * form.room, 8 * form.slots);
    }
    Form small_form(uint64_t memory) const {
        using Body = Sibson<Word, HalfSumRule<Word>, false>;
        Form form;
        const uint64_t fixed = block_overhead + small_slots * 2 * sizeof(uint32_t);
        const uint64_t of_front = sizeof(typename Body::Front) + 2 * sizeof(typename Body::Cell);
        if (memory < fixed + small_slots * of_front + least_room * sizeof(Word))
            return form;
        form.slots = small_slots;
        form.front = std::max((memory - fixed) / (cells_of_front * sizeof(Word) + of_front), small_slots);
        form.room = std::min({(memory - fixed - form.front * of_front) / sizeof(Word), whole_, uint64_t{UINT16_MAX}});
        form.memory = Body::bytes(form.room, form.front, form.slots);
        return form;
    }
    uint64_t labels() const { return graph_.layout().labels(); }
    Form large_form(uint64_t room, uint64_t slots) const {
        Form form;
        form.large = true;
        form.room = std::min(room, whole_);
        form.slots = std::min(slots, 2 * labels());
        form.front = std::max(form.room == whole_ ? whole_ : form.room / cells_of_large_front, form.slots);
        return form;
    }

    // Scratch memory for as many blocks as run at the same time, have a query each and the budget allows.
    template <typename Rule>
    void prepare(const Rule &rule, Launch launch, const Form &form, uint64_t queries) {
        scratch_ = {};
        if (!form.large) {
            launch.kernel = Kernel::sibson;
            launch.memory = form.memory;
            blocks_ = device_.resident(launch, body<false>(rule, form));
            return;
        }
        launch.kernel = Kernel::sibson_large;
        const uint64_t bytes = Sibson<Word, Rule, true>::bytes(form.room, form.front, form.slots);
        if (bytes > job_.bytes || form.room > UINT32_MAX)
            fail(LOCUS_E_MEMORY, "batch_bytes is ", job_.bytes, ": a query on the GPU needs ", bytes);
        blocks_ = std::min({device_.resident(launch, body<true>(rule, form)), job_.bytes / bytes, queries});
        scratch_ = device_.allocate<uint64_t>(blocks_ * bytes / sizeof(uint64_t));
    }

    template <bool large, typename Rule>
    Sibson<Word, Rule, large> body(const Rule &rule, const Form &form) const {
        Sibson<Word, Rule, large> sibson{};
        sibson.bricks = field_.bricks();
        sibson.rule = rule;
        sibson.least = static_cast<Word>(graph_.smallest_weight());
        sibson.label_bits = graph_.layout().label_bits;
        sibson.most = job_.most;
        sibson.margin = first_margin;
        sibson.room = static_cast<uint32_t>(form.room);
        sibson.front = static_cast<uint32_t>(form.front);
        sibson.slots = static_cast<uint32_t>(form.slots);
        sibson.scratch = reinterpret_cast<unsigned char *>(scratch_.get());
        return sibson;
    }

    // One launch: from the end of `left`; those that found no place go to `failed`, those whose rows found none back
    // to `left`.
    template <bool large, typename Rule>
    void answer(const Rule &rule, Launch launch, const Form &form, std::vector<Query> &left,
                std::vector<Query> &failed) {
        const uint64_t count = std::min<uint64_t>(left.size(), queries_at_once);
        const uint64_t room = std::max(count * entries_expected, form.slots);
        // Queries and counters; answers; rows.
        static_assert(sizeof(Answer) == 2 * sizeof(uint64_t) && sizeof(Share) == sizeof(uint64_t));
        std::vector<uint64_t> asked;
        asked.reserve(count + 2);
        for (uint64_t i = 0; i < count; ++i)
            asked.push_back(left[left.size() - 1 - i].voxel);
        asked.resize(count + 2, 0);
        if (kept_.count() < asked.size() + 2 * count + room) {
            kept_ = {};
            kept_ = device_.allocate<uint64_t>(asked.size() + 2 * count + room);
        }
        device_.upload(kept_.get(), std::span<const uint64_t>(asked));
        auto *const answers = reinterpret_cast<Answer *>(kept_.get() + asked.size());
        auto *const rows = reinterpret_cast<Share *>(answers + count);

        Sibson<Word, Rule, large> sibson = body<large>(rule, form);
        const uint64_t blocks = std::min(blocks_, count);
        sibson.queries = kept_.get();
        sibson.query_count = static_cast<uint32_t>(count);
        sibson.at_once = static_cast<uint32_t>(std::clamp<uint64_t>(count / (16 * blocks), 1, most_taken));
        sibson.taken = reinterpret_cast<uint32_t *>(kept_.get() + count);
        sibson.counted = kept_.get() + count + 1;
        sibson.answers = answers;
        sibson.rows = rows;
        sibson.counted_room = room;
        launch.kernel = large ? Kernel::sibson_large : Kernel::sibson;
        launch.memory = form.memory;
        device_.launch(launch, sibson, blocks);
        take(count, answers, rows, left, failed);
    }

    void take(uint64_t count, const Answer *answers, const Share *rows, std::vector<Query> &left,
              std::vector<Query> &failed) {
        answers_.resize(count);
        device_.download(std::span<Answer>(answers_), answers);
        uint64_t counted = 0;
        for (const Answer &answer : answers_)
            if (answer.length < Answer::no_room)
                counted = std::max(counted, answer.first + answer.length);
        RowPile &pile = piles_.emplace_back();
        pile.shares.resize(counted);
        device_.download(std::span<Share>(pile.shares), rows);
        for (auto *each : {&pile.place, &pile.begin, &pile.end})
            each->reserve(count);
        std::vector<Query> again;
        for (const Answer &answer : answers_) {
            const Query query = left.back();
            left.pop_back();
            if (answer.length >= Answer::no_room) {
                (answer.length == Answer::no_room ? again : failed).push_back(query);
                continue;
            }
            pile.place.push_back(query.row);
            pile.begin.push_back(answer.first);
            pile.end.push_back(answer.first + answer.length);
        }
        left.insert(left.end(), again.rbegin(), again.rend());
    }

    Device &device_;
    const Field<Word> &field_;
    Memory<uint64_t> &kept_;
    const NaturalJob &job_;
    const Graph &graph_;
    uint64_t whole_; // cells of a window that holds the whole grid
    uint64_t blocks_ = 0;
    Memory<uint64_t> scratch_;
    std::vector<Answer> answers_;
    std::vector<RowPile> piles_;
};

template <typename Word>
std::vector<RowPile> import_and_run(Device &device, const NaturalJob &job, Progress &progress) {
    Field<Word> field(device, job.field.graph());
    field.take(job.field.words());
    Memory<uint64_t> kept;
    return sibson_rows(device, field, kept, job, progress);
}

} // namespace

template <typename Word>
std::vector<RowPile> sibson_rows(Device &device, const Field<Word> &field, Memory<uint64_t> &kept,
                                 const NaturalJob &job, Progress &progress) {
    return Batches<Word>(device, field, kept, job).run(progress);
}
template std::vector<RowPile> sibson_rows(Device &, const Field<uint32_t> &, Memory<uint64_t> &, const NaturalJob &,
                                          Progress &);
template std::vector<RowPile> sibson_rows(Device &, const Field<uint64_t> &, Memory<uint64_t> &, const NaturalJob &,
                                          Progress &);

std::vector<RowPile> sibson_rows(Device &device, const NaturalJob &job, Progress &progress) {
    return job.field.graph().layout().bits == 32 ? import_and_run<uint32_t>(device, job, progress)
                                                 : import_and_run<uint64_t>(device, job, progress);
}

} // namespace locus::device
