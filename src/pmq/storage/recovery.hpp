// Stores from files and folders.
#pragma once

#include "core/progress.hpp"
#include "pmq/store.hpp"

#include <memory>
#include <string>

namespace locus::pmq {

// `options` may be nullptr: the defaults, with the file's record layout.
std::unique_ptr<Store> load(const std::string &path, const locus_pmq_options *options, Progress &progress);

// Recover the folder's store, or make a new one, and let it log. Tells what it found.
std::unique_ptr<Store> open_folder(const std::string &path, const locus_pmq_options *options,
                                   const locus_pmq_log_options &log_options, Progress &progress,
                                   locus_pmq_recovery &recovery);

} // namespace locus::pmq
