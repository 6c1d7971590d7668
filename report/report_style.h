// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

namespace groundglass {

// The report's look: a printed page on screen, and on paper.
constexpr char kReportStyle[] = R"(
:root { --ink: #23211f; --soft: #6c6761; --line: #dcd7cf; --paper: #fdfcfa; --wash: #f4f1ec;
  --good: #2f6b4f; --look: #9a6a14; --bad: #9b3429; --bar: #7f95a8; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 3.5rem 2rem 5rem; max-width: 70rem; color: var(--ink);
  background: var(--paper); font: 1rem/1.55 "Source Serif 4", "Iowan Old Style", Charter, Georgia,
  "DejaVu Serif", serif; }
h1 { font-size: 2.3rem; line-height: 1.15; font-weight: 600; margin: 0 0 .4rem; }
h2 { font-size: 1.45rem; font-weight: 600; margin: 3.2rem 0 .6rem; padding-top: 1rem;
  border-top: 1px solid var(--line); }
h3 { font-size: 1.15rem; font-weight: 600; margin: 0; }
p { max-width: 44rem; margin: .5rem 0 1rem; }
a { color: inherit; text-decoration-color: var(--bar); text-underline-offset: .15em; }
.lead { font-size: 1.15rem; color: var(--soft); }
.facts { display: flex; flex-wrap: wrap; gap: .5rem 3rem; margin: 2rem 0 0; padding: 0; }
.facts div { min-width: 7rem; }
.facts b { display: block; font-size: 2rem; font-weight: 600; line-height: 1.2; }
.facts span { color: var(--soft); font-size: .92rem; }
table { border-collapse: collapse; width: 100%; font-size: .93rem; margin: .8rem 0; }
th { text-align: left; font-weight: 600; color: var(--soft); font-size: .85rem;
  border-bottom: 1.5px solid var(--ink); padding: .3rem .9rem .3rem 0; vertical-align: bottom; }
td { border-bottom: 1px solid var(--line); padding: .34rem .9rem .34rem 0; vertical-align: top; }
.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
th.n { white-space: normal; }
.verdict { font-weight: 600; white-space: nowrap; }
.verdict::before { content: ""; display: inline-block; width: .6em; height: .6em;
  border-radius: 50%; margin-right: .45em; background: currentColor; }
.accepted { color: var(--good); } .review { color: var(--look); } .rejected { color: var(--bad); }
.unreadable { color: var(--bad); }
.soft { color: var(--soft); }
figure { margin: 0; }
figure img { display: block; width: 100%; height: auto; background: var(--wash); }
figcaption { font-size: .88rem; color: var(--soft); padding: .35rem 0 0; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(19rem, 1fr)); gap: 1rem;
  margin: .9rem 0; }
.photograph { margin: 2.6rem 0 0; break-inside: avoid; }
.photograph header { display: flex; gap: 1rem; align-items: baseline; flex-wrap: wrap; }
.photograph ul { margin: .3rem 0; padding-left: 1.2rem; }
.bar { display: inline-block; width: 7rem; height: .6em; background: var(--wash);
  border: 1px solid var(--line); }
.bar i { display: block; height: 100%; background: var(--bar); }
.missing td { background: var(--wash); }
summary { cursor: pointer; color: var(--soft); margin: 1rem 0 0; }
footer { margin-top: 4rem; padding-top: 1rem; border-top: 1px solid var(--line);
  font-size: .88rem; color: var(--soft); }
@media print { body { padding: 0; max-width: none; font-size: 10pt; } h2 { break-after: avoid; } }
)";

}  // namespace groundglass
