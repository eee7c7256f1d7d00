#pragma once
// Contact sheets of square cells.

#include "faceprobe/core/image.h"

namespace faceprobe::bench {

// The linear picture times `gain`, made to fit a cell of `cell_px` and put into its middle, the cell's corner being (x0, y0) of the sheet.
void put_cell(const Image& picture, float gain, int cell_px, int x0, int y0, ByteImage& sheet);

}  // namespace faceprobe::bench
