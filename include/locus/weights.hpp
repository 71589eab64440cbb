/* locus/weights.hpp - locus::weights, the owner of a locus_weights. Each member is the C function of its name: see
 * locus/weights.h for units, ranges and errors. */
#ifndef LOCUS_WEIGHTS_HPP
#define LOCUS_WEIGHTS_HPP

#include <locus/diagram.hpp>
#include <locus/weights.h>

namespace locus {

struct weights_options : locus_weights_options {
    explicit weights_options(std::uint32_t method_wanted = LOCUS_METHOD_SIBSON) noexcept {
        locus_weights_options_init(this, sizeof(locus_weights_options));
        method = method_wanted;
    }
    locus::progress progress; /* kept, and called by weights::update too */
};

/* Rows of weights: row i has the entries offsets[i] .. offsets[i + 1] - 1 of `ids` and `values`. */
struct weight_rows {
    std::vector<std::uint64_t> offsets;
    std::vector<std::uint32_t> ids;
    std::vector<float> values;
};

class weights {
public:
    /* An empty handle: only assigning to it and destroying it are allowed. */
    weights() noexcept = default;
    /* The weights of all voxels of a box. */
    explicit weights(diagram &diagram, const weights_options &options = weights_options(), within box = {},
                     status *result = nullptr) {
        make(diagram, options, result, [&](const locus_weights_options &plain, locus_weights **made) {
            return locus_weights_create(diagram.get(), &plain, box.get(), made);
        });
    }
    /* The weights of a list of voxels, given by their indices. */
    weights(diagram &diagram, const weights_options &options, span<const std::uint64_t> voxels,
            status *result = nullptr) {
        make(diagram, options, result, [&](const locus_weights_options &plain, locus_weights **made) {
            return locus_weights_create_for(diagram.get(), &plain, voxels.data(), voxels.size(), made);
        });
    }

    explicit operator bool() const noexcept { return handle_ != nullptr; }
    /* The C handle; it stays this object's. */
    locus_weights *get() const noexcept { return handle_.get(); }

    std::uint64_t row_count(status *result = nullptr) const {
        std::uint64_t rows = 0;
        detail::settle(locus_weights_size(get(), &rows, nullptr), result);
        return rows;
    }
    std::uint64_t entry_count(status *result = nullptr) const {
        std::uint64_t entries = 0;
        detail::settle(locus_weights_size(get(), nullptr, &entries), result);
        return entries;
    }

    /* Rows of weights; a first row and a count, or all of them. */
    weight_rows rows(std::uint64_t first, std::uint64_t count, status *result = nullptr) const {
        std::uint64_t rows = 0, entries = 0;
        weight_rows found;
        if (!detail::settle(locus_weights_size(get(), &rows, nullptr), result))
            return found;
        /* The library refuses rows that are not there; no memory is taken for them. */
        found.offsets.resize(first <= rows && count <= rows - first ? count + 1 : 1);
        locus_status code =
            locus_weights_rows(get(), first, count, found.offsets.data(), nullptr, nullptr, 0, &entries);
        if (code == LOCUS_E_CAPACITY) {
            found.ids.resize(entries);
            found.values.resize(entries);
            code = locus_weights_rows(get(), first, count, found.offsets.data(), found.ids.data(), found.values.data(),
                                      entries, nullptr);
        }
        if (!detail::settle(code, result))
            found = {};
        return found;
    }
    weight_rows rows(status *result = nullptr) const { return rows(0, unchecked_rows(), result); }

    /* Entry [i][j] of the dense rows is the weight of seed ids[j] at row first + i. */
    void dense(span<float> into, std::uint64_t first, std::uint64_t count, span<const std::uint32_t> ids,
               status *result = nullptr) const {
        detail::settle(locus_weights_dense(get(), first, count, ids.data(), ids.size(), into.data(), into.size()),
                       result);
    }
    std::vector<float> dense(span<const std::uint32_t> ids, status *result = nullptr) const {
        std::vector<float> found(unchecked_rows() * ids.size());
        dense(found, 0, unchecked_rows(), ids, result);
        return found;
    }

    /* `values`: a line of `components` numbers a seed, in the order of the diagram's seeds. */
    void interpolate(span<float> into, std::uint64_t first, std::uint64_t count, span<const float> values,
                     std::uint32_t components, status *result = nullptr) const {
        if (detail::has_size("values", values.size(), seeds_ * components, result))
            detail::settle(
                locus_weights_interpolate(get(), first, count, values.data(), components, into.data(), into.size()),
                result);
    }
    std::vector<float> interpolate(span<const float> values, std::uint32_t components = 1,
                                   status *result = nullptr) const {
        std::vector<float> found(unchecked_rows() * components);
        interpolate(found, 0, unchecked_rows(), values, components, result);
        return found;
    }

    /* Three numbers a row. */
    void gradients(span<float> into, std::uint64_t first, std::uint64_t count, std::uint32_t id,
                   status *result = nullptr) const {
        detail::settle(locus_weights_gradients(get(), first, count, id, into.data(), into.size()), result);
    }
    std::vector<float> gradients(std::uint32_t id, status *result = nullptr) const {
        std::vector<float> found(unchecked_rows() * 3);
        gradients(found, 0, unchecked_rows(), id, result);
        return found;
    }

    /* The numbers of the rows that changed, in rising order. */
    std::vector<std::uint64_t> update(status *result = nullptr) {
        std::vector<std::uint64_t> changed(unchecked_rows());
        std::size_t count = 0;
        const locus_status code = locus_weights_update(get(), changed.data(), changed.size(), &count);
        changed.resize(code == LOCUS_OK ? count : 0);
        if (settle(code, result))
            locus_diagram_get_seeds(diagram_.get(), nullptr, 0, &seeds_);
        return changed;
    }

private:
    struct callbacks {
        explicit callbacks(const weights_options &options, std::shared_ptr<detail::graph_callbacks> of_graph)
            : function(options.progress), graph(std::move(of_graph)), call(function, graph ? &graph->thrown : nullptr) {
        }
        progress function;
        std::shared_ptr<detail::graph_callbacks> graph;
        detail::progress_call call;
    };

    template <class Create>
    void make(const diagram &diagram, const weights_options &options, status *result, Create &&create) {
        callbacks_ = std::make_unique<callbacks>(options, diagram.callbacks_);
        locus_weights_options plain = options;
        plain.progress = detail::progress_call::at;
        plain.progress_user = &callbacks_->call;
        locus_weights *made = nullptr;
        const locus_status code = create(plain, &made);
        handle_.reset(made);
        diagram_ = diagram.handle_;
        if (settle(code, result))
            locus_diagram_get_seeds(diagram_.get(), nullptr, 0, &seeds_);
    }
    bool settle(locus_status code, status *result) {
        if (callbacks_ != nullptr) {
            if (callbacks_->graph != nullptr)
                callbacks_->graph->thrown.rethrow();
            callbacks_->call.rethrow();
        }
        return detail::settle(code, result);
    }
    /* 0 for an empty handle, which the library then refuses. */
    std::uint64_t unchecked_rows() const noexcept {
        std::uint64_t rows = 0;
        locus_weights_size(get(), &rows, nullptr);
        return rows;
    }

    /* In this order: the handle ends before what its callbacks use. */
    std::unique_ptr<callbacks> callbacks_;
    std::unique_ptr<locus_weights, detail::ended_by<locus_weights_destroy>> handle_;
    std::shared_ptr<locus_diagram> diagram_;
    std::size_t seeds_ = 0; /* when the rows were made: lines that interpolate reads */
};

} // namespace locus
#endif
