// The page's files, read once.
#pragma once

#include "explorer/http.hpp"

#include <map>
#include <string>

namespace explorer {

class Assets {
public:
    // Every file below `folder`, as a path such as /leaflet/leaflet.js; index.html is also /. Hidden files and links
    // are left out. Throws std::runtime_error.
    explicit Assets(const std::string &folder);

    const Reply *find(const std::string &path) const;
    size_t size() const { return files_.size(); }

private:
    std::map<std::string, Reply> files_;
};

} // namespace explorer
