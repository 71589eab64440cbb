// Finding the library that runs kernels. It is looked for only where a driver is, and once it was used it stays: the
// driver's threads do not end with it.
#include "graph/device/device.hpp"

#include <dlfcn.h>

#include <cstring>
#include <string>

#define LOCUS_TEXT_OF(number) #number
#define LOCUS_TEXT(number) LOCUS_TEXT_OF(number)

namespace locus::device {
namespace {

constexpr const char *driver = "libcuda.so.1";
constexpr const char *library = "liblocus_cuda.so." LOCUS_TEXT(LOCUS_VERSION_MAJOR);
constexpr const char *entry = LOCUS_TEXT(LOCUS_DEVICE_ENTRY);

struct Close {
    void operator()(void *handle) const { dlclose(handle); }
};
using Handle = std::unique_ptr<void, Close>;

Found absent(locus_status status, std::string why) { return {nullptr, status, std::move(why), {}}; }

std::string loader_error() {
    const char *text = dlerror();
    return text != nullptr ? text : "the loader says nothing";
}

// Is this the table of this very build? `why` says what is wrong with it.
bool fits(const Table *table, std::string &why) {
    if (table == nullptr)
        why = "it gives no table";
    else if (table->bytes != sizeof(Table) || table->interface != kInterface)
        why = "its interface is number " + std::to_string(table->interface) + ", not " + std::to_string(kInterface);
    else if (table->version != LOCUS_VERSION)
        why = "its version is " + std::to_string(table->version) + ", not " + std::to_string(LOCUS_VERSION);
    else
        return true;
    return false;
}

Found look() {
    const Handle have_driver(dlopen(driver, RTLD_NOW | RTLD_LOCAL));
    if (!have_driver)
        return absent(LOCUS_E_UNSUPPORTED, std::string("this machine has no CUDA driver (") + loader_error() + ")");
    Handle handle(dlopen(library, RTLD_NOW | RTLD_LOCAL));
    if (!handle)
        return absent(LOCUS_E_UNSUPPORTED,
                      std::string("Locus' CUDA library cannot be loaded (") + loader_error() + ")");
    using Entry = const Table *(*)();
    Entry give = nullptr;
    if (void *const symbol = dlsym(handle.get(), entry); symbol != nullptr)
        std::memcpy(&give, &symbol, sizeof give);
    if (give == nullptr)
        return absent(LOCUS_E_UNSUPPORTED,
                      std::string(library) + " is of another version than liblocus: it has no " + entry);
    const Table *table = give();
    std::string wrong;
    if (!fits(table, wrong))
        return absent(LOCUS_E_UNSUPPORTED, std::string(library) + " is of another build than liblocus: " + wrong);
    static_cast<void>(handle.release());
    Found found{table, LOCUS_OK, "", {}};
    Queue *queue = nullptr;
    Message why{};
    if (const int32_t status = table->open(&queue, &found.machine, &why); status != LOCUS_OK)
        return absent(status, why.text);
    table->close(queue);
    return found;
}

} // namespace

const Found &find() {
    static const Found found = look();
    return found;
}

} // namespace locus::device
