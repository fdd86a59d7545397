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
:root { --ink: #22282e; --soft: #68727c; --line: #d9dee3; --paper: #fff; --ground: #f3f5f7;
        --bar: #1f77b4; --false: #c81e3c; }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink);
       font: 15px/1.45 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
main { max-width: 1120px; margin: 0 auto; padding: 24px 16px 40px; }
h1 { font-size: 24px; margin: 0; overflow-wrap: anywhere; }
h2 { font-size: 16px; margin: 0 0 10px; }
.sub { color: var(--soft); margin: 2px 0 18px; overflow-wrap: anywhere; }
section { background: var(--paper); border: 1px solid var(--line); border-radius: 8px;
          padding: 14px 16px; margin-bottom: 16px; min-width: 0; }
section.wide { grid-column: 1 / -1; }
section:not(.wide):nth-child(odd):nth-last-child(2) { grid-column: 1 / -1; }
.columns { display: grid; grid-template-columns: repeat(auto-fit, minmax(430px, 1fr)); gap: 0 16px; }
.figures { display: flex; flex-wrap: wrap; gap: 6px 34px; margin-bottom: 16px; }
.figures div { min-width: 90px; }
.figures b { display: block; font-size: 22px; font-weight: 600; }
.figures span, figcaption, .note { color: var(--soft); font-size: 13px; }
ul.findings { list-style: none; margin: 0; padding: 0; }
ul.findings li { padding: 5px 10px; margin: 4px 0; border-left: 4px solid var(--line);
                 background: var(--ground); overflow-wrap: anywhere; }
ul.findings li.warning { border-color: #d98a00; background: #fff6e2; }
ul.findings li.good { border-color: #2d9a57; background: #eaf7ef; }
img { max-width: 100%; height: auto; display: block; }
figure { margin: 0 0 10px; }
.note { margin: 8px 0 10px; }
.grid-picture img { image-rendering: pixelated; width: 100%; max-height: 520px; object-fit: contain; }
svg { width: 100%; height: auto; display: block; }
{{chart_style}}table { border-collapse: collapse; width: 100%; font-size: 13px; font-variant-numeric: tabular-nums; }
th { text-align: right; color: var(--soft); font-weight: normal; }
td { text-align: right; padding: 2px 0 2px 10px; }
th:first-child, td:first-child { text-align: left; padding-left: 0; white-space: nowrap; }
tr.false td { color: var(--false); font-weight: 600; }
td.bar { width: 34%; }
td.bar i { display: block; height: 11px; background: var(--bar); border-radius: 2px; min-width: 1px; }
</style>
</head>
<body>
<main>
<h1>{{title}}</h1>
<p class="sub">{{subtitle}}</p>
<div class="figures">
{{figures}}</div>
<section><h2>What to know</h2>
<ul class="findings">
{{findings}}</ul></section>
<div class="columns">
{{sections}}</div>
</main>
</body>
</html>
)html";

}  // namespace rgbd_graphslam
