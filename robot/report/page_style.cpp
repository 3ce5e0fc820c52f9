#include "robot/report/report_page.h"

namespace prohull::robot {

// Blue and orange are told apart by everyone; good and bad have a symbol and words besides their colours.
std::string_view page_style() {
  return R"css(
:root {
  --page: #f4f6f8; --card: #ffffff; --ink: #18212c; --muted: #566273; --line: #dce2e9; --stage: #f8fafb;
  --link: #1a5da6; --good: #0a6b4f; --good-soft: #e5f4ee; --bad: #ad2318; --bad-soft: #fdecea;
  --look: #8a4b00; --look-soft: #fff3e0;
  color-scheme: light dark;
}
@media screen and (prefers-color-scheme: dark) {
  :root {
    --page: #10151b; --card: #19212a; --ink: #e8edf3; --muted: #a2afbd; --line: #2f3a47; --stage: #222c37;
    --link: #86bdf5; --good: #6fd3ae; --good-soft: #15322a; --bad: #ff9b90; --bad-soft: #3d1d1b;
    --look: #ffc277; --look-soft: #38290f;
  }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--ink); overflow-wrap: break-word;
  font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", "DejaVu Sans", sans-serif; }
main { max-width: 1120px; margin: 0 auto; padding: 2rem 1.25rem 3rem; }
h1 { font-size: 2.1rem; line-height: 1.15; margin: .1rem 0 .3rem; letter-spacing: -.01em; }
h2 { font-size: 1.35rem; margin: 2.6rem 0 .8rem; }
h3 { font-size: 1.15rem; margin: 0; }
h1, h3, li span { overflow-wrap: anywhere; }
li > b { white-space: nowrap; }
p { margin: .4rem 0; }
a { color: var(--link); text-underline-offset: .15em; }
.eyebrow { color: var(--muted); font-size: .82rem; font-weight: 600; letter-spacing: .07em; text-transform: uppercase; }
.muted, figcaption, caption { color: var(--muted); }
.small { font-size: .9rem; }
.findings, .marks { list-style: none; margin: 1.1rem 0 0; padding: 0; display: grid; gap: .5rem; }
.findings li, .marks li { display: flex; gap: .7rem; padding: .65rem .9rem; border-radius: 8px; }
.findings li { font-size: 1.06rem; font-weight: 600; }
.marks li { padding: .5rem .9rem; }
li.good { background: var(--good-soft); } li.bad { background: var(--bad-soft); } li.look { background: var(--look-soft); }
li.good > b, td.good, .badge.good { color: var(--good); }
li.bad > b, td.bad, .badge.bad { color: var(--bad); }
li.look > b, td.look, .badge.look { color: var(--look); }
td.good, td.bad, td.look { font-weight: 600; }
.card { background: var(--card); border: 1px solid var(--line); border-radius: 12px; padding: 1.2rem 1.3rem; }
.card + .card { margin-top: 1.1rem; }
.overview { display: grid; grid-template-columns: minmax(0, 3fr) minmax(0, 2fr); gap: 1.1rem; margin-top: 1.4rem; }
.overview.plain { grid-template-columns: minmax(0, 1fr); }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); gap: 1.1rem; }
.tiles:has(> :nth-child(-n + 3):last-child) { grid-template-columns: 1fr; }
.tile { display: flex; flex-direction: column; justify-content: center; padding: .9rem 1.1rem; margin: 0; }
.tile + .tile { margin-top: 0; }
.tile b { font-size: 1.7rem; line-height: 1.2; letter-spacing: -.01em; font-variant-numeric: tabular-nums; }
.tile span { color: var(--muted); font-size: .88rem; line-height: 1.35; }
figure { margin: 0; }
figure img { display: block; width: 100%; height: auto; background: var(--stage); border-radius: 8px; }
figcaption { font-size: .9rem; margin-top: .45rem; }
.pictures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 260px), 1fr)); gap: 1rem; margin: 1rem 0; }
.pictures figure { max-width: 560px; }
.legend { display: flex; flex-wrap: wrap; gap: .2rem 1.1rem; }
.chip { white-space: nowrap; }
.chip::before { content: ""; display: inline-block; width: .8em; height: .8em; border-radius: 3px; margin-right: .4em;
  vertical-align: -.05em; background: var(--chip); border: 1px solid #0003; }
.title { display: flex; flex-wrap: wrap; align-items: baseline; gap: .3rem .8rem; cursor: pointer; }
.title::before { content: "▸"; color: var(--muted); }
[open] > .title::before { content: "▾"; }
[id^="link-"] { scroll-margin-top: 4rem; }
code { font-size: .9em; }
.badge { font-size: .9rem; font-weight: 600; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: .93rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; padding-bottom: .4rem; }
th, td { text-align: right; padding: .42rem .5rem; border-bottom: 1px solid var(--line); vertical-align: top; }
td { white-space: nowrap; }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
th:last-child, td:last-child { padding-right: 0; }
thead th { color: var(--muted); font-weight: 600; font-size: .86rem; vertical-align: bottom; }
tbody th { font-weight: 500; }
tbody tr:last-child > * { border-bottom: 0; }
.facts { margin-top: .6rem; }
.facts table { max-width: 46rem; }
.notes { margin: .7rem 0 0; padding-left: 1.15rem; font-size: .93rem; }
.notes li { margin: .15rem 0; }
h4 { margin: 1rem 0 0; font-size: .95rem; }
dl.words { display: grid; grid-template-columns: minmax(8rem, auto) 1fr; gap: .45rem 1.2rem; margin: 0; font-size: .95rem; }
dl.words dt { font-weight: 600; } dl.words dd { margin: 0; }
footer { margin-top: 2.2rem; color: var(--muted); font-size: .88rem; }
@media screen and (min-width: 761px) {
  .body.one { display: grid; grid-template-columns: minmax(0, 1fr) minmax(0, 1fr); gap: 1.4rem; align-items: start; }
}
@media (max-width: 760px) {
  main { padding: 1.2rem .8rem 2rem; }
  h1 { font-size: 1.6rem; }
  .overview { grid-template-columns: minmax(0, 1fr); }
  .tiles { grid-template-columns: repeat(2, minmax(0, 1fr)); gap: .7rem; }
  .tile b { font-size: 1.3rem; }
  .card { padding: .9rem .9rem; }
  dl.words { grid-template-columns: 1fr; gap: 0; } dl.words dd { margin-bottom: .6rem; }
}
@page { size: A4; margin: 14mm 13mm; }
@media print {
  :root { --page: #fff; --stage: #fff; }
  body { font-size: 10pt; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  main { max-width: none; padding: 0; }
  a { color: inherit; text-decoration: none; }
  h2, h3, .title { break-after: avoid; }
  .title::before { content: none; }
  details::details-content { content-visibility: visible; display: block; }
  .card, figure, tr, .findings li, .marks li, dl.words > * { break-inside: avoid; }
  .card { padding: .8rem .9rem; }
  .wide { overflow: visible; }
  .body { display: grid; grid-template-columns: auto minmax(0, 1fr); column-gap: 6mm; align-items: start; }
  .pictures { grid-template-columns: 38mm 38mm; gap: 2mm; margin: 2mm 0; }
  .body.one .pictures { grid-template-columns: 60mm; }
  .facts table { max-width: none; }
  .notes { font-size: 8.5pt; margin-top: 0; }
  h4 { margin-top: 1mm; }
  .overview { grid-template-columns: 3fr 2fr; }
  .tiles { grid-template-columns: repeat(2, 1fr); }
  .overview .tiles { grid-template-columns: 1fr; }
  table { font-size: 8.5pt; }
  th, td { padding: .3rem .35rem; }
}
)css";
}

}  // namespace prohull::robot
