#include "paper/report_notes.h"

#include "paper/report_names.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

namespace faceprobe::cli {

namespace {

// Of a section, where some table of it has the row; an empty row: always.
struct SectionNote {
  std::string_view section;
  std::string_view row;
  const char* text;
};
constexpr const char* kDirectionRivals =
    "The rivals' rows are other ways to the light from what our estimate saw: its layers, its normals and, for the "
    "network of LeGendre et al., its place of the face. Gardner's and Hold-Geoffroy's networks have no row: they see "
    "the scene behind a head, and these photos show none. Ambient light has no direction, so straight ahead stands in "
    "its place. The lamp at the brightest highlight has no answer where no highlight was found.";
constexpr std::array kSectionNotes = {
    SectionNote{"highlights", "paper's network (MSCR)",
                "Row \"paper's network (MSCR)\" is the paper's network, trained by us on our synthetic faces and not "
                "finetuned on photos. On how little docs/benchmark.md says."},
    SectionNote{"highlights_grey",
                {},
                "The truth is averaged over the channels like the estimates, so it is another picture than in colour: "
                "no figure here compares with one of the section before. The paper's two figures are means over its 30 "
                "polarised faces, which are not published."},
    SectionNote{
        "relighting", "paper's solver on our layers",
        "Row \"paper's solver on our layers\" is the paper's solver of the light, given the layers and normals of "
        "our network. It is not the paper's whole system: its own network, its finetuning and its face model "
        "have no part in it."},
    SectionNote{
        "sun",
        {},
        "One lamp dominates a light whose strongest main light has a quarter of all energy or more and twice the "
        "irradiance of the next one. The main light is the strongest peak of a map, or its brightest cell where "
        "it has no peak. The sun is the centroid of the brightest 1 % of the sphere."},
    SectionNote{"direction_yale",
                {},
                "The values of the pixels are taken for linear light. That is a choice: the database says that its "
                "camera was linear, but the files carry no profile, and of any other such file sRGB is assumed, which "
                "does much worse here (`faceprobe eval direction` prints both). The row \"paper's solver, net\" has "
                "the normals "
                "of our network."},
    SectionNote{"direction_london",
                {},
                "The skins of most of these people were among the textures that the network was trained on "
                "(models/README.md): they are not people that it has never seen, if in other photos. Where a group is "
                "one person no interval is given. The rows \"paper's solver\" have the layers and normals of our "
                "network."},
    SectionNote{"direction_yale", "lombardi and nishino, lite", kDirectionRivals},
    SectionNote{"direction_london", "lombardi and nishino, lite", kDirectionRivals},
    SectionNote{"ablations",
                {},
                "The rows \"paper's solver\" have the layers and normals of our network, as in the section of the "
                "object."}};

// Of a table; one that ranks nothing has no best value.
struct TableNote {
  std::string_view section;
  std::string_view table;
  bool ranks;
  const char* text;
};
constexpr const char* kWholeCrop =
    "Here methods are given the crop alone: not the mask of the face nor the normals of the mesh, which they have for "
    "the figures on the skin. The background counts.";
constexpr std::array kTableNotes = {
    TableNote{"highlights", "RMSE on the whole crop", true, kWholeCrop},
    TableNote{"highlights", "SSIM on the whole crop", true, kWholeCrop},
    TableNote{"maps", "Mirror sphere, si-RMSE", false,
              "This ranks nothing: the few pixels that mirror the sun or a lamp make nearly all of the error, whatever "
              "else a map has right. So nothing is bold."},
    TableNote{"maps", "Map, NRMSE over the estimate's range", false,
              "Less is not better here: one very bright cell in an estimate widens the range that the error is divided "
              "by. A map with all of its light in one cell, as of the lamp at the brightest highlight, has the lowest "
              "figure. So nothing is bold; the error over the truth's range is the one to compare."},
    TableNote{"sun", "The sun's azimuth alone, degrees", true,
              "Photos whose true sun is within 5 degrees of the vertical are missing for all methods: an azimuth says "
              "nothing there."},
    TableNote{"direction_yale", "Centroid of all light above the median, degrees from the flash", true,
              "Another centroid than the sun's of the synthetic photos, which is of the brightest 1 % alone."},
    TableNote{"triangulation", "Faces, metres from where they are", true,
              "\"Faces known\" has no row here: it is told the places."},
    TableNote{
        "triangulation", "Lamps that were found, metres from where they are", true,
        "A lamp is found where an estimated one is less than 2 m off, so no error here is larger than that, and a "
        "method may lower its mean by missing the hard ones. Read it with the shares below."}};

constexpr std::array<std::pair<const char*, const char*>, 11> kTerms = {{
    {"transport",
     "this program's solver: it inverts the matrix that leads from directions of light to what each patch of skin "
     "shows, highlights with the shadows of the face itself, shading as if nothing were in the way. The row of that "
     "name is the whole estimate as it comes, learnt prior included"},
    {"prior",
     "the light that a small network expects from the same patches of skin, where the solver starts. Without it the "
     "solver starts from a smooth fit to the shading"},
    {"net", "this program's face network, and the layers and normals that it finds"},
    {"classical",
     "layers by a published separator instead of the network, such as \"Yang 2010\" after a comma; all are written "
     "again here"},
    {"paper's solver", "what the paper does from the highlight layer on: trace to the sphere and deconvolve"},
    {"ambient", "the same light from everywhere: what doing nothing gives"},
    {"black layer", "no highlight anywhere: what doing nothing gives"},
    {"lite",
     "written again here from the paper of those it is named after, in a shorter form. No authors' program was run; "
     "the "
     "networks among the rivals were trained here, on less data than their papers"},
    {"si-RMSE",
     "root mean square error after the estimate has its best scale, of light over the true mean; not of 255"},
    {"NRMSE", "root mean square error over a range of values, which each table names"},
    {"earlier", "measured on the same photos by an earlier version of this program, and not again for this report"},
}};

bool has_row(const eval::ReportSection& section, std::string_view name) {
  return std::ranges::any_of(section.tables, [name](const eval::ReportTable& table) {
    return std::ranges::find(table.rows, name, &eval::ReportTable::Row::name) != table.rows.end();
  });
}

// Reports of versions before this one told their parts in a line that could not be read.
std::string readable_origin(std::string text) {
  constexpr std::string_view kRest = " What else there is: ";
  constexpr std::string_view kParts = ", parts ";
  const std::size_t rest = text.find(kRest);
  if (rest != std::string::npos) text.replace(rest, kRest.size(), "\n\nThe other parts are from an earlier report: ");
  const std::size_t parts = text.find(kParts);
  if (parts != std::string::npos) text.replace(parts, kParts.size(), "; parts measured: ");
  return text;
}

// Reports of versions before this one name a benchmark that is a stage of `eval` now.
std::string command_now(const std::string& command) {
  constexpr std::string_view kBefore = "bench_direction ";
  return command.starts_with(kBefore) ? "faceprobe eval direction " + command.substr(kBefore.size()) : command;
}

// Of an earlier report that measured only the parts that this one measured again nothing is left: its line goes.
std::string without_replaced(const std::string& text) {
  constexpr std::string_view kEarlier = "The other parts are from an earlier report: ";
  constexpr std::string_view kMeasured = "; parts measured: ";
  std::string out;
  std::string last;  // parts that the line before named
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(kMeasured);
    const std::string parts = at == std::string::npos ? std::string() : line.substr(at + kMeasured.size());
    if (line.starts_with(kEarlier) && !parts.empty() && parts == last) continue;
    if (!line.empty()) {
      out += (out.empty() ? "" : "\n\n") + line;
      last = parts;
    }
  }
  return out;
}

}  // namespace

void make_readable(eval::PaperReport& report) {
  name_rows(report);
  report.made_with = without_replaced(readable_origin(std::move(report.made_with)));
  report.terms.assign(kTerms.begin(), kTerms.end());
  for (eval::ReportSection& section : report.sections) {
    section.notes.clear();
    section.command = command_now(section.command);
    for (const SectionNote& note : kSectionNotes) {
      if (note.section != section.id || !(note.row.empty() || has_row(section, note.row))) continue;
      section.notes += (section.notes.empty() ? "" : "\n\n") + std::string(note.text);
    }
    for (const TableNote& note : kTableNotes) {
      if (note.section != section.id) continue;
      const auto table = std::ranges::find(section.tables, note.table, &eval::ReportTable::title);
      if (table == section.tables.end()) continue;
      table->note = note.text;
      if (!note.ranks) table->better.assign(table->columns.size(), eval::Better::kNeither);
    }
  }
}

}  // namespace faceprobe::cli
