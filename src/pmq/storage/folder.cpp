// Names, and the lock.
#include "pmq/storage/folder.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <dirent.h>
#include <memory>
#include <string_view>
#include <sys/file.h>

namespace locus::pmq {
namespace {

constexpr size_t digits = 20; // of any number: names sort as numbers do

struct CloseFolder {
    void operator()(DIR *folder) const noexcept { ::closedir(folder); }
};
using OpenFolder = std::unique_ptr<DIR, CloseFolder>;

// "store-00000000000000000007" is 7, for the kind "store-"; what is not of that form is no number.
bool parse(std::string_view name, std::string_view kind, uint64_t &number) noexcept {
    if (!name.starts_with(kind) || name.size() != kind.size() + digits)
        return false;
    const auto [end, error] = std::from_chars(name.data() + kind.size(), name.data() + name.size(), number);
    return error == std::errc() && end == name.data() + name.size();
}

} // namespace

Folder::Folder(const std::string &path) : path_(path) {
    if (::mkdir(path.c_str(), 0777) == 0)
        flush_folder(folder_of(path));
    else if (errno != EEXIST)
        fail_io(path, "cannot make the folder", errno);
    const std::string lock = path_ + "/lock";
    lock_ = Descriptor(::open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
    if (!lock_.open())
        fail_io(lock, "cannot open", errno);
    if (::flock(lock_.number(), LOCK_EX | LOCK_NB) != 0) {
        if (errno == EWOULDBLOCK)
            fail(LOCUS_E_BUSY, path, ": another store has the folder open");
        fail_io(lock, "cannot lock", errno);
    }
}

std::string Folder::name(const char *kind, uint64_t number) const {
    const std::string text = std::to_string(number);
    return path_ + "/" + kind + std::string(digits - text.size(), '0') + text;
}

Folder::Content Folder::content() const {
    const OpenFolder folder(::opendir(path_.c_str()));
    if (!folder)
        fail_io(path_, "cannot list the folder", errno);
    Content content;
    errno = 0;
    while (const dirent *entry = ::readdir(folder.get())) {
        uint64_t number;
        if (parse(entry->d_name, "store-", number))
            content.saved.push_back(number);
        else if (parse(entry->d_name, "log-", number))
            content.logs.push_back(number);
        errno = 0;
    }
    if (errno != 0)
        fail_io(path_, "cannot list the folder", errno);
    std::sort(content.saved.begin(), content.saved.end());
    std::sort(content.logs.begin(), content.logs.end());
    return content;
}

void Folder::tidy(uint64_t least) const noexcept {
    try {
        const OpenFolder folder(::opendir(path_.c_str()));
        while (const dirent *entry = folder ? ::readdir(folder.get()) : nullptr) {
            const std::string_view name(entry->d_name);
            uint64_t number;
            const bool old = (parse(name, "store-", number) || parse(name, "log-", number)) && number < least;
            const bool left = name.starts_with("store-") && name.find(AtomicFile::infix) != name.npos;
            if (old || left)
                ::unlink((path_ + "/" + entry->d_name).c_str());
        }
    } catch (const std::bad_alloc &) {
    }
}

} // namespace locus::pmq
