#include "faceprobe/eval/paired_column.h"
#include "faceprobe/io/data_files.h"
#include "highlight_methods.h"
#include "paper/plan.h"
#include "paper/published.h"
#include "paper/report_names.h"

#include <utility>

namespace faceprobe::cli {

namespace {

const std::set<std::string> kOurs = {"net"};

// Name in the tables, file in the folder of rivals.
struct NamedNetwork {
  const char* name;
  const char* file;
};
constexpr NamedNetwork kRivals[] = {{"paper's network (MSCR)", "mscr.safetensors"},
                                    {"net, finetuned on photos of people", "finetuned.safetensors"},
                                    {"shi 2017", "shi.safetensors"}};

struct Methods {
  std::vector<eval::HighlightMethod> all;
  std::string missing;
};

Methods methods_of(const PaperPlan& plan) {
  Methods methods{classical_highlight_methods(plan.threads), {}};
  const std::string device = "auto";
  for (const NamedNetwork& rival : kRivals) {
    const std::filesystem::path file = plan.rivals / rival.file;
    if (!plan.rivals.empty() && std::filesystem::exists(file)) {
      methods.all.push_back(network_highlight_method(rival.name + ("=" + file.string()), device, plan.threads));
    } else {
      methods.missing += std::string(methods.missing.empty() ? "" : " ") + "No row of " + rival.name +
                         ": its weights, " + rival.file +
                         ", are not in a folder that --rivals names; docs/training.md says how they are made.";
    }
  }
  methods.all.push_back(
      network_highlight_method("net=" + io::data_file("face.safetensors").string(), device, plan.threads));
  return methods;
}

eval::ReportSection colour_section(const PaperPlan& plan, const synth::ShardReader& faces, const Methods& methods) {
  const eval::ScoreTable scores = eval::measure_highlights(
      faces, methods.all, {.samples = plan.highlight_photos(), .threads = plan.threads, .progress = plan.progress});
  eval::ReportSection section{.id = "highlights",
                              .title = "Highlight layers of synthetic faces",
                              .text =
                                  "The paper's Table 1 on faces, skins and lights that no network was trained on. "
                                  "Errors are of the highlight layer, linear "
                                  "light, 0 to 255.",
                              .command = "faceprobe eval highlight --data FACES --weights net=models/face.safetensors",
                              .missing = methods.missing};
  const auto higher = eval::Better::kHigher;
  section.tables = {paired_table_of(scores, "rmse_skin", "RMSE on the face's skin", 2, kOurs),
                    paired_table_of(scores, "ssim_skin", "SSIM on the face's skin", 3, kOurs, higher),
                    table_of(scores, "psnr_skin", "PSNR on the face's skin, dB", 1, kOurs, higher),
                    table_of(scores, "rmse_whole", "RMSE on the whole crop", 2, kOurs),
                    table_of(scores, "ssim_whole", "SSIM on the whole crop", 3, kOurs, higher),
                    table_of(scores, "psnr_whole", "PSNR on the whole crop, dB", 1, kOurs, higher),
                    table_by_group(scores, "rmse_skin", "tone", "RMSE on the skin by tone", 2, kOurs),
                    table_by_group(scores, "rmse_skin", "clipped", "RMSE on the skin by clipped share", 2, kOurs),
                    table_by_group(scores, "rmse_skin", "size", "RMSE on the skin by its share of the crop", 2, kOurs)};
  for (eval::ReportTable& published : published_highlights()) section.tables.push_back(std::move(published));
  section.plots = {histogram_of(scores, "rmse_skin", "Photos by RMSE on the skin", "RMSE, 0-255", kOurs),
                   histogram_of(scores, "ssim_skin", "Photos by SSIM on the skin", "SSIM", kOurs)};
  std::string columns = "Columns: photo, true highlight, ";
  for (const eval::HighlightMethod& method : methods.all) columns += row_name(method.name) + ", ";
  columns.replace(columns.size() - 2, 2, ". Highlights are drawn twice as bright.");
  section.pictures = {
      {.title = "Layers", .caption = columns, .picture = draw_highlights(faces, methods.all, plan.picture_rows())}};
  return section;
}

eval::ReportSection grey_section(const PaperPlan& plan, const synth::ShardReader& faces, const Methods& methods) {
  const eval::ScoreTable scores = eval::measure_highlights(
      faces, methods.all,
      {.samples = plan.highlight_photos(), .grey = true, .threads = plan.threads, .progress = plan.progress});
  return {.id = "highlights_grey",
          .title = "The same from grey photos",
          .text =
              "Three equal channels in, the mean of three out, as the paper has it (its SSIM .891, RMSE 8.13). "
              "Tan, Yang and Shen live by colour and find nothing here, as the black layer; Li expects a highlight of "
              "any skin.",
          .tables = {paired_table_of(scores, "rmse_skin", "RMSE on the face's skin", 2, kOurs),
                     paired_table_of(scores, "ssim_skin", "SSIM on the face's skin", 3, kOurs, eval::Better::kHigher),
                     table_of(scores, "rmse_whole", "RMSE on the whole crop", 2, kOurs),
                     table_of(scores, "ssim_whole", "SSIM on the whole crop", 3, kOurs, eval::Better::kHigher)},
          .plots = {histogram_of(scores, "rmse_skin", "Photos by RMSE on the skin", "RMSE, 0-255", kOurs)}};
}

}  // namespace

Sections highlight_sections(const PaperPlan& plan) {
  const synth::ShardReader faces(plan.faces);
  const Methods methods = methods_of(plan);
  return {colour_section(plan, faces, methods), grey_section(plan, faces, methods)};
}

}  // namespace faceprobe::cli
