// A graph in bricks on a device: its operands, its cut edges and the words of the latest solve, which stay there for
// the next solve or update.
#pragma once

#include "graph/device/bricks.hpp"
#include "graph/device/device.hpp"
#include "graph/device/halo.hpp"
#include "graph/device/metric.hpp"
#include "graph/device/transfer.hpp"
#include "graph/engine.hpp"

namespace locus::device {

// What the rounds of a solve or update did.
struct Work {
    uint64_t rounds = 0;   // that had work,
    uint64_t launched = 0; // and those beside them at the end
    uint64_t visits = 0;
    uint64_t vain = 0;   // visits that changed nothing
    uint64_t passes = 0; // over a brick's rows, in all visits
};

template <typename Word>
class Field {
public:
    Field(Device &device, const graph::Graph &graph);

    // As Engine::solve and Engine::update; after any failure the field is of no more use. `words` null: they stay on
    // the device. `change` not null: what it changed, which only words that stay there ask for.
    graph::Report solve(const graph::Problem &problem, graph::Words *words, Progress &progress,
                        graph::Change *change = nullptr);
    bool can_update(const graph::Problem &problem, const graph::Words *words) const;
    graph::Report update(const graph::Problem &problem, graph::Words *words, Progress &progress, graph::Change &change);

    // The words of the latest of these; a failure changes nothing.
    bool solved() const { return solved_; }
    void give(graph::Words &words);
    void write(const graph::Reading &reading, void *to);

    // Words of a solve elsewhere, of the graph as it is. Only an update asks for more than words.
    void take(const graph::Words &words);

    // What is on the device: the graph as imported, the words of the latest solve, update or take().
    Bricks<Word> bricks() const;
    const RuleTables<Word> &tables() const { return tables_; }

    uint64_t bytes() const;
    const Work &work() const { return work_; }
    uint64_t bricks_in_grid() const { return key_.count(); }

private:
    Layout layout() const;
    Rounds rounds(bool record) const;
    Seeds<Word> seeds() const { return {seed_address_.get(), seed_word_.get(), sources_.size()}; }
    Launch launch(Kernel kernel) const;
    template <typename T>
    void fill(const Memory<T> &to, T value);

    // Of the bricks in a list, packed.
    std::vector<float> operands(std::span<const uint32_t> list) const;
    std::vector<uint32_t> open_edges(std::span<const uint32_t> list) const;
    void import();
    void import_operands();
    void import_open_edges();
    void import(std::span<const uint32_t> list);
    void set_sources(std::span<const graph::Source> sources);

    void begin_rounds();
    void plant(bool record);
    void run_rounds(bool raise, bool record, Progress &progress);
    std::vector<uint32_t> edited_bricks(std::span<const graph::Source> sources) const;
    void remember(const graph::Problem &problem);
    Tallied tally(bool compare);
    void keep(graph::Change *change, graph::Report &report);
    graph::Change give_touched(graph::Words &words);

    Device &device_;
    const graph::Graph &graph_;
    RuleTables<Word> tables_;
    Memory<Word> words_;
    Memory<float> operands_;
    Memory<uint32_t> open_;
    Memory<Control> control_;
    Memory<BorderCell> border_;
    Memory<uint32_t> key_, waiting_, near_, touched_, is_touched_;
    Memory<uint64_t> seed_address_;
    Memory<Word> seed_word_;
    Memory<Tallied> tallied_;
    Memory<Word> before_; // where words stay on the device and an update tells what it changed: those it began with
    bool remembered_ = false;
    Memory<uint32_t> ids_; // of the seeds, by label, once they were asked for
    bool has_ids_ = false;

    std::optional<uint64_t> imported_; // the graph's version when its materials were read
    bool solved_ = false;              // the words are those of sources_ at version imported_
    Word beyond_ = 0;
    uint64_t reached_ = 0;
    std::vector<graph::Source> sources_;
    uint32_t round_ = 0;
    uint32_t at_once_ = 0;
    Work work_;
};

} // namespace locus::device
