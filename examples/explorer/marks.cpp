// Reading and writing older.marks.
#include "explorer/marks.hpp"

#include "common/canvas.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <unistd.h>

namespace explorer {
namespace {

// So that the file's new name outlives a loss of power, too.
void flush_folder(const std::string &path) {
    const int folder = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool good = folder >= 0 && fsync(folder) == 0;
    const int reason = errno;
    if (folder >= 0)
        close(folder);
    if (!good)
        throw std::runtime_error("cannot flush " + path + ": " + std::strerror(reason));
}

} // namespace

Marks::Marks(const std::string &folder) : folder_(folder), path_(folder + "/older.marks") {
    std::ifstream file(path_);
    std::string line;
    for (size_t row = 1; std::getline(file, line); ++row) {
        std::istringstream words(line);
        uint64_t number = 0, received = 0;
        std::string more;
        if (!(words >> number >> received) || words >> more)
            throw std::runtime_error(path_ + ": line " + std::to_string(row) +
                                     " is not the number of a saved file and a count");
        marks_[number] = received;
    }
}

std::optional<uint64_t> Marks::find(uint64_t number) const {
    const auto found = marks_.find(number);
    return found == marks_.end() ? std::nullopt : std::optional(found->second);
}

void Marks::keep(uint64_t number, uint64_t received, uint64_t least) {
    marks_[number] = received;
    marks_.erase(marks_.begin(), marks_.lower_bound(least));
    std::string text;
    for (const auto &[saved, count] : marks_)
        text += std::to_string(saved) + " " + std::to_string(count) + "\n";
    demo::write_file(path_, text.data(), text.size());
    flush_folder(folder_);
}

} // namespace explorer
