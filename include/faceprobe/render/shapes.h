#pragma once
// Things made in code, so that there is something to insert without a file. Each about 1 high, standing on y = 0, +y up, front towards +z,
// centred on the y axis; closed surfaces, counter-clockwise seen from outside, with smooth normals where the thing is smooth and split
// vertices at its edges.
//
//   Model model = shape("robot");

#include "faceprobe/render/model.h"

#include <string>
#include <string_view>
#include <vector>

namespace faceprobe::render {

Model sphere();         // material "plastic"
Model cube();           // edges a little rounded; material "clay"
Model pot();            // a lathed body with lid, spout and handle, like the well-known teapot; material "plastic"
Model robot();          // of boxes, balls and rods, in several materials
Model three_spheres();  // side by side: diffuse, matte silver, mirror: the three-sphere protocol's

// Any of them by name: "sphere", "cube", "pot", "robot", "spheres". Throws Error(kUsage) listing the names there are.
Model shape(std::string_view name);
const std::vector<std::string>& shape_names();

}  // namespace faceprobe::render
