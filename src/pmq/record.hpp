// Records are opaque bytes to the store; a RecordFormat knows their size and where the place and the time lie in them.
#pragma once

#include <locus/pmq.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace locus::pmq {

using Bytes = const std::byte *;

struct RecordFormat {
    size_t size;
    size_t latitude_at, longitude_at, time_at; // offsets
    bool single;                               // coordinates are floats, not doubles

    double latitude(Bytes record) const noexcept { return coordinate(record + latitude_at); }
    double longitude(Bytes record) const noexcept { return coordinate(record + longitude_at); }
    int64_t time(Bytes record) const noexcept { return load<int64_t>(record + time_at); }
    void set_time(std::byte *record, int64_t time) const noexcept { std::memcpy(record + time_at, &time, sizeof time); }

private:
    template <typename T>
    static T load(Bytes at) noexcept {
        T value;
        std::memcpy(&value, at, sizeof value);
        return value;
    }
    double coordinate(Bytes at) const noexcept {
        return single ? static_cast<double>(load<float>(at)) : load<double>(at);
    }
};

static_assert(sizeof(locus_point32) == LOCUS_RECORD_POINT32 && sizeof(locus_text156) == LOCUS_RECORD_TEXT156);
inline constexpr RecordFormat point32{sizeof(locus_point32), offsetof(locus_point32, latitude),
                                      offsetof(locus_point32, longitude), offsetof(locus_point32, time), false};
inline constexpr RecordFormat text156{sizeof(locus_text156), offsetof(locus_text156, latitude),
                                      offsetof(locus_text156, longitude), offsetof(locus_text156, time), true};

inline void copy_record(std::byte *to, Bytes from, size_t size) noexcept {
    if (size == LOCUS_RECORD_POINT32)
        std::memcpy(to, from, LOCUS_RECORD_POINT32); // inline
    else
        std::memcpy(to, from, size);
}

// Times from..to, both included.
struct TimeWindow {
    int64_t from = INT64_MIN;
    int64_t to = INT64_MAX;
    bool contains(int64_t time) const noexcept { return from <= time && time <= to; }
};

// The clock of one state of the store. Records older than `cutoff` have expired: queries do not see them, stored or
// not.
struct Moment {
    int64_t now = INT64_MIN;
    int64_t cutoff = INT64_MIN;

    static Moment at(int64_t now, int64_t horizon) noexcept {
        int64_t cutoff;
        if (horizon == LOCUS_NO_HORIZON || __builtin_sub_overflow(now, horizon, &cutoff))
            cutoff = INT64_MIN;
        return {now, cutoff};
    }
};

} // namespace locus::pmq
