#pragma once
// Pages for man(1), in the macros of man(7), written from the verbs and options themselves. The text is the same for the same program: it
// holds its version and no date.
//
//   const VerbText program = read_tree(app);
//   io::write_file_atomically(page_file(program), manual_page(program, program));     // faceprobe.1

#include "option_tree.h"

#include <string>

namespace faceprobe::cli {

// `verb`: the program itself or a verb below it.
std::string manual_page(const VerbText& program, const VerbText& verb);
// "faceprobe-synth-unwrap.1"
std::string page_file(const VerbText& verb);

}  // namespace faceprobe::cli
