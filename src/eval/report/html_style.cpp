#include "eval/report/html.h"

namespace faceprobe::eval {

// Colours of the series: Okabe and Ito's, the pale ones darkened for paper, and lighter ones of the same hues on a dark screen.
std::string report_style() {
  return R"css(
:root {
  --paper: #fff; --ink: #1a1a1a; --dim: #555; --line: #777; --grid: #e4e4e4; --tint: #eef4fb;
  --box: #fff6e0; --edge: #b7791f; --link: #0b5cad;
  --p0: #0072b2; --p1: #d55e00; --p2: #009e73; --p3: #b5578e; --p4: #b07d00; --p5: #4a4a4a;
}
@media screen and (prefers-color-scheme: dark) {
  :root {
    color-scheme: dark;
    --paper: #16181b; --ink: #e8e8e8; --dim: #a8adb3; --line: #8a9097; --grid: #2e3238; --tint: #1d2a38;
    --box: #33290f; --edge: #d9a441; --link: #7db8f0;
    --p0: #56b4e9; --p1: #ff8a4c; --p2: #35c79a; --p3: #e39ac3; --p4: #e6b93c; --p5: #c4c8cc;
  }
}
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body { margin: 0 auto; padding: 2rem 1.25rem 4rem; max-width: 60rem; background: var(--paper); color: var(--ink);
  font: 16px/1.5 system-ui, "Segoe UI", "Helvetica Neue", Arial, "Liberation Sans", "DejaVu Sans", sans-serif; }
h1 { font-size: 2rem; line-height: 1.2; margin: 0 0 1rem; }
h2 { font-size: 1.5rem; line-height: 1.25; margin: 0 0 0.75rem; }
h1, h2, caption, figcaption { overflow-wrap: anywhere; }
p { margin: 0 0 0.75rem; max-width: 46rem; }
a { color: var(--link); }
code { font: 0.875em/1.5 ui-monospace, "SFMono-Regular", Menlo, Consolas, "Liberation Mono", "DejaVu Sans Mono", monospace; overflow-wrap: anywhere; }
.note, .read { color: var(--dim); font-size: 0.875rem; }
dl.read { max-width: 46rem; }
.read dt { font-weight: 600; }
.read dd { margin: 0 0 0.25rem 1rem; }
.command { font-size: 0.875rem; color: var(--dim); }
.command code { color: var(--ink); background: var(--tint); padding: 0.1em 0.35em; border-radius: 3px; }
nav ol { margin: 0 0 1.5rem; padding-left: 1.6rem; }
nav li { margin: 0.15rem 0; }
section { border-top: 1px solid var(--grid); margin-top: 2.5rem; padding-top: 2rem; }
.missing { background: var(--box); border-left: 4px solid var(--edge); padding: 0.6rem 0.9rem; max-width: none; }
.wide { overflow-x: auto; margin: 1.25rem 0 0.5rem; }
table { border-collapse: collapse; font-size: 0.9375rem; font-variant-numeric: tabular-nums; }
caption, figcaption { text-align: left; font-weight: 600; padding: 0 0 0.4rem; }
th, td { padding: 0.3rem 0.75rem; text-align: right; white-space: nowrap; border-bottom: 1px solid var(--grid); vertical-align: baseline; }
thead th { border-bottom: 2px solid var(--line); vertical-align: bottom; font-weight: 600; }
th:first-child { text-align: left; white-space: normal; padding-left: 0.4rem; min-width: 9rem; }
tbody th { font-weight: 400; }
thead abbr { text-decoration: none; color: var(--dim); font-weight: 400; }
th[colspan] { text-align: center; }
.of { padding-right: 0; }
.range { color: var(--dim); font-size: 0.8125rem; text-align: left; padding-left: 0.4rem; }
tbody th small { display: block; color: var(--dim); font-size: 0.8125rem; font-weight: 400; }
tr.ours { background: var(--tint); }
tr.ours th { font-weight: 600; box-shadow: inset 3px 0 0 var(--p0); }
.plot, .picture { margin: 1.5rem 0; }
.picture img { display: block; max-width: 100%; height: auto; background: repeating-conic-gradient(#ddd 0% 25%, #fff 0% 50%) 0 0 / 16px 16px; }
.picture .note { margin-top: 0.4rem; }
.plot svg { display: block; width: 100%; max-width: 48rem; height: auto; font-size: 13px; }
.plot .note { margin-top: 0.3rem; }
svg text { fill: var(--ink); }
svg text.dim { fill: var(--dim); }
svg text.strong { font-weight: 600; }
.grid { stroke: var(--grid); }
.axis { stroke: var(--line); }
.mark { stroke: var(--line); stroke-dasharray: 4 3; }
.s0 { --c: var(--p0); } .s1 { --c: var(--p1); } .s2 { --c: var(--p2); } .s3 { --c: var(--p3); } .s4 { --c: var(--p4); } .s5 { --c: var(--p5); }
.curve { fill: none; stroke: var(--c); stroke-width: 1.75; stroke-linejoin: round; }
.curve.heavy { stroke-width: 3; }
.bar { fill: var(--c); fill-opacity: 0.4; }
.median { stroke: var(--c); stroke-width: 2; }
.drop { stroke: var(--c); stroke-width: 1; stroke-dasharray: 2 2; }
.spread { stroke: var(--c); stroke-width: 1.25; }
.whisker { stroke: var(--ink); stroke-width: 1.25; }
.marker { fill: var(--c); stroke: var(--c); stroke-width: 1.5; }
@page { size: A4; margin: 18mm 16mm 20mm; @bottom-center { content: counter(page) " / " counter(pages); font: 8pt sans-serif; color: #555; } }
@media print {
  :root { color-scheme: light; }
  html { font-size: 10pt; }
  body { padding: 0; max-width: none; font-size: 10pt; line-height: 1.4; }
  h1 { font-size: 20pt; } h2 { font-size: 15pt; }
  h1, h2, caption, figcaption, .command { break-after: avoid; }
  a { color: inherit; text-decoration: none; }
  section { break-before: page; border: 0; margin: 0; padding: 0; }
  .wide { overflow: visible; }
  table { font-size: 8.5pt; width: 100%; break-inside: auto; }
  th small, .range { font-size: 7.5pt; }
  th { white-space: normal; }
  th:first-child { min-width: 0; }
  thead { display: table-header-group; }
  tr, figure, .missing, p { break-inside: avoid; }
  .plot { margin: 5mm 0; } .plot svg { max-width: 135mm; }
  .picture img { max-height: 215mm; width: auto; }
  .missing, tr.ours, .command code, .picture img { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
)css";
}

}  // namespace faceprobe::eval
