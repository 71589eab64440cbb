// Memory for keys and records by slot number. In the thesis' plain form an element holds its key and its record.
#pragma once

#include "pmq/record.hpp"

#include <cstddef>
#include <memory>
#include <new>
#include <utility>

namespace locus::pmq {

class Slots {
public:
    Slots() = default;
    Slots(const RecordFormat &format, size_t count)
        : record_size_(format.size), stride_(stride(format)), memory_(allocate(count * stride_)), keys_(memory_.get()),
          records_(memory_.get() + sizeof(uint64_t)) {}

    static size_t stride(const RecordFormat &format) noexcept { return (sizeof(uint64_t) + format.size + 7) / 8 * 8; }
    size_t key_stride() const noexcept { return stride_; }
    size_t record_stride() const noexcept { return stride_; }

    const std::byte *key_address(size_t slot) const noexcept { return keys_ + slot * stride_; }
    uint64_t key(size_t slot) const noexcept {
        uint64_t key;
        std::memcpy(&key, key_address(slot), sizeof key);
        return key;
    }
    Bytes record(size_t slot) const noexcept { return records_ + slot * stride_; }

    // The slot of a record that record() returned.
    size_t slot_of(Bytes record) const noexcept { return static_cast<size_t>(record - records_) / stride_; }

    void set_key(size_t slot, uint64_t key) noexcept { std::memcpy(keys_ + slot * stride_, &key, sizeof key); }
    void put(size_t slot, uint64_t key, Bytes record) noexcept {
        set_key(slot, key);
        std::byte *to = records_ + slot * stride_;
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
        std::memmove(keys_ + to * stride_, source.keys_ + from * stride_, count * stride_);
    }

private:
    static constexpr std::align_val_t line{64};
    struct Free {
        void operator()(std::byte *memory) const noexcept { ::operator delete(memory, line); }
    };
    using Memory = std::unique_ptr<std::byte, Free>;
    static Memory allocate(size_t bytes) { return Memory(static_cast<std::byte *>(::operator new(bytes, line))); }

    size_t record_size_ = 0;
    size_t stride_ = 0;
    Memory memory_;
    std::byte *keys_ = nullptr;
    std::byte *records_ = nullptr;
};

} // namespace locus::pmq
