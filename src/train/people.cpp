#include "faceprobe/train/people.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/region.h"
#include "faceprobe/face/geometry.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/synth/shard.h"
#include "train/finetune_guards.h"
#include "train/histogram_transfer.h"
#include "train/light_colours.h"
#include "train/person_loss.h"
#include "train/radiometric.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

namespace faceprobe::train {
namespace {

namespace fs = std::filesystem;

constexpr int kCalibrationPx = 512;        // long side of a face at most, where its curve is looked for
constexpr int kLeastFacePx = 80;           // wide: below, highlights are a few pixels
constexpr int kLeastSyntheticFacePx = 36;  // of faces that were rendered at that size, and are sharp

bool is_photo(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension == ".jpg" || extension == ".jpeg" || extension == ".png" || extension == ".webp";
}

std::map<std::string, std::vector<fs::path>> photos_by_person(const fs::path& folder) {
  std::error_code error;
  std::map<std::string, std::vector<fs::path>> people;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (it->is_regular_file() && is_photo(it->path()))
      people[fs::relative(it->path().parent_path(), folder).generic_string()].push_back(it->path());
  }
  if (error) throw Error(ExitCode::kInput, folder.string() + " cannot be read: " + error.message() + ".");
  if (people.empty()) throw Error(ExitCode::kInput, "There are no photos in " + folder.string() + ".");
  for (auto& [name, files] : people) std::sort(files.begin(), files.end());
  return people;
}

struct Candidate {
  std::string name;
  PersonPhoto photo;
  SquarePhoto square;  // the photo as it was taken
  PhotoMeasures measures;
  ByteImage mask;
  Image mesh;
  bool calibrated = false;
};

PhotoLimits limits_of(const PeopleOptions& options) {
  return {.max_reprojection_share = options.max_expression, .max_light_colour_spread = options.max_light_colours};
}

class Reader {
 public:
  Reader(const PeopleOptions& options, int least_face_px)
      : options_(options), least_face_px_(least_face_px), finder_(face::FinderOptions{.min_face_px = least_face_px}),
        mesh_(face::load_canonical_mesh(io::data_file("canonical-face-model.obj"))),
        square_(face_template(mesh_, options.square_px)),
        regions_(template_regions(square_, face::triangle_regions(mesh_))) {}

  const ByteImage& regions() const { return regions_; }

  // Nothing when the photo is unsuitable; then `why` says so.
  std::optional<Candidate> read(io::Photo photo, std::string& why) const {
    if (photo.grey) return refused(why, "it is grey");
    face::Camera camera;
    camera.centre_x_px = 0.5 * photo.linear.width();
    camera.centre_y_px = 0.5 * photo.linear.height();
    // Press photos: taken from afar.
    camera.focal_px = photo.focal_px.value_or(2.0 * std::max(photo.linear.width(), photo.linear.height()));
    const std::vector<face::Face> faces = finder_.find(photo.linear, camera);
    if (faces.empty()) return refused(why, "no face was found");
    const face::Face& face = face::largest_of(faces);
    if (static_cast<double>(face.box.width) < least_face_px_) {
      return refused(why, "its face is " + std::to_string(static_cast<int>(face.box.width)) + " px wide");
    }
    const bool calibrated = options_.calibrate && calibrate(face, camera, photo);
    std::optional<Candidate> candidate = prepare(photo, face, camera, why);
    if (candidate) candidate->calibrated = calibrated;
    return candidate;
  }

 private:
  static std::nullopt_t refused(std::string& why, const std::string& reason) {
    why = reason;
    return std::nullopt;
  }

  // Decodes the photo by its own response curve; false when its skin gives no reason to. Such curves are told from small differences of
  // skin's colour, so they are looked for at the photo's own size.
  bool calibrate(const face::Face& face, const face::Camera& camera, io::Photo& photo) const {
    const face::GeometryOptions geometry{.long_side_px = kCalibrationPx};
    const face::Crop crop = face::face_crop(face, photo.linear.width(), photo.linear.height(), geometry);
    const ByteImage regions = face::rasterize_regions(face, camera, mesh_, crop);
    ByteImage skin(crop.width, crop.height, 1);
    for (std::size_t i = 0; i < regions.pixel_count(); ++i)
      skin.data()[i] = is_probe_skin(static_cast<Region>(regions.data()[i])) ? 1 : 0;
    const ResponseFit fit = fit_response(skin_triples(encode_srgb(face::crop_picture(photo.linear, crop)), skin));
    if (fit.kept_srgb) return false;
    photo.linear = linearise(encode_srgb(photo.linear), fit.contrast);
    return true;
  }

