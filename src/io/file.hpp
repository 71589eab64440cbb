// Files: a regular file open for reading, and one that appears under its name only when it is whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace locus::io {

// A regular file open for reading. Every failure is LOCUS_E_IO and names the path.
class InputFile {
public:
    explicit InputFile(const std::string &path);
    InputFile(InputFile &&other) noexcept;
    InputFile(const InputFile &) = delete;
    InputFile &operator=(const InputFile &) = delete;
    InputFile &operator=(InputFile &&) = delete;
    ~InputFile();

    const std::string &path() const { return path_; }
    uint64_t size() const { return size_; }
    // Read up to target.size() bytes from `offset` on; fewer only at the end of the file.
    size_t read_at(uint64_t offset, std::span<std::byte> target) const;

private:
    std::string path_;
    int descriptor_;
    uint64_t size_ = 0;
};

// A file that is written under a temporary name beside `path` and renamed to it by commit(); without one, it vanishes.
class AtomicFile {
public:
    explicit AtomicFile(const std::string &path);
    AtomicFile(const AtomicFile &) = delete;
    AtomicFile &operator=(const AtomicFile &) = delete;
    ~AtomicFile();

    void write(std::span<const std::byte> bytes); // behind what was written last
    void overwrite(uint64_t offset, std::span<const std::byte> bytes);
    uint64_t size() const { return size_; }
    void commit(); // flush to the disk and rename

private:
    void write_at(uint64_t offset, std::span<const std::byte> bytes);

    std::string path_;
    std::string temporary_;
    int descriptor_ = -1;
    uint64_t size_ = 0;
};

} // namespace locus::io
