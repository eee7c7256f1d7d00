#pragma once
// The stages that `faceprobe eval` measures, one file each: they print Markdown and write what --output asks for.

#include "faceprobe/eval/score_table.h"
#include "faceprobe/synth/shard.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::cli {

struct EvalOptions {
  std::string stage;
  std::string data;
  std::vector<std::string> weights;  // FILE or NAME=FILE
  std::string output;                // empty: nothing is written
  std::string device = "auto";
  int rows = 12;  // of pictures
  int samples = 100;
  int threads = 0;
  std::string head;  // of the stages geometry and direction: a head model to fit; empty = no such row
  // Of the stage direction.
  std::string set = "all";           // yale, london or all
  int every = 3;                     // every n-th photo and person
  std::vector<std::string> normals;  // mesh, net, 3dmm: rows by normals alone; empty = the usual rows
  std::string rivals;                // folder of weights of networks that are rows; empty = no such rows
  // Of the stages relight, insert and direction.
  std::string object;    // OBJ file; empty = a sphere. Of insert: a shape's name or a file
  std::string scenes;    // table of the maps' scenes; empty = not told apart
  std::string training;  // folder whose mean light is a row
  std::string prior;     // weights of the light prior; empty = those that come with the program
  bool ablation = false;
  // Of the stage cases.
  std::vector<std::string> methods;  // NAME=COMMAND
  int seconds = 120;                 // for a program and case
};

int eval_highlight(const EvalOptions& options);
int eval_geometry(const EvalOptions& options);
int eval_shading(const EvalOptions& options);
int eval_relight(const EvalOptions& options);
int eval_direction(const EvalOptions& options);
int eval_insert(const EvalOptions& options);
int eval_triangulate(const EvalOptions& options);
int eval_cases(const EvalOptions& options);
int eval_export_cases(const EvalOptions& options);

// The figures of eval_triangulate, without printing them.
eval::ScoreTable measure_lamps(const synth::ShardReader& groups, const EvalOptions& options,
                               const std::function<void(int done, int total)>& progress);

// NAME=FILE as that pair; of FILE alone its stem is the name.
std::pair<std::string, std::string> name_and_file(const std::string& named);
// For a device that is not there, even where nothing would run on it; the usual ones are not worth loading libtorch for. Throws Error(kUsage),
// Error(kDevice).
void refuse_missing_device(const std::string& device);
// Counts on a terminal, else says nothing.
std::function<void(int done, int total)> eval_progress();

}  // namespace faceprobe::cli