  std::optional<Candidate> prepare(const io::Photo& photo, const face::Face& face, const face::Camera& camera,
                                   std::string& why) const {
    const face::GeometryOptions geometry{.long_side_px = options_.crop_px};
    const face::Crop crop = face::face_crop(face, photo.linear.width(), photo.linear.height(), geometry);
    Candidate out;
    out.photo.linear = face::crop_picture(photo.linear, crop);
    out.photo.clipped = face::crop_flags(photo.clipped, crop);
    face::FaceGeometry surface = face::rasterize(face, camera, mesh_, crop);
    const ByteImage& regions = surface.region;
    out.mask = ByteImage(crop.width, crop.height, 1);
    for (std::size_t i = 0; i < regions.pixel_count(); ++i) {
      out.mask.data()[i] = is_skin(static_cast<Region>(regions.data()[i])) ? 1 : 0;
    }
    out.mesh = std::move(surface.normal_cam);
    WarpLandmarks landmarks{face.landmarks_px.leftCols<2>(), face.landmarks_px.col(2) * static_cast<float>(crop.scale)};
    for (Eigen::Index i = 0; i < landmarks.photo_px.rows(); ++i) {
      const Eigen::Vector2d at = crop.crop_from_photo(static_cast<double>(landmarks.photo_px(i, 0)),
                                                      static_cast<double>(landmarks.photo_px(i, 1)));
      landmarks.photo_px.row(i) = at.cast<float>().transpose();
    }
    out.photo.warp = face_warp(square_, landmarks, {crop.width, crop.height});
    measure(out, face);
    why = why_unsuitable(out.measures, limits_of(options_));
    if (!why.empty()) return std::nullopt;
    return out;
  }

  // All but the colours of the light, which the person's other photos tell of.
  void measure(Candidate& candidate, const face::Face& face) const {
    PhotoMasks masks;
    masks.skin = ByteImage(regions_.width(), regions_.height(), 1);
    for (std::size_t i = 0; i < regions_.pixel_count(); ++i)
      masks.skin.data()[i] = is_probe_skin(static_cast<Region>(regions_.data()[i])) ? 1 : 0;
    masks.seen = seen(candidate.photo.warp);
    Image clipped(candidate.photo.linear.width(), candidate.photo.linear.height(), 1);
    for (std::size_t i = 0; i < clipped.pixel_count(); ++i)
      clipped.data()[i] = candidate.photo.clipped.data()[i] != 0 ? 1.0F : 0.0F;
    const Image flat = sample(clipped, candidate.photo.warp);
    masks.clipped = ByteImage(flat.width(), flat.height(), 1);
    SquarePhoto& square = candidate.square;
    square = {sample(candidate.photo.linear, candidate.photo.warp), ByteImage(flat.width(), flat.height(), 1)};
    for (std::size_t i = 0; i < flat.pixel_count(); ++i) {
      masks.clipped.data()[i] = flat.data()[i] > 0 ? 1 : 0;
      const bool usable = masks.skin.data()[i] != 0 && masks.seen.data()[i] != 0 && masks.clipped.data()[i] == 0;
      square.usable.data()[i] = usable ? 1 : 0;
    }
    candidate.measures = measure_photo(square.linear, masks);
    candidate.measures.reprojection_share =
        face.reprojection_rms_px / static_cast<double>(std::max(1.0F, face.box.width));
  }

  PeopleOptions options_;
  double least_face_px_;
  face::FaceFinder finder_;
  face::CanonicalMesh mesh_;
  FaceTemplate square_;
  ByteImage regions_;
};

// Takes out the photo whose light has the most colours, until what is left agrees: one such photo is part of the mean that the others are
// measured by. `leave_out`: its name and why.
void leave_out_mixed_light(std::vector<Candidate>& photos, const PeopleOptions& options,
                           const std::function<void(const std::string&, const std::string&)>& leave_out) {
  while (photos.size() > 1) {
    std::vector<SquarePhoto> squares;
    squares.reserve(photos.size());
    for (const Candidate& photo : photos) squares.push_back(photo.square);
    const std::vector<double> spreads = light_colour_spreads(squares);
    const auto worst = std::ranges::max_element(spreads) - spreads.begin();
    Candidate& photo = photos[static_cast<std::size_t>(worst)];
    photo.measures.light_colour_spread = spreads[static_cast<std::size_t>(worst)];
    const std::string why = why_unsuitable(photo.measures, limits_of(options));
    if (why.empty()) return;
    leave_out(photo.name, why);
    photos.erase(photos.begin() + worst);
  }
}

// Colours of the first photo for all of them, by the skin alone.
void match_colours(std::vector<Candidate>& photos) {
  for (std::size_t k = 1; k < photos.size(); ++k) {
    photos[k].photo.linear =
        transfer_histogram(photos[k].photo.linear, photos[k].mask, photos[0].photo.linear, photos[0].mask);
  }
}

}  // namespace

std::string PeopleOptions::validate() const {
  if (crop_px < 32 || crop_px > 1024) return "crop_px is " + std::to_string(crop_px) + "; allowed is 32 to 1024.";
  if (square_px < 16 || square_px > 512) return "square_px is " + std::to_string(square_px) + "; allowed is 16 to 512.";
  if (!(max_expression > 0 && max_expression <= 1))
    return "max_expression is " + std::to_string(max_expression) + "; allowed is above 0, to 1.";
  if (!(max_light_colours > 0 && max_light_colours <= 1))
    return "max_light_colours is " + std::to_string(max_light_colours) + "; allowed is above 0, to 1.";
  if (least_photos < 2 || most_photos < least_photos)
    return "A person needs two photos or more, and most_photos not below least_photos.";
  return {};
}

