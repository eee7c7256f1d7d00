// glTF 2.0: the document is written anew from what is drawn, every number checked, so that assimp meets no other.

#include "assets/model_checks.h"
#include "assets/model_folder.h"
#include "assets/model_gltf_nodes.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace faceprobe::assets {
namespace {

using nlohmann::json;

constexpr int kMaxJsonDepth = 64;
constexpr int kTriangles = 4;  // primitive modes: below are points and lines, above strip and fan

std::uint32_t word_at(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);  // little-endian, as we are
  return word;
}

void append_word(std::vector<std::byte>& out, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) out.push_back(static_cast<std::byte>((value >> shift) & 0xFFU));
}

struct Chunks {
  std::span<const std::byte> text, binary;
};

Chunks split_glb(const ModelFile& file, std::span<const std::byte> bytes) {
  constexpr std::size_t kHead = 20;  // file header, then the first chunk's
  constexpr char kShort[] = "is cut short: it holds less than its GLB header announces. Copy or download it again.";
  if (bytes.size() < 4 || word_at(bytes, 0) != 0x46546C67U)
    file.refuse("is not a GLB: it does not begin with 'glTF'. Name a GLB file.");
  if (bytes.size() < kHead) file.refuse(kShort);
  if (word_at(bytes, 4) != 2)
    file.refuse("is glTF version " + std::to_string(word_at(bytes, 4)) +
                "; version 2 is read. Export it again as glTF 2.0.");
  const std::size_t text = word_at(bytes, 12);
  if (word_at(bytes, 8) > bytes.size() || text > bytes.size() - kHead) file.refuse(kShort);
  Chunks chunks{bytes.subspan(kHead, text), {}};
  const std::span<const std::byte> rest = bytes.subspan(kHead + text);
  if (rest.size() < 8) return chunks;
  if (word_at(rest, 0) > rest.size() - 8) file.refuse(kShort);
  chunks.binary = rest.subspan(8, word_at(rest, 0));
  return chunks;
}

class Gltf {
 public:
  Gltf(const ModelFile& file, std::size_t binary_bytes, std::vector<std::string>& warnings)
      : file_(file), binary_bytes_(binary_bytes), warnings_(warnings) {}

  json clean(const json& source) {
    check_version(source);
    out_["asset"] = {{"version", "2.0"}};
    copy_buffers(source);
    copy_accessors(source);
    copy_pictures(source);
    for (const json& material : list(source, "materials")) out_["materials"].push_back(clean_material(material));
    for (const json& mesh : list(source, "meshes")) out_["meshes"].push_back(clean_mesh(mesh));
    copy_nodes(file_, source, out_);
    return std::move(out_);
  }

 private:
  [[noreturn]] void malformed(const std::string& what) const { refuse_gltf(file_, what); }
  const json& list(const json& source, const char* key) const { return gltf_list(file_, source, key); }
  std::int64_t whole(const json& object, const char* key, std::int64_t fallback) const {
    return gltf_whole(file_, object, key, fallback);
  }
  std::int64_t index(const json& object, const char* key, const char* of) const {
    const std::int64_t value = whole(object, key, -1);
    if (value >= static_cast<std::int64_t>(out_.contains(of) ? out_[of].size() : 0))
      malformed(std::string(key) + " " + std::to_string(value) + " is not among its " + of);
    return value;
  }

  void check_version(const json& source) {
    const json asset = source.is_object() ? source.value("asset", json()) : json();
    const json version = asset.is_object() ? asset.value("version", json()) : json();
    if (!version.is_string()) malformed("it has no asset.version");
    if (!version.get_ref<const std::string&>().starts_with("2"))
      file_.refuse("is glTF version " + version.dump() + "; version 2 is read. Export it again as glTF 2.0.");
    static const std::set<std::string> kKnown = {
        "KHR_materials_transmission", "EXT_texture_webp",       "KHR_materials_unlit",     "KHR_materials_ior",
        "KHR_materials_volume",       "KHR_materials_specular", "KHR_materials_clearcoat", "KHR_lights_punctual"};
    for (const json& name : list(source, "extensionsRequired")) {
      if (!name.is_string() || !kKnown.contains(name.get<std::string>()))
        file_.refuse("needs the glTF extension " + name.dump() +
                     ", which is not read. Export it without (no compression, no quantisation).");
    }
    out_["extensionsUsed"] = {"KHR_materials_transmission"};
  }

