// Where time and place lie in a record.
#pragma once

#include "core/error.hpp"

#include <locus/pmq.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace locus::cold {

struct RecordFormat {
    size_t size;

    int64_t time(const std::byte *record) const noexcept {
        int64_t time;
        std::memcpy(&time,
                    record +
                        (size == sizeof(locus_point32) ? offsetof(locus_point32, time) : offsetof(locus_text156, time)),
                    sizeof time);
        return time;
    }

    // Throws Error(LOCUS_E_FORMAT) for coordinates that no store lets in.
    uint64_t key(const std::byte *record) const {
        uint64_t key = 0;
        locus_status status;
        if (size == sizeof(locus_point32)) {
            locus_point32 point;
            std::memcpy(&point, record, sizeof point);
            status = locus_pmq_key(point.latitude, point.longitude, &key);
        } else {
            float place[2];
            std::memcpy(place, record, sizeof place);
            status = locus_pmq_key(place[0], place[1], &key);
        }
        if (status != LOCUS_OK)
            fail(LOCUS_E_FORMAT, "a record's ", locus_last_error());
        return key;
    }
};

} // namespace locus::cold
