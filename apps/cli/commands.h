#pragma once
// The verbs of the command. Each adds its subcommand to the program; running it returns the exit code.

#include <CLI/CLI.hpp>
#include <functional>

namespace faceprobe::cli {

// What the program runs after parsing; set by the subcommand that was named.
using Action = std::function<int()>;

void add_estimate(CLI::App& program, Action& action);
void add_separate(CLI::App& program, Action& action);
void add_triangulate(CLI::App& program, Action& action);
void add_doctor(CLI::App& program, Action& action);
// These two read the program when they run, so that what is added after them is in their text too.
void add_manual(CLI::App& program, Action& action);
void add_completion(CLI::App& program, Action& action);
void add_relight(CLI::App& program, Action& action);
void add_insert(CLI::App& program, Action& action);
void add_info(CLI::App& program, Action& action);
void add_serve(CLI::App& program, Action& action);
void add_synth(CLI::App& program, Action& action);
void add_mesh(CLI::App& program, Action& action);
void add_trace(CLI::App& program, Action& action);
CLI::App* add_unwrap(CLI::App& synth, Action& action);  // under synth
CLI::App* add_pack(CLI::App& synth, Action& action);    // under synth
void add_train(CLI::App& program, Action& action);
void add_finetune(CLI::App& program, Action& action);
void add_finetune_surface(CLI::App& program, Action& action);
void add_eval(CLI::App& program, Action& action);

// Runs the action; every Error becomes its sentence on stderr and its exit code.
int run_guarded(const Action& action);

}  // namespace faceprobe::cli
