// The report's page: wipes, and which photographs are shown. SPDX-License-Identifier: Apache-2.0
"use strict";
for (const wipe of document.querySelectorAll(".wipe")) {
  const slider = wipe.querySelector("input");
  const move = () => wipe.style.setProperty("--at", slider.value + "%");
  slider.addEventListener("input", move);
  // Wherever it is touched or clicked, and not on its handle only.
  const follow = (event) => {
    if (event.type === "pointermove" && event.buttons === 0) return;
    const box = slider.getBoundingClientRect();
    slider.value = 100 * (event.clientX - box.left) / box.width;
    move();
  };
  slider.addEventListener("pointerdown", follow);
  slider.addEventListener("pointermove", follow);
  wipe.querySelector("select").addEventListener("change", (event) => {
    wipe.dataset.shows = event.target.value;
  });
  move();
}

const filter = document.querySelector(".filter");
if (filter) {
  const show = document.getElementById("show");
  const named = document.getElementById("named");
  const shown = document.getElementById("shown");
  const photographs = [...document.querySelectorAll("section.photograph")];
  const apply = () => {
    const words = named.value.trim().toLowerCase();
    let count = 0;
    for (const section of photographs) {
      const fits = (!show.value || section.dataset.verdict === show.value) &&
        section.id.toLowerCase().includes(words);
      section.hidden = !fits;
      count += fits ? 1 : 0;
    }
    shown.textContent = count + " of " + photographs.length;
  };
  show.addEventListener("change", apply);
  named.addEventListener("input", apply);
  // A link to a photograph that is not shown shows all again.
  addEventListener("hashchange", () => {
    const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (!target || !target.hidden) return;
    show.value = "";
    named.value = "";
    apply();
    target.scrollIntoView();
  });
  filter.hidden = false;
}
document.documentElement.dataset.ready = "1";
