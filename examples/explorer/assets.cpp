// Reading the page's files.
#include "explorer/assets.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

namespace explorer {
namespace {

namespace fs = std::filesystem;

std::string type_of(const std::string &extension) {
    static const std::map<std::string, std::string> types{{".html", "text/html; charset=utf-8"},
                                                          {".css", "text/css; charset=utf-8"},
                                                          {".js", "text/javascript; charset=utf-8"},
                                                          {".mjs", "text/javascript; charset=utf-8"},
                                                          {".json", "application/json"},
                                                          {".svg", "image/svg+xml"},
                                                          {".png", "image/png"},
                                                          {".ico", "image/x-icon"},
                                                          {".txt", "text/plain; charset=utf-8"},
                                                          {".webmanifest", "application/manifest+json"},
                                                          {".woff2", "font/woff2"}};
    const auto found = types.find(extension);
    return found == types.end() ? "application/octet-stream" : found->second;
}

std::string contents(const fs::path &path) {
    std::ifstream file(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(file), {}};
    if (!file)
        throw std::runtime_error("cannot read " + path.string());
    return bytes;
}

} // namespace

Assets::Assets(const std::string &folder) {
    std::error_code wrong;
    fs::recursive_directory_iterator files(folder, wrong);
    if (wrong)
        throw std::runtime_error("cannot read the page's files in " + folder + ": " + wrong.message());
    for (const fs::directory_entry &entry : files) {
        const bool hidden = entry.path().filename().string().starts_with('.');
        if (entry.is_symlink() || !entry.is_regular_file() || hidden)
            continue;
        const std::string bytes = contents(entry.path());
        Reply reply = text_reply(type_of(entry.path().extension().string()), bytes);
        reply.headers = {{"Cache-Control", "no-cache"},
                         {"ETag", "\"" + std::to_string(std::hash<std::string>()(bytes)) + "\""}};
        const std::string path = "/" + fs::relative(entry.path(), folder).generic_string();
        if (path == "/index.html")
            files_["/"] = reply;
        files_[path] = std::move(reply);
    }
}

const Reply *Assets::find(const std::string &path) const {
    const auto found = files_.find(path);
    return found == files_.end() ? nullptr : &found->second;
}

} // namespace explorer
