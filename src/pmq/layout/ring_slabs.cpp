// Mapping, touching and vacating slabs.
#include "pmq/layout/ring_slabs.hpp"

#include <algorithm>
#include <bit>
#include <new>
#include <sys/mman.h>

namespace locus::pmq {
namespace {

constexpr size_t huge_page = size_t{2} << 20;
constexpr size_t page = 4096;
constexpr size_t most_slab_bytes = LeafShape::slab_span;
constexpr size_t first_slab_bytes = size_t{256} << 10;
constexpr size_t ahead = 64; // leaves kept ready

// Memory aligned to the span of slabs: map more, and cut the ends off.
std::byte *map_pages(size_t bytes) {
    constexpr size_t alignment = LeafShape::slab_span;
    bytes = (bytes + page - 1) / page * page;
    void *mapped = mmap(nullptr, bytes + alignment, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapped == MAP_FAILED)
        throw std::bad_alloc();
    auto *base = static_cast<std::byte *>(mapped);
    const size_t before = (alignment - reinterpret_cast<uintptr_t>(base) % alignment) % alignment;
    if (before > 0)
        munmap(base, before);
    if (alignment > before)
        munmap(base + before + bytes, alignment - before);
    if (bytes >= huge_page)
        madvise(base + before, bytes, MADV_HUGEPAGE);
    return base + before;
}

// What the times of the leaves of a slab take, in whole pages.
size_t lead_bytes(size_t slab_bytes, size_t leaf_bytes) noexcept {
    return (slab_bytes / leaf_bytes * LeafShape::times_bytes + page - 1) / page * page;
}

} // namespace

Slabs::Slabs(size_t leaf_bytes, uint64_t limit) : leaf_bytes_(leaf_bytes), limited_(limit != UINT64_MAX) {
    largest_slab_ = static_cast<size_t>(std::clamp<uint64_t>(std::bit_floor(limit / 16), leaf_bytes, most_slab_bytes));
    smallest_slab_ = std::min(first_slab_bytes, largest_slab_);
}

Slabs::~Slabs() {
    for (const auto &slab : slabs_)
        munmap(slab->base, slab->bytes);
}

Slabs::Slab &Slabs::add_slab() {
    // Slabs grow with the store, to which one adds a sixteenth, but as soon as may be they consist of huge pages.
    const size_t wanted = std::max(bytes_ / 16, bytes_ < huge_page ? smallest_slab_ : huge_page);
    const size_t bytes = std::clamp(std::bit_floor(wanted), smallest_slab_, largest_slab_);
    auto slab = std::make_unique<Slab>();
    slab->lead = keep_times() ? lead_bytes(bytes, leaf_bytes_) : 0;
    slab->leaves = (bytes - slab->lead) / leaf_bytes_;
    slab->free.reserve(slab->leaves);
    slabs_.reserve(slabs_.size() + 1);
    slab->base = map_pages(bytes);
    slab->bytes = bytes;
    capacity_ += slab->leaves;
    bytes_ += bytes;
    ++mapped_;
    const auto at = std::lower_bound(slabs_.begin(), slabs_.end(), slab->base,
                                     [](const auto &s, const std::byte *base) { return s->base < base; });
    return **slabs_.insert(at, std::move(slab));
}

Slabs::Slab *Slabs::slab_of(LeafMemory leaf) const noexcept {
    const auto after = std::upper_bound(slabs_.begin(), slabs_.end(), leaf,
                                        [](const std::byte *at, const auto &s) { return at < s->base; });
    return std::prev(after)->get();
}

// The fullest slab with room, so that the others get the chance to run empty.
Slabs::Slab *Slabs::with_room() noexcept {
    Slab *best = nullptr;
    for (const auto &slab : slabs_)
        if (!slab->full() && slab.get() != vacating_ &&
            (!best || slab->used * best->leaves > best->used * slab->leaves))
            best = slab.get();
    return best;
}

// Small slabs have no room to spare.
bool Slabs::keep_times() const noexcept { return smallest_slab_ >= first_slab_bytes; }

LeafMemory Slabs::take() {
    if (!current_ || current_->full() || current_ == vacating_) {
        current_ = with_room();
        if (!current_ && vacating_) { // the room is needed after all
            current_ = vacating_;
            vacating_ = nullptr;
        }
        if (!current_ || current_->full())
            current_ = &add_slab();
    }
    Slab &slab = *current_;
    size_t number;
    if (!slab.free.empty()) {
        number = slab.free.back();
        slab.free.pop_back();
    } else {
        number = slab.fresh++;
        slab.touched = std::max(slab.touched, slab.lead + slab.fresh * leaf_bytes_);
    }
    ++slab.used;
    ++used_;
    return slab.base + slab.lead + number * leaf_bytes_;
}

void Slabs::give_back(LeafMemory leaf) noexcept {
    Slab &slab = *slab_of(leaf);
    const size_t offset = static_cast<size_t>(leaf - slab.base) - slab.lead;
    slab.free.push_back(static_cast<uint16_t>(offset / leaf_bytes_)); // reserved
    --slab.used;
    --used_;
}

bool Slabs::vacating(LeafMemory leaf) const noexcept {
    return vacating_ && leaf >= vacating_->base && leaf < vacating_->base + vacating_->bytes;
}

void Slabs::touch(Slab &slab, size_t bytes) noexcept {
    const size_t end = std::min(slab.touched + bytes, slab.bytes);
    for (size_t at = (slab.touched + page - 1) / page * page; at < end; at += page)
        *reinterpret_cast<volatile char *>(slab.base + at) = 0;
    slab.touched = end;
}

void Slabs::prepare() noexcept {
    release_empty();
    if (vacating_ && capacity_ - used_ < slack())
        vacating_ = nullptr;
    if (!vacating_)
        choose_vacating();
    // Have a slab ready before the last one is full, and its pages before its leaves.
    if (!limited_ && !vacating_ && bytes_ >= most_slab_bytes && capacity_ - used_ < ahead) {
        try {
            add_slab();
        } catch (const std::bad_alloc &) { // whoever needs it will report it
        }
    }
    for (const auto &slab : slabs_) {
        if (slab->touched < slab->bytes && slab->bytes >= huge_page &&
            slab->touched < std::max(slab->lead + (slab->fresh + ahead) * leaf_bytes_, huge_page)) {
            touch(*slab, huge_page);
            return; // one step a batch
        }
    }
}

// Free leaves that are worth keeping.
size_t Slabs::slack() const noexcept {
    if (pressed_)
        return 0;
    return limited_ ? capacity_ / 16 : std::max(capacity_ / 16, std::min(2 * ahead, capacity_ / 4));
}

// Vacate the emptiest slab when its leaves fit into the others with room to spare.
void Slabs::choose_vacating() noexcept {
    if (slabs_.size() < 2)
        return;
    Slab *emptiest = nullptr;
    for (const auto &slab : slabs_)
        if (!emptiest || slab->used * emptiest->leaves < emptiest->used * slab->leaves)
            emptiest = slab.get();
    if (capacity_ - used_ >= emptiest->leaves + (pressed_ ? 0 : capacity_ / 16) + slack())
        vacating_ = emptiest;
}

void Slabs::release_empty() noexcept {
    for (size_t i = slabs_.size(); i-- > 0;) {
        const Slab &slab = *slabs_[i];
        if (slab.used == 0 && capacity_ - used_ >= slab.leaves + slack())
            unmap(i);
    }
}

void Slabs::unmap(size_t index) noexcept {
    Slab *slab = slabs_[index].get();
    if (current_ == slab)
        current_ = nullptr;
    if (vacating_ == slab)
        vacating_ = nullptr;
    munmap(slab->base, slab->bytes);
    bytes_ -= slab->bytes;
    capacity_ -= slab->leaves;
    slabs_.erase(slabs_.begin() + static_cast<ptrdiff_t>(index));
}

} // namespace locus::pmq