  void copy_buffers(const json& source) {
    std::int64_t total = 0;
    for (const json& buffer : list(source, "buffers")) {
      const std::int64_t bytes = whole(buffer, "byteLength", 0);
      file_.check_count(total += bytes, file_.limits.max_file_bytes, "bytes in its buffers");
      json copy = {{"byteLength", bytes}};
      std::int64_t found = 0;
      if (const json uri = buffer.value("uri", json()); uri.is_string()) {
        copy["uri"] = uri;
        found = bytes_behind(uri.get_ref<const std::string&>());
      } else if (out_["buffers"].empty()) {
        found = static_cast<std::int64_t>(binary_bytes_);
      }
      if (found < bytes || bytes < 1)
        file_.refuse("is cut short: a buffer is announced with " + std::to_string(bytes) + " bytes and has " +
                     std::to_string(found) + ". Copy or download it again.");
      out_["buffers"].push_back(copy);
    }
    for (const json& view : list(source, "bufferViews")) {
      const std::int64_t offset = whole(view, "byteOffset", 0), length = whole(view, "byteLength", 0),
                         stride = whole(view, "byteStride", 0);
      const std::int64_t buffer = index(view, "buffer", "buffers");
      if (buffer < 0 || length < 1 || stride > 252 ||
          offset + length > out_["buffers"][static_cast<std::size_t>(buffer)]["byteLength"].get<std::int64_t>())
        malformed("a bufferView lies outside its buffer");
      json copy = {{"buffer", buffer}, {"byteOffset", offset}, {"byteLength", length}};
      if (stride > 0) copy["byteStride"] = stride;
      out_["bufferViews"].push_back(copy);
    }
  }

  std::int64_t bytes_behind(const std::string& uri) const {
    if (uri.starts_with("data:")) {
      const std::size_t comma = uri.find(";base64,");
      if (comma == std::string::npos) malformed("a data: URI is not base64");
      const std::size_t digits = uri.size() - comma - 8;
      if (digits % 4 != 0)
        malformed("a data: URI's base64 has " + std::to_string(digits) + " digits, not a multiple of 4");
      constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
      const std::size_t end = uri.find_first_not_of(kDigits, comma + 8);
      if (end != std::string::npos && (uri.find_first_not_of('=', end) != std::string::npos || uri.size() - end > 2)) {
        malformed("a data: URI is not base64");
      }
      const auto padding = static_cast<std::int64_t>(uri.ends_with("==") ? 2 : uri.ends_with('=') ? 1 : 0);
      return static_cast<std::int64_t>(digits / 4 * 3) - padding;
    }
    const std::filesystem::path path = find_companion(file_, uri, "the buffer");
    if (path.empty()) file_.refuse("names the buffer '" + uri + "', which is not there; put it beside the model.");
    std::error_code problem;
    const auto size = std::filesystem::file_size(path, problem);
    return problem ? 0 : static_cast<std::int64_t>(size);
  }

  void copy_accessors(const json& source) {
    static const std::map<std::int64_t, std::int64_t> kSizes = {{5120, 1}, {5121, 1}, {5122, 2},
                                                                {5123, 2}, {5125, 4}, {5126, 4}};
    static const std::map<std::string, std::int64_t> kParts = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
    for (const json& accessor : list(source, "accessors")) {
      const std::int64_t type = whole(accessor, "componentType", 0), count = whole(accessor, "count", 0),
                         offset = whole(accessor, "byteOffset", 0);
      const json kind = accessor.value("type", json());
      const auto size = kSizes.find(type);
      const auto parts = kParts.find(kind.is_string() ? kind.get<std::string>() : "");
      const std::int64_t view = index(accessor, "bufferView", "bufferViews");
      // Matrices (skins) and sparse or empty accessors (morph targets) are not for what is drawn; their places are kept.
      if (size == kSizes.end() || parts == kParts.end() || view < 0 || accessor.contains("sparse")) {
        out_["accessors"].push_back(json::object());
        continue;
      }
      const json& slice = out_["bufferViews"][static_cast<std::size_t>(view)];
      const std::int64_t element = size->second * parts->second;
      const std::int64_t stride = slice.value("byteStride", element);
      const std::int64_t length = slice["byteLength"];
      if (count < 1 || stride < element || offset > length - element ||
          count - 1 > (length - offset - element) / stride) {
        malformed("an accessor of " + std::to_string(count) + " elements does not fit its bufferView");
      }
      out_["accessors"].push_back(
          {{"bufferView", view}, {"byteOffset", offset}, {"componentType", type}, {"count", count}, {"type", kind}});
    }
  }

