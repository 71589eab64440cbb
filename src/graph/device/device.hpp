// A device to run kernels on, with its memory. Every failure becomes an Error: LOCUS_E_MEMORY where the device has no
// more memory, LOCUS_E_DEVICE with the text of the driver otherwise.
#pragma once

#include "core/crew.hpp"
#include "core/error.hpp"
#include "graph/device/table.hpp"

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace locus::device {

// The table of the library that runs kernels, or why there is none.
struct Found {
    const Table *table = nullptr;
    locus_status status = LOCUS_OK;
    std::string why;
    Machine machine{};
};

// Looks once in the life of the process for a driver, liblocus_cuda.so and a GPU.
const Found &find();

// Whether an error says that a device cannot do what was asked of it, though another backend may.
inline bool is_devices_own(const Error &error) {
    return error.status() == LOCUS_E_DEVICE || error.status() == LOCUS_E_MEMORY ||
           error.status() == LOCUS_E_UNSUPPORTED;
}

// Memory of a device; move-only.
template <typename T>
class Memory {
public:
    Memory() = default;
    Memory(const Table &table, Queue *queue, uint64_t count) : table_(&table), queue_(queue), count_(count) {
        Message why{};
        void *raw = nullptr;
        const int32_t status = table.allocate(queue, (count > 0 ? count : 1) * sizeof(T), &raw, &why);
        if (status != LOCUS_OK)
            fail(status, why.text);
        data_ = static_cast<T *>(raw);
    }
    Memory(Memory &&other) noexcept { *this = std::move(other); }
    Memory &operator=(Memory &&other) noexcept {
        std::swap(table_, other.table_);
        std::swap(queue_, other.queue_);
        std::swap(data_, other.data_);
        std::swap(count_, other.count_);
        return *this;
    }
    ~Memory() {
        if (data_ != nullptr)
            table_->release(queue_, data_);
    }

    T *get() const { return data_; }
    uint64_t count() const { return count_; }
    uint64_t bytes() const { return count_ * sizeof(T); }

private:
    const Table *table_ = nullptr;
    Queue *queue_ = nullptr;
    T *data_ = nullptr;
    uint64_t count_ = 0;
};

// The host's part in one copy between it and a device: on several threads where it is large.
class HostCopying {
public:
    HostCopying(uint32_t threads, uint64_t bytes) {
        const uint64_t useful = std::min<uint64_t>(bytes / worth_a_thread, most_threads);
        if (threads < 2 || useful < 2)
            return;
        crew_.emplace(static_cast<uint32_t>(std::min<uint64_t>(threads, useful)));
        copy_ = {run, &*crew_};
    }
    // Null: one thread does.
    const HostCopy *get() const { return crew_ ? &copy_ : nullptr; }

private:
    static constexpr uint64_t worth_a_thread = uint64_t{1} << 20, piece = uint64_t{1} << 18; // bytes
    static constexpr uint64_t most_threads = 8;                                              // saturate the memory

    static void run(void *crew, void *to, const void *from, uint64_t bytes) {
        static_cast<Crew *>(crew)->for_each(bytes, piece, [&](uint64_t begin, uint64_t end) {
            std::memcpy(static_cast<unsigned char *>(to) + begin, static_cast<const unsigned char *>(from) + begin,
                        end - begin);
        });
    }

    std::optional<Crew> crew_;
    HostCopy copy_{};
};

class Device {
public:
    // `stream`: the caller's; null: one of its own.
    explicit Device(const Table &table, void *stream = nullptr) : table_(table) {
        Message why{};
        int32_t status = table.open(&queue_, &machine_, &why);
        if (status == LOCUS_OK && stream != nullptr) {
            status = table.use_stream(queue_, stream, &why);
            if (status != LOCUS_OK)
                table.close(queue_);
        }
        if (status != LOCUS_OK)
            fail(status, why.text);
    }
    Device(const Device &) = delete;
    Device &operator=(const Device &) = delete;
    ~Device() { table_.close(queue_); }

    const Machine &machine() const { return machine_; }

    template <typename T>
    Memory<T> allocate(uint64_t count) {
        return Memory<T>(table_, queue_, count);
    }
    template <typename T>
    Memory<T> copy_of(std::span<const T> values) {
        Memory<T> memory = allocate<T>(values.size());
        upload(memory.get(), values);
        return memory;
    }
    // `threads`: of the host, for what is large.
    template <typename T>
    void upload(T *to, std::span<const T> values, uint32_t threads = 1) {
        if (values.empty())
            return;
        const HostCopying copying(threads, values.size_bytes());
        call([&](Message *why) {
            return table_.upload(queue_, to, values.data(), values.size_bytes(), copying.get(), why);
        });
    }
    template <typename T>
    void download(std::span<T> to, const T *from, uint32_t threads = 1) {
        if (to.empty())
            return;
        const HostCopying copying(threads, to.size_bytes());
        call([&](Message *why) {
            return table_.download(queue_, to.data(), from, to.size_bytes(), copying.get(), why);
        });
    }
    template <typename T>
    T download(const T *from) {
        T value;
        download(std::span<T>(&value, 1), from);
        return value;
    }
    void compact(const uint8_t *flags, uint64_t count, uint64_t *list, uint64_t *listed) {
        call([&](Message *why) { return table_.compact(queue_, flags, count, list, listed, why); });
    }
    void check_writable(const void *memory) {
        call([&](Message *why) { return table_.writable(queue_, memory, why); });
    }
    void finish() {
        call([&](Message *why) { return table_.finish(queue_, why); });
    }

    // Put a kernel into the queue. `items`: see Launch.
    template <typename Body>
    void launch(Launch launch, const Body &body, uint64_t items) {
        launch.body = &body;
        launch.body_bytes = sizeof body;
        launch.items = items;
        if (items > 0)
            call([&](Message *why) { return table_.launch(queue_, &launch, why); });
    }
    template <typename Body>
    uint64_t resident(Launch launch, const Body &body) {
        launch.body = &body;
        launch.body_bytes = sizeof body;
        uint64_t blocks = 0;
        call([&](Message *why) { return table_.resident(queue_, &launch, &blocks, why); });
        return blocks;
    }

private:
    template <typename Call>
    void call(Call &&work) {
        Message why{};
        const int32_t status = work(&why);
        if (status != LOCUS_OK)
            fail(status, why.text);
    }

    const Table &table_;
    Queue *queue_ = nullptr;
    Machine machine_{};
};

} // namespace locus::device
