#pragma once
// What clients are told, as openapi.json lays down.

#include "faceprobe/io/photo.h"
#include "faceprobe/pipeline/room.h"
#include "faceprobe/render/model.h"
#include "serve/records.h"

#include <string>
#include <string_view>
#include <vector>

namespace faceprobe::serve {

// By its extension, such as "image/png".
std::string media_type(std::string_view path);
Json files_json(const std::vector<ServedFile>& files);
Json material_json(const render::Material& material);
Json object_json(const std::string& name, const render::Model& model);

// Everything of an estimate that is done, but its job. `room` is null for one face.
Json describe(const EstimateRecord& record, const io::Photo& photo, const pipeline::EstimateOptions& options,
              const pipeline::Room* room);

Json estimate_json(const EstimateRecord& record);
Json summary_json(const EstimateRecord& record);
Json insertion_json(const InsertionRecord& record);

}  // namespace faceprobe::serve
