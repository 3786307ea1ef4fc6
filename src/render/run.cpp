#include "render/run.h"

#include <fmt/format.h>

#include "files/checked_file.h"
#include "files/frames.h"
#include "render/extras.h"
#include "render/font.h"
#include "render/pictures.h"
#include "render/png_writer.h"

namespace seiche::render {

RenderReport render_run(const RenderOptions& options, const std::function<void(const std::string&)>& say) {
  const Job job = prepare_job(options, say);
  Studio studio(job);
  find_font(options.font);  // before anything is written
  make_folder(job.out);
  RenderReport report;
  std::vector<std::filesystem::path> pictures;
  const std::vector<Shot> shots = shots_of(job);
  const bool still = shots.size() > 1 && job.chosen.size() == 1;
  ContactSheet sheet(int(shots.size()), options.width, options.height, options.font);
  for (const Shot& shot : shots) {
    const int number = still ? report.pictures : shot.frame;
    pictures.push_back(job.out / frame_file(still ? "turn" : "frame", number, extension_of(options.format)));
    const Studio::Result picture = studio.draw(shot, pictures.back());
    if (options.contact_sheet) sheet.offer(report.pictures, picture.image, picture.label);
    ++report.pictures;
    say(pictures.back().string());
  }
  if (options.contact_sheet) {
    const auto file = options.contact_sheet->empty() ? job.out / "contact_sheet.png" : *options.contact_sheet;
    write_png(file, sheet.image());
    report.files.push_back(file);
  }
  if (options.animation) {
    const double rate = job.scene.time.frame_rate;
    const std::string trouble = encode_animation(pictures, rate <= 60 ? rate : 30, *options.animation);
    if (trouble.empty())
      report.files.push_back(*options.animation);
    else
      say(trouble);
  }
  for (const auto& file : report.files) say(file.string());
  return report;
}

}  // namespace seiche::render
