#include "runtime/graph/page_parts.hpp"

namespace tamp::runtime
{

const char* const graph_page_style = R"css(
:root { color-scheme: light dark; --paper: #ffffff; --ink: #1c1d1f; --faint: #5a5e66; --rule: #e2e5ea; --box: #edf1f6;
  --declared: #0b4fae; --message: #b84a00; --critical: #a3123f; }
@media (prefers-color-scheme: dark) { :root { --paper: #15171a; --ink: #e4e5e7; --faint: #a5aab3; --rule: #2c3037;
  --box: #20252c; --declared: #5aa0ff; --message: #ff9440; --critical: #ff6f91; } }
body { margin: 0; padding: 1.2rem 1rem 3rem; font: 15px/1.5 system-ui, sans-serif; color: var(--ink);
  background: var(--paper); overflow-wrap: anywhere; }
h1 { font-size: 1.4rem; line-height: 1.25; margin: 0 0 0.3rem; }
h2 { font-size: 1.1rem; line-height: 1.3; margin: 0 0 0.2rem; }
h3 { font-size: 0.87rem; margin: 1rem 0 0.2rem; border-top: 1px solid var(--rule); padding-top: 0.4rem; }
p { margin: 0.2rem 0 0.5rem; }
a { color: var(--declared); }
.faint { color: var(--faint); }
.search { display: flex; gap: 0.8rem; align-items: baseline; flex-wrap: wrap; margin: 0.6rem 0; }
input { font: inherit; color: inherit; background: var(--paper); border: 1px solid var(--faint); border-radius: 4px;
  padding: 0.2rem 0.5rem; width: 18rem; max-width: 100%; box-sizing: border-box; }
main { display: grid; grid-template-columns: minmax(0, 1fr) 27rem; gap: 1.5rem; align-items: start; }
.drawing { overflow-x: auto; }
.drawing svg { display: block; margin: 0 auto; width: 100%; height: auto; }
aside { position: sticky; top: 1rem; max-height: calc(100vh - 2rem); overflow-y: auto; box-sizing: border-box;
  border: 1px solid var(--rule); border-top: 2px solid var(--ink); padding: 0.7rem 1rem 1rem; font-size: 0.9rem; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 0.1rem 0.9rem; margin: 0.4rem 0; }
dt { color: var(--faint); }
dd { margin: 0; min-width: 0; }
ul { margin: 0.2rem 0; padding-left: 1.1rem; }
.close { float: right; border: 0; background: none; color: inherit; font-size: 1.1rem; cursor: pointer; }
.slice { display: grid; gap: 2px; width: max-content; margin: 0.4rem 0; }
.grid { overflow-x: auto; }
.place { font: 11px/1 ui-monospace, Menlo, Consolas, monospace; min-width: 1.7rem; height: 1.35rem; padding: 0 0.2rem;
  border: 1px solid var(--faint); border-radius: 3px; color: var(--ink); background: var(--paper); cursor: pointer; }
.many .place { min-width: 0; width: 0.95rem; height: 0.95rem; padding: 0; }
.place.odd { background: var(--box); }
.place:disabled { opacity: 0.35; cursor: default; }
.place.near { border: 2px solid var(--declared); }
.place.chosen { background: var(--declared); color: var(--paper); border-color: var(--declared); }
.task-graph .task { cursor: pointer; }
.task-graph .task.measured rect { fill: color-mix(in srgb, var(--declared) var(--heat), var(--box)); }
.task-graph .task.measured .small { fill: var(--ink); }
.task-graph .task.critical rect { stroke: var(--critical); stroke-width: 3; stroke-dasharray: none; }
.task-graph .edge.critical .line { stroke: var(--critical); stroke-width: 2.6; }
.task-graph .edge.critical .head { fill: var(--critical); }
.task-graph .dim { opacity: 0.16; }
.task-graph .lit rect { stroke-width: 2.6; }
.task-graph .edge.lit .line { stroke: var(--declared); stroke-width: 2; }
.task-graph .edge.lit .head { fill: var(--declared); }
.task-graph .edge.message.lit .line { stroke: var(--message); }
.task-graph .edge.message.lit .head { fill: var(--message); }
:focus-visible { outline: 3px solid var(--declared); outline-offset: 1px; }
@media (max-width: 60rem) {
  main { grid-template-columns: minmax(0, 1fr); }
  aside { position: fixed; left: 0; right: 0; bottom: 0; top: auto; max-height: 46vh; background: var(--paper); }
  aside.resting { display: none; }
  body { padding-bottom: 48vh; }
}
@media print {
  :root { color-scheme: light; --paper: #ffffff; --ink: #1c1d1f; --faint: #5a5e66; --rule: #e2e5ea; --box: #edf1f6;
    --declared: #0b4fae; --message: #b84a00; }
  body { padding: 0; }
  .search, aside { display: none; }
  main { display: block; }
  .drawing svg { min-width: 0 !important; max-height: 24cm; }
}
)css";

const char* const graph_page_script = R"js("use strict";
const parsed = id => JSON.parse(document.getElementById(id).textContent);
const {tasks, edges} = parsed("folded");
const panel = document.querySelector("aside");
const nothing = panel.innerHTML;
const drawn = {task: [], edge: []};
for (const g of document.querySelectorAll(".task")) drawn.task[g.dataset.task] = g;
for (const g of document.querySelectorAll(".edge")) drawn.edge[g.dataset.edge] = g;
let held = false;

// Makes an element; texts and elements become its children.
function make(name, attributes, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

function bytesText(n) {
  const units = ["B", "kB", "MB", "GB"];
  let k = 0;
  while (n >= 1000 && k < 3) { n /= 1000; ++k; }
  return `${Number(n.toPrecision(3))} ${units[k]}`;
}

const haloText = halo => halo > 0 ? `, halo ${halo}` : "";
const linkTo = (hash, text) => make("a", {href: "#" + hash}, text);
const list = items => items.length ? make("ul", {}, ...items.map(item => make("li", {}, ...item)))
                                   : make("p", {class: "faint"}, "none");

// The instances, read when they are first asked for: columns, and the edges of each in both directions.
let all = null;
function instances() {
  if (all) return all;
  all = parsed("instances");
  const n = all.task.length;
  all.before = Array.from({length: n}, () => []);
  all.after = Array.from({length: n}, () => []);
  all.edge_to.forEach((to, e) => {
    const from = to - all.edge_back[e], why = all.reasons[all.edge_reason[e]];
    all.before[to].push([from, why]);
    all.after[from].push([to, why]);
  });
  all.of_task = tasks.map(() => []);
  all.task.forEach((task, i) => all.of_task[task].push(i));
  return all;
}

function instanceText(i) {
  const at = instances(), patch = at.patch[i] < 0 ? `rank ${at.rank[i]}` : `patch ${at.patch[i]}`;
  return patch + (at.group[i] < 0 ? "" : `, ${at.groups[at.group[i]]}`);
}

// A button for each patch, as the patches lie, or for each rank where a task belongs to none.
function map(ids, chosen, near) {
  const at = instances(), [nx, ny, nz] = at.n_patches;
  const button = (i, text, odd) => {
    const b = make("button", {class: "place" + (odd ? " odd" : ""), type: "button"}, text);
    if (i === undefined) { b.disabled = true; return b; }
    b.setAttribute("aria-label", instanceText(i));
    b.title = `${instanceText(i)}, rank ${at.rank[i]}`;
    b.classList.toggle("chosen", i === chosen);
    b.classList.toggle("near", near.has(at.patch[i]));
    b.onclick = () => { location.hash = "i" + i; };
    return b;
  };
  if (at.patch[ids[0]] < 0) return make("p", {}, ...ids.map(i => button(i, `rank ${at.rank[i]}`, at.rank[i] % 2)));
  const of_patch = new Map(ids.map(i => [at.patch[i], i]));
  const slices = [];
  for (let z = 0; z < nz; ++z) {
    const slice = make("div", {class: nx > 11 ? "slice many" : "slice", style: `grid-template-columns: repeat(${nx}, auto)`});
    for (let y = ny - 1; y >= 0; --y)
      for (let x = 0; x < nx; ++x) {
        const patch = x + nx * (y + ny * z);
        slice.append(button(of_patch.get(patch), nx > 11 ? "" : String(patch), at.rank_of_patch[patch] % 2));
      }
    slices.push(slice);
  }
  return make("div", {class: "grid"}, ...slices);
}

// The instances of a task on the map, a map for each group.
function maps(task, chosen, near) {
  const at = instances(), groups = new Map();
  for (const i of at.of_task[task]) groups.set(at.group[i], [...(groups.get(at.group[i]) || []), i]);
  return [...groups].flatMap(([group, ids]) =>
    [...(group < 0 ? [] : [make("p", {class: "faint"}, at.groups[group])]), map(ids, chosen, near)]);
}

function usesOf(task) {
  const uses = make("dl", {});
  for (const mode of ["reads", "computes", "updates", "accumulates", "reduces"]) {
    if (!task[mode].length) continue;
    const said = task[mode].map(use => [use.label + haloText(use.halo) + (use.step === "previous" ? " (previous step)" : ""),
                                        ...(use.centring ? [" ", make("span", {class: "faint"}, use.centring)] : [])]);
    uses.append(make("dt", {}, mode), make("dd", {}, ...said.flatMap((item, k) => k ? [make("br", {}), ...item] : item)));
  }
  return uses;
}

const labelTexts = edge => edge.labels.map(l => `${l.label}${haloText(l.halo)}: ${l.edges} ${l.edges > 1 ? "edges" : "edge"}` +
  (l.bytes ? `, ${bytesText(l.bytes)}` : "") + (l.crossing ? `, ${l.crossing} from rank to rank` : ""));

// The edges whose end `near` is task t, each with a link to the task at its end `far`.
function foldedEdges(near, t, far) {
  return list(edges.filter(edge => edge[near] === t).map(edge =>
    [linkTo("t" + edge[far], tasks[edge[far]].name), make("br", {}),
     make("span", {class: "faint"}, labelTexts(edge).join("; "))]));
}

// The measured time of a task, if the page has it.
const secondsText = s => s >= 0.1 ? `${Number(s.toPrecision(3))} s` : s >= 1e-4 ? `${Number((s * 1e3).toPrecision(3))} ms`
                                                                              : `${Number((s * 1e6).toPrecision(3))} µs`;
const percentText = share => `${(100 * share).toFixed(1)} %`;
function measuredOf(task) {
  const m = task.measured;
  if (!m) return [];
  const rows = [["ran", `${m.count} times`], ["mean", secondsText(m.mean_s)], ["95 % below", secondsText(m.p95_s)],
    ["share", percentText(m.share)], ["imbalance", Number(m.imbalance.toPrecision(3)).toString()],
    ["in longest chain", secondsText(m.chain_s)], ["critical path", `in ${percentText(m.on_chain || 0)} of steps`]];
  if (m.step_gain_if_free !== undefined) {
    rows.push(["gain at -10 %", `${percentText(m.step_gain_if_a_tenth_faster)} of a step`],
              ["gain if free", `${percentText(m.step_gain_if_free)} of a step`]);
  }
  return [make("h3", {}, "Measured"), make("dl", {}, ...rows.flatMap(([name, text]) => [make("dt", {}, name), make("dd", {}, text)]))];
}

function taskView(t, opened) {
  const task = tasks[t];
  const about = `${task.kind}, ${task.instances} ${task.instances > 1 ? "instances" : "instance"}` +
    (task.materials.length ? ` for ${task.materials.join(", ")}` : "");
  return [make("h2", {}, task.name), make("p", {class: "faint"}, about), usesOf(task), ...measuredOf(task),
          ...(opened ? [make("h3", {}, "Instances"), ...maps(t, -1, new Set())] : []),
          make("h3", {}, "Waits for"), foldedEdges("to", t, "from"),
          make("h3", {}, "Is waited for by"), foldedEdges("from", t, "to")];
}

function edgeView(e) {
  const {from, to} = edges[e];
  return [make("h2", {}, linkTo("t" + from, tasks[from].name), " → ", linkTo("t" + to, tasks[to].name)),
          list(labelTexts(edges[e]).map(text => [text]))];
}

function reasonText([label, halo, bytes, message]) {
  return instances().labels[label] + haloText(halo) + (bytes ? `, ${bytesText(bytes)}` : "") + (message ? ", message" : "");
}

function instanceEdges(found) {
  const at = instances(), reasons = new Map();
  for (const [other, why] of found) reasons.set(other, [...(reasons.get(other) || []), reasonText(why)]);
  return list([...reasons].sort((a, b) => a[0] - b[0]).map(([other, texts]) =>
    [linkTo("i" + other, `${tasks[at.task[other]].name}, ${instanceText(other)}`), make("br", {}),
     make("span", {class: "faint"}, texts.join("; "))]));
}

function instanceView(i) {
  const at = instances(), t = at.task[i];
  const near = new Set([...at.before[i], ...at.after[i]].map(([other]) => at.patch[other]).filter(patch => patch >= 0));
  return [make("h2", {}, linkTo("t" + t, tasks[t].name)), make("p", {}, `${instanceText(i)}, on rank ${at.rank[i]}`),
          make("h3", {}, "Waits for"), instanceEdges(at.before[i]),
          make("h3", {}, "Is waited for by"), instanceEdges(at.after[i]),
          make("h3", {}, "All instances"), ...maps(t, i, near)];
}

function light(lit_tasks, lit_edges, any) {
  const mark = (g, lit) => { g.classList.toggle("lit", any && lit); g.classList.toggle("dim", any && !lit); };
  drawn.task.forEach((g, t) => mark(g, lit_tasks.has(t)));
  drawn.edge.forEach((g, e) => mark(g, lit_edges.has(e)));
}

function lightTask(t) {
  const lit_tasks = new Set([t]), lit_edges = new Set();
  edges.forEach((edge, e) => {
    if (edge.from !== t && edge.to !== t) return;
    lit_edges.add(e);
    lit_tasks.add(edge.from).add(edge.to);
  });
  light(lit_tasks, lit_edges, true);
}

const lightEdge = e => light(new Set([edges[e].from, edges[e].to]), new Set([e]), true);

function show(content) {
  const close = make("button", {class: "close", type: "button", "aria-label": "close"}, "×");
  close.onclick = () => { location.hash = ""; };
  panel.replaceChildren(...(held ? [close] : []), ...content);
  panel.classList.remove("resting");
}

// Nothing is pointed at or held.
function rest() {
  if (held) return;
  panel.innerHTML = nothing;
  panel.classList.add("resting");
  search();
}

// Holds what the address names: #t3 a task, #e5 an edge, #i27 an instance.
function follow() {
  const [, kind, digits] = /^#([tei])(\d+)$/.exec(location.hash) || [], n = Number(digits);
  const count = {t: () => tasks.length, e: () => edges.length, i: () => instances().task.length}[kind];
  held = count !== undefined && n < count();
  if (!held) { rest(); return; }
  if (kind === "t") { lightTask(n); show(taskView(n, true)); }
  if (kind === "e") { lightEdge(n); show(edgeView(n)); }
  if (kind === "i") { lightTask(instances().task[n]); show(instanceView(n)); }
  panel.scrollTop = 0;
}

// Lights the tasks that have or use what is looked for, and the edges that are for it.
const field = document.querySelector("input");
const hits = document.querySelector(".hits");
function search() {
  const wanted = field.value.trim().toLowerCase(), has = text => text.toLowerCase().includes(wanted);
  const words = task => [task.name, ...["reads", "computes", "updates", "accumulates", "reduces"].flatMap(mode =>
    task[mode].map(use => use.label))];
  const found = new Set(tasks.flatMap((task, t) => words(task).some(has) ? [t] : []));
  const lines = new Set(edges.flatMap((edge, e) => edge.labels.some(l => has(l.label)) ? [e] : []));
  const counted = (n, one) => `${n} ${one}${n === 1 ? "" : "s"}`;
  hits.textContent = wanted ? `${counted(found.size, "task")}, ${counted(lines.size, "edge")}` : "";
  light(found, lines, wanted !== "");
}

// A mouse that points at something, a click or Enter that holds it.
function listen(g, hash, point) {
  g.addEventListener("pointerenter", () => { if (!held) point(); });
  g.addEventListener("pointerleave", rest);
  g.addEventListener("click", () => { location.hash = hash; });
  g.addEventListener("keydown", event => { if (event.key === "Enter") location.hash = hash; });
}
drawn.edge.forEach((g, e) => listen(g, "e" + e, () => { lightEdge(e); show(edgeView(e)); }));
drawn.task.forEach((g, t) => {
  g.setAttribute("tabindex", "0");
  g.setAttribute("role", "button");
  listen(g, "t" + t, () => { lightTask(t); show(taskView(t, false)); });
});
field.addEventListener("input", () => { location.hash = ""; search(); });
document.addEventListener("keydown", event => { if (event.key === "Escape") location.hash = ""; });
window.addEventListener("hashchange", follow);

// Tasks darker by their share of the time; the longest chain.
const most = Math.max(...tasks.map(task => task.measured ? task.measured.share : 0));
drawn.task.forEach((g, t) => {
  const m = tasks[t].measured;
  if (!m) return;
  g.classList.add("measured");
  g.style.setProperty("--heat", `${(45 * m.share / most).toFixed(1)}%`);
  if (m.chain_s > 0) g.classList.add("critical");
});
drawn.edge.forEach((g, e) => { if (edges[e].critical) g.classList.add("critical"); });

// The drawing shrinks to fit, as far as it can still be read; beyond that it is scrolled, from its middle.
const drawing = document.querySelector(".drawing"), svg = drawing.firstElementChild;
const natural = svg.viewBox.baseVal.width;
svg.style.maxWidth = `${natural}px`;
svg.style.minWidth = `${0.7 * natural}px`;
drawing.scrollLeft = (drawing.scrollWidth - drawing.clientWidth) / 2;
follow();
)js";

}  // namespace tamp::runtime
