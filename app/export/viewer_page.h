#pragma once
#include <string_view>

namespace sprung {

/// A page that shows a film in three dimensions in any browser with WebGL, by itself (viewer.html with three.js and its
/// licence in it): what it shows is put in place of kViewerFilm, a JavaScript object. Drag to turn, wheel to come
/// nearer, space or the bar to stop.
inline constexpr std::string_view kViewerFilm = "/*FILM*/";
[[nodiscard]] std::string_view viewer_page();

}  // namespace sprung
