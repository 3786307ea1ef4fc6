#pragma once
// Renders pictures of the frames of a run.
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/camera.h"

namespace seiche::render {

struct RenderOptions {
  std::filesystem::path run;  // the run directory
  std::filesystem::path out;  // folder of the pictures; empty: <run>/pictures
  int width = 1280, height = 720;
  std::string frames = "all";        // "all", "A-B", "0,10,20", or such parts joined by commas
  std::optional<CameraSpec> camera;  // 3D; unset: the whole domain in view
  std::string up = "auto";           // 3D: "auto" (against gravity), "x", "y", "z"
  std::string color = "auto";        // "auto": speed in 2D, none in 3D
  std::optional<std::filesystem::path> contact_sheet, animation;
};

struct RenderReport {
  int pictures = 0;
  std::vector<std::filesystem::path> files;  // contact sheet and animation, if made
};

// Writes frame.NNNN.png for each chosen frame, then contact sheet and animation. `say` gets lines of text for the user.
// Throws Error(bad_input) for a folder without frames and for missing frames, Error(output_failed).
RenderReport render_run(const RenderOptions& options, const std::function<void(const std::string&)>& say);

// Parse "1280x720", "ex,ey,ez,lx,ly,lz[,degrees]" and a list of frames among those available (ascending). Throw
// Error(bad_input) that names the option and shows its form.
std::array<int, 2> parse_size(const std::string& text);
CameraSpec parse_camera(const std::string& text);
std::vector<int> choose_frames(const std::string& text, const std::vector<int>& available);

}  // namespace seiche::render