namespace {

// A photo that may turn out not to be one, and what to call it.
struct PhotoSource {
  std::string name;
  std::function<io::Photo()> photo;
};

// Empty when too few photos are suitable.
std::optional<PersonSet> person_of(const std::string& name, const std::vector<PhotoSource>& sources,
                                   const Reader& reader, const PeopleOptions& options,
                                   const std::function<void(const std::string&)>& progress) {
  PersonSet person{
      .name = name, .photos = {}, .masks = {}, .meshes = {}, .regions = reader.regions(), .left_out = {}, .calibrated = 0};
  const auto leave_out = [&](const std::string& photo, const std::string& why) {
    person.left_out.push_back(photo + ": " + why);
    if (progress) progress(name + "/" + person.left_out.back());
  };
  std::vector<Candidate> candidates;
  for (const PhotoSource& source : sources) {
    if (static_cast<int>(candidates.size()) == options.most_photos) break;
    std::string why;
    try {
      if (std::optional<Candidate> candidate = reader.read(source.photo(), why)) {
        candidate->name = source.name;
        candidates.push_back(std::move(*candidate));
      }
    } catch (const Error& error) {
      why = error.what();
    }
    if (!why.empty()) leave_out(source.name, why);
  }
  leave_out_mixed_light(candidates, options, leave_out);
  person.calibrated =
      static_cast<int>(std::ranges::count_if(candidates, [](const Candidate& c) { return c.calibrated; }));
  if (progress) {
    progress(name + ": " + std::to_string(candidates.size()) + " photos of " + std::to_string(sources.size()) +
             " can be used" +
             (options.calibrate ? ", " + std::to_string(person.calibrated) + " by curves of their own" : ""));
  }
  if (static_cast<int>(candidates.size()) < options.least_photos) return std::nullopt;
  if (options.match_colours) match_colours(candidates);
  for (Candidate& candidate : candidates) {
    person.photos.push_back(std::make_shared<const PersonPhoto>(std::move(candidate.photo)));
    person.masks.push_back(std::move(candidate.mask));
    person.meshes.push_back(std::move(candidate.mesh));
  }
  return person;
}

io::Photo photo_of(const synth::Sample& sample) {
  io::Photo photo;
  photo.linear = decode_srgb(sample.photo);
  photo.clipped = sample.clip;
  return photo;
}

// Numbers of the samples of each person, in the order in which they lie; one face a picture.
std::map<int, std::vector<int>> samples_by_person(const synth::ShardReader& faces) {
  std::map<int, std::vector<int>> people;
  for (int number = 0; number < faces.sample_count(); ++number) people[faces.person(number)].push_back(number);
  return people;
}

}  // namespace

std::vector<PersonSet> load_people(const fs::path& folder, const PeopleOptions& options,
                                   const std::function<void(const std::string&)>& progress) {
  if (const std::string fault = options.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
  const Reader reader(options, kLeastFacePx);
  std::vector<PersonSet> people;
  for (const auto& [name, files] : photos_by_person(folder)) {
    std::vector<PhotoSource> sources;
    sources.reserve(files.size());
    for (const fs::path& file : files)
      sources.push_back({file.filename().string(), [file] { return io::load_photo(file); }});
    if (std::optional<PersonSet> person = person_of(name, sources, reader, options, progress))
      people.push_back(std::move(*person));
  }
  return people;
}

std::vector<PersonSet> load_synthetic_people(const fs::path& folder, int most_people, const PeopleOptions& options,
                                             const std::function<void(const std::string&)>& progress) {
  if (const std::string fault = options.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
  if (most_people < 1)
    throw Error(ExitCode::kUsage, "most_people is " + std::to_string(most_people) + "; it must be 1 or more.");
  const synth::ShardReader faces(folder);
  const Reader reader(options, kLeastSyntheticFacePx);
  const std::map<int, std::vector<int>> numbers = samples_by_person(faces);
  const double stride = std::max(1.0, static_cast<double>(numbers.size()) / most_people);
  std::vector<PersonSet> people;
  double next = 0;
  int at = 0;
  for (const auto& [person_number, samples] : numbers) {
    if (at++ < next) continue;
    next += stride;
    // Lights of one view lie side by side: taken with strides, photos differ in both.
    std::vector<PhotoSource> sources;
    const std::size_t tried = std::min<std::size_t>(samples.size(), 2 * static_cast<std::size_t>(options.most_photos));
    for (std::size_t i = 0; i < tried; ++i) {
      const int number = samples[i * samples.size() / tried];
      sources.push_back({std::to_string(number), [&faces, number] { return photo_of(faces.copy_light(number)); }});
    }
    if (std::optional<PersonSet> person =
            person_of("person " + std::to_string(person_number), sources, reader, options, progress))
      people.push_back(std::move(*person));
  }
  return people;
}

}  // namespace faceprobe::train
