#pragma once
// How far an estimated picture is from the true one, in one number. Pictures are linear light, as everywhere in this
// project; the figures are not those of the same pictures encoded as sRGB. For numbers over many pictures see
// eval/score_table.h.
//
// Not for environment maps: their rows stand for different solid angles, and nothing here weights them.
//
//   const double error = eval::rmse(estimate, truth, face_mask);   // 0-255 scale, as in the paper's tables
//   const double likeness = eval::ssim(estimate, truth);           // 1 = the same
//
// All take `estimate` and `truth` of one size, H x W x C, and `mask`: H x W x 1, non-zero where to compare; empty =
// everywhere. A black background counts as agreement where no mask is given, so say with a figure which it was. All are NaN
// when there is nothing to compare, or when a compared value is not finite. They throw std::invalid_argument when sizes
// or channels do not fit. Any number of threads gives the same result.

#include "faceprobe/core/image.h"

namespace faceprobe::eval {

// Root of the mean over pixels and channels of (255 (estimate - truth))^2.
double rmse(const Image& estimate, const Image& truth, const ByteImage& mask = {}, int threads = 0);

// Peak signal-to-noise ratio in decibels of that error on the 0-255 scale: 20 lg(255 / rmse); infinite for no error.
double psnr_of_rmse(double rmse_255);

// Mean structural similarity (Wang et al. 2004, "Image quality assessment: from error visibility to structural similarity",
// IEEE TIP 13): Gaussian window of 11 x 11 pixels and sigma 1.5, K1 = .01, K2 = .03, for layers in [0, 1] (L = 1), mean over
// channels, no downsampling. A window counts when it lies whole inside the picture and its centre in the mask; it reads what
// is around the mask, too. NaN for pictures smaller than a window. Symmetric in its pictures.
double ssim(const Image& estimate, const Image& truth, const ByteImage& mask = {}, int threads = 0);

// Root mean square error once the estimate is scaled by the one factor that fits best, all channels together:
// s = <estimate, truth> / <estimate, estimate>. In the units of the pictures; the tables of DiffusionLight and StyleLight
// sum the channels instead of averaging them, which is sqrt(3) times as much.
double si_rmse(const Image& estimate, const Image& truth, const ByteImage& mask = {}, int threads = 0);

// Mean angle in degrees between the colours (R, G, B) of each pixel, whatever their brightness. Needs 3 channels. Pixels
// whose colour has a length of `black` or less in either picture are left out: they have no hue to speak of.
double angular_error_deg(const Image& estimate, const Image& truth, const ByteImage& mask = {}, double black = 1e-3,
                         int threads = 0);

}  // namespace faceprobe::eval
