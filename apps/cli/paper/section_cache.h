#pragma once
// Parts of the report that were measured before, by what they were measured with: the program itself, its weights, the data, and how much of
// them. A run that was cut off goes on at the part it was at, and nothing old is shown for new.

#include "paper/plan.h"

#include <functional>
#include <span>
#include <string>

namespace faceprobe::cli {

// Hash over the program, its weights, those of the rivals that are named (files in plan.rivals), the recipes of the faces, and names, sizes and
// times of all other data. Throws Error(kInput).
std::string key_of(const PaperPlan& plan, std::span<const char* const> rivals);

// The part called `name`, from plan.output/cache or measured now and left there. Throws what `measure` does, and Error(kOutput).
Sections cached_part(const PaperPlan& plan, const std::string& key, const std::string& name,
                     const std::function<Sections(const PaperPlan&)>& measure);

}  // namespace faceprobe::cli
