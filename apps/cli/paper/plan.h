#pragma once
// What `faceprobe eval paper` measures, and on what: the paper's whole evaluation as sections of one report.

#include "faceprobe/eval/paper_report.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace faceprobe::cli {

struct PaperPlan {
  std::filesystem::path data;    // the folder that docs/data.md lays out
  std::filesystem::path output;  // gets the report, cache/ and what synthetic faces it makes
  // Synthetic faces to measure on, as docs/training.md makes them; made below `output` where empty.
  std::filesystem::path faces;   // 128 px: highlights
  std::filesystem::path light;   // 256 px: light
  std::filesystem::path groups;  // several faces under near lamps: triangulation
  std::filesystem::path distant;  // the like under distant light alone; made where `groups` is, else empty = not measured
  // Traced training faces, for the rows that learn from them; empty = no such rows.
  std::filesystem::path training;
  // Weights of the rivals that are networks, trained on the same data (docs/training.md), NAME.safetensors each; empty = no such rows.
  std::filesystem::path rivals;
  std::vector<std::string> parts;  // measured now; empty = all
  // report.json of an earlier run, for rows and parts that this one lacks (eval/earlier_rows.h); empty = none.
  std::filesystem::path earlier;
  std::vector<std::string> methods;  // NAME=COMMAND: other people's programs, rows of relighting (docs/cases.md)
  int seconds = 120;                 // for such a program and photo
  bool quick = false;                // few photos, for a look in minutes
  int threads = 0;
  std::function<void(int done, int total)> progress = {};  // within the part at hand

  bool measures(std::string_view part) const { return parts.empty() || std::ranges::find(parts, part) != parts.end(); }
  // Photos of each part.
  int highlight_photos() const { return quick ? 20 : 100; }
  int light_photos() const { return quick ? 8 : 100; }
  int ablation_photos() const { return quick ? 6 : 50; }
  int group_photos() const { return quick ? 2 : 100; }
  int distant_photos() const { return quick ? 2 : 20; }
  int direction_step() const { return quick ? 12 : 1; }  // every n-th photo and person
  int picture_rows() const { return quick ? 4 : 8; }
};

using Sections = std::vector<eval::ReportSection>;

// The parts of the report, each measured by itself. All throw Error as the stages of `faceprobe eval` do. What a part needs and the plan has
// not becomes a section's `missing`.
Sections highlight_sections(const PaperPlan& plan);
Sections object_sections(const PaperPlan& plan);
Sections relight_sections(const PaperPlan& plan);
Sections direction_sections(const PaperPlan& plan);
Sections room_sections(const PaperPlan& plan);
Sections ablation_sections(const PaperPlan& plan);

// Makes the synthetic faces that the plan lacks, and writes into it where they are. Goes on where it was cut off.
void make_paper_faces(PaperPlan& plan);

}  // namespace faceprobe::cli
