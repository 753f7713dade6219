// Hovering, focusing or clicking a point shows what is known of it; a click holds it until the next or Escape.
"use strict";
const panel = document.getElementById("chosen");
const content = panel.querySelector(".content");
const nothing = content.innerHTML;
let held = false;

function show(button) {
  const text = document.getElementById("point-" + button.dataset.point);
  content.replaceChildren(text.content.cloneNode(true));
  panel.classList.add("shown");
  document.body.classList.add("choosing");
  for (const other of document.querySelectorAll(".point"))
    other.classList.toggle("chosen", other.dataset.point === button.dataset.point);
}

function close() {
  held = false;
  content.innerHTML = nothing;
  panel.classList.remove("shown");
  document.body.classList.remove("choosing");
  for (const other of document.querySelectorAll(".chosen")) other.classList.remove("chosen");
}

for (const drawing of document.querySelectorAll(".drawing")) {
  const points = [...drawing.querySelectorAll(".point")];
  points.forEach((point, k) => {
    point.addEventListener("pointerenter", () => { if (!held) show(point); });
    point.addEventListener("focus", () => {
      for (const other of points) other.tabIndex = other === point ? 0 : -1;
      show(point);
    });
    point.addEventListener("click", () => { show(point); held = true; });
    point.addEventListener("keydown", event => {
      const last = points.length - 1;
      const next = { ArrowRight: Math.min(k + 1, last), ArrowDown: Math.min(k + 1, last), ArrowLeft: Math.max(k - 1, 0),
                     ArrowUp: Math.max(k - 1, 0), Home: 0, End: last }[event.key];
      if (next === undefined) return;
      event.preventDefault();
      points[next].focus();
    });
  });
}
panel.querySelector(".close").addEventListener("click", close);
document.addEventListener("keydown", event => { if (event.key === "Escape") close(); });
