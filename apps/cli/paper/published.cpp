#include "paper/published.h"

namespace faceprobe::cli {

using eval::Better;

eval::ReportTable published_highlights() {
  return {.title = "As the paper has it (its Table 1)",
          .note = "Other faces and lights than ours. Compare the order.",
          .columns = {"RMSE, mean", "RMSE, median", "SSIM, mean"},
          .rows = {{.name = "the paper's network", .values = {3.37, 3.41, .94}},
                   {.name = "Shi 2017", .values = {4.15, 3.54, .94}},
                   {.name = "Li 2017", .values = {5.35, 4.68, .92}},
                   {.name = "Shen & Zheng 2013", .values = {6.75, 6.41, .91}},
                   {.name = "Yang 2010", .values = {8.08, 7.82, .91}},
                   {.name = "Tan & Ikeuchi 2004", .values = {28.00, 29.50, .87}}},
          .decimals = {2, 2, 2},
          .better = {Better::kLower, Better::kLower, Better::kHigher}};
}

eval::ReportTable published_relighting() {
  return {.title = "As the paper has it (its Table 2), mean RMSE",
          .note = "Other faces, lights and another renderer. Compare the order and the ratios.",
          .columns = {"outdoor, diffuse", "outdoor, glossy", "indoor, diffuse", "indoor, glossy"},
          .rows = {{.name = "the paper's method", .values = {10.78, 11.02, 13.18, 13.69}},
                   {.name = "Hold-Geoffroy 2017, outdoor; Gardner 2017, indoor", .values = {18.13, 18.28, 29.25, 29.71}},
                   {.name = "Lombardi & Nishino 2016", .values = {21.20, 21.63, 25.40, 25.92}},
                   {.name = "Knorr & Kurz 2014", .values = {17.77, 18.28, 20.52, 21.01}}},
          .decimals = {2, 2, 2, 2},
          .better = {Better::kLower, Better::kLower, Better::kLower, Better::kLower}};
}

}  // namespace faceprobe::cli
