#pragma once
#include <string_view>

namespace sprung {

/// The style sheet of the report's page: black on white, system fonts, sections kept together on paper.
inline constexpr std::string_view kReportStyle = R"css(
:root { color-scheme: light; --ink: #1b1b1b; --soft: #5c5c5c; --rule: #dcdcdc; --good: #00694d; --bad: #b3261e; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 40px 28px 80px; max-width: 1040px; background: #fff; color: var(--ink);
  font: 16px/1.5 Inter, "Segoe UI", "Helvetica Neue", Arial, "DejaVu Sans", sans-serif; }
h1 { margin: 0; font-size: 30px; line-height: 1.2; letter-spacing: -0.01em; }
h2 { margin: 0 0 6px; font-size: 21px; line-height: 1.3; }
p { margin: 0 0 12px; max-width: 76ch; }
.made { margin: 6px 0 22px; color: var(--soft); }
.tally { display: flex; gap: 40px; margin: 0 0 22px; padding: 16px 0; border: solid var(--rule); border-width: 1px 0; }
.tally b { display: block; font-size: 30px; line-height: 1.15; font-variant-numeric: tabular-nums; }
.tally span { color: var(--soft); font-size: 14px; }
.good { color: var(--good); } .bad { color: var(--bad); }
nav { margin: 0 0 26px; columns: 2; column-gap: 40px; font-size: 15px; }
nav a { display: flex; justify-content: space-between; gap: 12px; padding: 3px 0; color: var(--ink);
  text-decoration: none; border-bottom: 1px solid #efefef; break-inside: avoid; }
nav a > :last-child { white-space: nowrap; }
nav a:hover { text-decoration: underline; }
section { margin: 44px 0 0; padding: 22px 0 0; border-top: 2px solid var(--ink); }
table { width: 100%; margin: 14px 0 8px; border-collapse: collapse; font-size: 14px; line-height: 1.35;
  font-variant-numeric: tabular-nums; }
th { padding: 4px 16px 6px 0; text-align: left; font-weight: 600; color: var(--soft);
  border-bottom: 1px solid var(--ink); white-space: nowrap; vertical-align: bottom; }
td { padding: 4px 16px 4px 0; border-bottom: 1px solid #ececec; vertical-align: top; }
th.n, td.n { text-align: right; white-space: nowrap; }
td.v { white-space: nowrap; font-weight: 600; }
tr.info td { color: var(--soft); } tr.info td.v { font-weight: 400; }
tr.fail td { background: #fdf0ef; }
.matrix { width: auto; } .matrix td { border-bottom: 0; padding: 2px 22px 2px 0; }
.matrix tr.first td { border-top: 1px solid #e2e2e2; } .matrix tbody tr:first-child td { border-top: 0; }
.matrix tr.of td { padding: 12px 0 4px; color: var(--soft); border-bottom: 1px solid #ececec; }
.matrix tr.of b { color: var(--ink); } td.info { color: var(--soft); }
td.n.good, td.n.bad { font-weight: 600; }
.key { margin: 4px 0 0; color: var(--soft); font-size: 13px; }
details { margin: 10px 0 0; } summary { cursor: pointer; color: var(--soft); font-size: 14px; }
summary:hover { color: var(--ink); }
.sources { margin: 0 0 16px; padding: 0; list-style: none; color: var(--soft); font-size: 13px; }
figure { margin: 20px 0 0; break-inside: avoid; }
figure svg { display: block; width: 100%; height: auto; }
figure img { display: block; max-width: 100%; height: auto; }
figcaption { margin: 6px 0 0; color: var(--soft); font-size: 14px; max-width: 76ch; }
.pictures { display: flex; flex-wrap: wrap; gap: 20px; } .pictures figure { width: calc(50% - 10px); }
.bar { display: flex; align-items: center; gap: 8px; margin: 8px 0 0; font-size: 13px; color: var(--soft);
  font-variant-numeric: tabular-nums; }
.bar i { width: 140px; height: 10px; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
@media (max-width: 700px) { nav { columns: 1; } .pictures figure { width: 100%; } .table { overflow-x: auto; } }
@media print {
  @page { size: A4; margin: 14mm; }
  body { padding: 0; max-width: none; font-size: 10.5pt; }
  section { margin-top: 22px; }
  h2, .what { break-after: avoid; }
  thead { display: table-header-group; } tr { break-inside: avoid; }
  table { font-size: 8.5pt; } td, th { padding-right: 6px; }
}
)css";

}  // namespace sprung
