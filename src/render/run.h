#pragma once
// Renders pictures of the frames of a run.
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/camera.h"
#include "render/painter.h"

namespace seiche::render {

struct RenderOptions {
  std::filesystem::path run;  // the run directory
  std::filesystem::path out;  // folder of the pictures; empty: <run>/pictures
  int width = 1280, height = 720;
  Format format = Format::png;  // svg and pdf in 2D, exr in 3D
  std::string frames = "all";   // "all", "A-B", "0,10,20", or such parts joined by commas
  std::string font;             // family or file; empty: DejaVu Sans or the system's own
  bool plain = false;           // no texts, axes, colour bar, edges of the domain
  std::optional<std::filesystem::path> contact_sheet, animation;

  std::string color = "auto";                 // "auto": speed in 2D, none in 3D
  std::string color_map = "auto";             // "auto": viridis; coolwarm for quantities with a sign
  std::optional<std::array<float, 2>> range;  // of the colours; unset: that of all frames
  bool per_frame = false;                     // each frame has a range of its own
  bool streamlines = false;                   // 2D

  // 3D
  std::optional<CameraSpec> camera;   // unset: the whole domain in view
  std::filesystem::path camera_path;  // CSV; empty: none
  std::string camera_steps = "smooth";
  int turntable = 0;              // pictures of one turn of the camera; 0: it does not turn
  std::string up = "auto";        // "auto" (against gravity), "x", "y", "z"
  std::string material = "auto";  // look of the liquid; "auto": by the scene's density and viscosity
  std::optional<float> foam;      // amount; unset: none
  bool transparent = false;       // no ground and no sky
};

struct RenderReport {
  int pictures = 0;
  std::vector<std::filesystem::path> files;  // contact sheet and animation, if made
};

// Writes frame.NNNN.png (or .svg, .pdf, .exr) for each chosen frame, then contact sheet and animation; with `turntable`
// and one frame turn.NNNN.png. `say` gets lines of text for the user. Throws Error(bad_input) for a folder without
// frames, for missing frames, and for options that do not apply, Error(output_failed).
RenderReport render_run(const RenderOptions& options, const std::function<void(const std::string&)>& say);

// Parse "1280x720", "ex,ey,ez,lx,ly,lz[,degrees]", "low,high" and a list of frames among those available (ascending).
// Throw Error(bad_input) that names the option and shows its form.
std::array<int, 2> parse_size(const std::string& text);
CameraSpec parse_camera(const std::string& text);
std::array<float, 2> parse_color_range(const std::string& text);
std::vector<int> choose_frames(const std::string& text, const std::vector<int>& available);

}  // namespace seiche::render
