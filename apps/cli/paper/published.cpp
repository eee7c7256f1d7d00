#include "paper/published.h"

namespace faceprobe::cli {

using eval::Better;
using eval::ReportTable;

namespace {

ReportTable layers_table(const std::string& title, const std::string& note, std::vector<ReportTable::Row> rows) {
  return {.title = title,
          .note = note,
          .columns = {"RMSE, mean", "RMSE, median", "SSIM, mean", "SSIM, median"},
          .rows = std::move(rows),
          .decimals = {2, 2, 2, 2},
          .better = {Better::kLower, Better::kLower, Better::kHigher, Better::kHigher}};
}

ReportTable bunny_table(const std::string& of, std::vector<ReportTable::Row> rows) {
  return {.title = "As the paper has it (its Table 2), " + of + " RMSE",
          .note = "Other faces, lights and another renderer. Compare the order and the ratios.",
          .columns = {"outdoor, diffuse", "outdoor, glossy", "indoor, diffuse", "indoor, glossy"},
          .rows = std::move(rows),
          .decimals = {2, 2, 2, 2},
          .better = {Better::kLower, Better::kLower, Better::kLower, Better::kLower}};
}

}  // namespace

std::vector<ReportTable> published_highlights() {
  return {
      layers_table("As the paper has it (its Table 1)", "Other faces and lights than ours. Compare the order.",
                   {{.name = "the paper's network", .values = {3.37, 3.41, .94, .95}},
                    {.name = "Shi 2017", .values = {4.15, 3.54, .94, .94}},
                    {.name = "Li 2017", .values = {5.35, 4.68, .92, .92}},
                    {.name = "Shen & Zheng 2013", .values = {6.75, 6.41, .91, .91}},
                    {.name = "Yang 2010", .values = {8.08, 7.82, .91, .91}},
                    {.name = "Tan & Ikeuchi 2004", .values = {28.00, 29.50, .87, .87}}}),
      layers_table("As the paper has it (its Table 1), 30 real faces under polarisers",
                   "We have nothing beside it: the photos with their polarised truth, and those of the laboratory in "
                   "the paper's figures, are not published. What the figures print for single photos is left out.",
                   {{.name = "the paper's network", .values = {7.61, 6.75, .89, .90}},
                    {.name = "Shi 2017", .values = {8.93, 8.71, .89, .90}},
                    {.name = "Li 2017", .values = {10.34, 10.54, .90, .91}},
                    {.name = "Shen & Zheng 2013", .values = {10.51, 9.76, .86, .88}},
                    {.name = "Yang 2010", .values = {11.74, 11.53, .88, .90}},
                    {.name = "Tan & Ikeuchi 2004", .values = {19.60, 22.96, .88, .89}}})};
}

std::vector<ReportTable> published_relighting() {
  return {bunny_table("mean", {{.name = "the paper's method", .values = {10.78, 11.02, 13.18, 13.69}},
                               {.name = "Hold-Geoffroy 2017, outdoor; Gardner 2017, indoor",
                                .values = {18.13, 18.28, 29.25, 29.71}},
                               {.name = "Lombardi & Nishino 2016", .values = {21.20, 21.63, 25.40, 25.92}},
                               {.name = "Knorr & Kurz 2014", .values = {17.77, 18.28, 20.52, 21.01}}}),
          bunny_table("median", {{.name = "the paper's method", .values = {9.38, 9.74, 11.68, 11.98}},
                                 {.name = "Hold-Geoffroy 2017, outdoor; Gardner 2017, indoor",
                                  .values = {17.03, 17.67, 25.99, 26.53}},
                                 {.name = "Lombardi & Nishino 2016", .values = {19.95, 20.49, 25.38, 25.91}},
                                 {.name = "Knorr & Kurz 2014", .values = {15.91, 16.30, 19.22, 19.75}}})};
}

ReportTable published_maps() {
  return {.title = "As the paper's supplement has it: real scenes, mean NRMSE over the estimate's range",
          .note =
              "Of 15 scenes whose light was captured beside the faces, 8 outdoor and 7 indoor. They are not published, "
              "so ours are of synthetic photos, in other lights: not even the order need be the same. What lowers "
              "this figure is told at ours.",
          .columns = {"outdoor", "indoor"},
          .rows = {{.name = "the paper's method", .values = {.143, .045}},
                   {.name = "Hold-Geoffroy 2017, outdoor; Gardner 2017, indoor", .values = {.163, .050}},
                   {.name = "Lombardi & Nishino 2016", .values = {.154, .083}},
                   {.name = "Knorr & Kurz 2014", .values = {.245, .286}}},
          .decimals = {3, 3}};
}

}  // namespace faceprobe::cli