  void copy_pictures(const json& source) {
    for (const json& picture : list(source, "images")) {
      json copy = json::object();
      if (const json uri = picture.value("uri", json()); uri.is_string()) {
        copy["uri"] = uri;
        if (uri.get_ref<const std::string&>().starts_with("data:")) bytes_behind(uri);
      } else if (const std::int64_t view = index(picture, "bufferView", "bufferViews"); view >= 0) {
        copy["bufferView"] = view;
        const json mime = picture.value("mimeType", json());
        copy["mimeType"] = mime.is_string() ? mime : json("image/png");
      }
      out_["images"].push_back(copy);
    }
    for (const json& texture : list(source, "textures")) {
      std::int64_t picture = index(texture, "source", "images");
      const json webp = gltf_member(gltf_member(texture, "extensions"), "EXT_texture_webp");
      if (webp.is_object()) picture = index(webp, "source", "images");
      out_["textures"].push_back(picture >= 0 ? json{{"source", picture}} : json::object());
    }
  }

  json texture_of(const json& source, const char* key) {
    const json info = gltf_member(source, key);
    if (!info.is_object()) return {};
    if (whole(info, "texCoord", 0) != 0)
      gltf_warn(warnings_, file_.name + " has textures on a second set of texture points; the first set is used.");
    if (gltf_member(info, "extensions").contains("KHR_texture_transform"))
      gltf_warn(warnings_,
                file_.name + " moves or scales textures (KHR_texture_transform); they are drawn as they are.");
    return {{"index", index(info, "index", "textures")}};
  }

