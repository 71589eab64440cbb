// The pictures of a run: the moving window, the world and a zoom at the end.
#pragma once

#include "common/animation.hpp"
#include "common/events.hpp"
#include "stream/heat_map.hpp"
#include "stream/window.hpp"

#include <optional>
#include <string>
#include <vector>

namespace demo {

struct PictureSettings {
    std::string folder;
    std::string zoom;          // "auto", LAT,LON or the name of a place
    double zoom_km = 0;        // 0: chosen
    int64_t horizon = 0;       // microseconds
    std::vector<Event> events; // none are known of a file
    bool draw = true;
};

class Pictures {
public:
    // Makes the folder, and takes away the frames of an earlier run. Throws std::runtime_error.
    Pictures(const World &world, PictureSettings settings);

    // A frame of the animation. Where the disk is full, that is kept as error() and nothing more is drawn.
    void frame(const Window &window);

    // The last pictures. Call it once, at the end.
    void finish(const Window &window);

    const View &zoom() const { return *zoom_; } // after finish(),
    Position middle() const { return middle_; } // and its middle
    const std::vector<std::string> &files() const { return files_; }
    const std::string &error() const { return error_; }

private:
    std::vector<Event> events_in(const Window &window) const;
    void choose_zoom(const Window &window);
    MapText text_of(const Window &window, const std::string &what) const;
    void add_places(const View &view, MapText &text) const;
    Canvas draw(const View &view, const Window &window, bool places) const;
    template <typename Work>
    void guarded(Work work);

    const World &world_;
    PictureSettings settings_;
    Animation animation_;
    std::optional<View> zoom_;
    Position middle_;
    bool local_ = false; // the records lie close together: the world would show a dot
    std::optional<View> frame_view_;
    std::vector<std::string> files_;
    std::string error_;
};

} // namespace demo
