/* locus/volume.hpp - locus::volume, the owner of a locus_volume, and writing (liblocus_io): see locus/volume.h. */
#ifndef LOCUS_VOLUME_HPP
#define LOCUS_VOLUME_HPP

#include <locus/io.hpp>
#include <locus/volume.h>

#include <memory>

namespace locus {

/* The C structs with their defaults. */
struct volume_info : locus_volume_info {
    volume_info() noexcept { locus_volume_info_init(this, sizeof(locus_volume_info)); }
};
struct volume_read_options : locus_volume_read_options {
    volume_read_options() noexcept { locus_volume_read_options_init(this, sizeof(locus_volume_read_options)); }
};
struct volume_write_options : locus_volume_write_options {
    volume_write_options() noexcept { locus_volume_write_options_init(this, sizeof(locus_volume_write_options)); }
};

/* The LOCUS_VOXEL_ constant of a C++ type. */
template <class Number>
constexpr std::uint32_t voxel_type() noexcept {
    static_assert(std::is_arithmetic_v<Number> && sizeof(Number) <= 8 && !std::is_same_v<Number, bool>,
                  "a volume holds integers and floats of 8 to 64 bits");
    if constexpr (std::is_floating_point_v<Number>)
        return sizeof(Number) == 4 ? LOCUS_VOXEL_FLOAT32 : LOCUS_VOXEL_FLOAT64;
    constexpr std::uint32_t first = sizeof(Number) == 1   ? LOCUS_VOXEL_UINT8
                                    : sizeof(Number) == 2 ? LOCUS_VOXEL_UINT16
                                    : sizeof(Number) == 4 ? LOCUS_VOXEL_UINT32
                                                          : LOCUS_VOXEL_UINT64;
    return first + (std::is_signed_v<Number> ? 1 : 0);
}

class volume {
public:
    /* An empty handle: only assigning to it and destroying it are allowed. */
    volume() noexcept = default;
    explicit volume(const std::string &path, const volume_read_options &options = {}, status *result = nullptr) {
        locus_volume *made = nullptr;
        const locus_status code = locus_volume_read(path.c_str(), &options, &made);
        handle_.reset(made);
        detail::settle_io(code, result);
    }

    explicit operator bool() const noexcept { return handle_ != nullptr; }
    /* The C handle; it stays this object's. */
    locus_volume *get() const noexcept { return handle_.get(); }

    volume_info info(status *result = nullptr) const {
        volume_info info;
        detail::settle_io(locus_volume_get_info(get(), &info), result);
        return info;
    }
    /* The numbers, x fastest, as long as the volume lives. Another type than they have is LOCUS_E_ARGUMENT. */
    template <class Number = float>
    span<const Number> data(status *result = nullptr) const {
        status state;
        const volume_info known = info(&state);
        if (!detail::settle(state.code(), result, state.text()))
            return {};
        if (known.type != voxel_type<Number>()) {
            detail::settle(LOCUS_E_ARGUMENT, result,
                           "locus::volume::data: the numbers have type " + std::to_string(known.type) + ", not " +
                               std::to_string(voxel_type<Number>()) + " (LOCUS_VOXEL_)");
            return {};
        }
        return {static_cast<const Number *>(locus_volume_data(get())),
                static_cast<std::size_t>(known.dims[0] * known.dims[1] * known.dims[2] * known.components)};
    }

private:
    std::unique_ptr<locus_volume, detail::ended_by<locus_volume_destroy>> handle_;
};

/* What reading the file would give, from its header alone. */
inline volume_info read_volume_info(const std::string &path, const volume_read_options &options = {},
                                    status *result = nullptr) {
    volume_info info;
    detail::settle_io(locus_volume_read_info(path.c_str(), &options, &info), result);
    return info;
}

/* Write numbers, laid out as `info` says; their type is that of `data`. */
template <class Number>
void write_volume(const std::string &path, volume_info info, span<const Number> data,
                  const volume_write_options &options = {}, status *result = nullptr) {
    info.type = voxel_type<Number>();
    std::uint64_t wanted = info.components;
    for (const std::uint64_t size : info.dims)
        wanted *= size;
    if (detail::has_size("data", data.size(), wanted, result))
        detail::settle_io(locus_volume_write(path.c_str(), &info, data.data(), &options), result);
}

} // namespace locus
#endif