  json clean_material(const json& source) {
    const json surface = gltf_member(source, "pbrMetallicRoughness");
    json copy = json::object(), kept = json::object();
    if (const json name = gltf_member(source, "name"); name.is_string()) copy["name"] = name;
    for (const char* key : {"metallicFactor", "roughnessFactor"}) {
      if (const json value = gltf_member(surface, key); value.is_number()) kept[key] = value;
    }
    if (const json colour = gltf_member(surface, "baseColorFactor"); gltf_numbers(colour, 4))
      kept["baseColorFactor"] = colour;
    for (const char* key : {"baseColorTexture", "metallicRoughnessTexture"}) {
      if (const json info = texture_of(surface, key); !info.is_null() && info["index"] >= 0) kept[key] = info;
    }
    copy["pbrMetallicRoughness"] = kept;
    const json passes =
        gltf_member(gltf_member(gltf_member(source, "extensions"), "KHR_materials_transmission"), "transmissionFactor");
    if (passes.is_number()) copy["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = passes;
    if (gltf_member(source, "alphaMode") == "BLEND" && !passes.is_number())
      gltf_warn(warnings_, file_.name + " has materials that are see-through by alpha; they are drawn opaque.");
    return copy;
  }

  // The accessor that an attribute names, if it is of this kind; `count` elements when that is not negative.
  std::int64_t attribute(const json& attributes, const char* key, std::initializer_list<const char*> kinds,
                         std::initializer_list<int> types, std::int64_t count) const {
    const std::int64_t at = index(attributes, key, "accessors");
    if (at < 0) return -1;
    const json& accessor = out_["accessors"][static_cast<std::size_t>(at)];
    if (accessor.empty()) malformed(std::string(key) + " is sparse or without data; export without sparse accessors");
    if (std::ranges::find(kinds, accessor["type"].get<std::string>()) == kinds.end() ||
        std::ranges::find(types, accessor["componentType"].get<int>()) == types.end())
      malformed(std::string(key) + " is stored as " + accessor["type"].get<std::string>() + " of type " +
                accessor["componentType"].dump() + ", and plain floats (indices: unsigned integers) are needed");
    if (count >= 0 && accessor["count"] != count)
      malformed(std::string(key) + " has another number of elements than POSITION");
    return at;
  }

  json clean_mesh(const json& source) {
    json copy = {{"primitives", json::array()}};
    if (const json name = gltf_member(source, "name"); name.is_string()) copy["name"] = name;
    for (const json& primitive : list(source, "primitives")) {
      const std::int64_t mode = whole(primitive, "mode", kTriangles);
      if (mode < kTriangles || mode > kTriangles + 2) continue;
      file_.check_count(++primitives_, file_.limits.max_parts, "meshes");
      const json attributes = gltf_member(primitive, "attributes");
      json kept = {{"mode", mode}};
      const std::int64_t position = attribute(attributes, "POSITION", {"VEC3"}, {5126}, -1);
      if (position < 0) continue;
      kept["attributes"]["POSITION"] = position;
      const std::int64_t count = out_["accessors"][static_cast<std::size_t>(position)]["count"];
      const auto keep = [&](const char* key, std::initializer_list<const char*> kinds, std::initializer_list<int> types) {
        if (const std::int64_t at = attribute(attributes, key, kinds, types, count); at >= 0)
          kept["attributes"][key] = at;
      };
      keep("NORMAL", {"VEC3"}, {5126});
      keep("TEXCOORD_0", {"VEC2"}, {5126});
      keep("COLOR_0", {"VEC3", "VEC4"}, {5126, 5121, 5123});
      std::int64_t corners = count;
      if (const std::int64_t at = attribute(primitive, "indices", {"SCALAR"}, {5121, 5123, 5125}, -1); at >= 0) {
        kept["indices"] = at;
        corners = out_["accessors"][static_cast<std::size_t>(at)]["count"];
      }
      if (corners < 3) continue;
      if (mode == kTriangles && corners % 3 != 0)
        malformed("a primitive has " + std::to_string(corners) + " corners, not a multiple of 3");
      if (const std::int64_t at = index(primitive, "material", "materials"); at >= 0) kept["material"] = at;
      file_.check_count(vertices_ += count, file_.limits.max_vertices, "vertices");
      file_.check_count(triangles_ += mode == kTriangles ? corners / 3 : corners - 2, file_.limits.max_triangles,
                        "triangles");
      copy["primitives"].push_back(kept);
    }
    return copy;
  }

  const ModelFile& file_;
  std::size_t binary_bytes_;
  std::vector<std::string>& warnings_;
  json out_;
  std::int64_t primitives_ = 0, vertices_ = 0, triangles_ = 0;
};

json parse(const ModelFile& file, std::span<const std::byte> text) {
  const auto* first = reinterpret_cast<const char*>(text.data());
  const auto shallow = [&](int depth, json::parse_event_t, json&) {
    if (depth > kMaxJsonDepth)
      refuse_gltf(file, "its JSON is nested more than " + std::to_string(kMaxJsonDepth) + " deep");
    return true;
  };
  return json::parse(first, first + text.size(), shallow);
}

}  // namespace

std::vector<std::byte> clean_gltf(const ModelFile& file, std::span<const std::byte> bytes, bool binary,
                                  std::vector<std::string>& warnings) {
  const Chunks chunks = binary ? split_glb(file, bytes) : Chunks{bytes, {}};
  std::string text;
  try {
    text = Gltf(file, chunks.binary.size(), warnings).clean(parse(file, chunks.text)).dump();
  } catch (const json::exception& error) {
    refuse_gltf(file, error.what());
  }
  const auto pad = [](std::size_t size) { return (4 - size % 4) % 4; };
  text.append(binary ? pad(text.size()) : 0, ' ');
  std::vector<std::byte> out;
  if (binary) {
    append_word(out, 0x46546C67U);
    append_word(out, 2);
    const std::size_t data = chunks.binary.size() + pad(chunks.binary.size());
    append_word(out, 20 + text.size() + (data > 0 ? 8 + data : 0));
    append_word(out, text.size());
    append_word(out, 0x4E4F534AU);
  }
  out.insert(out.end(), reinterpret_cast<const std::byte*>(text.data()),
             reinterpret_cast<const std::byte*>(text.data()) + text.size());
  if (!chunks.binary.empty()) {
    append_word(out, chunks.binary.size() + pad(chunks.binary.size()));
    append_word(out, 0x004E4942U);
    out.insert(out.end(), chunks.binary.begin(), chunks.binary.end());
    out.resize(out.size() + pad(chunks.binary.size()));
  }
  return out;
}

}  // namespace faceprobe::assets
