/** The page of a report, with places for what a run fills in. */
#pragma once

namespace rgbd_graphslam {

inline constexpr const char* report_page = R"html(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{{title}}</title>
<style>
:root { color-scheme: light dark;
        --ink: #22282e; --soft: #5d6771; --line: #d9dee3; --paper: #fff; --ground: #f1f3f5;
        --bar: #1f77b4; --false: #c81e3c; --warn: #d98a00; --warn-ground: #fff6e2;
        --good: #2d9a57; --good-ground: #eaf7ef; }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink);
       font: 15px/1.45 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
main { max-width: 1180px; margin: 0 auto; padding: 24px 16px 40px; }
h1 { font-size: 24px; margin: 0; overflow-wrap: anywhere; }
h2 { font-size: 16px; margin: 0 0 10px; }
.sub { color: var(--soft); margin: 2px 0 16px; overflow-wrap: anywhere; }
section { background: var(--paper); border: 1px solid var(--line); border-radius: 8px;
          padding: 14px 16px; min-width: 0; flex: 1 1 min(400px, 100%); }
section.wide { flex-basis: 100%; }
.columns { display: flex; flex-wrap: wrap; gap: 16px; }
.figures { display: grid; grid-template-columns: repeat(auto-fill, minmax(112px, 1fr));
           gap: 12px 16px; margin-bottom: 18px; }
.figures b { display: block; font-size: 21px; font-weight: 600; white-space: nowrap; }
.figures span, figcaption, .note { color: var(--soft); font-size: 13px; }
ul.findings { list-style: none; margin: 0; padding: 0; }
ul.findings li { padding: 5px 10px; margin: 4px 0; border-left: 4px solid var(--line);
                 background: var(--ground); overflow-wrap: anywhere; }
ul.findings li.warning { border-color: var(--warn); background: var(--warn-ground); }
ul.findings li.good { border-color: var(--good); background: var(--good-ground); }
img { max-width: 100%; height: auto; display: block; margin: 0 auto; border-radius: 4px; }
figure { margin: 0 0 6px; }
figcaption { margin-top: 6px; }
.note { margin: 8px 0 10px; }
.plan img { max-height: 560px; width: auto; }
.grid-picture img { image-rendering: pixelated; width: 100%; max-height: 560px;
                    object-fit: contain; }
svg { width: 100%; max-width: 760px; height: auto; display: block; margin: 0 auto; }
dl.facts { display: grid; grid-template-columns: max-content minmax(0, 1fr); gap: 4px 18px;
           margin: 0; font-size: 14px; }
dl.facts dt { color: var(--soft); }
dl.facts dd { margin: 0; overflow-wrap: anywhere; }
dl.facts code { font: 13px/1.4 ui-monospace, "DejaVu Sans Mono", monospace; }
{{chart_style}}.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: 13px;
        font-variant-numeric: tabular-nums; }
th, td { text-align: right; padding: 3px 0 3px 16px; white-space: nowrap; }
th { color: var(--soft); font-weight: normal; border-bottom: 1px solid var(--line); }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
table.quality th, table.quality td { white-space: normal; text-align: left;
                                     vertical-align: top; }
tr.false td { color: var(--false); font-weight: 600; }
td.bar { width: 34%; }
td.bar i { display: block; height: 11px; background: var(--bar); border-radius: 2px; min-width: 1px; }
@media (max-width: 620px) {
  main { padding: 16px 10px 24px; }
  section { padding: 12px; }
  dl.facts { grid-template-columns: minmax(0, 1fr); gap: 0; }
  dl.facts dd { margin-bottom: 8px; }
  th, td { padding-left: 7px; }
  table { font-size: 12px; }
  .bar { display: none; }
}
@media screen and (prefers-color-scheme: dark) {
  :root { --ink: #e3e7eb; --soft: #9aa5b1; --line: #3a434e; --paper: #262d36; --ground: #1b2027;
          --bar: #4fa3dd; --false: #ff6b81; --warn: #e0a030; --warn-ground: #3a3020;
          --good: #46b873; --good-ground: #20352a; }
  svg text { fill: #9aa5b1; } svg .grid { stroke: #3a434e; }
  svg .estimate { stroke: #f08c46; } svg .truth { stroke: #b9c3cd; }
  svg .before { stroke: #b493dd; } svg .after, svg .value { stroke: #4fa3dd; }
  svg .loop { stroke: #ff6b81; } svg .lost { fill: #5a2f36; }
}
@media print {
  body { background: #fff; font-size: 12px; }
  main { max-width: none; padding: 0; }
  section { break-inside: avoid; flex-basis: 45%; }
  img, td.bar i, ul.findings li { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
</style>
</head>
<body>
<main>
<h1>{{title}}</h1>
<p class="sub">{{subtitle}}</p>
<div class="figures">
{{figures}}</div>
<div class="columns">
<section class="wide"><h2>Findings</h2>
<ul class="findings">
{{findings}}</ul></section>
{{sections}}</div>
</main>
</body>
</html>
)html";

}  // namespace rgbd_graphslam
