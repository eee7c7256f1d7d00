#pragma once
// Parts of the report that were measured before, by what they were measured with: the program itself, its weights, the data, and how much of
// them. A run that was cut off goes on at the part it was at, and nothing old is shown for new.

#include "paper/plan.h"

#include <functional>
#include <span>
#include <string>

namespace faceprobe::cli {

// Hash over the contents of the plan's faces, photos, maps and objects (paper/folder_listing.h): a copy of them is the same data. It reads them, so it
// is made once for all parts. Throws Error(kInput).
std::string identity_of_data(const PaperPlan& plan);

// Hash over the program, its weights, that data, and what a part alone asks for: weights of the rivals that are named (files in plan.rivals), and the
// identity of other people's programs. Throws Error(kInput).
std::string key_of(const PaperPlan& plan, const std::string& data, std::span<const char* const> rivals,
                   const std::string& programs = {});

// The part called `name`, from plan.output/cache or measured now and left there. Throws what `measure` does, and Error(kOutput).
Sections cached_part(const PaperPlan& plan, const std::string& key, const std::string& name,
                     const std::function<Sections(const PaperPlan&)>& measure);

}  // namespace faceprobe::cli
