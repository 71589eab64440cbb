// Memory for keys and records by slot number.
#pragma once

#include "pmq/record.hpp"

#include <cstddef>
#include <memory>
#include <new>
#include <utility>

namespace locus::pmq {

// Where the keys are: beside their records, an element holding both, as in the thesis' plain form; or apart from them,
// all keys before all records, so that a search or a count touches keys only.
enum class Keys { beside, apart };

class Slots {
public:
    Slots() = default;
    Slots(const RecordFormat &format, size_t count, Keys keys)
        : record_size_(format.size), key_stride_(keys == Keys::beside ? element(format) : sizeof(uint64_t)),
          record_stride_(keys == Keys::beside ? element(format) : format.size),
          memory_(allocate(count * bytes(format, keys))), keys_(memory_.get()),
          records_(keys_ + (keys == Keys::beside ? 1 : count) * sizeof(uint64_t)) {}

    // Of one slot.
    static size_t bytes(const RecordFormat &format, Keys keys) noexcept {
        return keys == Keys::beside ? element(format) : sizeof(uint64_t) + format.size;
    }
    size_t key_stride() const noexcept { return key_stride_; }
    size_t record_stride() const noexcept { return record_stride_; }

    const std::byte *key_address(size_t slot) const noexcept { return keys_ + slot * key_stride_; }
    uint64_t key(size_t slot) const noexcept {
        uint64_t key;
        std::memcpy(&key, key_address(slot), sizeof key);
        return key;
    }
    Bytes record(size_t slot) const noexcept { return records_ + slot * record_stride_; }

    // The slot of a record that record() returned.
    size_t slot_of(Bytes record) const noexcept { return static_cast<size_t>(record - records_) / record_stride_; }

    void set_key(size_t slot, uint64_t key) noexcept { std::memcpy(keys_ + slot * key_stride_, &key, sizeof key); }
    void put(size_t slot, uint64_t key, Bytes record) noexcept {
        set_key(slot, key);
        std::byte *to = records_ + slot * record_stride_;
        // The two layouts' sizes as constants, so that the copies are a few instructions.
        switch (record_size_) {
        case point32.size:
            std::memcpy(to, record, point32.size);
            break;
        case text156.size:
            std::memcpy(to, record, text156.size);
            break;
        default:
            std::memcpy(to, record, record_size_);
        }
    }
    // Copy `count` neighbours; the ranges may overlap.
    void move(size_t to, const Slots &source, size_t from, size_t count) noexcept {
        std::memmove(keys_ + to * key_stride_, source.keys_ + from * key_stride_, count * key_stride_);
        if (key_stride_ != record_stride_)
            std::memmove(records_ + to * record_stride_, source.records_ + from * record_stride_,
                         count * record_stride_);
    }

private:
    static constexpr std::align_val_t line{64};
    static size_t element(const RecordFormat &format) noexcept { return (sizeof(uint64_t) + format.size + 7) / 8 * 8; }
    struct Free {
        void operator()(std::byte *memory) const noexcept { ::operator delete(memory, line); }
    };
    using Memory = std::unique_ptr<std::byte, Free>;
    static Memory allocate(size_t bytes) { return Memory(static_cast<std::byte *>(::operator new(bytes, line))); }

    size_t record_size_ = 0;
    size_t key_stride_ = 0, record_stride_ = 0;
    Memory memory_;
    std::byte *keys_ = nullptr;
    std::byte *records_ = nullptr;
};

} // namespace locus::pmq
