// The bricks of a grid in memory: one block, in large pages where the system has them.
#pragma once

#include "core/pages.hpp"
#include "graph/bricks/layout.hpp"

#include <memory>

namespace locus::bricks {

template <typename Word>
class Store {
public:
    explicit Store(const Layout &layout) : layout_(layout), count_(layout.count() + 1) {
        brick_.reset(static_cast<Brick<Word> *>(allocate_pages(bytes())));
    }

    const Layout &layout() const { return layout_; }
    size_t bytes() const { return count_ * sizeof(Brick<Word>); }
    Brick<Word> &operator[](size_t index) { return brick_.get()[index]; }
    const Brick<Word> &operator[](size_t index) const { return brick_.get()[index]; }

    // Bricks are numbered x fastest; the one after the last stands for everything outside the grid, and nothing writes
    // to it.
    size_t outside() const { return count_ - 1; }
    size_t at(const Place &p) const {
        const auto in = [](int32_t i, uint32_t n) { return static_cast<uint32_t>(i) < n; };
        if (!in(p.x, layout_.bricks[0]) || !in(p.y, layout_.bricks[1]) || !in(p.z, layout_.bricks[2]))
            return outside();
        return layout_.index(static_cast<uint32_t>(p.x), static_cast<uint32_t>(p.y), static_cast<uint32_t>(p.z));
    }
    Place place(size_t index) const {
        const size_t row = index / layout_.bricks[0];
        return {static_cast<int32_t>(index % layout_.bricks[0]), static_cast<int32_t>(row % layout_.bricks[1]),
                static_cast<int32_t>(row / layout_.bricks[1])};
    }

private:
    struct Free {
        void operator()(Brick<Word> *raw) const { free_pages(raw); }
    };
    Layout layout_;
    size_t count_;
    std::unique_ptr<Brick<Word>, Free> brick_;
};

} // namespace locus::bricks
